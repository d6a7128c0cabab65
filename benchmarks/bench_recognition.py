"""How well landmarks are known again on a first and a second visit, with odometry 5 % off.

    python benchmarks/bench_recognition.py [--maps PLAN ...] [--log LOG LABELS] [--buildings N]
                                           [--seeds N] [--jobs N]

Generated buildings, and floor plans in the format of `ssrics bench designators --maps`, are
explored from a place drawn at random; then with the memory of that visit twice more: from another
place, without knowing where in it the robot is, and from home, where the first visit began. Misled
is a robot that is told that it begins at home, on the drive from the other place. A log is driven
once. The same reflexes are
given to two plain matchers: one that takes the nearest landmark within 1.5 m as odometry has it,
and one that takes the landmark whose view correlates most, .8 or more.
"""

from __future__ import annotations

import argparse
import copy
import functools
import os
import sys
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ssrics_like.bench.conditions import NOMINAL
from ssrics_like.bench.drives import BenchDrive, OfLog, OnPlan, Simulated, make_drive
from ssrics_like.comparison.recognition import Marked, Recogniser, RecognitionTally
from ssrics_like.cues import read_cue
from ssrics_like.library import find, find_cue
from ssrics_like.model import CognitiveModel
from ssrics_like.perception import PerceptionBuffer
from ssrics_like.perception.reflex import Reflex
from ssrics_like.productions.rulebook import load_rulebook
from ssrics_like.results.records import MARKS
from ssrics_like.scenarios.modules import load_memory, load_perception

DRIFT = 0.05
PURPOSE = 3  # buildings of their own, in which nothing was tuned
WITHIN_M, ALIKE = 1.5, 0.8
MISLED = "2 misled"
VISITS = ("1", "2", "2 from home", MISLED)
AT_HOME = VISITS[2:]
MODELS = ("human-like + landmark", "nearest by odometry", "nearest view")


@dataclass(frozen=True)
class Visits:
    """Drives through one building: a first visit, and others with its memory.

    Attributes
    ----------
    course : str
        What kind of building.
    drives : tuple
        One for each of `VISITS`, or the first alone.
    """

    course: str
    drives: tuple[Simulated | OnPlan | OfLog, ...]


def by_the_model(drives: list[BenchDrive]) -> list[RecognitionTally]:
    """Let the model go through all drives, the others with the memory of the first."""
    first, remembered, tallies = Recogniser(places_of(drives[0])), None, []
    for visit, drive in zip(VISITS, drives, strict=False):
        model = CognitiveModel(
            load_perception("human-like"), load_rulebook(find("productions", "landmark")),
            load_memory("act-r"), frame=drive.frame, remembered=remembered,
            at_home=visit in AT_HOME,
        )  # fmt: skip
        decisions = [d for o in drive.observations for d in model.observe(o)] + model.finish()
        index = {o.index: i for i, o in enumerate(drive.observations)}
        marks = [
            Marked(*drive.way.xy_m[index[d.scan]].tolist(), d.decision, d.landmark)
            for d in sorted(decisions, key=lambda d: d.event)
            if d.decision in MARKS
        ]
        # Each later visit is told from the first alone, whose places it therefore gets a copy of.
        recogniser = first if remembered is None else copy.deepcopy(first)
        tallies.append(recogniser.count(marks))
        remembered = remembered or model.saved_memory("first")
    return tallies


def by_matching(drives: list[BenchDrive], *, view: bool) -> list[RecognitionTally]:
    """Match the same reflexes plainly."""
    first, at_first, tallies = Recogniser(places_of(drives[0])), [], []
    for drive in drives:
        marks, known = [], list(at_first)
        index = {o.index: i for i, o in enumerate(drive.observations)}
        for reflex in reflexes(drive):
            name = nearest(known, reflex, view=view)
            decision = "recognised" if name else "declared"
            if not name:
                name = f"L{len(known) + 1}"
                known.append((name, reflex))
            marks.append(Marked(*drive.way.xy_m[index[reflex.scan]].tolist(), decision, name))
        recogniser = copy.deepcopy(first) if tallies else first
        tallies.append(recogniser.count(marks))
        at_first = at_first or known
    return tallies


