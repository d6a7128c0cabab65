"""The human ceiling: each person, or a model in their place, against the consensus of the others.

People and runs are drawn anew, and in each draw the others form their consensus anew, so that the
intervals hold how uncertain it is, too.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from ssrics_like.people.consensus import consensus_of
from ssrics_like.people.figures import Crowd, Figure
from ssrics_like.people.hits import MEASURES, hits
from ssrics_like.people.resampling import (
    Weights,
    centred_interval,
    known_mean,
    mean,
    mean_interval,
    weighted_means,
)

HELD = ("f", "kappa")
"""The measures in which a model is held against the people."""

Draws = dict[str, NDArray[np.float64]]


def people_against_others(crowd: Crowd) -> dict[str, Figure]:
    """Return the mean over people of how each meets the consensus of the others."""
    drawn = _people_in_draws(crowd)
    found = {}
    for name in MEASURES:
        value = mean(crowd.against_others.measure(name))
        draws = weighted_means(drawn[name], crowd.weights)
        found[f"{name}_others"] = Figure(value, centred_interval(draws, value, len(crowd), name))
    return found


def model_against_others(
    marked: NDArray[np.bool_], crowd: Crowd, weights: Weights
) -> dict[str, Figure]:
    """Return where the runs of a model stand as one more participant.

    Parameters
    ----------
    marked : ndarray of bool, shape (runs, units)
        Which run marked which unit.
    crowd : Crowd
        The people.
    weights : ndarray, shape (draws, runs)
        How often each run counts in each draw.

    Returns
    -------
    dict of str to Figure
        For F and kappa: the mean against the others of each person, that less the person's own,
        and the share of people who are exceeded.
    """
    own, runs = crowd.against_others, hits(marked, crowd.others)
    people, model = _people_in_draws(crowd), _model_in_draws(marked, crowd, weights)
    once = np.ones((len(crowd.weights), 1))
    found = {}
    for name in HELD:
        theirs, mine = own.measure(name), known_mean(runs.measure(name), axis=1)
        level, above = mean(mine), mean(mine - theirs)
        draws = weighted_means(model[name], crowd.weights)
        differences = weighted_means(model[name] - people[name], crowd.weights)
        found[f"{name}_others"] = Figure(level, centred_interval(draws, level, len(crowd), name))
        found[f"{name}_ceiling"] = Figure(above, centred_interval(differences, above, len(crowd)))
        exceeded = np.where(
            np.isfinite(mine - theirs), (mine > theirs).astype(np.float64), np.nan
        )  # fmt: skip
        found[f"{name}_exceeds"] = Figure(
            *mean_interval(exceeded[:, np.newaxis], crowd.weights, once)
        )
    return found


def _others_in_draws(crowd: Crowd) -> Iterator[tuple[int, NDArray[np.bool_]]]:
    """Return for each person the consensus of the others in each draw, shape (draws, units).

    Whoever was drawn twice is no other to themselves.
    """
    for person in range(len(crowd)):
        weights = crowd.weights.copy()
        weights[:, person] = 0.0
        yield person, consensus_of(crowd.marked, weights)


def _people_in_draws(crowd: Crowd) -> Draws:
    """Return how each person meets the others, shape (draws, people)."""
    found = {name: np.empty(crowd.weights.shape) for name in MEASURES}
    for person, others in _others_in_draws(crowd):
        against = hits(crowd.marked[person : person + 1], others)
        for name in MEASURES:
            found[name][:, person] = against.measure(name)[:, 0]
    return found


def _model_in_draws(marked: NDArray[np.bool_], crowd: Crowd, weights: Weights) -> Draws:
    """Return how the drawn runs meet the others of each person, shape (draws, people)."""
    found = {name: np.empty(crowd.weights.shape) for name in HELD}
    for person, others in _others_in_draws(crowd):
        against = hits(marked, others)
        for name in HELD:
            found[name][:, person] = weighted_means(against.measure(name), weights)
    return found
