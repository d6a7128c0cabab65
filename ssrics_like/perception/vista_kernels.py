"""The compiled inner loop of what is at the end of the hallway, in all directions."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from ssrics_like.compiling import compiled

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

STEEP = 2.0
"""A wall is an end if from one beam to the next it recedes by no more than so many times what lies
between the beams: along a wall one does not see to where it ends."""
NOISE_M = 0.1
"""So much more does not matter: the laser is wrong by some centimetres."""


@compiled
def look_far(
    pose: tuple[float, float, float],
    bearings_rad: NDArray[np.float64],
    ranges_m: NDArray[np.float64],
    place: tuple[float, float, float],
    farthest_m: float,
    nearest_m: float,
    ratio: float,
    lengths_m: NDArray[np.float64],
    counts: NDArray[np.int64],
    beams: NDArray[np.int64],
) -> None:
    """Sort the ends of a scan's beams by direction and by how far from a place they are.

    Parameters
    ----------
    pose, place : tuple of float
        x, y and direction, of the laser and of the place.
    bearings_rad, ranges_m : ndarray, shape (beams,)
        The scan.
    farthest_m : float
        A reading that is not above 0 and below this says nothing.
    nearest_m, ratio : float
        Where the first class of lengths begins, and by how much each begins farther than the last.
    lengths_m, counts : ndarray, shape (directions, classes)
        Sum and number of the lengths of each class, of walls that face the laser; added to. The
        first direction is ahead of the place, the others counter-clockwise. A beam counts for both
        of the directions that it lies between.
    beams : ndarray, shape (directions, classes)
        Number of all lengths, whatever they meet; added to.
    """
    directions, classes = counts.shape
    width, step = 2.0 * math.pi / directions, math.log(ratio)
    for i in range(len(ranges_m)):
        if not 0.0 < ranges_m[i] < farthest_m:
            continue
        angle = pose[2] + bearings_rad[i]
        x = pose[0] + ranges_m[i] * math.cos(angle) - place[0]
        y = pose[1] + ranges_m[i] * math.sin(angle) - place[1]
        length = math.hypot(x, y)
        if length <= nearest_m:
            continue
        first = math.floor((math.atan2(y, x) - place[2]) / width)
        farther = min(int(math.log(length / nearest_m) / step), classes - 1)
        wall = _faced(bearings_rad, ranges_m, i, i - 1) or _faced(bearings_rad, ranges_m, i, i + 1)
        for direction in (first % directions, (first + 1) % directions):
            beams[direction, farther] += 1
            if wall:
                lengths_m[direction, farther] += length
                counts[direction, farther] += 1


@compiled
def _faced(
    bearings_rad: NDArray[np.float64], ranges_m: NDArray[np.float64], beam: int, other: int
) -> bool:
    """Tell whether two beams meet one wall that faces the laser."""
    if not 0 <= other < len(ranges_m):
        return False
    between = ranges_m[beam] * abs(bearings_rad[beam] - bearings_rad[other])
    return bool(abs(ranges_m[beam] - ranges_m[other]) <= STEEP * between + NOISE_M)
