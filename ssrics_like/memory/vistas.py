"""Whether one sees as far from one place as from another: a vista, direction by direction.

Who sees farther than to an end that is remembered is elsewhere, since nobody sees through walls.
Who sees an end nearer than remembered may be elsewhere, or somebody stands in the way.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

FAR_M = 12.0
"""What is nearer than this is in the room, and told by what surrounds the place."""
SAME_M, SAME = 1.0, 0.12
"""Two lengths that differ by the former, or by this share of the longer, are the same."""
AGREEING, FARTHER, LESS_FAR = -0.4, 0.6, 0.3
"""What it counts that an end agrees, that it goes on farther, and that it ends nearer."""


def contradiction(
    seen: NDArray[np.float32],
    turns: NDArray[np.int64],
    remembered: NDArray[np.float32],
) -> NDArray[np.float64]:
    """Tell how far what is seen in the distance contradicts what is remembered of places.

    Parameters
    ----------
    seen : ndarray, shape (directions,)
        Metres to an end; 0 where nothing was seen, below 0 where it goes on at least so far.
    turns : ndarray, shape (places,)
        By how many directions that is turned to fit each place.
    remembered : ndarray, shape (directions, places)
        The same of the places.

    Returns
    -------
    ndarray, shape (places,), float64
        From `AGREEING`, where all agrees, to `FARTHER` + `LESS_FAR`; 0 where nothing can be
        compared.
    """
    # Compiled code is loaded only where it is needed.
    from ssrics_like.memory import vista_kernels  # noqa: PLC0415

    found = np.zeros((len(turns), 3), np.bool_)
    vista_kernels.compare_vistas(seen, turns, remembered, FAR_M, SAME_M, SAME, found)
    share: NDArray[np.float64] = found @ np.array([AGREEING, FARTHER, LESS_FAR])
    return share


def farther(one: NDArray[np.float32], other: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return the farther of two vistas in each direction; an end, if both may be that.

    As perception does with two beams, of which memory knows nothing.

    Parameters
    ----------
    one, other : ndarray, shape (directions,)
        As for `contradiction`, of one place.
    """
    found = np.where(np.abs(other) > np.abs(one), other, one)
    for end, more in ((one, other), (other, one)):
        same = (end > 0.0) & (more < 0.0) & (-more <= (1.0 + SAME) * end)
        found = np.where(same, end, found)
    return np.asarray(found, np.float32)
