"""How well the robot is led to landmarks, around closed doors, and finds itself when carried away.

    python benchmarks/bench_leading.py [--maps PLAN ...] [--buildings N] [--seeds N] [--errands N]
                                       [--doors N] [--kidnaps N] [--parts PART ...] [--jobs N]

Odometry is 5 % off. In each building, generated ones and floor plans in the format of `ssrics
bench designators --maps`, the robot explores, and then

* *goto*: is sent to landmarks drawn at random, one after the other;
* *closed door*: is sent to a landmark, a doorway on the shortest way to it having been shut, where
  another way is open;
* *kidnapped*: is put down at random places of another drive, again and again, and goes on from
  there until it has marked four different places. The end of that drive, where it does not pass
  four landmarks any more, is left out: it says nothing of whether four are enough.

Reached is an errand that the model takes for reached, its end truly within 1 m of where the
landmark was declared. Located is a robot whose first recognition among these is right.
"""

from __future__ import annotations

import argparse
import math
import os
import sys
from collections import Counter
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ssrics_like.bench.conditions import NOMINAL
from ssrics_like.bench.drives import OnPlan, Simulated, Stage, stage
from ssrics_like.comparison.proportions import wilson
from ssrics_like.decision import Decision
from ssrics_like.memory.routes import shortest_routes
from ssrics_like.model import CognitiveModel
from ssrics_like.perception.observation import Observation, Pose
from ssrics_like.results.records import MARKS
from ssrics_like.scenarios.modules import load_memory, load_perception, load_productions
from ssrics_like.wayfinding import Errand
from ssrics_like.world.disturbances import DoorChange
from ssrics_like.world.doors import door_leaf
from ssrics_like.world.exploration import Exploration
from ssrics_like.world.grid import OCCUPIED, GridMap
from ssrics_like.world.leading import Lead
from ssrics_like.world.navigation import Navigator
from ssrics_like.world.reachable import reachable

Spec = Simulated | OnPlan
DRIFT = 0.05
PURPOSE = 3  # buildings of their own, in which nothing was tuned
REACHED_M, SAME_M, AWAY_M, PASSED_M = 1.0, 1.0, 3.0, 0.5
FOUR = 4
ENOUGH_SCANS = 3000  # after a kidnap; then what was marked counts


class Mind:
    """A model on its journey, and the truth about its landmarks."""

    def __init__(self) -> None:
        self.model = CognitiveModel(
            load_perception("human-like"), load_productions("wayfinding"), load_memory("act-r")
        )
        self.places: dict[str, Pose] = {}

    def observe(self, observation: Observation) -> list[Decision]:
        decisions = self.model.observe(observation)
        for d in decisions:
            if d.decision == "declared":
                self.places[d.landmark] = d.true_pose
        return decisions


class Errands(Lead):
    """A leg whose landmark is drawn when its turn has come."""

    def __init__(self, mind: Mind, draw: Callable[[], str]) -> None:
        super().__init__("?")
        self.guide = mind.model.wayfinder
        self._draw = draw

    def begin(self, navigator: Navigator, t_s: float) -> None:
        self._errand = self._draw()
        super().begin(navigator, t_s)


def led(
    there: Stage, mind: Mind, draw: Callable[[], str], errands: int,
    doors: Sequence[DoorChange] = (),
) -> list[str]:  # fmt: skip
    """Explore, go on errands, and say of each how it went."""
    drive = there.simulation([Exploration(), *(Errands(mind, draw) for _ in range(errands))],
                             doors=doors)  # fmt: skip
    found = []
    way = mind.model.wayfinder
    for observation in drive:
        mind.observe(observation)
        if len(found) < len(way.errands) and way.errands[-1].outcome:
            found.append(judged(way.errands[-1], mind, observation.true_pose))
    return found + ["unfinished"] * (errands - len(found))


