"""Intervals from people and runs drawn anew."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scipy.stats import norm, t

from ssrics_like.comparison.proportions import LEVEL

Weights = NDArray[np.float64]
Interval = tuple[float, float]
UNKNOWN: Interval = (math.nan, math.nan)
LIMITS = {
    "precision": (0.0, 1.0), "recall": (0.0, 1.0), "f": (0.0, 1.0), "kappa": (-1.0, 1.0),
    "above_chance": (-math.inf, 1.0),
}  # fmt: skip
"""What a measure cannot exceed."""
LEAST = 5
"""People, or runs, that an interval is drawn from.

Of four the widened percentiles lie beyond the most extreme draws, those of one marker again and
again, so that the interval would be the range of what these four did.
"""
ALIKE = 1e-12
TOLD = 0.5
"""At least this share of the draws must have a value."""


def drawn(generator: np.random.Generator, draws: int, count: int) -> Weights:
    """Draw `count` of `count` with replacement, again and again: how often each was drawn.

    Returns
    -------
    ndarray, shape (draws, count)
    """
    if count == 0:
        return np.zeros((draws, 0))
    return generator.multinomial(count, np.full(count, 1.0 / count), draws).astype(np.float64)


def interval(values: NDArray[np.float64], count: int, level: float = LEVEL) -> Interval:
    """Return the percentile interval of what was found in draws, widened for small samples.

    Parameters
    ----------
    values : ndarray, shape (draws,)
        What was found in each draw; NaN where nothing can be said.
    count : int
        How many were drawn from: people or runs, whichever are the sample.
    level : float
        Confidence level.

    Returns
    -------
    low, high : float
        NaN for fewer than `LEAST`, where most draws have no value, and where all draws are alike:
        they say nothing of what other people, or runs, would do.

    References
    ----------
    Efron (1979), "Bootstrap methods"; expanded percentiles after Hesterberg (2015), "What teachers
    should know about the bootstrap": drawing n of n has a variance (n - 1) / n times too small, and
    Student's quantiles replace the normal ones.
    """
    if count < LEAST:
        return UNKNOWN
    known = values[np.isfinite(values)]
    if len(known) < TOLD * len(values) or len(known) == 0 or np.ptp(known) < ALIKE:
        return UNKNOWN
    wide = widened_tail(count, level)
    low, high = np.quantile(known, [wide, 1.0 - wide]).tolist()
    return low, high


def widened_tail(count: int, level: float = LEVEL) -> float:
    """Return the share of draws below an interval of two markers or more, widened for few."""
    tail = (1.0 - level) / 2.0
    return float(norm.cdf(math.sqrt(count / (count - 1)) * t.ppf(tail, count - 1)))


def centred_interval(
    values: NDArray[np.float64], value: float, count: int, measure: str = ""
) -> Interval:
    """Return the interval of a figure against a consensus that is formed anew in each draw.

    Of the people drawn some are drawn twice, so that fewer form the consensus, it wavers more, and
    every figure against it comes out worse than it would from as many different people. Therefore
    the draws are moved until their mean is the figure itself.

    Parameters
    ----------
    values : ndarray, shape (draws,)
        What was found in each draw.
    value : float
        The figure.
    count : int
        How many people there are.
    measure : str
        Its name, for the limits that it cannot exceed; none if left out.
    """
    low, high = interval(values, count)
    moved = value - mean(values)
    least, most = LIMITS.get(measure, (-math.inf, math.inf))
    return max(low + moved, least), min(high + moved, most)


def drawn_means(table: NDArray[np.float64], people: Weights, runs: Weights) -> NDArray[np.float64]:
    """Return the mean of a table in each draw of people and runs, shape (draws,).

    Parameters
    ----------
    table : ndarray, shape (people, runs)
        A value of each pair; NaN where it has none.
    people, runs : ndarray, shape (draws, people) and (draws, runs)
        How often each counts in each draw.
    """
    known = np.isfinite(table)
    total = ((people @ np.where(known, table, 0.0)) * runs).sum(axis=1)
    count = ((people @ known.astype(np.float64)) * runs).sum(axis=1)
    means: NDArray[np.float64] = np.divide(
        total, count, out=np.full(len(total), np.nan), where=count > 0
    )
    return means


def mean_interval(
    table: NDArray[np.float64], people: Weights, runs: Weights
) -> tuple[float, Interval]:
    """Return the mean of a table of people and runs, and its interval; as `drawn_means`."""
    return mean(table), interval(drawn_means(table, people, runs), table.shape[0])


def mean(values: NDArray[np.float64], axis: int | None = None) -> float:
    """Return the mean of what is known; NaN where nothing is."""
    return float(known_mean(values, axis=axis))


def known_mean(values: NDArray[np.float64], axis: int | None = None) -> NDArray[np.float64]:
    """Return means along an axis of what is known; NaN where nothing is."""
    known = np.isfinite(values)
    count = known.sum(axis=axis)
    total = np.where(known, values, 0.0).sum(axis=axis)
    means: NDArray[np.float64] = np.divide(
        total, count, out=np.full(np.shape(total), np.nan), where=count > 0
    )
    return means


def known_median(values: NDArray[np.float64]) -> float:
    """Return the median of what is known; NaN where nothing is."""
    known = values[np.isfinite(values)]
    return float(np.median(known)) if len(known) else math.nan


def weighted_means(values: NDArray[np.float64], weights: Weights) -> NDArray[np.float64]:
    """Return weighted means of what is known along the last axis; NaN where nothing is."""
    known = np.isfinite(values)
    total = (np.where(known, values, 0.0) * weights).sum(axis=1)
    count = (known * weights).sum(axis=1)
    means: NDArray[np.float64] = np.divide(
        total, count, out=np.full(len(total), np.nan), where=count > 0
    )
    return means
