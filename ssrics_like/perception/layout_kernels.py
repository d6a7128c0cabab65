"""The compiled inner loops of the layout of a place: how far it goes on along the walls.

Buildings have walls along two directions at right angles. A place is looked at along these, not
along the way: at a junction or a corner a robot turns, and the gap that it passes lies aslant.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.compiling import compiled
from ssrics_like.perception.local_map_kernels import CELL_M, OCCUPIED, cell_state, march

if TYPE_CHECKING:
    from numpy.typing import NDArray

HALF = 50  # cells to each side in which walls are sought
ANGLES = 30  # walls are sought in steps of 3 degrees
BINS = 2 * math.ceil(HALF * math.sqrt(2.0)) + 2
FAR_M = 4.0  # as far as it is looked, metres of the map
LANE_M = 0.15  # between the lanes, metres of the map
AHEAD, LEFT, BEHIND, RIGHT = 0, 1, 2, 3
LANES = (7, 13)  # ahead and behind; to the sides
STRIP = 4  # lanes side by side that one can go along, 0.9 m from the first to the last


@compiled
def walls_along(
    evidence: NDArray[np.int8], seen_m: NDArray[np.float64], place: tuple[float, float, float],
    oldest_m: float,
) -> float:  # fmt: skip
    """Find the direction that walls run in: of the four the one nearest to that of travel.

    What is occupied around the place is projected onto two directions at right angles. Seen along
    a wall all of it falls into one bin: the sum of the squares of the counts is greatest.

    Returns
    -------
    float
        The direction, radians, within 45 degrees of that of travel; that of travel itself if
        nothing is occupied.
    """
    x, y, heading = place
    middle_row, middle_column = math.floor(y / CELL_M), math.floor(x / CELL_M)
    rows, columns = np.empty((2, (2 * HALF + 1) ** 2))
    count = 0
    for row in range(-HALF, HALF + 1):
        for column in range(-HALF, HALF + 1):
            here = cell_state(evidence, seen_m, middle_row + row, middle_column + column, oldest_m)
            if here == OCCUPIED:
                rows[count], columns[count] = row, column
                count += 1
    if count == 0:
        return heading
    best, found = -1, 0.0
    bins = np.empty((2, BINS), np.int64)
    for step in range(ANGLES):
        angle = 0.5 * math.pi * step / ANGLES
        cos, sin = math.cos(angle), math.sin(angle)
        bins[:] = 0
        for i in range(count):
            bins[0, math.floor(cos * columns[i] + sin * rows[i]) + BINS // 2] += 1
            bins[1, math.floor(cos * rows[i] - sin * columns[i]) + BINS // 2] += 1
        score = (bins * bins).sum()
        if score > best:
            best, found = score, angle
    return found + 0.5 * math.pi * round((heading - found) / (0.5 * math.pi))


@compiled
def layout(
    evidence: NDArray[np.int8],
    seen_m: NDArray[np.float64],
    place: tuple[float, float, float],
    oldest_m: float,
    scale: float,
    out: NDArray[np.float64],
) -> None:
    """Look along lanes side by side in the four directions of the walls.

    Of the two sides that to which it goes on less far comes first, as in a mirror.

    Parameters
    ----------
    evidence, seen_m : ndarray, shape (cells, cells)
        The map.
    place : tuple of float
        x, y and direction of travel: metres, radians, frame of the map.
    oldest_m : float
        What was seen before counts as unknown.
    scale : float
        Metres of the world to a metre of the map.
    out : ndarray, shape (measures,)
        Filled in the order of `ssrics_like.perception.layout.LAYOUT`, metres of the world.
    """
    x, y, heading = place
    ahead = walls_along(evidence, seen_m, place, oldest_m)
    far, unknown = np.empty((4, LANES[1])), np.empty((4, LANES[1]))
    for side in range(4):
        dx, dy = _direction(ahead, side)
        # Lanes are counted from right to left, or from behind to ahead.
        aside_x, aside_y = _direction(ahead, LEFT if side % 2 == 0 else AHEAD)
        lanes = LANES[side % 2]
        for lane in range(lanes):
            off = LANE_M * (lane - lanes // 2)
            far[side, lane], unknown[side, lane] = march(
                evidence, seen_m, (x + off * aside_x, y + off * aside_y), (dx, dy), FAR_M, oldest_m
            )
    mirrored = far[LEFT].sum() > far[RIGHT].sum()
    out[0] = abs(ahead - heading)
    at = 1
    for number in range(4):
        side = (number + 2) % 4 if mirrored and number % 2 == 1 else number
        lanes = LANES[side % 2]
        widest = 0.0
        for lane in range(lanes):
            # Ahead and behind from the lesser side to the greater.
            from_lane = lane if mirrored or side % 2 == 1 else lanes - 1 - lane
            out[at] = scale * far[side, from_lane]
            out[at + 1] = scale * unknown[side, from_lane]
            at += 2
            if lane + STRIP <= lanes:
                widest = max(widest, far[side, lane : lane + STRIP].min())
        out[at] = scale * widest
        at += 1


@compiled
def _direction(ahead: float, side: int) -> tuple[float, float]:
    angle = ahead + 0.5 * math.pi * side
    return math.cos(angle), math.sin(angle)
