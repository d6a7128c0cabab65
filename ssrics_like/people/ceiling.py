"""The human ceiling: each person, or a model in their place, against the consensus of the others.

People and runs are drawn anew, and in each draw the others form their consensus anew, so that the
intervals hold how uncertain it is, too. A person and a model are held against the same others, as
many for the one as for the other.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from ssrics_like.comparison.proportions import share, wilson
from ssrics_like.people.consensus import consensus_of
from ssrics_like.people.figures import Crowd, DrawnRuns, Figure
from ssrics_like.people.hits import MEASURES, hits
from ssrics_like.people.resampling import (
    centred_interval,
    known_mean,
    mean,
    weighted_means,
)

HELD = ("f", "kappa")
"""The measures in which a model is held against the people."""
TIE = 1e-9
"""Means of equal numbers differ by rounding; whoever is so little ahead exceeds nobody."""

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


def model_against_others(runs: DrawnRuns, crowd: Crowd) -> dict[str, Figure]:
    """Return where the runs of a model stand as one more participant.

    Returns
    -------
    dict of str to Figure
        The mean against the others of each person; for F and kappa, that less the person's own,
        and the share of people who are exceeded, with its Wilson interval.
    """
    own, met = crowd.against_others, crowd.meet_others(runs.marked)
    people, model = _people_in_draws(crowd), _model_in_draws(runs, crowd)
    found = {}
    for name in MEASURES:
        level = mean(known_mean(met.measure(name), axis=1))
        draws = weighted_means(model[name], crowd.weights)
        found[f"{name}_others"] = Figure(level, centred_interval(draws, level, len(crowd), name))
    for name in HELD:
        above = known_mean(met.measure(name), axis=1) - own.measure(name)
        draws = weighted_means(model[name] - people[name], crowd.weights)
        found[f"{name}_ceiling"] = Figure(
            mean(above), centred_interval(draws, mean(above), len(crowd))
        )
        known = above[np.isfinite(above)]
        exceeded = int((known > TIE).sum())
        found[f"{name}_exceeds"] = Figure(
            share(exceeded, len(known)), wilson(exceeded, len(known))
        )  # fmt: skip
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


def _model_in_draws(runs: DrawnRuns, crowd: Crowd) -> Draws:
    """Return how the drawn runs meet the others of each person, shape (draws, people)."""
    found = {name: np.empty(crowd.weights.shape) for name in MEASURES}
    for person, others in _others_in_draws(crowd):
        against = hits(runs.marked, others)
        for name in MEASURES:
            found[name][:, person] = weighted_means(against.measure(name), runs.weights)
    return found
