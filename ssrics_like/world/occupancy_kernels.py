"""The compiled inner loops of the robot's own map: what a scan says about each cell."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from ssrics_like.compiling import compiled

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

HIT, MISS = 4, 2
MOST = 30
"""Evidence is added up to here and no farther, so that a changed world is believed soon."""

CLEAR, MOVED = 1, 2

EDGE = 0.5
"""Cells by which a reading is taken to reach into what it met, so that noise does not thicken walls."""  # noqa: E501


@compiled
def _recount(
    counts: NDArray[np.int16], discs: NDArray[np.int32], row: int, column: int, change: int
) -> None:
    """Add to the number of occupied cells near each cell around (row, column).

    `counts` has a layer for each radius that matters to planning; `discs` lists offsets with row,
    column and the index of the least of these radii.
    """
    layers, rows, columns = counts.shape
    for i in range(discs.shape[0]):
        r, c = row + discs[i, 0], column + discs[i, 1]
        if 0 <= r < rows and 0 <= c < columns:
            for layer in range(discs[i, 2], layers):
                counts[layer, r, c] += change


@compiled
def add_evidence(
    evidence: NDArray[np.int8],
    history: NDArray[np.uint8],
    counts: NDArray[np.int16],
    discs: NDArray[np.int32],
    row: int,
    column: int,
    weight: int,
) -> int:
    """Add evidence to one cell, positive for occupied; return 1 if it was unknown before.

    Zero means that a cell was never seen, so evidence never returns there. In `history` it is
    noted that a cell was surely free once, and that something has MOVED in since and may go again.
    """
    before = evidence[row, column]
    after = min(max(before + weight, -MOST), MOST)
    if after == 0:
        after = 1 if weight > 0 else -1
    evidence[row, column] = after
    if after == -MOST:
        history[row, column] = CLEAR
    if before <= 0 < after:
        _recount(counts, discs, row, column, 1)
        if history[row, column] == CLEAR:
            history[row, column] = MOVED
    elif after < 0 < before:
        _recount(counts, discs, row, column, -1)
    return 1 if before == 0 else 0


@compiled
def _clear_ray(
    evidence: NDArray[np.int8],
    history: NDArray[np.uint8],
    counts: NDArray[np.int16],
    discs: NDArray[np.int32],
    start: tuple[float, float],
    direction: tuple[float, float],
    begin: float,
    end: float,
) -> int:
    """Note that a ray passed through the cells between two distances; lengths in cells."""
    dx, dy = direction
    px, py = start[0] + begin * dx, start[1] + begin * dy
    length = end - begin
    if length <= 0.0:
        return 0
    rows, columns = evidence.shape
    column, row = math.floor(px), math.floor(py)
    step_x, step_y = (1 if dx > 0.0 else -1), (1 if dy > 0.0 else -1)
    over_x = abs(1.0 / dx) if dx != 0.0 else math.inf
    over_y = abs(1.0 / dy) if dy != 0.0 else math.inf
    tx = (column + 1 - px if dx > 0.0 else px - column) * over_x if dx != 0.0 else math.inf
    ty = (row + 1 - py if dy > 0.0 else py - row) * over_y if dy != 0.0 else math.inf
    new = 0
    while 0 <= row < rows and 0 <= column < columns:
        found = evidence[row, column]
        if found > 0 or -MOST < found <= MISS - MOST:
            new += add_evidence(evidence, history, counts, discs, row, column, -MISS)
        elif found > -MOST:  # most often: nothing else depends on it
            evidence[row, column] = found - MISS
            new += found == 0
        if min(tx, ty) > length:
            break
        if tx < ty:
            tx += over_x
            column += step_x
        else:
            ty += over_y
            row += step_y
    return new


@compiled
def _silent(ranges_m: NDArray[np.float64], k: int, least: int) -> bool:
    """Tell whether beam k stands in a run of at least so many beams without return."""
    run = 1
    i = k - 1
    while i >= 0 and math.isinf(ranges_m[i]) and run < least:
        run += 1
        i -= 1
    i = k + 1
    while i < ranges_m.shape[0] and math.isinf(ranges_m[i]) and run < least:
        run += 1
        i += 1
    return run >= least


@compiled
def take_scan(
    evidence: NDArray[np.int8],
    history: NDArray[np.uint8],
    counts: NDArray[np.int16],
    discs: NDArray[np.int32],
    cell_m: float,
    pose: tuple[float, float, float],
    directions: NDArray[np.float64],
    ranges_m: NDArray[np.float64],
    reach_m: float,
    silent_run: int,
) -> int:
    """Take a scan into the map; return how many cells became known.

    Beams count up to `reach_m`. A beam without return has met nothing up to there if it stands in
    a run of at least `silent_run` such beams; else it may have been lost, and says nothing.
    Between neighbouring beams the space up to the nearer of their readings is taken for free, so
    that a map of far walls has no gaps.
    """
    x, y, theta = pose
    px, py, reach = x / cell_m, y / cell_m, reach_m / cell_m
    cos, sin = math.cos(theta), math.sin(theta)
    n = ranges_m.shape[0]
    rows, columns = evidence.shape
    new = 0
    before = -1.0  # how far the beam before was free, in cells; less than 0 if it said nothing
    bx, by = 0.0, 0.0
    for k in range(n):
        r = ranges_m[k]
        c, s = directions[k, 0], directions[k, 1]
        dx, dy = cos * c - sin * s, sin * c + cos * s
        if math.isnan(r) or (math.isinf(r) and not _silent(ranges_m, k, silent_run)):
            before = -1.0
            continue
        free = min(r / cell_m - EDGE, reach)
        new += _clear_ray(evidence, history, counts, discs, (px, py), (dx, dy), 0.0, free)
        if before > 0.0:
            spread = math.hypot(dx - bx, dy - by)
            shared = min(free, before)
            between = math.floor(shared * spread)
            for i in range(1, between + 1):
                share = i / (between + 1)
                mx, my = bx + share * (dx - bx), by + share * (dy - by)
                length = math.hypot(mx, my)
                ray = (mx / length, my / length)
                new += _clear_ray(
                    evidence,
                    history,
                    counts,
                    discs,
                    (px, py),
                    ray,
                    min(0.7 / spread, shared),
                    shared,
                )
        before, bx, by = free, dx, dy
    for k in range(n):
        r = ranges_m[k]
        if not r < reach_m:
            continue
        c, s = directions[k, 0], directions[k, 1]
        far = r / cell_m + EDGE
        column = math.floor(px + far * (cos * c - sin * s))
        row = math.floor(py + far * (sin * c + cos * s))
        if 0 <= row < rows and 0 <= column < columns:
            new += add_evidence(evidence, history, counts, discs, row, column, HIT)
    return new


@compiled
def passing_costs(
    evidence: NDArray[np.int8],
    counts: NDArray[np.int16],
    prices: tuple[int, int, int, int],
    unknown: int,
    costs: NDArray[np.uint8],
) -> None:
    """Write what it costs to pass each cell.

    `prices` are those of a cell with something within the first, second and third radius of
    `counts`, and of one without; an occupied cell gets 0, and one never seen `unknown`, unless
    something is within the first radius.
    """
    rows, columns = evidence.shape
    for r in range(rows):
        for c in range(columns):
            if evidence[r, c] > 0:
                costs[r, c] = 0
            elif evidence[r, c] == 0:
                costs[r, c] = unknown if counts[0, r, c] == 0 else 0
            elif counts[2, r, c] == 0:
                costs[r, c] = prices[3]
            elif counts[0, r, c] > 0:
                costs[r, c] = prices[0]
            elif counts[1, r, c] > 0:
                costs[r, c] = prices[1]
            else:
                costs[r, c] = prices[2]


@compiled
def count_outside(counts: NDArray[np.int16], discs: NDArray[np.int32]) -> None:
    """Count what lies around the grid as occupied."""
    rows, columns = counts.shape[1], counts.shape[2]
    for row in range(-1, rows + 1):
        _recount(counts, discs, row, -1, 1)
        _recount(counts, discs, row, columns, 1)
    for column in range(columns):
        _recount(counts, discs, -1, column, 1)
        _recount(counts, discs, rows, column, 1)
