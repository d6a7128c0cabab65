"""By what a doorway is known again: what surrounds it, against the scan taken in it.

    python benchmarks/bench_views.py [--maps PLAN ...] [--buildings N]

Of each two reflexes at doorways of one drive, the agreement of their surroundings and the
correlation of their scans are compared: of the same doorway gone through the same way, or the
other way, and of different ones. The less often different doorways look as alike as half of the
pairs of the same one do, the better a view tells. Of the pairs that are alike near by it is told
how often their vistas contradict, too.
"""

from __future__ import annotations

import argparse
import math
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np

from ssrics_like.bench.conditions import NOMINAL
from ssrics_like.bench.drives import BenchDrive, OnPlan, Simulated, make_drive
from ssrics_like.cues import read_cue
from ssrics_like.library import find_cue
from ssrics_like.memory.surroundings import SIDES, agreement, both_sides, by_direction
from ssrics_like.perception import PerceptionBuffer
from ssrics_like.perception.reflex import Reflex
from ssrics_like.scenarios.modules import load_perception

PURPOSE = 3  # buildings of their own, in which nothing was tuned
SAME_M, OTHER_M = 0.7, 1.2
SAME_RAD, BACK_RAD = 0.6, 2.5
ALIKE = 0.7
"""Share of directions in which what surrounds two places that are alike agrees."""
VIEWS = ("surroundings", "scan", "vista")
PAIRS = ("the same, the same way", "the same, the other way", "different")


def doorways(drive: BenchDrive, view: str) -> list[Reflex]:
    """Return the reflexes at doorways, with one kind of view."""
    profile = load_perception("human-like").model_copy(update={"structure": "", "view": view})
    buffer = PerceptionBuffer(profile, read_cue(find_cue(profile.doorways)))
    fired = [r for o in drive.observations for r in buffer.update(o)] + buffer.flush()
    return [r for r in fired if r.structure == "doorway" and r.directed]


def pair_of(one: Reflex, other: Reflex) -> str | None:
    """Tell what two reflexes have in common; None for what is neither the same nor different."""
    assert one.true_pose is not None
    assert other.true_pose is not None
    away_m = one.true_pose.distance_m(other.true_pose)
    turn_rad = abs(math.remainder(one.true_pose.theta_rad - other.true_pose.theta_rad, math.tau))
    if away_m > OTHER_M:
        return "different"
    if away_m < SAME_M and turn_rad < SAME_RAD:
        return PAIRS[0]
    return PAIRS[1] if away_m < SAME_M and turn_rad > BACK_RAD else None


def compared(drive: BenchDrive, found: dict[str, dict[str, list[float]]]) -> None:
    """Add the pairs of a drive."""
    around, scans = doorways(drive, "surroundings"), doorways(drive, "scan")
    for i, one in enumerate(around):
        if not i:
            continue
        others = np.array([other.view for other in around[:i]])
        alike, sides = agreement(one.view, others), both_sides(one.view, by_direction(others))
        likely = sides.agreeing >= alike - SIDES  # it may look the same from both
        apart = np.where(likely, sides.apart, np.inf).min(axis=0)
        for j, other in enumerate(around[:i]):
            pair = pair_of(one, other)
            if pair is not None and not math.isnan(alike[j]):
                found["surroundings"][pair].append(float(alike[j]))
                found["scan"][pair].append(float(np.dot(scans[i].view, scans[j].view)))
            if pair is not None and alike[j] >= ALIKE:
                found["vista"][pair].append(float(apart[j]))


def asked_for(doc: str) -> list[Simulated | OnPlan]:
    """Return the drives that the command line asks for, odometry 5 % off."""
    parser = argparse.ArgumentParser(description=doc.splitlines()[0])
    parser.add_argument("--maps", nargs="*", type=Path, default=[])
    parser.add_argument("--buildings", type=int, default=10)
    options = parser.parse_args()
    drifting = replace(NOMINAL, drift=0.05)
    specs: list[Simulated | OnPlan] = [
        Simulated(drifting, seed, PURPOSE) for seed in range(options.buildings)
    ]
    return specs + [OnPlan(plan, 1000, drifting) for plan in options.maps]


def main() -> int:
    specs = asked_for(__doc__)
    found = {view: {pair: list[float]() for pair in PAIRS} for view in VIEWS}
    for spec in specs:
        compared(make_drive(spec), found)
    print(
        "| view | pair | pairs | a tenth below | median | different ones as alike as the median |"
    )
    print("|---|---|---|---|---|---|")
    vistas = found.pop("vista")
    for view, pairs in found.items():
        for pair, values in pairs.items():
            low, middle = np.quantile(values, [0.1, 0.5])
            share = np.mean(np.array(pairs["different"]) >= middle)
            said = "" if pair == "different" else f"{100 * share:.1f} %"
            print(f"| {view} | {pair} | {len(values)} | {low:.2f} | {middle:.2f} | {said} |")
    print(
        "\n| alike near by | pairs | nothing contradicts | goes on past an end | an end differs |"
    )
    print("|---|---|---|---|---|")
    for pair, values in vistas.items():
        apart, n = np.array(values), len(values)
        found = [int(which.sum()) for which in (apart == 0, (apart > 0) & (apart < 1), apart == 1)]
        shares = " | ".join(f"{100 * k / n:.0f} %" if n else "–" for k in found)
        print(f"| {pair} | {n} | {shares} |")
    return 0


if __name__ == "__main__":
    sys.exit(main())
