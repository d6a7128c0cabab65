"""Planning on the maps that an exploration meets, against graph libraries, in one run.

    python benchmarks/bench_planning.py [--plans N] [--repeats N]

A run of the scenario `complex` is driven, and what its robot asks of the planner is kept: the
costs of its map, where it stands, the frontiers. A sample of it, evenly spread over the run, is
then asked of `scipy.sparse.csgraph.dijkstra` and, where it can be imported, of
`skimage.graph.MCP_Geometric` (scikit-image, no dependency of this project); the frontiers also
of `scipy.ndimage`. The exit code is 1 if a way does not cost the same.

scipy gets the costs of the package's own search: a step costs 5 straight or 7 askew, times the
price of the cell entered. scikit-image has a rule of its own, the length of a step times the mean
price of its two cells: its ways are checked against scipy's by that rule.
"""

from __future__ import annotations

import argparse
import itertools
import math
import os
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage, sparse
from scipy.sparse.csgraph import dijkstra

from ssrics_like.library import find
from ssrics_like.scenarios.feeds import make_feed
from ssrics_like.scenarios.resolving import load_resolved
from ssrics_like.world import frontier_kernels, way_kernels
from ssrics_like.world.way_kernels import BLOCKED, DIAGONAL, STRAIGHT

try:
    from skimage.graph import MCP_Geometric
except ImportError:
    MCP_Geometric = None

STEPS = [(r, c) for r in (-1, 0, 1) for c in (-1, 0, 1) if r or c]
CROSS, SQUARE = ndimage.generate_binary_structure(2, 1), np.ones((3, 3), bool)

Cells = list[tuple[int, int]]
Costs = Callable[[tuple[int, int], NDArray[Any], NDArray[Any]], NDArray[np.float64]]


def own_rule(step: tuple[int, int], _left: NDArray[Any], entered: NDArray[Any]) -> Any:
    """Return what steps between cells of these prices cost, as `way_kernels` counts."""
    return (DIAGONAL if all(step) else STRAIGHT) * entered.astype(float)


def skimage_rule(step: tuple[int, int], left: NDArray[Any], entered: NDArray[Any]) -> Any:
    """Return the same as `MCP_Geometric` counts."""
    return math.hypot(*step) * (left.astype(float) + entered) / 2


def cost_of(way: Cells, costs: NDArray[np.uint8], rule: Costs) -> float:
    """Add the steps of a way up."""
    total = 0.0
    for (r0, c0), (r1, c1) in itertools.pairwise(way):
        total += float(rule((r1 - r0, c1 - c0), costs[r0, c0], costs[r1, c1]))
    return total


@dataclass(frozen=True)
class Plan:
    """The robot asked for a way to the nearest goal."""

    costs: NDArray[np.uint8]
    goals: NDArray[np.int32]
    start: tuple[int, int]
    dearest: int

    @property
    def passable(self) -> NDArray[np.bool_]:
        return (self.costs > 0) & (self.costs != BLOCKED)

    @property
    def ends(self) -> NDArray[np.bool_]:
        ends = (self.goals >= 0) & self.passable & (self.costs <= self.dearest)
        ends[self.start] = self.goals[self.start] >= 0
        return ends

    def by_ours(self) -> Cells:
        distance, parent = np.empty((2, *self.costs.shape), np.int32)
        goal = way_kernels.spread(
            self.costs, self.goals, self.start, self.dearest, distance, parent
        )
        if goal < 0:
            return []
        way = way_kernels.way_to(parent, goal, 1.0)
        return [(row, column) for column, row in way.astype(int).tolist()]

    def graph(self, rule: Costs) -> tuple[sparse.csr_matrix, NDArray[np.int32]]:
        """Return the graph of the passable cells, and the number of each."""
        passable, (rows, columns) = self.passable, self.costs.shape
        number = np.full(self.costs.shape, -1, np.int32)
        count = int(passable.sum())
        number[passable] = np.arange(count)
        parts = []
        for r, c in STEPS:
            here = slice(max(-r, 0), rows - max(r, 0)), slice(max(-c, 0), columns - max(c, 0))
            there = slice(max(r, 0), rows - max(-r, 0)), slice(max(c, 0), columns - max(-c, 0))
            both = passable[here] & passable[there]
            price = rule((r, c), self.costs[here][both], self.costs[there][both])
            parts.append((price, number[here][both], number[there][both]))
        prices, left, entered = (np.concatenate(part) for part in zip(*parts, strict=True))
        return sparse.csr_matrix((prices, (left, entered)), shape=(count, count)), number

    def by_scipy(self, graph: sparse.csr_matrix, number: NDArray[np.int32]) -> Cells:
        distance, before = dijkstra(graph, indices=number[self.start], return_predecessors=True)
        ends = number[self.ends]
        if not len(ends) or not np.isfinite(distance[ends]).any():
            return []
        at = int(ends[np.argmin(distance[ends])])
        cells = np.argwhere(self.passable)
        way = []
        while at >= 0:
            way.append(tuple(cells[at].tolist()))
            at = int(before[at])
        return way[::-1]

    def by_skimage(self) -> Cells:
        ends = np.argwhere(self.ends)
        search = MCP_Geometric(np.where(self.passable, self.costs, -1.0))
        distance, _ = search.find_costs([self.start], ends, find_all_ends=False)
        found = distance[tuple(ends.T)]
        if not len(ends) or not np.isfinite(found).any():
            return []
        return search.traceback(ends[np.argmin(found)])


