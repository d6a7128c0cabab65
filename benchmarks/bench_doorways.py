"""What it costs to see doorways and other structure, a scan on one core; ways round against scipy.

    python benchmarks/bench_doorways.py [--scans N] [--gaps N] [--repeats N]

A run of the scenario `complex` is driven. Its scans are perceived with the default profile, and
with the profile `report` to compare with. The way round a sample of its gaps is then asked of
`scipy.sparse.csgraph.dijkstra`, on a graph of the local map's cells. The exit code is 1 if a way
is not as long.
"""

from __future__ import annotations

import argparse
import itertools
import math
import os
import sys
import time
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage, sparse
from scipy.sparse.csgraph import dijkstra

from ssrics_like.cues import read_cue, read_structure_cue
from ssrics_like.library import find, find_cue
from ssrics_like.perception import Observation, PerceptionBuffer, PerceptionProfile, surroundings
from ssrics_like.perception.around_kernels import BESIDE_M, HALF, ROUND_M, SIDE, around
from ssrics_like.perception.frame_kernels import framed, narrowest
from ssrics_like.perception.local_map import MEMORY_M, LocalMap
from ssrics_like.perception.local_map_kernels import CELL_M, OCCUPIED, UNKNOWN, cell_state
from ssrics_like.scenarios.feeds import make_feed
from ssrics_like.scenarios.modules import load_perception
from ssrics_like.scenarios.resolving import load_resolved

CROSS = ndimage.generate_binary_structure(2, 1)


class Gap:
    """A gap as perception met it: the local map then, and the line between the jambs."""

    def __init__(self, local: LocalMap, place: tuple[float, float, float], here_m: float) -> None:
        self.cells = local.evidence.copy(), local.seen_m.copy()
        self.oldest_m = here_m - MEMORY_M
        left_m, right_m, towards = narrowest(*self.cells, place, self.oldest_m)
        self.left = math.cos(towards), math.sin(towards)
        self.middle = framed((place[0], place[1]), self.left, 0.0, 0.5 * (left_m - right_m))
        self.width_m = left_m + right_m

    def by_ours(self) -> tuple[float, float]:
        out = np.empty(8)
        around(*self.cells, self.middle, self.left, self.width_m, self.oldest_m, out, 0)
        return float(out[0]), float(out[1])

    def _line(self, ahead_m: float, width_m: float) -> NDArray[np.bool_]:
        cells = np.zeros((SIDE, SIDE), bool)
        steps = max(math.ceil(width_m / CELL_M) * 4, 1)
        for step in range(steps + 1):
            x, y = framed(self.middle, self.left, ahead_m, width_m * (step / steps - 0.5))
            row, column = (math.floor(v / CELL_M) - math.floor(m / CELL_M) + HALF
                           for v, m in ((y, self.middle[1]), (x, self.middle[0])))  # fmt: skip
            if 0 <= row < SIDE and 0 <= column < SIDE:
                cells[row, column] = True
        return cells

    def lay_out(self) -> None:
        """Draw what scipy's graphs are made of, which is not timed."""
        row, column = (math.floor(v / CELL_M) - HALF for v in (self.middle[1], self.middle[0]))
        self.states = np.array(
            [
                [cell_state(*self.cells, row + r, column + c, self.oldest_m) for c in range(SIDE)]
                for r in range(SIDE)
            ]
        )
        blocked = ndimage.binary_dilation(self.states == OCCUPIED, CROSS)
        self.blocked = blocked | self._line(0.0, self.width_m + 2 * CELL_M)
        self.start, self.goal = (self._line(at, self.width_m) for at in (BESIDE_M, -BESIDE_M))

    def by_scipy(self) -> tuple[float, float]:
        return self._way(self.states != UNKNOWN), self._way(np.ones_like(self.blocked))

    def _way(self, known: NDArray[np.bool_]) -> float:
        passable = known & ~self.blocked
        number = np.where(passable, np.cumsum(passable).reshape(passable.shape) - 1, -1)
        pairs = ((number[1:], number[:-1]), (number[:, 1:], number[:, :-1]))
        ends = [(a[(a >= 0) & (b >= 0)], b[(a >= 0) & (b >= 0)]) for a, b in pairs]
        one, other = (np.concatenate(part) for part in zip(*ends, strict=True))
        count = int(passable.sum())
        graph = sparse.csr_matrix((np.ones(len(one)), (one, other)), shape=(count, count))
        starts = number[self.start & passable & (self.states != UNKNOWN)]
        goals = number[self.goal & passable]
        if not len(starts) or not len(goals):
            return ROUND_M
        steps = dijkstra(graph, False, starts, unweighted=True, min_only=True)[goals].min()
        return min(float(steps) * CELL_M, ROUND_M)


