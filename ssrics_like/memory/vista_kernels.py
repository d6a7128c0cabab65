"""The compiled inner loop that compares what is seen in the distance from many places."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.compiling import compiled

if TYPE_CHECKING:
    from numpy.typing import NDArray


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
    # One direction more at either end, so that each has one beside it on both sides.
    one, other = np.empty(directions + 2, np.float32), np.empty(directions + 2, np.float32)
    alike, crosswise = np.empty(directions + 1, np.bool_), np.empty(directions + 1, np.bool_)
    compared, agrees = np.empty(directions + 2, np.bool_), np.empty(directions + 2, np.bool_)
    for index in range(len(turns)):
        j = (-1 - turns[index]) % directions
        for k in range(directions + 2):
            one[k] = seen[j]
            j = j + 1 if j + 1 < directions else 0
        for k in range(directions):
            other[k + 1] = remembered[k, index]
        other[0], other[directions + 1] = other[directions], other[1]
        for k in range(directions + 1):
            alike[k] = _same(one[k], other[k], same_m, same)
            crosswise[k] = _same(one[k], other[k + 1], same_m, same) | _same(
                one[k + 1], other[k], same_m, same
            )
        for k in range(1, directions + 1):
            farthest = max(one[k - 1], one[k], one[k + 1], other[k - 1], other[k], other[k + 1])
            compared[k] = (one[k] > 0.0) & (other[k] > 0.0) & (farthest >= far_m)
            agrees[k] = compared[k] & (alike[k] | crosswise[k - 1] | crosswise[k])
        agrees[0], agrees[directions + 1] = agrees[directions], agrees[1]
        found = False
        for k in range(1, directions + 1):
            found |= compared[k] & (not (agrees[k - 1] | agrees[k] | agrees[k + 1]))
        differs[index] = found
        goes_past = False
        for k in range(1, directions + 1):
            goes_past |= _goes_past(one, other, k, past_by) | _goes_past(other, one, k, past_by)
        past[index] = goes_past


@compiled
def _same(a: float, b: float, same_m: float, same: float) -> bool:
    """Tell whether two ends are the same; False if one is none."""
    return bool((a > 0.0) & (b > 0.0) & (abs(a - b) < max(same_m, same * max(a, b))))


@compiled
def _goes_past(
    one: NDArray[np.float32], other: NDArray[np.float32], k: int, past_by: float
) -> bool:
    """Tell whether one goes on past all ends of the other in and beside a direction."""
    nearest = min(other[k - 1], other[k], other[k + 1])
    farthest = max(other[k - 1], other[k], other[k + 1])
    return bool((nearest > 0.0) & (farthest < -one[k] * (1.0 - past_by)))
