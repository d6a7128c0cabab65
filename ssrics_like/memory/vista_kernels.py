"""The compiled inner loop that compares what is seen in the distance from many places."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ssrics_like.compiling import compiled

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

AGREES, FARTHER, LESS_FAR = 0, 1, 2


@compiled
def compare_vistas(
    seen: NDArray[np.float32],
    turns: NDArray[np.int64],
    remembered: NDArray[np.float32],
    far_m: float,
    same_m: float,
    same: float,
    found: NDArray[np.bool_],
) -> None:
    """Tell whether a vista agrees with remembered ones in some direction, or contradicts them.

    Asked of each direction in which one of both goes on farther than beside it, and far, if the
    other was seen there and on both sides.

    Parameters
    ----------
    seen, turns, remembered : as for `vistas.contradiction`
    far_m : float
        Nearer ends say nothing.
    same_m, same : float
        Two lengths that differ by the former, or by this share of the longer, are the same.
    found : ndarray, shape (places, 3)
        Set where an end agrees, something is seen farther than to an end remembered, and an end is
        seen nearer.
    """
    directions = len(seen)
    for place in range(len(turns)):
        turn = turns[place]
        for k in range(directions):
            left, right = (k + 1) % directions, (k - 1) % directions
            a, b, c = (
                seen[(k - turn) % directions],
                seen[(left - turn) % directions],
                seen[(right - turn) % directions],
            )
            x, y, z = remembered[k, place], remembered[left, place], remembered[right, place]
            kind = _kind(a, b, c, x, y, z, far_m, same_m, same, FARTHER, LESS_FAR)
            if kind >= 0:
                found[place, kind] = True
            kind = _kind(x, y, z, a, b, c, far_m, same_m, same, LESS_FAR, FARTHER)
            if kind >= 0:
                found[place, kind] = True


@compiled
def _kind(
    peak: float, left: float, right: float, x: float, y: float, z: float,
    far_m: float, same_m: float, same: float, above: int, below: int,
) -> int:  # fmt: skip
    """Tell what three lengths say of the middle one of three others; -1 for nothing."""
    far = abs(peak)
    if far <= far_m or far < max(abs(left), abs(right)) or x == 0.0 or y == 0.0 or z == 0.0:
        return -1
    most, end = 0.0, False
    for other in (x, y, z):
        if abs(far - abs(other)) < max(same_m, same * max(far, abs(other))):
            return AGREES if peak > 0.0 and other > 0.0 else -1
        if abs(other) > most:
            most, end = abs(other), other > 0.0
    if most < far:
        return above if end else -1
    return below if peak > 0.0 else -1