def gaps_of(observations: list[Observation], count: int) -> list[Gap]:
    """Perceive a drive and keep some of the gaps that are described, spread evenly over it."""
    met: list[Gap] = []
    every = max(len(observations) // (3 * count), 1)
    described, numbers = surroundings.gap_features, itertools.count()

    def noted(local: LocalMap, place: Any, here_m: float) -> Any:
        if next(numbers) % every == 0:
            met.append(Gap(local, place, here_m))
        return described(local, place, here_m)

    surroundings.gap_features = noted
    try:
        perceive(observations, load_perception("human-like"))
    finally:
        surroundings.gap_features = described
    return [met[i] for i in np.linspace(0, len(met) - 1, min(count, len(met))).astype(int)]


def perceive(observations: list[Observation], profile: PerceptionProfile) -> NDArray[np.float64]:
    """Return the seconds that each scan takes."""
    cue = read_cue(find_cue(profile.doorways)) if profile.doorways else None
    structure = read_structure_cue(find_cue(profile.structure)) if profile.structure else None
    buffer, seconds = PerceptionBuffer(profile, cue, structure), []
    for observation in observations:
        start = time.perf_counter()
        buffer.update(observation)
        seconds.append(time.perf_counter() - start)
    return np.array(seconds)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument(
        "--scans", type=int, default=5000, help="how many of the run's are perceived"
    )
    parser.add_argument("--gaps", type=int, default=200, help="how many of its gaps are asked")
    parser.add_argument("--repeats", type=int, default=5)
    arguments = parser.parse_args()
    feed = make_feed(load_resolved(find("scenarios", "complex")), 0)
    observations = list(itertools.islice(feed, arguments.scans))
    gaps = gaps_of(observations, arguments.gaps)  # which also compiles
    print(
        f"{len(observations)} scans of a run, {len(gaps)} of its gaps; {arguments.repeats} "
        f"repeats, load {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores\n"
    )
    print("| perceiving a scan | mean, ms | 99 of 100 within, ms | times as long |")
    print("|---|---|---|---|")
    means: list[float] = []
    usual = load_perception("human-like")
    profiles = {
        "profile `human-like`": usual,
        "without `structure`": usual.model_copy(update={"structure": ""}),
        "profile `report`": load_perception("report"),
    }
    for name, profile in profiles.items():
        perceive(observations[:200], profile)
        # The least of the repeats for each scan: what else the machine does is not perception's.
        each = np.min([perceive(observations, profile) for _ in range(arguments.repeats)], axis=0)
        means.append(float(each.mean()))
        print(
            f"| {name} | {1e3 * means[-1]:.3f} | {1e3 * np.percentile(each, 99):.3f} "
            f"| {means[-1] / means[0]:.2f} |"
        )
    for gap in gaps:
        gap.lay_out()
    gaps[0].by_ours()  # compiles
    taken: dict[str, list[float]] = {"`around`": [], "scipy dijkstra, with building the graph": []}
    for _ in range(arguments.repeats):
        for name, seconds in taken.items():
            start = time.perf_counter()
            found = [gap.by_ours() if name == "`around`" else gap.by_scipy() for gap in gaps]
            seconds.append((time.perf_counter() - start) / len(gaps))
            if name == "`around`":
                ours = found
    print("\n| the ways round a gap | ms | times as long |")
    print("|---|---|---|")
    medians = {name: float(np.median(seconds)) for name, seconds in taken.items()}
    for name, median in medians.items():
        print(f"| {name} | {1e3 * median:.3f} | {median / medians['`around`']:.0f} |")
    same = np.allclose(ours, found)
    print(f"\nways round the {len(gaps)} gaps: {'same' if same else 'DIFFERENT'}")
    return 0 if same else 1


if __name__ == "__main__":
    sys.exit(main())