def judged(errand: Errand, mind: Mind, here: Pose) -> str:
    if errand.outcome != "reached":
        return f"failed: {errand.reason.partition(',')[0]}"
    return "reached" if here.distance_m(mind.places[errand.goal]) <= REACHED_M else "elsewhere"


def gone_to(spec: Spec, errands: int) -> Counter:
    """Send a robot to landmarks drawn at random."""
    mind, rng = Mind(), np.random.default_rng((7, spec.seed))
    names = lambda: list(mind.model.topological) or ["L1"]  # noqa: E731
    return Counter(led(stage(spec), mind, lambda: str(rng.choice(names())), errands))


def around_doors(spec: Spec, doors: int) -> Counter:
    """Send a robot to landmarks with a doorway shut on the way, where there is another way."""
    there, before = stage(spec), Mind()
    drive = there.simulation([Exploration()])
    for observation in drive:
        before.observe(observation)
    rng, found = np.random.default_rng((8, spec.seed)), Counter()
    for door, goal in obstructed(there, before, drive.pose, rng)[:doors]:
        mind = Mind()
        change = DoorChange(drive.t_s, door, closed=True)
        found.update(led(there, mind, lambda goal=goal: goal, 1, doors=(change,)))
    return found


def obstructed(
    there: Stage, mind: Mind, here: Pose, rng: np.random.Generator
) -> list[tuple[np.ndarray, str]]:
    """Find doorways that lie on the shortest way to a landmark which has another way as well."""
    known = mind.model.wayfinder._last_met()  # noqa: SLF001 - where the route will begin
    routes = shortest_routes(mind.model.topological.arcs, known)
    found = []
    for location in there.locations:
        if location.kind != "doorway":
            continue
        x_m, y_m = there.grid.points_in_grid([(location.x_m, location.y_m)])[0].tolist()
        at = [n for n, p in mind.places.items()
              if math.hypot(p.x_m - location.x_m, p.y_m - location.y_m) < SAME_M]  # fmt: skip
        leaf = door_leaf(there.grid, x_m, y_m)
        cells = there.grid.cells.copy()
        cells[leaf] = OCCUPIED
        shut = GridMap(cells, there.grid.cell_m, there.grid.origin)
        free = reachable(shut, here.x_m, here.y_m, there.robot.radius_m)
        for name, route in routes.items():
            place = there.grid.pose_in_grid(mind.places[name])
            row, column = there.grid.cell_of(place.x_m, place.y_m)
            if set(at) & set(route.landmarks[:-1]) and name not in at and free[row, column]:
                found.append((leaf, name))
    return [found[i] for i in rng.permutation(len(found)).tolist()]


def put_down(spec: Spec, other: Spec, kidnaps: int) -> Counter:
    """Carry a robot to random places of another drive."""
    mind = Mind()
    last = None
    for last in stage(spec).simulation([Exploration()]):
        mind.observe(last)
    drive = list(stage(other).simulation([Exploration()]))
    rng, found = np.random.default_rng((9, spec.seed)), Counter()
    t_s, index = last.t_s, last.index
    ahead = scans_with_four_ahead(drive, mind)
    while ahead and sum(found.values()) < kidnaps:
        i = int(rng.integers(ahead))
        if drive[i].true_pose.distance_m(last.true_pose) < AWAY_M:
            continue
        origin, at, carried_s = last.pose, drive[i].pose, t_s
        marks: list[str] = []
        places: list[Pose] = []
        for o in drive[i : i + ENOUGH_SCANS]:
            t_s, index = t_s + 0.1, index + 1
            last = replace(o, index=index, t_s=t_s, pose=origin.onward(o.pose.seen_from(at)))
            for d in mind.observe(last):
                if d.decision not in MARKS or d.t_s <= carried_s:
                    continue
                marks.append(judged_mark(d, mind))
                if all(d.true_pose.distance_m(place) > SAME_M for place in places):
                    places.append(d.true_pose)
            if len(places) >= FOUR or {"located", "wrong"} & set(marks):
                break
        found[next((m for m in marks if m in ("located", "wrong")), "unknown")] += 1
    return found


