"""The compiled frame of a gap: the line between its two jambs, and places relative to it.

All of a gap is measured in its own frame: the origin midway between the two jambs, `ahead` in the
direction of travel through the gap, `left` along the line between the jambs. So a doorway looks
the same however obliquely, and however far from its middle, it is passed.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.compiling import compiled
from ssrics_like.perception.local_map_kernels import march

if TYPE_CHECKING:
    from numpy.typing import NDArray

LIMIT_M = 2.5  # a wall farther aside bounds no gap
TURNS, TURN_RAD = 10, math.radians(5.0)  # the line between the jambs is sought so far either way
OBLIQUE_M = 0.02  # what a turn of 5 degrees costs, so that of equal gaps the straight one is taken
ASKEW_M = 0.01  # the same where the direction through is nearly known
NEARLY_M = 0.1  # lines longer by that than the shortest one cross the same doorway: walls are thick
LEAST_M = 0.5  # no robot goes through less: the way is not where it was believed to be
BESIDE_M, BESIDE_TURNS = 0.3, 3  # of lines nearly as short, one farther off crosses another gap


@compiled
def narrowest(
    evidence: NDArray[np.int8],
    seen_m: NDArray[np.float64],
    place: tuple[float, float, float],
    oldest_m: float,
) -> tuple[float, float, float]:
    """Find the shortest line through a place from what stands left to what stands right.

    Returns
    -------
    tuple of float
        Metres to the left and to the right, 2.5 at most each, and the direction to the left.
    """
    x, y, heading = place
    best, left, right, towards = np.inf, LIMIT_M, LIMIT_M, heading + math.pi / 2
    for turn in range(-TURNS, TURNS + 1):
        angle = heading + math.pi / 2 + turn * TURN_RAD
        dx, dy = math.cos(angle), math.sin(angle)
        to_left, _ = march(evidence, seen_m, (x, y), (dx, dy), LIMIT_M, oldest_m)
        to_right, _ = march(evidence, seen_m, (x, y), (-dx, -dy), LIMIT_M, oldest_m)
        width = to_left + to_right + OBLIQUE_M * abs(turn)
        if width < best:
            best, left, right, towards = width, to_left, to_right, angle
    return left, right, towards


@compiled
def doorway_frame(
    evidence: NDArray[np.int8],
    seen_m: NDArray[np.float64],
    way_m: NDArray[np.float64],
    through_rad: float,
    oldest_m: float,
) -> tuple[float, float, float, float]:
    """Find the frame of a doorway from all lines across the way that are nearly as short as can be.

    One line depends on where just the way leads, and on cells; their mean does not.

    Parameters
    ----------
    evidence, seen_m, oldest_m : as for `narrowest`
    way_m : ndarray, shape (n, 2)
        Places along the way through the doorway, one at least; frame of the map.
    through_rad : float
        The direction through it, nearly.

    Returns
    -------
    tuple of float
        x and y of its middle, the direction through, and how wide it is; metres, radians. That is
        infinite, and all else NaN, where nothing stands on both sides of the way.
    """
    turns = 2 * TURNS + 1
    costs = np.full((len(way_m), turns), np.inf)
    lines = np.zeros((len(way_m), turns, 3))  # length, x and y of the middle
    for i in range(len(way_m)):
        x, y = way_m[i]
        for turn in range(turns):
            aside = through_rad + math.pi / 2 + (turn - TURNS) * TURN_RAD
            dx, dy = math.cos(aside), math.sin(aside)
            to_left, _ = march(evidence, seen_m, (x, y), (dx, dy), LIMIT_M, oldest_m)
            to_right, _ = march(evidence, seen_m, (x, y), (-dx, -dy), LIMIT_M, oldest_m)
            length, off = to_left + to_right, 0.5 * (to_left - to_right)
            if length < LEAST_M or max(to_left, to_right) >= LIMIT_M:
                continue
            costs[i, turn] = length + ASKEW_M * abs(turn - TURNS)
            lines[i, turn] = length, x + off * dx, y + off * dy
    least = int(np.argmin(costs))
    best, best_turn = lines[least // turns, least % turns], least % turns
    most = costs[least // turns, best_turn] + NEARLY_M
    if math.isinf(most):
        return math.nan, math.nan, math.nan, math.inf
    count = 0
    total_x = total_y = total_turn = 0.0
    for i in range(len(way_m)):
        for turn in range(turns):
            _, x, y = lines[i, turn]
            near = abs(turn - best_turn) <= BESIDE_TURNS
            near = near and math.hypot(x - best[1], y - best[2]) < BESIDE_M
            if near and costs[i, turn] <= most:
                count += 1
                total_x, total_y, total_turn = total_x + x, total_y + y, total_turn + turn - TURNS
    theta = through_rad + total_turn / count * TURN_RAD
    return total_x / count, total_y / count, theta, best[0]


@compiled
def framed(
    middle: tuple[float, float], left: tuple[float, float], ahead_m: float, left_m: float
) -> tuple[float, float]:
    """Return where a place of the gap's frame lies in that of the map.

    Parameters
    ----------
    middle : tuple of float
        Midway between the jambs, metres, frame of the map.
    left : tuple of float
        The direction to the left, of length 1.
    ahead_m, left_m : float
        The place.
    """
    lx, ly = left
    return middle[0] + left_m * lx + ahead_m * ly, middle[1] + left_m * ly - ahead_m * lx
