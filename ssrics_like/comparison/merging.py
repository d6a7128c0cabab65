"""Marks of one place taken together, so that repetitions count neither for nor against."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ssrics_like.comparison.matching import points


def groups_of(marks: ArrayLike, radius_m: float) -> NDArray[np.int64]:
    """Group marks that lie within a radius of an earlier one.

    Marks are taken in order: each joins the nearest group whose first mark lies within the
    radius, or begins a group of its own. A group cannot creep along a path as a chain of
    neighbours would, and the first marks of any two groups are further apart than the radius.

    Parameters
    ----------
    marks : array_like, shape (n, 2)
        Marks in order of time, metres.
    radius_m : float
        How near is the same place.

    Returns
    -------
    ndarray of int64, shape (n,)
        The group of each mark, counted from 0 in order of the first marks.
    """
    marks = points(marks)
    joined = np.empty(len(marks), np.int64)
    firsts = np.empty_like(marks)
    groups = 0
    for i, mark in enumerate(marks):
        distances = np.hypot(*(firsts[:groups] - mark).T)
        group = int(distances.argmin()) if groups else 0
        if groups == 0 or distances[group] > radius_m:
            group = groups
            firsts[group] = mark
            groups += 1
        joined[i] = group
    return joined


def merge(marks: ArrayLike, radius_m: float) -> NDArray[np.float64]:
    """Merge marks that lie within a radius of an earlier one.

    Parameters
    ----------
    marks : array_like, shape (n, 2)
        Marks in order of time, metres.
    radius_m : float
        How near is the same place; see `groups_of`.

    Returns
    -------
    ndarray, shape (groups, 2)
        The mean of each group, in order of the first marks.
    """
    marks = points(marks)
    joined = groups_of(marks, radius_m)
    sizes = np.bincount(joined)
    sums = [np.bincount(joined, weights=marks[:, axis]) for axis in (0, 1)]
    return np.column_stack(sums) / sizes[:, np.newaxis]