def scans_with_four_ahead(drive: list[Observation], mind: Mind) -> int:
    """Return for how many scans, from the first one on, a drive goes on through four landmarks.

    0 for a drive through fewer; there are no trials then, and the number told is less.
    """
    path_m = np.array([(o.true_pose.x_m, o.true_pose.y_m) for o in drive])
    passed = [np.flatnonzero(np.hypot(*(path_m - (place.x_m, place.y_m)).T) < PASSED_M)
              for place in mind.places.values()]  # fmt: skip
    last = sorted(int(scans[-1]) for scans in passed if len(scans))
    return last[-FOUR] if len(last) >= FOUR else 0


def judged_mark(decision: Decision, mind: Mind) -> str:
    if decision.decision != "recognised":
        return decision.decision
    near = decision.true_pose.distance_m(mind.places[decision.landmark]) <= SAME_M
    return "located" if near else "wrong"


@dataclass(frozen=True)
class Trial:
    part: str
    course: str
    spec: Spec
    other: Spec
    count: int


def carried_out(trial: Trial) -> tuple[Trial, Counter]:
    if trial.part == "goto":
        return trial, gone_to(trial.spec, trial.count)
    if trial.part == "closed door":
        return trial, around_doors(trial.spec, trial.count)
    return trial, put_down(trial.spec, trial.other, trial.count)


def trials(options: argparse.Namespace) -> list[Trial]:
    drifting = replace(NOMINAL, drift=DRIFT)
    places: list[tuple[str, Spec, Spec]] = [
        ("generated", Simulated(drifting, seed, PURPOSE), Simulated(drifting, seed, PURPOSE, 1))
        for seed in range(options.buildings)
    ]
    places += [("plans", OnPlan(plan, 3000 + 2 * seed, drifting),
                OnPlan(plan, 3001 + 2 * seed, drifting))
               for plan in options.maps for seed in range(options.seeds)]  # fmt: skip
    counts = {"goto": options.errands, "closed door": options.doors, "kidnapped": options.kidnaps}
    return [Trial(part, *place, counts[part]) for part in options.parts for place in places]


def counted(all_trials: list[Trial], jobs: int | None) -> dict[tuple[str, str], Counter]:
    """Carry out all trials; how they went, by part and course."""
    total: dict[tuple[str, str], Counter] = {}
    with ProcessPoolExecutor(jobs) as pool:
        for trial, found in pool.map(carried_out, all_trials):
            where = trial.spec.folder.name if isinstance(trial.spec, OnPlan) else trial.spec.seed
            print(trial.part, trial.course, where, dict(found), file=sys.stderr, flush=True)
            total.setdefault((trial.part, trial.course), Counter()).update(found)
    return total


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--maps", nargs="*", type=Path, default=[])
    parser.add_argument("--buildings", type=int, default=10)
    parser.add_argument("--seeds", type=int, default=1)
    parser.add_argument("--errands", type=int, default=28)
    parser.add_argument("--doors", type=int, default=3)
    parser.add_argument("--kidnaps", type=int, default=25)
    parser.add_argument("--parts", nargs="+", default=["goto", "closed door", "kidnapped"])
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    options = parser.parse_args()
    total = counted(trials(options), options.jobs)
    print("| trial | course | trials | reached or located | 95 % | otherwise |")
    print("|---|---|---|---|---|---|")
    for (part, course), found in total.items():
        n, right = sum(found.values()), found["reached"] + found["located"]
        low, high = wilson(right, n)
        good = ("reached", "located")
        rest = ", ".join(f"{c} {k}" for k, c in found.most_common() if k not in good)
        share = 100 * right / n if n else math.nan
        print(f"| {part} | {course} | {n} | {share:.1f} % | {100 * low:.1f}–{100 * high:.1f} % "
              f"| {rest or 'none'} |")  # fmt: skip
    return 0


if __name__ == "__main__":
    sys.exit(main())
