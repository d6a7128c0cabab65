"""The compiled inner loops of the laser: rays through a grid, and past round bodies.

A ray is followed exactly, from cell boundary to cell boundary. Where the cells
around are all free it leaps: a table holds for each cell how many cells away
the nearest solid one is, and no boundary inside that square can matter.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.compiling import compiled

if TYPE_CHECKING:
    from numpy.typing import NDArray


@compiled
def cast_ray(
    leap: NDArray[np.uint8], px: float, py: float, dx: float, dy: float, reach: float
) -> float:
    """Return how far a ray from (px, py) along (dx, dy) goes until it enters a solid cell.

    Everything is in cells. The direction has length 1. `leap` holds 0 for a solid cell, else the
    distance of the nearest solid cell counted as a chess king moves; cells outside are solid. A
    ray that goes farther than `reach` gives infinity. On the corner of four cells a ray crosses
    the boundary in x first.
    """
    rows, columns = leap.shape
    column = math.floor(px)
    row = math.floor(py)
    if row < 0 or row >= rows or column < 0 or column >= columns:
        return 0.0
    over_x = 1.0 / dx if dx != 0.0 else math.inf
    over_y = 1.0 / dy if dy != 0.0 else math.inf
    t = 0.0
    free = leap[row, column]
    while free > 0:
        # Leave the square of free cells around this one, by its nearer side.
        if dx > 0.0:
            tx = (column + free - px) * over_x
        elif dx < 0.0:
            tx = (column + 1 - free - px) * over_x
        else:
            tx = math.inf
        if dy > 0.0:
            ty = (row + free - py) * over_y
        elif dy < 0.0:
            ty = (row + 1 - free - py) * over_y
        else:
            ty = math.inf
        if tx <= ty:
            t = tx
            column = column + free if dx > 0.0 else column - free
            if free > 1 and dy != 0.0:
                row = _cell_at(py, dy, over_y, t, row - free + 1, row + free - 1, False)
        else:
            t = ty
            row = row + free if dy > 0.0 else row - free
            if free > 1 and dx != 0.0:
                column = _cell_at(px, dx, over_x, t, column - free + 1, column + free - 1, True)
        if t > reach:
            return math.inf
        if row < 0 or row >= rows or column < 0 or column >= columns:
            return float(t)
        free = leap[row, column]
    return float(t)


@compiled
def _cell_at(
    p: float, d: float, over: float, t: float, lowest: int, highest: int, inclusive: bool
) -> int:
    """Return the cell along one axis after all boundaries that the ray has crossed by `t`.

    A boundary counts if it is crossed before `t`, or at it where `inclusive`. Times are computed
    as when boundaries are crossed one by one, so that leaping changes no bit of the result.
    """
    cell = min(max(math.floor(p + t * d), lowest), highest)
    if d > 0.0:
        while cell < highest and _crossed((cell + 1 - p) * over, t, inclusive):
            cell += 1
        while cell > lowest and not _crossed((cell - p) * over, t, inclusive):
            cell -= 1
    else:
        while cell > lowest and _crossed((cell - p) * over, t, inclusive):
            cell -= 1
        while cell < highest and not _crossed((cell + 1 - p) * over, t, inclusive):
            cell += 1
    return cell


@compiled
def _crossed(at: float, t: float, inclusive: bool) -> bool:
    return at < t or (inclusive and at == t)


@compiled
def cast_scan(
    leap: NDArray[np.uint8],
    cell_m: float,
    pose: tuple[float, float, float],
    directions: NDArray[np.float64],
    range_max_m: float,
    ranges_m: NDArray[np.float64],
) -> None:
    """Write the range of each beam to `ranges_m`; infinity beyond `range_max_m`.

    `pose` is x, y (metres, grid frame) and heading; `directions` holds the cosine and sine of
    each bearing, shape (beams, 2).
    """
    x, y, theta = pose
    px, py, reach = x / cell_m, y / cell_m, range_max_m / cell_m
    cos, sin = math.cos(theta), math.sin(theta)
    for k in range(directions.shape[0]):
        c, s = directions[k, 0], directions[k, 1]
        ranges_m[k] = cast_ray(leap, px, py, cos * c - sin * s, sin * c + cos * s, reach) * cell_m


@compiled
def cast_discs(
    pose: tuple[float, float, float],
    directions: NDArray[np.float64],
    discs: NDArray[np.float64],
    ranges_m: NDArray[np.float64],
) -> None:
    """Shorten the beams that meet a disc; `discs` holds x, y, radius in metres, shape (n, 3)."""
    x, y, theta = pose
    cos, sin = math.cos(theta), math.sin(theta)
    for i in range(discs.shape[0]):
        ox, oy, radius = discs[i, 0] - x, discs[i, 1] - y, discs[i, 2]
        far2 = ox * ox + oy * oy
        if far2 <= radius * radius:
            ranges_m[:] = 0.0
            return
        for k in range(directions.shape[0]):
            c, s = directions[k, 0], directions[k, 1]
            dx, dy = cos * c - sin * s, sin * c + cos * s
            along = ox * dx + oy * dy
            if along <= 0.0:
                continue
            miss2 = far2 - along * along
            if miss2 < radius * radius:
                ranges_m[k] = min(ranges_m[k], along - math.sqrt(radius * radius - miss2))


@compiled
def mix_edges(
    ranges_m: NDArray[np.float64],
    chances: NDArray[np.float64],
    where: NDArray[np.float64],
    probability: float,
    jump_m: float,
) -> None:
    """Let some beams at the edge of something report a range between it and what lies behind.

    A beam of finite width that meets two surfaces answers with a mixture of both. `chances` and
    `where` are uniform random numbers, one of each for a beam.
    """
    before = ranges_m.copy()
    n = ranges_m.shape[0]
    for k in range(n):
        behind = before[k]
        if k > 0 and math.isfinite(before[k - 1]):
            behind = max(behind, before[k - 1])
        if k < n - 1 and math.isfinite(before[k + 1]):
            behind = max(behind, before[k + 1])
        if behind - before[k] > jump_m and math.isfinite(behind) and chances[k] < probability:
            ranges_m[k] = before[k] + where[k] * (behind - before[k])
