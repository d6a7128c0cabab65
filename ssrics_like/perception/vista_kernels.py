"""The compiled inner loop of how far one sees from a place."""

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
SAME = 0.12
"""What is seen to go on by this share farther than an end, at most, is that end."""


@compiled
def look_far(
    pose: tuple[float, float, float],
    bearings_rad: NDArray[np.float64],
    ranges_m: NDArray[np.float64],
    place: tuple[float, float, float],
    farthest_m: float,
    out: NDArray[np.float64],
) -> None:
    """Note how far away from a place the ends of a scan's beams are.

    Parameters
    ----------
    pose, place : tuple of float
        x, y and direction, of the laser and of the place.
    bearings_rad, ranges_m : ndarray, shape (beams,)
        The scan.
    farthest_m : float
        A reading that is not above 0 and below this says nothing.
    out : ndarray, shape (directions,)
        Metres, the first one ahead of the place, then counter-clockwise; 0 where nothing was seen,
        below 0 where it goes on at least so far. Changed where something is farther. What lies
        between two directions counts for both.
    """
    directions, beams = len(out), len(ranges_m)
    half = math.pi / directions
    for i in range(beams):
        if not 0.0 < ranges_m[i] < farthest_m:
            continue
        angle = pose[2] + bearings_rad[i]
        x = pose[0] + ranges_m[i] * math.cos(angle) - place[0]
        y = pose[1] + ranges_m[i] * math.sin(angle) - place[1]
        length = math.hypot(x, y)
        if not (
            _faced(bearings_rad, ranges_m, i, i - 1) or _faced(bearings_rad, ranges_m, i, i + 1)
        ):
            length = -length
        halves = round((math.atan2(y, x) - place[2]) / half)
        first = (halves // 2) % directions
        out[first] = farther(out[first], length)
        if halves % 2:
            second = (first + 1) % directions
            out[second] = farther(out[second], length)


@compiled
def _faced(
    bearings_rad: NDArray[np.float64], ranges_m: NDArray[np.float64], beam: int, other: int
) -> bool:
    """Tell whether two beams meet one wall that faces the laser."""
    if not 0 <= other < len(ranges_m):
        return False
    between = ranges_m[beam] * abs(bearings_rad[beam] - bearings_rad[other])
    return bool(abs(ranges_m[beam] - ranges_m[other]) <= STEEP * between + NOISE_M)


@compiled
def farther(one: float, other: float) -> float:
    """Return the farther of two lengths of a vista; an end if both may be that."""
    if one > 0.0 > other:
        return one if -other <= (1.0 + SAME) * one else other
    if other > 0.0 > one:
        return other if -one <= (1.0 + SAME) * other else one
    return one if abs(one) >= abs(other) else other
