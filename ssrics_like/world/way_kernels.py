"""The compiled inner loops of planning: the cheapest way over a grid."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.compiling import compiled

if TYPE_CHECKING:
    from numpy.typing import NDArray

STRAIGHT, DIAGONAL = 5, 7  # a cell's side and diagonal, times the cost of the cell entered
BLOCKED, OUT_OF_BLOCKED = 255, 20  # a cell that touches something; what it costs to get out
ESCAPE = 6  # cells around the start in which that is allowed
BUCKETS = 256  # more than the dearest step, DIAGONAL * OUT_OF_BLOCKED
FAR = np.iinfo(np.int32).max
OPEN = 1
STRAIGHT_MOST = 120  # places of a way that may be left out at once


@compiled
def spread(
    costs: NDArray[np.uint8],
    goals: NDArray[np.int32],
    start: tuple[int, int],
    dearest: int,
    distance: NDArray[np.int32],
    parent: NDArray[np.int32],
) -> int:
    """Find the cheapest way from a cell to the nearest goal.

    Parameters
    ----------
    costs : ndarray, shape (rows, columns), uint8
        As `occupancy.OccupancyGrid.costs`; BLOCKED cells are passed only from the start outwards.
    goals : ndarray, shape (rows, columns), int32
        0 or more where the way may end.
    start : tuple of int
        Row and column.
    dearest : int
        A goal whose cell costs more than this is none, but for the start itself.
    distance, parent : ndarray, shape (rows, columns), int32
        Filled with the cost of each cell reached (FAR for the others) and the flat index of the
        cell before it.

    Returns
    -------
    int
        Flat index of the nearest goal, or -1. Cells beyond it are not searched.

    References
    ----------
    Dijkstra (1959), with the ring of buckets of Dial (1969): costs are small whole numbers.
    """
    rows, columns = costs.shape
    distance[:] = FAR
    heads = np.full(BUCKETS, -1, np.int32)
    # An entry that a cheaper way has overtaken stays in its bucket and is passed over when met.
    cell_of = np.empty(8 * rows * columns + 1, np.int32)
    after = np.empty(8 * rows * columns + 1, np.int32)
    reached, before = distance.reshape(-1), parent.reshape(-1)
    cost_of, goal_of = costs.reshape(-1), goals.reshape(-1)
    origin = start[0] * columns + start[1]
    reached[origin], before[origin] = 0, -1
    cell_of[0], after[0], heads[0] = origin, -1, 0
    used, unused, waiting, level = 1, -1, 1, 0
    while waiting > 0:
        entry = heads[level % BUCKETS]
        if entry < 0:
            level += 1
            continue
        heads[level % BUCKETS] = after[entry]
        after[entry], unused = unused, entry
        waiting -= 1
        cell = cell_of[entry]
        if reached[cell] != level:
            continue
        row, column = cell // columns, cell % columns
        # Out of where it touches something the robot may go, but only a step or two.
        escaping = (
            cost_of[cell] == BLOCKED
            and abs(row - start[0]) < ESCAPE
            and abs(column - start[1]) < ESCAPE
        )
        if goal_of[cell] >= 0 and (cost_of[cell] <= dearest or cell == origin):
            return int(cell)
        for r in range(max(row - 1, 0), min(row + 2, rows)):
            for c in range(max(column - 1, 0), min(column + 2, columns)):
                other = r * columns + c
                cost = cost_of[other]
                if cost == 0 or (cost == BLOCKED and not escaping):
                    continue
                if cost == BLOCKED:
                    cost = OUT_OF_BLOCKED
                there = level + (DIAGONAL if r != row and c != column else STRAIGHT) * cost
                if there < reached[other]:
                    reached[other], before[other] = there, cell
                    entry = unused
                    if entry >= 0:
                        unused = after[entry]
                    else:
                        entry = used
                        used += 1
                    cell_of[entry] = other
                    after[entry] = heads[there % BUCKETS]
                    heads[there % BUCKETS] = entry
                    waiting += 1
    return -1


@compiled
def way_to(parent: NDArray[np.int32], goal: int, cell_m: float) -> NDArray[np.float64]:
    """Return the centres of the cells from the start to a goal, shape (n, 2), metres."""
    columns = parent.shape[1]
    from_cell = parent.reshape(-1)
    n = 0
    cell = goal
    while cell >= 0:
        n += 1
        cell = from_cell[cell]
    way = np.empty((n, 2))
    cell = goal
    for i in range(n - 1, -1, -1):
        way[i, 0] = (cell % columns + 0.5) * cell_m
        way[i, 1] = (cell // columns + 0.5) * cell_m
        cell = from_cell[cell]
    return way


@compiled
def _is_clear(
    costs: NDArray[np.uint8], way: NDArray[np.float64], start: int, end: int, cell_m: float
) -> bool:
    """Tell whether the straight line between two places of a way stays in OPEN cells."""
    x, y = way[start, 0], way[start, 1]
    dx, dy = way[end, 0] - x, way[end, 1] - y
    steps = math.ceil(2.0 * math.hypot(dx, dy) / cell_m)
    for i in range(1, steps):
        r = math.floor((y + dy * i / steps) / cell_m)
        c = math.floor((x + dx * i / steps) / cell_m)
        if costs[r, c] != OPEN:
            return False
    return True


@compiled
def straightened(
    costs: NDArray[np.uint8], way: NDArray[np.float64], cell_m: float
) -> NDArray[np.float64]:
    """Return a way with straight stretches where there is room; its places stay a cell apart.

    A way from cell to cell has only eight directions. Where the straight line to a later place
    keeps clear of everything, it is taken.
    """
    n = way.shape[0]
    places = way.copy()
    i = 0
    while i < n - 1:
        j = min(i + STRAIGHT_MOST, n - 1)
        while j > i + 1 and not _is_clear(costs, way, i, j, cell_m):
            j -= 1
        for k in range(i + 1, j):
            share = (k - i) / (j - i)
            places[k, 0] = way[i, 0] + share * (way[j, 0] - way[i, 0])
            places[k, 1] = way[i, 1] + share * (way[j, 1] - way[i, 1])
        i = j
    return places


@compiled
def is_open(blocked: NDArray[np.int16], way: NDArray[np.float64], at: int, cell_m: float) -> bool:
    """Tell whether no place of a way, from its `at`-th on, touches something known.

    A way may lead out of where the robot touches something already.
    """
    outside = False
    for i in range(at, way.shape[0]):
        free = blocked[math.floor(way[i, 1] / cell_m), math.floor(way[i, 0] / cell_m)] == 0
        if outside and not free:
            return False
        outside = outside or free
    return True
