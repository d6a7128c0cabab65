"""What people agree about: the units that at least half of them marked."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ssrics_like.people.settings import CONSENSUS

ROUNDING = 1e-9


def consensus_of(marked: ArrayLike, weights: ArrayLike | None = None) -> NDArray[np.bool_]:
    """Return the units that at least half of the people marked.

    Parameters
    ----------
    marked : array_like of bool, shape (people, units)
        Who marked which unit.
    weights : array_like, shape (draws, people), optional
        How often each person counts, in as many ways; once each if left out.

    Returns
    -------
    ndarray of bool, shape (draws, units)
        One row where weights are left out. None at all where nobody counts.
    """
    table = np.asarray(marked, np.float64)
    counts = np.ones((1, len(table))) if weights is None else np.asarray(weights, np.float64)
    people = counts.sum(axis=1, keepdims=True)
    agreed: NDArray[np.bool_] = counts @ table >= CONSENSUS * people - ROUNDING
    return np.asarray(agreed & (people > 0))


def consensus_of_others(marked: ArrayLike) -> NDArray[np.bool_]:
    """Return for each person the consensus of all the others, shape (people, units)."""
    table = np.asarray(marked, bool)
    return consensus_of(table, 1.0 - np.eye(len(table)))
