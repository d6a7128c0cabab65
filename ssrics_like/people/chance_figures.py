"""What marks that know nothing reach against the people's consensus, and a model beyond that."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ssrics_like.comparison.chance import DRAWS, random_marks
from ssrics_like.comparison.proportions import chance_corrected
from ssrics_like.people.figures import Crowd, DrawnRuns, Figure, Model
from ssrics_like.people.hits import hits
from ssrics_like.people.resampling import centred_interval, known_mean, mean, weighted_means
from ssrics_like.people.units import Units


def chance_figures(
    model: Model, units: Units, runs: DrawnRuns, crowd: Crowd, generator: np.random.Generator
) -> dict[str, Figure]:
    """Return the F of marks that know nothing, and the F of the runs corrected for it.

    As many marks as each run made are set at random on its way, uniformly by length, as
    `ssrics_like.comparison` does, and meet the same consensus as the run: that of all people, and
    that of each draw of them.

    Parameters
    ----------
    model : Model
        The runs with their ways.
    units : Units
        What can be marked.
    runs : DrawnRuns
        What the runs marked.
    crowd : Crowd
        The people.
    generator : numpy.random.Generator
        Source of the randomness.
    """
    # The same few consensuses are drawn again and again; all people's own stands first.
    drawn, of_draw = np.unique(crowd.drawn_consensus, axis=0, return_inverse=True)
    wanted = np.vstack([crowd.consensus[np.newaxis], drawn])
    met = hits(runs.marked, wanted).f
    by_chance = np.full((len(wanted), len(model.runs)), np.nan)
    for i, (run, way) in enumerate(zip(model.runs, model.ways, strict=True)):
        if len(way.xy_m):
            marks = way.at(random_marks(way, len(run), generator)).reshape(-1, 2)
            table = _table(units.of(marks).reshape(DRAWS, len(run)), len(units))
            by_chance[:, i] = known_mean(hits(table, wanted).f, axis=1)
    f, chance = mean(met[0]), mean(by_chance[0])
    above = chance_corrected(f, chance)
    of_draw = 1 + of_draw.reshape(-1)
    runs_f = weighted_means(met[of_draw], runs.weights)
    chances = weighted_means(by_chance[of_draw], runs.weights)
    people = len(crowd)
    return {
        "f_chance": Figure(chance, centred_interval(chances, chance, people, "f")),
        "f_corrected": Figure(
            above, centred_interval(_corrected(runs_f, chances), above, people, "above_chance")
        ),
    }


def _table(fell: NDArray[np.int64], units: int) -> NDArray[np.bool_]:
    """Return which unit each set of marks fell on, shape (sets, units); -1 is off the route."""
    table = np.zeros((len(fell), units + 1), bool)  # the last column takes what is off
    table[np.arange(len(fell))[:, np.newaxis], fell] = True
    return table[:, :-1]


def _corrected(f: NDArray[np.float64], chance: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return `chance_corrected` of each draw."""
    pairs = zip(f.tolist(), chance.tolist(), strict=True)
    return np.array([chance_corrected(a, c) for a, c in pairs])
