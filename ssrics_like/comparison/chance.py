"""Marks that know nothing: as many as the real ones, set anywhere on the way, or by a clock."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ssrics_like.comparison.way import Way

DRAWS = 200


def random_marks(
    way: Way, count: int, generator: np.random.Generator, draws: int = DRAWS
) -> NDArray[np.float64]:
    """Set marks at random along a way, uniformly by its length.

    Parameters
    ----------
    way : Way
        Where the robot was. A stretch over which it was carried gets no mark.
    count : int
        How many marks.
    generator : numpy.random.Generator
        Source of the randomness.
    draws : int
        How often they are set.

    Returns
    -------
    ndarray, shape (draws, count)
        Metres driven up to each, rising; all 0 where nothing was driven.
    """
    return np.sort(generator.uniform(0.0, way.length_m, (draws, count)), axis=1)


def clock_marks(
    way: Way, count: int, generator: np.random.Generator, draws: int = DRAWS
) -> NDArray[np.float64]:
    """Set marks along a way at equal intervals of time, the first of them at a random moment.

    Marks at random clump, and leave places out that evenly spaced ones meet. A rule that marks
    every so many scans, whatever they show, is to be compared with this.

    Parameters
    ----------
    way : Way
        Where the robot was, at equal intervals of time; at least one pose.
    count : int
        How many marks.
    generator : numpy.random.Generator
        Source of the random moment.
    draws : int
        How often they are set.

    Returns
    -------
    ndarray, shape (draws, count)
        Metres driven up to each, rising: those of poses of the way.
    """
    moments = (np.arange(count) + generator.random((draws, 1))) / max(count, 1)
    along: NDArray[np.float64] = way.along_m[(moments * len(way.xy_m)).astype(np.int64)]
    return along
