"""How a model's runs meet what people marked, and where they stand among them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ssrics_like.comparison.chance import DRAWS, random_marks
from ssrics_like.comparison.proportions import chance_corrected
from ssrics_like.people.ceiling import model_against_others
from ssrics_like.people.figures import Crowd, Figure, Model
from ssrics_like.people.hits import MEASURES, hits
from ssrics_like.people.raters import alpha, fleiss, mean_kappa
from ssrics_like.people.resampling import (
    Weights,
    centred_interval,
    interval,
    known_median,
    mean,
    mean_interval,
    weighted_means,
)
from ssrics_like.people.units import Units


def model_figures(
    marked: NDArray[np.bool_],
    crowd: Crowd,
    weights: Weights,
    kappa: NDArray[np.float64],
) -> dict[str, Figure]:
    """Return the figures of a model's runs.

    Parameters
    ----------
    marked : ndarray of bool, shape (runs, units)
        Which run marked which unit.
    crowd : Crowd
        The people.
    weights : ndarray, shape (draws, runs)
        How often each run counts in each draw.
    kappa : ndarray, shape (people + runs, people + runs)
        Cohen's kappa of every pair, people first.

    Returns
    -------
    dict of str to Figure
        The keys are explained in `definitions`.
    """
    people = len(crowd)
    found = _against_consensus(marked, crowd, weights)
    between = kappa[:people, people:]
    found["kappa_people"] = Figure(*mean_interval(between, crowd.weights, weights))
    found["kappa_people_median"] = Figure(known_median(between))
    runs = kappa[people:, people:]
    found["consistency"] = Figure(
        mean(runs[np.triu_indices(len(runs), 1)]),
        interval(mean_kappa(runs, weights), len(runs)),
    )
    joined = [np.vstack([crowd.marked, run]) for run in marked]
    found["fleiss"] = Figure(mean(np.array([fleiss(table) for table in joined])))
    found["alpha"] = Figure(mean(np.array([alpha(table) for table in joined])))
    return found | model_against_others(marked, crowd, weights)


def chance_figures(
    model: Model, units: Units, crowd: Crowd, f: float, generator: np.random.Generator
) -> dict[str, Figure]:
    """Return the F of marks that know nothing, and F corrected for it.

    As many marks as each run made are set at random on its way, uniformly by length, as
    `ssrics_like.comparison` does, and meet the same consensus.

    Parameters
    ----------
    model : Model
        The runs with their ways.
    units : Units
        What can be marked.
    crowd : Crowd
        The people.
    f : float
        Mean F of the runs.
    generator : numpy.random.Generator
        Source of the randomness.
    """
    values = []
    for run, way in zip(model.runs, model.ways, strict=True):
        if len(way.xy_m) == 0:
            continue
        marks = way.at(random_marks(way, len(run), generator))
        fell = units.of(marks.reshape(-1, 2)).reshape(DRAWS, len(run))
        table = np.zeros((DRAWS, len(units) + 1), bool)  # the last column takes what is off
        table[np.arange(DRAWS)[:, np.newaxis], fell] = True
        values.append(mean(hits(table[:, :-1], crowd.consensus[np.newaxis]).f))
    chance = mean(np.array(values, np.float64))
    return {"f_chance": Figure(chance), "f_corrected": Figure(chance_corrected(f, chance))}


def _against_consensus(
    marked: NDArray[np.bool_], crowd: Crowd, weights: Weights
) -> dict[str, Figure]:
    """Return the means over the runs; in each draw, people form their consensus anew."""
    now, drawn = hits(marked, crowd.consensus[np.newaxis]), hits(marked, crowd.drawn_consensus)
    found = {}
    for name in MEASURES:
        value = mean(now.measure(name))
        draws = weighted_means(drawn.measure(name), weights)
        found[name] = Figure(value, centred_interval(draws, value, len(crowd), name))
    return found
