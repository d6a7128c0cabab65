"""Shares, how certain they are, and what is made of two of them. NaN for what cannot be said."""

from __future__ import annotations

import math

from scipy.stats import binomtest

LEVEL = 0.95


def share(part: float, whole: float) -> float:
    """Return part / whole; NaN where there is nothing to have a share of."""
    return part / whole if whole > 0 else math.nan


def wilson(found: int, tried: int, level: float = LEVEL) -> tuple[float, float]:
    """Return the Wilson score interval of a proportion.

    Parameters
    ----------
    found, tried : int
        Successes, and trials; 0 <= found <= tried.
    level : float
        Confidence level.

    Returns
    -------
    low, high : float
        NaN both where nothing was tried.

    References
    ----------
    Wilson (1927), "Probable inference, the law of succession, and statistical inference";
    computed by scipy.
    """
    if tried == 0:
        return math.nan, math.nan
    interval = binomtest(found, tried).proportion_ci(confidence_level=level, method="wilson")
    return float(interval.low), float(interval.high)


def chance_corrected(recall: float, chance: float) -> float:
    """Return (r - c) / (1 - c): 0 at chance, 1 if perfect, negative below chance.

    NaN where chance finds everything, for then nothing can be told. The form is that of Cohen's
    kappa (1960).
    """
    return (recall - chance) / (1.0 - chance) if chance < 1.0 else math.nan


def harmonic_mean(a: float, b: float) -> float:
    """Return the harmonic mean of two shares, as the F measure is one; 0 if both are 0."""
    if a == b == 0.0:
        return 0.0
    return 2.0 * a * b / (a + b)