@dataclass(frozen=True)
class Look:
    """The robot asked for the frontiers, and from where they can be looked across."""

    evidence: NDArray[np.int8]
    tried: NDArray[np.uint8]
    tries: int
    least: int
    peek: int

    def by_ours(self) -> tuple[int, NDArray[np.bool_]]:
        goals = np.empty(self.evidence.shape, np.int32)
        kept = frontier_kernels.frontier_goals(
            self.evidence, self.tried, self.tries, self.least, self.peek, goals
        )
        return kept, goals >= 0

    def by_scipy(self) -> tuple[int, NDArray[np.bool_]]:
        """Find the same cells; which frontier is nearest to each is not asked."""
        free = self.evidence < 0
        beside = ndimage.binary_dilation(self.evidence == 0, CROSS)
        parts, count = ndimage.label(free & beside & (self.tried < self.tries), SQUARE)
        large = np.bincount(parts.ravel(), minlength=count + 1) >= self.least
        large[0] = False
        frontier = large[parts]
        reach = ndimage.binary_dilation(frontier, SQUARE, iterations=self.peek, mask=free)
        return int(large.sum()), reach if large.any() else frontier


def record(run: int) -> tuple[list[Plan], list[Look]]:
    """Drive a run and keep what the planner is asked."""
    plans: list[Plan] = []
    looks: list[Look] = []
    spread, frontier_goals = way_kernels.spread, frontier_kernels.frontier_goals

    def spread_noted(costs: Any, goals: Any, start: Any, dearest: int, *rest: Any) -> Any:
        plans.append(Plan(costs.copy(), goals.copy(), start, dearest))
        return spread(costs, goals, start, dearest, *rest)

    def frontiers_noted(evidence: Any, tried: Any, *rest: Any) -> Any:
        looks.append(Look(evidence.copy(), tried.copy(), *rest[:3]))
        return frontier_goals(evidence, tried, *rest)

    way_kernels.spread = spread_noted
    frontier_kernels.frontier_goals = frontiers_noted
    try:
        for _ in make_feed(load_resolved(find("scenarios", "complex")), run):
            pass
    finally:
        way_kernels.spread, frontier_kernels.frontier_goals = spread, frontier_goals
    return plans, looks


def sample(things: list[Any], count: int) -> list[Any]:
    picked = np.linspace(0, len(things) - 1, min(count, len(things))).astype(int)
    return [things[i] for i in picked]


