"""Two models on the same people: which comes nearer to people, and whether that may be chance."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.stats import permutation_test

from ssrics_like.people.figures import Crowd, DrawnRuns, Figure
from ssrics_like.people.hits import hits
from ssrics_like.people.optional import needed
from ssrics_like.people.resampling import drawn_means, interval, known_mean
from ssrics_like.people.settings import CONSENSUS

MEASURES = ("f", "kappa")
LOCATIONS = "locations"
"""Name of the comparison of who is right about which location."""
DRAWS = 9999
"""So many changes of sign, or exchanges of runs, are drawn where there are more of them."""


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
        Probability of such a difference if the models were alike, over people or locations;
        two-sided.
    p_runs : float
        The same over runs; NaN for ``locations``, and where a model has a single run.
    p_holm : float
        The larger of both, corrected for the number of pairs of models.
    """

    first: str
    second: str
    measure: str
    difference: Figure
    count: int
    p: float
    p_runs: float = math.nan
    p_holm: float = math.nan

    @property
    def p_largest(self) -> float:
        """The larger of both probabilities; NaN where that over people cannot be said."""
        return self.p if math.isnan(self.p_runs) else max(self.p, self.p_runs)


def compared_pairs(
    models: Mapping[str, DrawnRuns],
    crowd: Crowd,
    locations: int,
    generator: np.random.Generator,
) -> tuple[Pair, ...]:
    """Compare every two models.

    Of each person, the mean over the runs of a model of how near they come to what this person
    marked is taken, so that the values of different people do not depend on each other as those
    against a common consensus would. Both people and runs are samples. A difference that all
    people see in the same few runs may be one of these runs, not of the models, as Clark (1973)
    said of the words of an experiment; therefore runs are exchanged between the models, too, and
    the larger probability counts.

    Parameters
    ----------
    models : mapping of str to DrawnRuns
        What the runs of each model marked.
    crowd : Crowd
        The people.
    locations : int
        How many of the units, the first ones, are locations.
    generator : numpy.random.Generator
        Draws changes of sign and exchanges.
    """
    pairs = []
    for first, second in itertools.combinations(models, 2):
        chosen = models[first], models[second]
        near = [hits(runs.marked, crowd.marked) for runs in chosen]
        for measure in MEASURES:
            a, b = (one.measure(measure) for one in near)
            over_people = _by_people(chosen, crowd, a, b, generator)
            over_runs = _by_runs(a, b, generator)
            pairs.append(Pair(first, second, measure, *over_people, over_runs))
        pairs.append(_by_locations(first, second, chosen, crowd.consensus[:locations]))
    return _holm(pairs)


def _by_people(
    runs: tuple[DrawnRuns, DrawnRuns],
    crowd: Crowd,
    a: NDArray[np.float64],
    b: NDArray[np.float64],
    generator: np.random.Generator,
) -> tuple[Figure, int, float]:
    """Compare by people: a and b have the shapes (people, runs of each model).

    Returns
    -------
    tuple of Figure, int and float
        The difference, of how many people, and its probability over them.
    """
    mine, theirs = known_mean(a, axis=1), known_mean(b, axis=1)
    known = np.isfinite(mine) & np.isfinite(theirs)
    count, people = int(known.sum()), crowd.weights[:, known]
    if count == 0:
        return Figure(), 0, math.nan
    drawn = drawn_means(a[known], people, runs[0].weights)
    drawn -= drawn_means(b[known], people, runs[1].weights)
    p = math.nan
    if count > 1:
        p = _permuted(mine[known], theirs[known], "samples", generator)
    return Figure(float((mine - theirs)[known].mean()), interval(drawn, count)), count, p


def _by_runs(
    a: NDArray[np.float64], b: NDArray[np.float64], generator: np.random.Generator
) -> float:
    """Return the probability of the difference if runs were exchanged between the models.

    NaN where a model has a single run.
    """
    mine, theirs = (known_mean(values, axis=0) for values in (a, b))
    mine, theirs = mine[np.isfinite(mine)], theirs[np.isfinite(theirs)]
    if min(len(mine), len(theirs)) < 2:  # noqa: PLR2004 - one does not tell how runs differ
        return math.nan
    return _permuted(mine, theirs, "independent", generator)


def _permuted(
    a: NDArray[np.float64], b: NDArray[np.float64], kind: str, generator: np.random.Generator
) -> float:
    """Return the two-sided probability of a difference of means under a permutation."""
    return float(
        permutation_test(
            (a, b), _difference, permutation_type=kind, vectorized=True, n_resamples=DRAWS,
            rng=generator,
        ).pvalue
    )  # fmt: skip


def _difference(
    a: NDArray[np.float64], b: NDArray[np.float64], axis: int = -1
) -> NDArray[np.float64]:
    return np.asarray(a.mean(axis=axis) - b.mean(axis=axis))


def _by_locations(
    first: str,
    second: str,
    runs: tuple[DrawnRuns, DrawnRuns],
    consensus: NDArray[np.bool_],
) -> Pair:
    """Compare by McNemar's exact test (1947) what most runs say of each location."""
    count = len(consensus)
    if count == 0:
        return Pair(first, second, LOCATIONS, Figure(), 0, math.nan)
    a, b = ((one.marked[:, :count].mean(axis=0) >= CONSENSUS) == consensus for one in runs)
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
            i
            for i, pair in enumerate(pairs)
            if pair.measure == measure and math.isfinite(pair.p_largest)
        ]
        if chosen:
            _, values, *_ = multipletests([pairs[i].p_largest for i in chosen], method="holm")
            for i, p in zip(chosen, values.tolist(), strict=True):
                corrected[i] = replace(pairs[i], p_holm=p)
    return tuple(corrected)
