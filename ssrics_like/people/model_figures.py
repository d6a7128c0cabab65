"""How a model's runs meet what people marked, and where they stand among them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ssrics_like.people.ceiling import model_against_others
from ssrics_like.people.figures import Crowd, DrawnRuns, Figure
from ssrics_like.people.hits import MEASURES, hits
from ssrics_like.people.raters import alpha, fleiss, mean_kappa, weighted_fleiss
from ssrics_like.people.resampling import (
    centred_interval,
    interval,
    known_median,
    mean,
    mean_interval,
    weighted_means,
)


def model_figures(runs: DrawnRuns, crowd: Crowd, kappa: NDArray[np.float64]) -> dict[str, Figure]:
    """Return the figures of a model's runs.

    Parameters
    ----------
    runs : DrawnRuns
        What they marked.
    crowd : Crowd
        The people.
    kappa : ndarray, shape (people + runs, people + runs)
        Cohen's kappa of every pair, people first.

    Returns
    -------
    dict of str to Figure
        The keys are explained in `definitions`.
    """
    people = len(crowd)
    between, among = kappa[:people, people:], kappa[people:, people:]
    found = _against_consensus(runs, crowd)
    found["kappa_people"] = Figure(*mean_interval(between, crowd.weights, runs.weights))
    found["kappa_people_median"] = Figure(known_median(between))
    found["consistency"] = Figure(
        mean(among[np.triu_indices(len(among), 1)]),
        interval(mean_kappa(among, runs.weights), len(among)),
    )
    return found | _joined(runs, crowd) | model_against_others(runs, crowd)


def _joined(runs: DrawnRuns, crowd: Crowd) -> dict[str, Figure]:
    """Return the agreement of all people and one run, as one more of them; mean over the runs.

    In each draw people are drawn anew and the run is there once; then the runs are drawn. Whoever
    is drawn twice makes no pair with themselves, so that the run's pairs weigh more than among as
    many different people; draws are moved for that.
    """
    once = np.ones((len(crowd.weights), 1))
    weights = np.hstack([crowd.weights, once])
    tables = [np.vstack([crowd.marked, run]) for run in runs.marked]
    drawn = [weighted_fleiss(table, weights) for table in tables]
    found = {}
    for name, measure, column in (("fleiss", fleiss, 0), ("alpha", alpha, 1)):
        draws = np.column_stack([one[column] for one in drawn])
        value = mean(np.array([measure(table) for table in tables]))
        draws = weighted_means(draws, runs.weights)
        found[name] = Figure(value, centred_interval(draws, value, len(crowd), "kappa"))
    return found


def _against_consensus(runs: DrawnRuns, crowd: Crowd) -> dict[str, Figure]:
    """Return the means over the runs; in each draw, people form their consensus anew."""
    now = hits(runs.marked, crowd.consensus[np.newaxis])
    drawn = hits(runs.marked, crowd.drawn_consensus)
    found = {}
    for name in MEASURES:
        value = mean(now.measure(name))
        draws = weighted_means(drawn.measure(name), runs.weights)
        found[name] = Figure(value, centred_interval(draws, value, len(crowd), name))
    return found
