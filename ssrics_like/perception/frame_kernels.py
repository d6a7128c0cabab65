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
