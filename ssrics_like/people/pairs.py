"""Two models on the same people: which comes nearer to people, and whether that may be chance."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.stats import permutation_test

from ssrics_like.people.figures import Figure
from ssrics_like.people.hits import hits
from ssrics_like.people.optional import needed
from ssrics_like.people.resampling import Weights, drawn_means, interval, known_mean
from ssrics_like.people.settings import CONSENSUS

MEASURES = ("f", "kappa")
LOCATIONS = "locations"
"""Name of the comparison of who is right about which location."""
DRAWS = 9999
"""So many changes of sign are drawn where there are more of them, that is from 14 people on."""


@dataclass(frozen=True, slots=True)
class Pair:
    """One comparison of two models.

    Attributes
    ----------
    first, second : str
        The models.
    measure : str
        ``f`` or ``kappa`` (with each person), or ``locations``.
    difference : Figure
        The first less the second. For ``locations``, of the share of them about which most runs
        agree with the consensus; without an interval.
    count : int
        People, or locations, that are compared.
    p : float
        Probability of such a difference if the models were alike; two-sided.
    p_holm : float
        The same, corrected for the number of pairs of models.
    """

    first: str
    second: str
    measure: str
    difference: Figure
    count: int
    p: float
    p_holm: float = math.nan


def compared_pairs(
    marked: dict[str, NDArray[np.bool_]],
    people: NDArray[np.bool_],
    people_weights: Weights,
    run_weights: dict[str, Weights],
    consensus: NDArray[np.bool_],
    generator: np.random.Generator,
) -> tuple[Pair, ...]:
    """Compare every two models.

    The participants are the sample. Of each, the mean over the runs of a model of how near they
    come to what this participant marked is taken, so that the values of different participants do
    not depend on each other as those against a common consensus would.

    Parameters
    ----------
    marked : dict of str to ndarray of bool, shape (runs, units)
        Which run of each model marked which unit.
    people : ndarray of bool, shape (people, units)
        Who marked which unit.
    people_weights : ndarray, shape (draws, people)
        How often each person counts in each draw.
    run_weights : dict of str to ndarray, shape (draws, runs)
        How often each run counts in each draw.
    consensus : ndarray of bool, shape (locations,)
        What people agree about the locations on the route, which are the first units.
    generator : numpy.random.Generator
        Draws changes of sign.
    """
    pairs = []
    for first, second in itertools.combinations(marked, 2):
        near = hits(marked[first], people), hits(marked[second], people)
        for measure in MEASURES:
            a, b = (one.measure(measure) for one in near)
            pairs.append(
                _by_people(
                    first, second, measure, a, b,
                    people_weights, (run_weights[first], run_weights[second]), generator,
                )
            )  # fmt: skip
        pairs.append(_by_locations(first, second, marked, consensus))
    return _holm(pairs)


def _by_people(
    first: str,
    second: str,
    measure: str,
    a: NDArray[np.float64],
    b: NDArray[np.float64],
    people: Weights,
    runs: tuple[Weights, Weights],
    generator: np.random.Generator,
) -> Pair:
    """Compare by people: a and b have the shapes (people, runs of each model)."""
    mine, theirs = known_mean(a, axis=1), known_mean(b, axis=1)
    known = np.isfinite(mine) & np.isfinite(theirs)
    drawn = drawn_means(a[known], people[:, known], runs[0])
    drawn -= drawn_means(b[known], people[:, known], runs[1])
    count = int(known.sum())
    p = math.nan
    if count > 1:
        p = float(
            permutation_test(
                (mine[known], theirs[known]), _difference, permutation_type="samples",
                vectorized=True, n_resamples=DRAWS, rng=generator,
            ).pvalue
        )  # fmt: skip
    value = float(_difference(mine[known], theirs[known])) if count else math.nan
    return Pair(first, second, measure, Figure(value, interval(drawn, count)), count, p)


def _difference(
    a: NDArray[np.float64], b: NDArray[np.float64], axis: int = -1
) -> NDArray[np.float64]:
    return np.asarray((a - b).mean(axis=axis))


def _by_locations(
    first: str,
    second: str,
    marked: dict[str, NDArray[np.bool_]],
    consensus: NDArray[np.bool_],
) -> Pair:
    """Compare by McNemar's exact test (1947) what most runs say of each location."""
    count = len(consensus)
    if count == 0:
        return Pair(first, second, LOCATIONS, Figure(), 0, math.nan)
    a, b = (
        (marked[name][:, :count].mean(axis=0) >= CONSENSUS) == consensus for name in (first, second)
    )
    table = [[(a & b).sum(), (a & ~b).sum()], [(~a & b).sum(), (~a & ~b).sum()]]
    mcnemar = needed("statsmodels.stats.contingency_tables").mcnemar
    p = float(mcnemar(np.array(table), exact=True).pvalue)
    return Pair(first, second, LOCATIONS, Figure(float(a.mean() - b.mean())), count, p)


def _holm(pairs: Sequence[Pair]) -> tuple[Pair, ...]:
    """Correct each measure for the number of pairs of models (Holm 1979)."""
    multipletests = needed("statsmodels.stats.multitest").multipletests
    corrected = list(pairs)
    for measure in (*MEASURES, LOCATIONS):
        chosen = [
            i for i, pair in enumerate(pairs) if pair.measure == measure and math.isfinite(pair.p)
        ]
        if chosen:
            _, values, *_ = multipletests([pairs[i].p for i in chosen], method="holm")
            for i, p in zip(chosen, values.tolist(), strict=True):
                corrected[i] = replace(pairs[i], p_holm=p)
    return tuple(corrected)
