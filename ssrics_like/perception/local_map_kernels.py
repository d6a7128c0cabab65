"""The compiled inner loops of the local map: beams in, cells looked up."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from ssrics_like.compiling import compiled

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

CELL_M = 0.05
OCCUPIED, UNKNOWN, FREE = 1, 0, -1
HIT, MISS = 3, -1  # evidence of a beam that ends in a cell, and of one that passes it
MOST, LEAST = 9, -6  # evidence is kept within, so that what has moved is soon forgotten
_HALF = CELL_M / 2
_NEVER = 1e30


@compiled
def add_evidence(
    evidence: NDArray[np.int8],
    seen_m: NDArray[np.float64],
    row: int,
    column: int,
    weight: int,
    now_m: float,
    memory_m: float,
) -> None:
    """Add a beam's evidence to a cell; what was seen there too long ago is forgotten first."""
    if now_m - seen_m[row, column] > memory_m:
        evidence[row, column] = 0
    seen_m[row, column] = now_m
    evidence[row, column] = max(LEAST, min(MOST, evidence[row, column] + weight))


@compiled
def take_scan(
    evidence: NDArray[np.int8],
    seen_m: NDArray[np.float64],
    pose: tuple[float, float, float],
    bearings_rad: NDArray[np.float64],
    ranges_m: NDArray[np.float64],
    reach_m: float,
    now_m: float,
    memory_m: float,
) -> None:
    """Take a scan into the map.

    The map repeats itself in both directions: a cell of the world lies at its row and column
    modulo the number of cells, which is a power of 2, so that the last bits tell.

    Parameters
    ----------
    evidence : ndarray, shape (cells, cells), int8
        Above 0 occupied, below 0 free; changed.
    seen_m : ndarray, shape (cells, cells), float64
        Metres travelled when each cell was last seen; changed.
    pose : tuple of float
        x, y, heading of the laser: metres, radians.
    bearings_rad, ranges_m : ndarray, shape (beams,)
        A range of NaN is passed over; from `reach_m` on a beam has met nothing so far.
    reach_m, now_m, memory_m : float
        How far beams are followed; metres travelled so far; how long a cell is remembered.
    """
    last = evidence.shape[0] - 1
    x, y, heading = pose
    for beam in range(ranges_m.shape[0]):
        reading = ranges_m[beam]
        if not reading > 0.0:
            continue
        hit = reading < reach_m
        length = reading if hit else reach_m
        dx = math.cos(heading + bearings_rad[beam])
        dy = math.sin(heading + bearings_rad[beam])
        column, row = math.floor(x / CELL_M), math.floor(y / CELL_M)
        last_column = math.floor((x + length * dx) / CELL_M)
        last_row = math.floor((y + length * dy) / CELL_M)
        # From border to border of the cells (Amanatides and Woo 1987).
        step_x, step_y = (1 if dx > 0 else -1), (1 if dy > 0 else -1)
        between_x = abs(CELL_M / dx) if dx != 0 else _NEVER
        between_y = abs(CELL_M / dy) if dy != 0 else _NEVER
        next_x = (column + (dx > 0) - x / CELL_M) * step_x * between_x if dx != 0 else _NEVER
        next_y = (row + (dy > 0) - y / CELL_M) * step_y * between_y if dy != 0 else _NEVER
        while (column != last_column or row != last_row) and min(next_x, next_y) <= length + CELL_M:
            # A beam that grazes a wall passes its neighbours: those just before its end are left.
            if not hit or min(next_x, next_y) < length - _HALF:
                add_evidence(evidence, seen_m, row & last, column & last, MISS, now_m, memory_m)
            if next_x < next_y:
                column += step_x
                next_x += between_x
            else:
                row += step_y
                next_y += between_y
        if hit:
            add_evidence(
                evidence, seen_m, last_row & last, last_column & last, HIT, now_m, memory_m
            )


@compiled
def cell_state(
    evidence: NDArray[np.int8], seen_m: NDArray[np.float64], row: int, column: int, oldest_m: float
) -> int:
    """Return whether a cell is OCCUPIED, FREE or UNKNOWN; seen before `oldest_m` is unknown."""
    last = evidence.shape[0] - 1
    row, column = row & last, column & last
    if seen_m[row, column] < oldest_m or evidence[row, column] == 0:
        return UNKNOWN
    return OCCUPIED if evidence[row, column] > 0 else FREE


@compiled
def state(
    evidence: NDArray[np.int8], seen_m: NDArray[np.float64], x_m: float, y_m: float, oldest_m: float
) -> int:
    """Return whether a place is OCCUPIED, FREE or UNKNOWN; seen before `oldest_m` is unknown."""
    return cell_state(
        evidence, seen_m, math.floor(y_m / CELL_M), math.floor(x_m / CELL_M), oldest_m
    )


@compiled
def march(
    evidence: NDArray[np.int8],
    seen_m: NDArray[np.float64],
    start: tuple[float, float],
    direction: tuple[float, float],
    limit_m: float,
    oldest_m: float,
) -> tuple[float, float]:
    """Go straight on until something is met.

    Returns
    -------
    tuple of float
        Metres gone, `limit_m` at most, and how many of them lay in unknown cells.
    """
    steps = round(limit_m / _HALF)
    unknown = 0
    last_row, last_column = math.floor(start[1] / CELL_M), math.floor(start[0] / CELL_M)
    for step in range(steps + 1):
        row = math.floor((start[1] + step * _HALF * direction[1]) / CELL_M)
        column = math.floor((start[0] + step * _HALF * direction[0]) / CELL_M)
        here = cell_state(evidence, seen_m, row, column, oldest_m)
        if here == OCCUPIED:
            return step * _HALF, unknown * _HALF
        # Nothing slips between two cells of a slanting wall that touch at a corner.
        if (
            row != last_row
            and column != last_column
            and cell_state(evidence, seen_m, row, last_column, oldest_m) == OCCUPIED
            and cell_state(evidence, seen_m, last_row, column, oldest_m) == OCCUPIED
        ):
            return step * _HALF, unknown * _HALF
        last_row, last_column = row, column
        if here == UNKNOWN:
            unknown += 1
    return limit_m, unknown * _HALF
