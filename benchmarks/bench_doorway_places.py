"""Where a doorway is perceived, against where it is.

    python benchmarks/bench_doorway_places.py [--maps PLAN ...] [--buildings N]

Each reflex at a doorway is compared with the nearest doorway of the plan: how far its middle is
off, and how far its direction is turned, half a turn being no difference. So are two simpler
answers: the one shortest line from jamb to jamb through any place within 0.4 m of the robot's way,
and just where the robot was, and where it headed. Left out are those that have no direction, and
those that were fired more than 1.2 m from any doorway; how many is told.
"""

from __future__ import annotations

import math
import sys

import numpy as np
from bench_views import asked_for
from numpy.typing import NDArray

from ssrics_like.bench.drives import make_drive, stage
from ssrics_like.cues import read_cue
from ssrics_like.library import find_cue
from ssrics_like.perception import Observation, PerceptionBuffer, Pose
from ssrics_like.perception.conditioning import condition
from ssrics_like.perception.reflex import Reflex
from ssrics_like.perception.sights import NECK_M, WIDTH
from ssrics_like.perception.surroundings import Described, Surroundings
from ssrics_like.scenarios.modules import load_perception

NEAR_M = 1.2  # what is perceived farther from any doorway is none of them
FAR_OFF_M = 0.3
ANSWERS = ("as perceived", "one line", "the robot")

Errors = tuple[float, float]


def answers(observations: tuple[Observation, ...]) -> list[tuple[Reflex, list[Pose]]]:
    """Return the reflexes at doorways, and where each answer has the doorway; true frame.

    A reflex without a direction has no answers.
    """
    profile = load_perception("human-like")
    profile = profile.model_copy(update={"structure": "", "egomotion": "odometry"})
    buffer = PerceptionBuffer(profile, read_cue(find_cue(profile.doorways)))
    fired = [r for o in observations for r in buffer.update(o)] + buffer.flush()
    surroundings: Surroundings[Observation] = Surroundings()
    places: list[Described[Observation]] = []
    for o in observations:
        ranges_m = condition(o.scan.ranges_m, profile.range_cap_m, profile.repair_window).ranges_m
        places += surroundings.update(o.pose, o.scan.bearings_rad, ranges_m, o)
    at_m = np.array([each.place.at_m for each in places])
    found: list[tuple[Reflex, list[Pose]]] = []
    for reflex in fired:
        if reflex.structure != "doorway":
            continue
        if not reflex.directed:
            found.append((reflex, []))
            continue
        near = np.flatnonzero(np.abs(at_m - reflex.travelled_m) <= NECK_M)
        line = min((places[i] for i in near), key=lambda each: float(each.measures[WIDTH])).gap
        seen = [pose.seen_from(reflex.pose) for pose in (reflex.place, line, reflex.pose)]
        assert reflex.true_pose is not None
        found.append((reflex, [reflex.true_pose.onward(pose) for pose in seen]))
    return found


def errors(pose: Pose, lines_m: NDArray[np.float64]) -> Errors:
    """Tell how far a pose is off from the nearest doorway, metres, and how far it is turned."""
    middles = lines_m.mean(axis=1)
    off_m = np.hypot(*(middles - (pose.x_m, pose.y_m)).T)
    nearest = int(off_m.argmin())
    along_x, along_y = lines_m[nearest, 1] - lines_m[nearest, 0]
    through_rad = math.atan2(along_y, along_x) + math.pi / 2
    return float(off_m[nearest]), abs(math.remainder(pose.theta_rad - through_rad, math.pi))


def main() -> int:
    found: dict[str, list[Errors]] = {answer: [] for answer in ANSWERS}
    undirected = elsewhere = 0
    for spec in asked_for(__doc__):
        lines_m = stage(spec).lines_m
        lines_m = lines_m[np.isfinite(lines_m).all(axis=(1, 2))]  # other places have none
        for reflex, poses in answers(make_drive(spec).observations):
            assert reflex.true_pose is not None
            if errors(reflex.true_pose, lines_m)[0] >= NEAR_M:
                elsewhere += 1
            elif not poses:
                undirected += 1
            else:
                for answer, pose in zip(ANSWERS, poses, strict=True):
                    found[answer].append(errors(pose, lines_m))
    if not found[ANSWERS[0]]:
        sys.exit("no doorway was perceived with a direction")
    print(
        "| doorway | n | off, median | a tenth above | > 0.3 m | turned, median | a tenth above |"
    )
    print("|---|---|---|---|---|---|---|")
    for answer, rows in found.items():
        off_m, turned_rad = np.array(rows).T
        (off, far), (turned, askew) = (
            np.quantile(each, [0.5, 0.9]) for each in (off_m, turned_rad)
        )
        share = 100 * np.mean(off_m > FAR_OFF_M)
        print(
            f"| {answer} | {len(rows)} | {off:.2f} m | {far:.2f} m | {share:.1f} % "
            f"| {turned:.2f} rad | {askew:.2f} rad |"
        )
    print(f"\nLeft out: {undirected} without a direction, {elsewhere} at no doorway of the plan.")
    return 0


if __name__ == "__main__":
    sys.exit(main())