def nearest(known: list[tuple[str, Reflex]], reflex: Reflex, *, view: bool) -> str:
    """Return the landmark that is nearest, if it is near enough."""
    if not known:
        return ""
    if view:
        likeness = [float(np.dot(reflex.view, other.view)) for _, other in known]
        best = int(np.argmax(likeness))
        return known[best][0] if likeness[best] >= ALIKE else ""
    distance = [reflex.pose.distance_m(other.pose) for _, other in known]
    best = int(np.argmin(distance))
    return known[best][0] if distance[best] <= WITHIN_M else ""


def reflexes(drive: BenchDrive) -> list[Reflex]:
    """Return the reflexes at doorways, which the default rules mark, with scans as their views."""
    profile = load_perception("human-like").model_copy(update={"structure": "", "view": "scan"})
    buffer = PerceptionBuffer(profile, read_cue(find_cue(profile.doorways)))
    fired = [r for o in drive.observations for r in buffer.update(o)] + buffer.flush()
    return [reflex for reflex in fired if reflex.structure == "doorway"]


def places_of(drive: BenchDrive) -> np.ndarray:
    return np.array([(place.x_m, place.y_m) for place in drive.locations]).reshape(-1, 2)


def visited(visits: Visits) -> tuple[str, list[list[RecognitionTally]]]:
    """Go through a building by each model; the counts of each visit."""
    drives = list(map(functools.cache(make_drive), visits.drives))  # one of them stands there twice
    return visits.course, [
        by_the_model(drives), by_matching(drives, view=False), by_matching(drives, view=True)
    ]  # fmt: skip


def tallied(visits: list[Visits], jobs: int | None) -> dict[tuple[str, int, int], RecognitionTally]:
    """Go through all buildings; counts by course, visit and model (index into MODELS)."""
    total: dict[tuple[str, int, int], RecognitionTally] = {}
    with ProcessPoolExecutor(jobs) as pool:
        for course, models in pool.map(visited, visits):
            for model, tallies in enumerate(models):
                for visit, tally in enumerate(tallies):
                    key = (course, visit, model)
                    total[key] = total.get(key, RecognitionTally()) + tally
    return total


def courses(options: argparse.Namespace) -> list[Visits]:
    drifting = replace(NOMINAL, drift=DRIFT)
    made = [
        Visits("generated", tuple(
            Simulated(drifting, seed, PURPOSE, visit, visit == 2) for visit in (0, 1, 2, 1)
        ))
        for seed in range(options.buildings)
    ]  # fmt: skip
    made += [
        Visits("plans", (
            OnPlan(plan, 2 * seed + 1000, drifting),
            OnPlan(plan, 2 * seed + 1001, drifting),
            OnPlan(plan, 2 * seed + 100_001, drifting, begun=2 * seed + 1000),
            OnPlan(plan, 2 * seed + 1001, drifting),
        ))
        for plan in options.maps for seed in range(options.seeds)
    ]  # fmt: skip
    if options.log:
        made.append(Visits("log", (OfLog(*options.log),)))
    return made


def percent(value: float, interval: tuple[float, float] | None = None) -> str:
    if np.isnan(value):
        return "–"
    text = f"{100 * value:.1f} %"
    return f"{text} ({100 * interval[0]:.1f}–{100 * interval[1]:.1f})" if interval else text


def row(tally: RecognitionTally) -> list[str]:
    return [
        str(tally.marks), str(tally.again), percent(tally.recall, tally.recall_interval),
        percent(tally.wrong_share, tally.wrong_interval), percent(tally.new_share),
        percent(tally.unsure / tally.marks if tally.marks else float("nan")),
        f"{tally.landmarks_per_place:.2f}",
    ]  # fmt: skip


HEAD = ["course", "visit", "by", "marks", "at known places", "recognised rightly", "wrong",
        "new", "unsure", "landmarks a place"]  # fmt: skip


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--maps", nargs="*", type=Path, default=[])
    parser.add_argument("--log", nargs=2, type=Path)
    parser.add_argument("--buildings", type=int, default=20)
    parser.add_argument("--seeds", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    options = parser.parse_args()
    total = tallied(courses(options), options.jobs)
    print("| " + " | ".join(HEAD) + " |")
    print("|" + "---|" * len(HEAD))
    for (course, visit, model), tally in total.items():
        print("| " + " | ".join([course, VISITS[visit], MODELS[model], *row(tally)]) + " |")
    return 0


if __name__ == "__main__":
    sys.exit(main())
