"""Whether what is at the end of the hallway is the same: a vista, direction by direction.

Rooms along a hallway are alike near by, but their doors are not as far from its ends.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

FAR_M = 12.0
"""What is nearer than this is in the room, and told by what surrounds the place."""
SAME_M, SAME = 0.7, 0.06
"""Two ends that differ by the former, or by this share of the longer, are the same."""
PAST, PAST_BY = 0.45, 0.12
"""What it counts that one goes on past an end of the other, by this share of how far that is at
least: it may be a gap. That an end differs counts 1."""


def contradiction(
    seen: NDArray[np.float32],
    turns: NDArray[np.int64],
    remembered: NDArray[np.float32],
) -> NDArray[np.float64]:
    """Tell how far what is seen in the distance contradicts what is remembered of places.

    Parameters
    ----------
    seen : ndarray, shape (directions,)
        Metres to an end; below 0 where it goes on at least so far; 0 where neither is known.
    turns : ndarray, shape (places,)
        By how many directions that is turned to fit each place.
    remembered : ndarray, shape (directions, places)
        The same of the places.

    Returns
    -------
    ndarray, shape (places,), float64
        1 where an end differs in some direction, else `PAST` where it goes on past one; else 0,
        also where nothing can be compared.
    """
    # Compiled code is loaded only where it is needed.
    from ssrics_like.memory import vista_kernels  # noqa: PLC0415

    differs, past = np.zeros((2, len(turns)), np.bool_)
    vista_kernels.compare_vistas(
        seen, turns, remembered, FAR_M, SAME_M, SAME, PAST_BY, differs, past
    )
    return np.where(differs, 1.0, np.where(past, PAST, 0.0))


def gathered(remembered: NDArray[np.float32], seen: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return what is known of a vista after another look: the ends seen last.

    Parameters
    ----------
    remembered, seen : ndarray, shape (directions,)
        As for `contradiction`, of one place.
    """
    unknown = (seen <= 0.0) & (remembered <= 0.0)
    known = np.where(seen > 0.0, seen, remembered)
    return np.asarray(np.where(unknown, np.minimum(seen, remembered), known), np.float32)
