"""The compiled inner loops of exploration: where the known free space borders on the unknown."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.compiling import compiled

if TYPE_CHECKING:
    from numpy.typing import NDArray

_NOT_YET, _OUTSIDE = 254, 255  # in place of steps: a frontier cell not yet visited; no such cell


@compiled
def borders_unknown(evidence: NDArray[np.int8], row: int, column: int) -> bool:
    """Tell whether one of the four neighbours of a cell was never seen."""
    rows, columns = evidence.shape
    return bool(
        (row > 0 and evidence[row - 1, column] == 0)
        or (row < rows - 1 and evidence[row + 1, column] == 0)
        or (column > 0 and evidence[row, column - 1] == 0)
        or (column < columns - 1 and evidence[row, column + 1] == 0)
    )


@compiled
def frontier_goals(
    evidence: NDArray[np.int8],
    tried: NDArray[np.uint8],
    tries: int,
    least: int,
    peek: int,
    goals: NDArray[np.int32],
) -> int:
    """Mark the cells from which a frontier can be looked across.

    A frontier is a connected set of free cells that border on unknown ones (Yamauchi 1997).

    Parameters
    ----------
    evidence : ndarray, shape (rows, columns), int8
        Above 0 occupied, below 0 free, 0 never seen.
    tried : ndarray, shape (rows, columns), uint8
        How often a frontier cell was gone to in vain.
    tries : int
        Cells tried this often are left out.
    least : int
        Smaller frontiers are left out; cells.
    peek : int
        How many steps from a frontier it can be looked across; cells.
    goals : ndarray, shape (rows, columns), int32
        Filled with the flat index of the nearest frontier cell, -1 farther away than `peek`.

    Returns
    -------
    int
        Number of frontiers.
    """
    rows, columns = evidence.shape
    goals[:] = -1
    depth = np.full((rows, columns), _OUTSIDE, np.uint8)
    found = 0
    for row in range(rows):
        for column in range(columns):
            if (
                evidence[row, column] < 0
                and tried[row, column] < tries
                and borders_unknown(evidence, row, column)
            ):
                depth[row, column] = _NOT_YET
                found += 1
    queue = np.empty(rows * columns, np.int32)
    kept = 0
    end = 0
    if found == 0:
        return 0
    for row in range(rows):
        for column in range(columns):
            if depth[row, column] != _NOT_YET:
                continue
            begin = end
            depth[row, column] = 0
            queue[end] = row * columns + column
            end += 1
            i = begin
            while i < end:
                r0, c0 = queue[i] // columns, queue[i] % columns
                i += 1
                for r in range(max(r0 - 1, 0), min(r0 + 2, rows)):
                    for c in range(max(c0 - 1, 0), min(c0 + 2, columns)):
                        if depth[r, c] == _NOT_YET:
                            depth[r, c] = 0
                            queue[end] = r * columns + c
                            end += 1
            if end - begin < least:
                for j in range(begin, end):
                    depth[queue[j] // columns, queue[j] % columns] = _OUTSIDE
                end = begin
            else:
                kept += 1
    for j in range(end):
        goals[queue[j] // columns, queue[j] % columns] = queue[j]
    i = 0
    while i < end:
        r0, c0 = queue[i] // columns, queue[i] % columns
        i += 1
        if depth[r0, c0] >= peek:
            continue
        for r in range(max(r0 - 1, 0), min(r0 + 2, rows)):
            for c in range(max(c0 - 1, 0), min(c0 + 2, columns)):
                if evidence[r, c] < 0 and depth[r, c] == _OUTSIDE:
                    depth[r, c] = depth[r0, c0] + 1
                    goals[r, c] = goals[r0, c0]
                    queue[end] = r * columns + c
                    end += 1
    return kept


@compiled
def set_aside(
    evidence: NDArray[np.int8], tried: NDArray[np.uint8], row: int, column: int, around: int
) -> None:
    """Count a try for the cells of a frontier around one of its cells."""
    rows, columns = evidence.shape
    for r in range(max(row - around, 0), min(row + around + 1, rows)):
        for c in range(max(column - around, 0), min(column + around + 1, columns)):
            near = (r - row) ** 2 + (c - column) ** 2 <= around * around
            if near and evidence[r, c] < 0 and borders_unknown(evidence, r, c):
                tried[r, c] = min(tried[r, c] + 1, 200)


@compiled
def facing(
    evidence: NDArray[np.int8], stand: tuple[int, int], frontier: tuple[int, int], around: int
) -> float:
    """Return the heading, radians, from a cell to the unknown cells around a frontier cell."""
    rows, columns = evidence.shape
    row, column = frontier
    x, y, n = 0.0, 0.0, 0
    for r in range(max(row - around, 0), min(row + around + 1, rows)):
        for c in range(max(column - around, 0), min(column + around + 1, columns)):
            if evidence[r, c] == 0 and (r - row) ** 2 + (c - column) ** 2 <= around * around:
                x += c
                y += r
                n += 1
    if n == 0:
        return math.nan
    return math.atan2(y / n - stand[0], x / n - stand[1])
