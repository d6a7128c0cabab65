"""People and models beside each other: everything that a comparison says."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ssrics_like.people.chance_figures import chance_figures
from ssrics_like.people.figures import Crowd, DrawnRuns, Figure, Model
from ssrics_like.people.markers import PEOPLE, Marker
from ssrics_like.people.model_figures import model_figures
from ssrics_like.people.notes import notes_of
from ssrics_like.people.pairs import Pair, compared_pairs
from ssrics_like.people.people_figures import people_figures
from ssrics_like.people.raters import kappas
from ssrics_like.people.resampling import drawn
from ssrics_like.people.route import route_of
from ssrics_like.people.settings import Settings
from ssrics_like.people.shares import Share
from ssrics_like.people.units import Units
from ssrics_like.world.locations import Location

DRAWN_STREAM, CHANCE_STREAM, PAIRS_STREAM = 0, 1, 2
"""Keep what is drawn for one purpose apart from what is drawn for another."""


@dataclass(frozen=True, eq=False)
class Beside:
    """People and models beside each other.

    Attributes
    ----------
    people : tuple of Marker
        The participants.
    models : tuple of Model
        The models, with their runs.
    units : Units
        What can be marked.
    clustered : bool
        Whether the locations were found from people's marks.
    settings : Settings
        What it was made with.
    marked : dict of str to ndarray of bool, shape (markers, units)
        Which unit each person, and each run of each model, marked; by group.
    crowd : Crowd
        The people's consensus.
    shares : tuple of Share
        Location by location, and for each first the people.
    kappa : ndarray, shape (markers, markers)
        Cohen's kappa of every pair; people first, then the runs of each model.
    figures : dict of str to dict of str to Figure
        By group, and by the name of the figure.
    pairs : tuple of Pair
        Every two models compared.
    notes : tuple of str
        What a reader has to know: what is off the route, what could not be said.
    """

    people: tuple[Marker, ...]
    models: tuple[Model, ...]
    units: Units
    clustered: bool
    settings: Settings
    marked: dict[str, NDArray[np.bool_]]
    crowd: Crowd
    shares: tuple[Share, ...]
    kappa: NDArray[np.float64]
    figures: dict[str, dict[str, Figure]]
    pairs: tuple[Pair, ...]
    notes: tuple[str, ...]

    @property
    def markers(self) -> tuple[Marker, ...]:
        """People, then the runs of each model."""
        return (*self.people, *(run for model in self.models for run in model.runs))


def compare_people(
    people: Sequence[Marker],
    models: Sequence[Model],
    locations: Sequence[Location],
    settings: Settings,
    *,
    clustered: bool = False,
    notes: Sequence[str] = (),
) -> Beside:
    """Compare what people marked with what the runs of models marked.

    Parameters
    ----------
    people : sequence of Marker
        The participants; at least one.
    models : sequence of Model
        At least one, with a run each at least; their names differ.
    locations : sequence of Location
        Labelled, or found from people's marks; may be empty.
    settings : Settings
        Radius, length of a bin, seed, number of draws.
    clustered : bool
        Whether the locations were found from people's marks.
    notes : sequence of str
        What there is to say of how people and models were read; stands before the other notes.

    Raises
    ------
    MissingPackageError
        statsmodels or krippendorff is not installed.
    """
    route = route_of(
        [way for model in models for way in model.ways], settings.bin_m, settings.radius_m
    )
    units = Units(tuple(locations), route)
    marked = {PEOPLE: units.marked(people)}
    marked |= {model.name: units.marked(model.runs) for model in models}
    generator = np.random.default_rng([settings.seed, DRAWN_STREAM])
    weights = {
        group: drawn(generator, settings.resamples, len(table)) for group, table in marked.items()
    }
    crowd = Crowd.of(marked[PEOPLE], weights[PEOPLE])
    kappa = kappas(np.vstack(list(marked.values())))
    count = len(people)
    figures = {PEOPLE: people_figures(crowd, kappa[:count, :count])}
    chance = np.random.default_rng([settings.seed, CHANCE_STREAM])
    first, drawn_runs = count, {}
    for model in models:
        among = [*range(count), *range(first, first + len(model.runs))]
        runs = DrawnRuns(marked[model.name], weights[model.name])
        figures[model.name] = model_figures(runs, crowd, kappa[np.ix_(among, among)])
        figures[model.name] |= chance_figures(model, units, runs, crowd, chance)
        drawn_runs[model.name] = runs
        first += len(model.runs)
    pairs = compared_pairs(
        drawn_runs, crowd, len(units.location_of),
        np.random.default_rng([settings.seed, PAIRS_STREAM]),
    )  # fmt: skip
    return Beside(
        tuple(people), tuple(models), units, clustered, settings, marked, crowd,
        _shares(people, models, units), kappa, figures, pairs,
        (*notes, *notes_of(people, models, units, crowd, marked, clustered=clustered)),
    )  # fmt: skip


def _shares(people: Sequence[Marker], models: Sequence[Model], units: Units) -> tuple[Share, ...]:
    groups = [(PEOPLE, units.marked_locations(people))]
    groups += [(model.name, units.marked_locations(model.runs)) for model in models]
    return tuple(
        Share(place, name, len(table), int(table[:, i].sum()))
        for i, place in enumerate(units.locations)
        for name, table in groups
    )
