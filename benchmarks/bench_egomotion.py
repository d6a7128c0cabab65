"""How far path integration goes astray: matching scans against wheels alone, on the same drives.

    python benchmarks/bench_egomotion.py [--maps PLAN ...] [--buildings N] [--drift SHARE]
                                         [--log LOG [LABELS]] ...

The error is that of the pose after 20 m of path, seen from where these began, over all stretches of
a drive that begin 5 m apart. The time is that of one scan, on one core. Then the robot is set down
somewhere else on the same drive, 3 m away or more, again and again, while its wheels count on. Logs
of real robots, with labels that hold their true poses, or without, follow one by one.
"""

from __future__ import annotations

import argparse
import csv
import itertools
import math
import sys
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ssrics_like.bench.conditions import NOMINAL
from ssrics_like.bench.drives import OnPlan, Simulated, make_drive
from ssrics_like.perception import Observation
from ssrics_like.perception.egomotion import Egomotion
from ssrics_like.poses import Pose
from ssrics_like.sources import open_log

STRETCH_M, APART_M = 20.0, 5.0
CARRIED, AWAY_M, SCANS = 20, 3.0, 10  # times a drive; how far; scans before it and after
PURPOSE = 3  # buildings of their own, in which nothing was tuned


def errors(poses: list[Pose], truth: list[Pose]) -> NDArray[np.float64]:
    """Return metres and degrees of error after each stretch, shape (stretches, 2)."""
    steps = [one.distance_m(other) for one, other in itertools.pairwise(truth)]
    along = np.concatenate([[0.0], np.cumsum(steps)])
    found: list[tuple[float, float]] = []
    for start_m in np.arange(0.0, along[-1] - STRETCH_M, APART_M):
        i, j = np.searchsorted(along, [start_m, start_m + STRETCH_M])
        ours, theirs = (way[j].seen_from(way[i]) for way in (poses, truth))
        turned = math.remainder(ours.theta_rad - theirs.theta_rad, math.tau)
        found.append((ours.distance_m(theirs), math.degrees(abs(turned))))
    return np.array(found).reshape(-1, 2)


def noticed(observations: tuple[Observation, ...], rng: np.random.Generator) -> list[bool]:
    """Carry the robot to random places of its drive; tell each time whether it notices."""
    found = []
    while len(found) < CARRIED:
        i, j = rng.integers(SCANS, len(observations) - SCANS, 2).tolist()
        here, there = observations[i], observations[j]
        if here.true_pose.distance_m(there.true_pose) < AWAY_M:
            continue
        egomotion = Egomotion()
        for o in observations[i - SCANS : i + 1]:
            egomotion.update(o.pose, o.scan.bearings_rad, o.scan.ranges_m)
        for o in observations[j : j + SCANS]:
            pose = here.pose.onward(o.pose.seen_from(there.pose))
            egomotion.update(pose, o.scan.bearings_rad, o.scan.ranges_m)
        found.append(egomotion.carried > 0)
    return found


def logged(log: Path, labels: Path | None) -> str:
    """Tell how far the path integration of a real robot went astray."""
    observations = list(open_log(log))
    egomotion = Egomotion()
    matched = [egomotion.update(o.pose, o.scan.bearings_rad, o.scan.ranges_m) for o in observations]
    said = f"{log.name}: carried {egomotion.carried} times in {len(observations)} scans"
    if labels is None:
        return said
    with (labels / "poses.csv").open() as lines:
        truth = [
            Pose(float(row["x_m"]), float(row["y_m"]), float(row["theta_rad"]))
            for row in csv.DictReader(lines)
        ]
    for name, poses in (("wheels", [o.pose for o in observations]), ("scans", matched)):
        metres, degrees = np.percentile(errors(poses, truth), [50, 95], axis=0).T
        said += (
            f"; by {name} {metres[0]:.2f} and {metres[1]:.2f} m, "
            f"{degrees[0]:.1f} and {degrees[1]:.1f} degrees"
        )
    return said


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--maps", nargs="*", type=Path, default=[])
    parser.add_argument("--buildings", type=int, default=10)
    parser.add_argument("--drift", type=float, default=0.05)
    parser.add_argument("--log", nargs="+", type=Path, action="append", default=[])
    options = parser.parse_args()
    for log in options.log:
        print(logged(log[0], log[1] if len(log) > 1 else None), flush=True)
    condition = replace(NOMINAL, drift=options.drift)
    specs: list[Simulated | OnPlan] = [
        Simulated(condition, seed, PURPOSE) for seed in range(options.buildings)
    ]
    specs += [OnPlan(plan, 1000, condition) for plan in options.maps]
    matched, wheels, seconds, false, right = [], [], [], 0, []
    rng = np.random.default_rng(0)
    for spec in specs:
        observations = make_drive(spec).observations
        egomotion, poses = Egomotion(), []
        for o in observations:
            start = time.perf_counter()
            poses.append(egomotion.update(o.pose, o.scan.bearings_rad, o.scan.ranges_m))
            seconds.append(time.perf_counter() - start)
        false += egomotion.carried
        right += noticed(observations, rng)
        truth = [o.true_pose for o in observations if o.true_pose is not None]
        matched.append(errors(poses, truth))
        wheels.append(errors([o.pose for o in observations], truth))
    print(f"{len(specs)} drives, odometry {100 * options.drift:g} % off, after {STRETCH_M:g} m:")
    for name, parts in (("wheels alone", wheels), ("scans matched", matched)):
        metres, degrees = (np.percentile(np.concatenate(parts), [50, 95], axis=0)).T
        print(
            f"  {name}: {metres[0]:.2f} m in the middle, {metres[1]:.2f} m in 95 % of the "
            f"stretches; {degrees[0]:.1f} and {degrees[1]:.1f} degrees"
        )
    ratio = np.median(np.concatenate(wheels)[:, 0]) / np.median(np.concatenate(matched)[:, 0])
    print(f"  ratio {ratio:.1f}")
    print(f"matching a scan: {1e3 * np.median(seconds):.2f} ms")
    print(
        f"carried away: noticed {sum(right)} times of {len(right)}; without reason {false} times "
        f"in {len(seconds)} scans"
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