def table(
    of: str, works: dict[str, Callable[[], object]], count: int, asked: int, turns: int
) -> None:
    """Time all in turn, and print the medians; the first is what the others are compared with."""
    seconds: dict[str, list[float]] = {name: [] for name in works}
    for _ in range(turns):
        for name, work in works.items():
            start = time.perf_counter()
            work()
            seconds[name].append((time.perf_counter() - start) / count)
    median = {name: float(np.median(times)) for name, times in seconds.items()}
    ours = median[next(iter(works))]
    print(f"| {of} | ms | times as long | s for the run's {asked} |")
    print("|---|---|---|---|")
    for name, each in median.items():
        print(f"| {name} | {1e3 * each:.2f} | {each / ours:.1f} | {each * asked:.2f} |")
    print()


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--plans", type=int, default=40, help="how many of the run's are asked")
    parser.add_argument("--repeats", type=int, default=7)
    arguments = parser.parse_args()
    asked, looked = record(0)
    # Where the robot touches something it may get out and not in; no undirected grid says that.
    usable = [plan for plan in asked if plan.costs[plan.start] != BLOCKED]
    plans, looks = sample(usable, arguments.plans), sample(looked, arguments.plans)
    rows, columns = plans[0].costs.shape
    print(
        f"{len(asked)} plans of a run, {len(asked) - len(usable)} of them not comparable; "
        f"{len(plans)} are asked, on maps of {rows} x {columns} cells, "
        f"{min(p.passable.sum() for p in plans)} to {max(p.passable.sum() for p in plans)} "
        f"passable; median of {arguments.repeats} repeats, load {os.getloadavg()[0]:.1f} on "
        f"{os.cpu_count()} cores\n"
    )
    graphs = [plan.graph(own_rule) for plan in plans]
    works: dict[str, Callable[[], object]] = {
        "`spread` and `way_to`": lambda: [plan.by_ours() for plan in plans],
        "scipy dijkstra, its graph there already": lambda: [
            plan.by_scipy(*graph) for plan, graph in zip(plans, graphs, strict=True)
        ],
        "scipy dijkstra, with building the graph": lambda: [
            plan.by_scipy(*plan.graph(own_rule)) for plan in plans
        ],
    }
    if MCP_Geometric is not None:
        works["scikit-image `MCP_Geometric`"] = lambda: [plan.by_skimage() for plan in plans]
    table("a way to the nearest goal", works, len(plans), len(asked), arguments.repeats)
    frontier_works: dict[str, Callable[[], object]] = {
        "`frontier_goals`": lambda: [look.by_ours() for look in looks],
        "scipy.ndimage, without the nearest frontier": lambda: [look.by_scipy() for look in looks],
    }
    table("a search for frontiers", frontier_works, len(looks), len(looked), arguments.repeats)
    if MCP_Geometric is None:
        print("scikit-image is left out: it is not installed here (pip install scikit-image)")

    fine = True
    without = 0
    dearer = []
    for plan, graph in zip(plans, graphs, strict=True):
        ours, theirs = plan.by_ours(), plan.by_scipy(*graph)
        without += not ours
        cost = cost_of(ours, plan.costs, own_rule)
        fine &= bool(ours) == bool(theirs) and cost == cost_of(theirs, plan.costs, own_rule)
        if MCP_Geometric is None:
            continue
        by_skimage = plan.by_skimage()
        expected = plan.by_scipy(*plan.graph(skimage_rule))
        found = [cost_of(way, plan.costs, skimage_rule) for way in (by_skimage, expected)]
        fine &= bool(ours) == bool(by_skimage) and math.isclose(*found)
        if cost:
            dearer.append(cost_of(by_skimage, plan.costs, own_rule) / cost - 1)
    print(
        f"cost of the {len(plans)} ways, {without} of them none: {'same' if fine else 'DIFFERENT'}"
    )
    if dearer:
        print(
            f"scikit-image's ways by our costs: dearer by {100 * np.mean(dearer):.1f} % on average"
        )
    alike = all(
        one[0] == other[0] and np.array_equal(one[1], other[1])
        for one, other in ((look.by_ours(), look.by_scipy()) for look in looks)
    )
    print(f"frontiers of the {len(looks)} searches: {'same' if alike else 'DIFFERENT'}")
    return 0 if fine and alike else 1


if __name__ == "__main__":
    sys.exit(main())
