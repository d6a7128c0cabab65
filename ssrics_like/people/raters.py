"""Agreement beyond chance: of two markers, and of many.

References
----------
Cohen (1960), "A coefficient of agreement for nominal scales". Fleiss (1971), "Measuring nominal
scale agreement among many raters". Krippendorff (2004), "Content analysis", chapter 11, and
(2011), "Computing Krippendorff's alpha-reliability". Computed by statsmodels and krippendorff.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ssrics_like.people.hits import hits
from ssrics_like.people.optional import needed

PAIR = 2


def kappas(marked: ArrayLike) -> NDArray[np.float64]:
    """Return Cohen's kappa of every pair of markers.

    Parameters
    ----------
    marked : array_like of bool, shape (markers, units)
        Who marked which unit.

    Returns
    -------
    ndarray, shape (markers, markers)
        Symmetric; NaN on the diagonal, and where both markers marked all units, or both none.
    """
    cohens_kappa = needed("statsmodels.stats.inter_rater").cohens_kappa
    table = np.asarray(marked, bool)
    count = hits(table, table)
    found = np.full((len(table), len(table)), np.nan)
    for i in range(len(table)):
        for j in range(i):
            both, a, b = count.both[i, j], count.marked[i, j], count.wanted[i, j]
            if a == b == count.units or a == b == 0:
                continue
            cells = [[both, b - both], [a - both, count.units - a - b + both]]
            found[i, j] = found[j, i] = cohens_kappa(np.array(cells), return_results=False)
    return found


def fleiss(marked: ArrayLike) -> float:
    """Return Fleiss' kappa of markers, bool of shape (markers, units).

    NaN for fewer than two, and where all units are marked by everybody, or none by anybody.
    """
    table = np.asarray(marked, bool)
    if len(table) < PAIR or not _varies(table):
        return math.nan
    yes = table.sum(axis=0)
    counts = np.column_stack([len(table) - yes, yes])
    return float(needed("statsmodels.stats.inter_rater").fleiss_kappa(counts))


def alpha(marked: ArrayLike) -> float:
    """Return Krippendorff's alpha, nominal, of markers, bool of shape (markers, units).

    NaN as of `fleiss`.
    """
    table = np.asarray(marked, bool)
    if len(table) < PAIR or not _varies(table):
        return math.nan
    data = table.astype(np.float64)
    return float(
        needed("krippendorff").alpha(reliability_data=data, level_of_measurement="nominal")
    )


def mean_kappa(kappa: NDArray[np.float64], weights: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the mean kappa of all pairs of two different markers, each counted so often.

    Parameters
    ----------
    kappa : ndarray, shape (markers, markers)
        From `kappas`; pairs without a kappa are left out.
    weights : ndarray, shape (draws, markers)
        How often each marker counts.

    Returns
    -------
    ndarray, shape (draws,)
        NaN where no pair is left. A marker that counts twice makes no pair with itself.
    """
    known = np.isfinite(kappa)
    np.fill_diagonal(known, val=False)
    total = _quadratic(weights, np.where(known, kappa, 0.0))
    pairs = _quadratic(weights, known.astype(np.float64))
    means: NDArray[np.float64] = np.divide(
        total, pairs, out=np.full(len(weights), np.nan), where=pairs > 0
    )
    return means


def weighted_fleiss(
    marked: ArrayLike, weights: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return Fleiss' kappa and Krippendorff's alpha of markers that count so often.

    With every weight 1 they are those of `fleiss` and `alpha`. A marker that counts twice makes no
    pair with itself, for it would agree with itself about everything. What is to be expected by
    chance is taken from the same pairs: each marker counts as often as there are pairs with it.

    Parameters
    ----------
    marked : array_like of bool, shape (markers, units)
        Who marked which unit.
    weights : ndarray, shape (draws, markers)
        How often each marker counts.

    Returns
    -------
    kappa, alpha : ndarray, shape (draws,)
        NaN where there is no pair, or all that is said is the same.
    """
    table = np.asarray(marked, np.float64)
    markers, units = table.shape
    none = np.full(len(weights), np.nan)
    if markers < PAIR or units == 0:
        return none, none
    agree = np.array(hits(table, table).agreement)
    np.fill_diagonal(agree, 0.0)
    pairs = _quadratic(weights, 1.0 - np.eye(markers))
    observed = np.divide(_quadratic(weights, agree), pairs, out=none.copy(), where=pairs > 0)
    raters = weights.sum(axis=1)
    paired = weights * (raters[:, np.newaxis] - weights)  # how many pairs each marker is in
    p = paired @ table.mean(axis=1) / np.where(pairs > 0, pairs, np.nan)
    differ = 2.0 * p * (1.0 - p)  # how often two marks drawn from all would differ
    by_chance = np.where(differ > 0, differ, np.nan)
    kappa = 1.0 - (1.0 - observed) / by_chance
    values = raters * units
    alphas = 1.0 - (1.0 - observed) * (values - 1.0) / (values * by_chance)
    return kappa, alphas


def _quadratic(weights: NDArray[np.float64], table: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return w' A w of each row of weights."""
    found: NDArray[np.float64] = ((weights @ table) * weights).sum(axis=1)
    return found


def _varies(table: NDArray[np.bool_]) -> bool:
    return bool(table.any() and not table.all())
