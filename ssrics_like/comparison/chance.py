"""What as many marks would find that know nothing: set anywhere on the way, or by a clock."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ssrics_like.comparison.matching import points

DRAWS = 200
CARRIED_M = 5.0
"""Between two poses of a path, a tenth of a second apart, no robot drives this far."""

Statistic = Callable[[NDArray[np.float64]], ArrayLike]
"""Takes marks, shape (n, 2); returns a number, or an array of them."""


def random_marks(
    path: ArrayLike, count: int, generator: np.random.Generator
) -> NDArray[np.float64]:
    """Set marks at random along a path, uniformly by its length.

    Parameters
    ----------
    path : array_like, shape (poses, 2)
        Where the robot was, in order, metres; at least one pose. A step of more than 5 m was not
        driven (the robot was carried) and gets no mark.
    count : int
        How many marks.
    generator : numpy.random.Generator
        Source of the randomness.

    Returns
    -------
    ndarray, shape (count, 2)
        All at one pose, where nothing was driven.
    """
    path = points(path)
    steps = np.hypot(*np.diff(path, axis=0).T)
    driven = np.concatenate([[0.0], np.where(steps > CARRIED_M, 0.0, steps).cumsum()])
    at = generator.uniform(0.0, driven[-1], count)
    leg = np.clip(np.searchsorted(driven, at, side="right") - 1, 0, max(len(path) - 2, 0))
    after = np.minimum(leg + 1, len(path) - 1)
    length = driven[after] - driven[leg]
    share = np.divide(at - driven[leg], length, out=np.zeros(count), where=length > 0)
    marks: NDArray[np.float64] = path[leg] + share[:, np.newaxis] * (path[after] - path[leg])
    return marks


def clock_marks(path: ArrayLike, count: int, generator: np.random.Generator) -> NDArray[np.float64]:
    """Set marks along a path at equal intervals of time, the first of them at a random moment.

    Marks at random clump, and leave places out that evenly spaced ones meet. A rule that marks
    every so many scans, whatever they show, is to be compared with this.

    Parameters
    ----------
    path : array_like, shape (poses, 2)
        Where the robot was, metres, at equal intervals of time; at least one pose.
    count : int
        How many marks.
    generator : numpy.random.Generator
        Source of the random moment.

    Returns
    -------
    ndarray, shape (count, 2)
        Poses of the path.
    """
    path = points(path)
    moments = (np.arange(count) + generator.random()) / max(count, 1)
    marks: NDArray[np.float64] = path[(moments * len(path)).astype(np.int64)]
    return marks


Placing = Callable[[ArrayLike, int, np.random.Generator], NDArray[np.float64]]


def mean_by_chance(
    path: ArrayLike,
    count: int,
    statistic: Statistic,
    generator: np.random.Generator,
    draws: int = DRAWS,
    placing: Placing = random_marks,
) -> NDArray[np.float64]:
    """Return the mean of a statistic over marks that know nothing, as many as the real ones.

    Parameters
    ----------
    path : array_like, shape (poses, 2)
        Where the robot was, metres.
    count : int
        How many marks it set there.
    statistic : callable
        What is asked of marks, for example which places they find.
    generator : numpy.random.Generator
        Source of the randomness.
    draws : int
        How often marks are drawn.
    placing : callable
        How they are set: `random_marks` or `clock_marks`.

    Returns
    -------
    ndarray
        Of the statistic's shape; NaN where the path has no pose.
    """
    path = points(path)
    if len(path) == 0:
        return np.full(np.shape(statistic(path)), np.nan)
    found = [np.asarray(statistic(placing(path, count, generator))) for _ in range(draws)]
    return np.asarray(np.mean(found, axis=0))
