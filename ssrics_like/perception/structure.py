"""What a place looks like, in one word."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

from ssrics_like.perception.gap import FEATURES

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

Structure = Literal["unknown", "doorway", "corridor", "room"]

CORRIDOR_M = 3.2
"""A corridor is nowhere wider than this from a metre behind to a metre ahead."""

_WIDEST = [
    i
    for i, name in enumerate(FEATURES)
    if name.startswith("widest_m@") and not name.startswith(("widest_m@-2.0", "widest_m@+1.1"))
]


def corridor_or_room(measures: NDArray[np.float64]) -> Structure:
    """Tell by how wide it is around a place.

    Parameters
    ----------
    measures : ndarray, shape (features,)
        Of the place; see `ssrics_like.perception.gap.FEATURES`.
    """
    return "corridor" if measures[_WIDEST].max() <= CORRIDOR_M else "room"
