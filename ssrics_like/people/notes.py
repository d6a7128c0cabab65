"""What a reader of a comparison has to know: what was left out, and what could not be said."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ssrics_like.comparison.matching import NONE
from ssrics_like.people.figures import Crowd, Model
from ssrics_like.people.markers import PEOPLE, Marker
from ssrics_like.people.names import in_a_row, short
from ssrics_like.people.resampling import LEAST
from ssrics_like.people.units import Units
from ssrics_like.results.counts import counted

ALPHA = 0.05
"""A test that cannot come below it is said to be unable to."""


def notes_of(
    people: Sequence[Marker],
    models: Sequence[Model],
    units: Units,
    crowd: Crowd,
    marked: dict[str, NDArray[np.bool_]],
    *,
    clustered: bool,
) -> tuple[str, ...]:
    """Return the notes on a comparison, one sentence or two each."""
    notes = _few(people, models)
    if not units.locations:
        said = "no two people marked the same place" if clustered else "no place is labelled"
        notes.append(f"There is no location: {said}. Every unit is a bin of the route.")
    elif clustered:
        notes.append(
            "Locations were found by clustering people's marks, which flatters people: they agree "
            "there by construction."
        )
    notes += _off_route(people, models, units)
    if not crowd.consensus.any():
        notes.append(
            "No unit was marked by at least half of the people: there is no consensus, so that "
            "recall, F, d′ and what is made of them are empty."
        )
    notes += _undecided(people, models, marked, len(units))
    return tuple(notes)


def _few(people: Sequence[Marker], models: Sequence[Model]) -> list[str]:
    """Say what so few people, or runs, cannot tell."""
    notes, count = [], len(people)
    if count == 1:
        notes.append(
            "There is one participant: nothing can be said of how people agree, of the ceiling, or "
            "of how certain the figures are."
        )
    elif count < LEAST:
        notes.append(
            f"There are {count} participants. Intervals of figures need {LEAST}: drawn from fewer, "
            "they would be no more than the range of these few. Shares have Wilson's interval."
        )
    least_p = 2.0 ** (1 - count)
    if len(models) > 1 and count > 1 and least_p > ALPHA:
        notes.append(
            f"With {count} participants, p of models compared over people cannot be below "
            f"{f'{least_p:.3g}'.removeprefix('0')}, however different the models are."
        )
    single = [model.name for model in models if len(model.runs) == 1]
    several = [model for model in models if 1 < len(model.runs) < LEAST]
    if single:
        holds = "holds" if len(single) == 1 else "hold"
        notes.append(
            f"Of {in_a_row(single)} there is one run: what is said of it {holds} for this run, and "
            "intervals tell only how people differ."
        )
    notes += [
        f"Of {short(model.name)} there are {len(model.runs)} runs; the interval of κ against each "
        f"other run needs {LEAST}."
        for model in several
    ]
    return notes


def _off_route(people: Sequence[Marker], models: Sequence[Model], units: Units) -> list[str]:
    notes = []
    route = units.route
    far = [units.locations[i].id for i in np.flatnonzero(~units.on_route)]
    if far:
        notes.append(
            f"Fewer than half of the runs came within {route.radius_m:g} m of "
            f"{in_a_row(far, 'location')}: in the table of locations only."
        )
    if route.dropped:
        bins, are = counted(route.dropped, "bin"), "is" if route.dropped == 1 else "are"
        notes.append(
            f"{bins} of the route that fewer than half of the runs came by {are} left out."
        )
    for name, markers in ((PEOPLE, people), *((m.name, m.runs) for m in models)):
        fell = np.concatenate([units.of(marker.xy_m) for marker in markers])
        off = int((fell == NONE).sum())
        if off:
            notes.append(
                f"{off} of {len(fell)} marks of {short(name)} lie off the route and count for no "
                "unit."
            )
    return notes


def _undecided(
    people: Sequence[Marker],
    models: Sequence[Model],
    marked: dict[str, NDArray[np.bool_]],
    units: int,
) -> list[str]:
    """Name the markers that marked nothing, or everything: they have no kappa with each other."""
    notes = []
    for name, markers in ((PEOPLE, people), *((m.name, m.runs) for m in models)):
        counts = marked[name].sum(axis=1)
        for said, chosen in (
            ("nothing on the route", counts == 0),
            ("every unit", counts == units),
        ):
            who = [m.name for m, yes in zip(markers, chosen.tolist(), strict=True) if yes]
            if who and units:
                notes.append(
                    f"{in_a_row(who)} of {short(name)} marked {said}: κ of two such is not defined."
                )
    return notes
