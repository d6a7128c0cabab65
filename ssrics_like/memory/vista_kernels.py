"""The compiled inner loop that compares what is seen in the distance from many places."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.compiling import compiled

if TYPE_CHECKING:
    from numpy.typing import NDArray

AGREES, DIFFERS = 1, 2


@compiled
def compare_vistas(
    seen: NDArray[np.float32],
    turns: NDArray[np.int64],
    remembered: NDArray[np.float32],
    far_m: float,
    same_m: float,
    same: float,
    past_by: float,
    differs: NDArray[np.bool_],
    past: NDArray[np.bool_],
) -> None:
    """Tell whether a vista contradicts remembered ones in some direction.

    An end is compared with those that the other has in that direction and in the two beside it, if
    the other has one in that direction.

    Parameters
    ----------
    seen, turns, remembered : as for `vistas.contradiction`
    far_m : float
        Ends say something if one of them is so far.
    same_m, same : float
        Two ends that differ by the former, or by this share of the longer, are the same.
    past_by : float
        It goes on past an end if that is nearer by this share of how far it goes on at least.
    differs : ndarray, shape (places,)
        Set where an end is none of the other's, and neither is the same beside it.
    past : ndarray, shape (places,)
        Set where one goes on past an end of the other, in that direction and in both beside it.
    """
    directions = len(seen)
    turned = np.empty(directions, np.float32)
    place = np.empty(directions, np.float32)
    kinds = np.empty(directions, np.int64)
    for index in range(len(turns)):
        for k in range(directions):
            turned[k] = seen[(k - turns[index]) % directions]
            place[k] = remembered[k, index]
        for k in range(directions):
            kinds[k] = _kind(turned, place, k, far_m, same_m, same)
            if _goes_past(turned, place, k, past_by) or _goes_past(place, turned, k, past_by):
                past[index] = True
        for k in range(directions):
            beside = kinds[k - 1] == AGREES or kinds[(k + 1) % directions] == AGREES
            if kinds[k] == DIFFERS and not beside:
                differs[index] = True


@compiled
def _kind(
    one: NDArray[np.float32], other: NDArray[np.float32], direction: int,
    far_m: float, same_m: float, same: float,
) -> int:  # fmt: skip
    """Tell what the ends in and beside a direction say of it; -1 for nothing."""
    if one[direction] <= 0.0 or other[direction] <= 0.0:
        return -1
    agrees = far = False
    for aside in (-1, 0, 1):
        beside = (direction + aside) % len(one)
        far = far or one[beside] >= far_m or other[beside] >= far_m
        for a, b in ((one[direction], other[beside]), (other[direction], one[beside])):
            agrees = agrees or (b > 0.0 and abs(a - b) < max(same_m, same * max(a, b)))
    if not far:
        return -1
    return AGREES if agrees else DIFFERS


@compiled
def _goes_past(
    one: NDArray[np.float32], other: NDArray[np.float32], direction: int, past_by: float
) -> bool:
    """Tell whether one goes on past all ends of the other in and beside a direction."""
    past = one[direction] < 0.0
    for aside in (-1, 0, 1):
        end = other[(direction + aside) % len(other)]
        past = past and 0.0 < end < -one[direction] * (1.0 - past_by)
    return bool(past)
