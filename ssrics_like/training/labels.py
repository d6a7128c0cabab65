"""What the learner is told of each place: in a doorway, not in one, or nothing."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.spatial.distance import cdist

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ssrics_like.training.examples import Example

NOT, DOORWAY, LEFT_OUT = 0, 1, -1
WITHIN_M = 0.3
"""A place is in a doorway if it is nearer than this to the middle."""
ARGUABLE_M = 0.6
"""Up to here one may or may not say so."""
OTHER_M = 1.0
"""Around an opening, junction or corner one may say so too: people do not agree about them."""


def labels(example: Example) -> NDArray[np.int8]:
    """Return DOORWAY, NOT or LEFT_OUT for each place.

    Parameters
    ----------
    example : Example
        The places and the truth.

    Returns
    -------
    ndarray, shape (places,), int8
    """
    doorway_m = nearest(example.xy_m, example.doorways_m)
    told = np.full(len(doorway_m), NOT, np.int8)
    told[nearest(example.xy_m, example.others_m) < OTHER_M] = LEFT_OUT
    told[doorway_m < ARGUABLE_M] = LEFT_OUT
    told[doorway_m < WITHIN_M] = DOORWAY
    return told


def nearest(places: NDArray[np.float64], marks: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return how far the nearest mark is from each place, metres; infinity if there is none."""
    distances: NDArray[np.float64] = cdist(places, marks).min(axis=1, initial=np.inf)
    return distances
