"""Whether several runs find the same places."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike


def consistency(found: ArrayLike) -> float:
    """Return the mean pairwise agreement of runs about which places were found.

    Two runs agree about a place if both found it or both missed it. The figure is the share of
    places agreed about, averaged over all pairs of runs: 1 if every run finds the same places,
    about .5 if each place is found by the toss of a coin. Runs that find nothing agree too, so it
    is read beside recall.

    Parameters
    ----------
    found : array_like of bool, shape (runs, places)
        Which run found which place.

    Returns
    -------
    float
        NaN for fewer than two runs, or without places.
    """
    table = np.asarray(found, bool)
    runs, places = table.shape
    if runs < 2 or places == 0:  # noqa: PLR2004 - a pair
        return math.nan
    k = table.sum(axis=0)
    agreeing = k * (k - 1) + (runs - k) * (runs - k - 1)
    return float(agreeing.mean() / (runs * (runs - 1)))
