"""Which mark found which place: one to one, within a radius."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import linear_sum_assignment
from scipy.spatial.distance import cdist

NONE = -1
"""Stands for the mark of a place that no mark found."""


def points(places: ArrayLike) -> NDArray[np.float64]:
    """Return places as an array of shape (n, 2); none at all have shape (0, 2)."""
    return np.asarray(places, np.float64).reshape(-1, 2)


def match(marks: ArrayLike, places: ArrayLike, radius_m: float) -> NDArray[np.int64]:
    """Pair marks with places, as many as can be, and these as near as can be.

    A mark finds at most one place and a place is found by at most one mark, so that one mark
    between two doorways does not count for both.

    Parameters
    ----------
    marks : array_like, shape (n, 2)
        Where the robot marked something, metres.
    places : array_like, shape (m, 2)
        Where it should have.
    radius_m : float
        A mark finds a place at most this far away.

    Returns
    -------
    ndarray of int64, shape (m,)
        For each place the index of its mark; -1 for one that was not found.

    References
    ----------
    Kuhn (1955), "The Hungarian method for the assignment problem"; solved by scipy.
    """
    marks, places = points(marks), points(places)
    found = np.full(len(places), NONE, np.int64)
    distances = cdist(marks, places)
    within = distances <= radius_m
    near = np.flatnonzero(within.any(axis=1))
    if len(near) == 0:
        return found
    distances, within = distances[near], within[near]
    # Whatever lies out of reach costs more than all pairs within reach together, so that the
    # cheapest assignment has the most pairs, and of those the shortest.
    far = (min(within.shape) + 1) * (radius_m + 1)
    rows, columns = linear_sum_assignment(np.where(within, distances, far))
    good = within[rows, columns]
    found[columns[good]] = near[rows[good]]
    return found
