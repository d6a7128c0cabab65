"""Matching and merging for many sets of marks at once, as the draws of chance are.

The same answers as `match` and `merge` give for one set after the other; those are the
definitions.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ssrics_like.comparison.matching import NONE, match

AT_ONCE = 2_000_000
"""So many distances are looked at together, to bound memory."""


def places_found(
    marks: NDArray[np.float64], places: NDArray[np.float64], radius_m: float
) -> NDArray[np.bool_]:
    """Tell which places each set of marks finds, one to one.

    Parameters
    ----------
    marks : ndarray, shape (draws, n, 2)
        Sets of marks, metres; NaN for one that is not there.
    places : ndarray, shape (m, 2)
        The places.
    radius_m : float
        A mark finds a place at most this far away.

    Returns
    -------
    ndarray of bool, shape (draws, m)
    """
    draws, count = marks.shape[:2]
    found = np.zeros((draws, len(places)), bool)
    if count == 0 or len(places) == 0:
        return found
    chunk = max(1, AT_ONCE // (count * len(places)))
    for start in range(0, draws, chunk):
        some = marks[start : start + chunk]
        within = _squared(some[:, :, np.newaxis], places) <= radius_m**2
        found[start : start + chunk] = within.any(axis=1)
        # Where no mark reaches two places no two of them compete for one: whatever is in reach
        # is found. Elsewhere marks must be shared out.
        for i in np.flatnonzero((within.sum(axis=2) > 1).any(axis=1)):
            near = some[i][within[i].any(axis=1)]
            found[start + i] = match(near, places, radius_m) != NONE
    return found


def passages_found(
    along_m: NDArray[np.float64], passages_m: NDArray[np.float64], radius_m: float
) -> NDArray[np.int64]:
    """Count the passages that each set of marks finds, one to one, along the way.

    On a line the most pairs come about if each passage, in order, takes the first mark in reach
    that is left.

    Parameters
    ----------
    along_m : ndarray, shape (draws, n)
        Sets of marks, metres driven, rising.
    passages_m : ndarray, shape (k,)
        The passages, metres driven, rising.
    radius_m : float
        A mark finds a passage at most this far away.

    Returns
    -------
    ndarray of int64, shape (draws,)
    """
    draws, count = along_m.shape
    found = np.zeros(draws, np.int64)
    if count == 0:
        return found
    rows, next_mark = np.arange(draws), np.zeros(draws, np.int64)
    for passage_m in passages_m:
        away = along_m - passage_m
        next_mark = np.maximum(next_mark, (away < -radius_m).sum(axis=1))
        there = np.minimum(next_mark, count - 1)
        taken = (next_mark < count) & (away[rows, there] <= radius_m)
        next_mark += taken
        found += taken
    return found


def merged(marks: NDArray[np.float64], radius_m: float) -> NDArray[np.float64]:
    """Merge each set of marks as `ssrics_like.comparison.merging.merge` does.

    Parameters
    ----------
    marks : ndarray, shape (draws, n, 2)
        Sets of marks in order of time, metres.
    radius_m : float
        How near is the same place.

    Returns
    -------
    ndarray, shape (draws, groups, 2)
        The mean of each group, as many as the set with the most has; NaN for the others' rest.
    """
    draws, count = marks.shape[:2]
    firsts = np.full((draws, count, 2), np.inf)
    sums, sizes = np.zeros((draws, count, 2)), np.zeros((draws, count))
    rows, groups = np.arange(draws), np.zeros(draws, np.int64)
    for i in range(count):
        mark = marks[:, i]
        squared = _squared(firsts[:, : int(groups.max()) + 1], mark[:, np.newaxis])
        group = squared.argmin(axis=1)
        new = squared[rows, group] > radius_m**2
        group = np.where(new, groups, group)
        firsts[rows[new], groups[new]] = mark[new]
        groups += new
        sums[rows, group] += mark
        sizes[rows, group] += 1
    most = int(groups.max()) if count and draws else 0
    sizes[sizes == 0] = np.nan
    means: NDArray[np.float64] = (sums / sizes[..., np.newaxis])[:, :most]
    return means


def _squared(a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return squared distances, shape (...), of places of shape (..., 2)."""
    x, y = a[..., 0] - b[..., 0], a[..., 1] - b[..., 1]
    squared: NDArray[np.float64] = x * x + y * y
    return squared
