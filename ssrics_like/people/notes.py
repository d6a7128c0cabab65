"""What a reader of a comparison has to know: what was left out, and what could not be said."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ssrics_like.comparison.matching import NONE
from ssrics_like.people.figures import Crowd, Model
from ssrics_like.people.markers import PEOPLE, Marker
from ssrics_like.people.units import Units

FEW = 5
"""With fewer people, intervals and the consensus say little."""


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
    notes = []
    if len(people) == 1:
        notes.append(
            "There is one participant: nothing can be said of how people agree, of the ceiling, or "
            "of how certain the figures are."
        )
    elif len(people) < FEW:
        notes.append(f"There are only {len(people)} participants; intervals are wide, and rough.")
    if not units.locations:
        said = "no two people marked the same place" if clustered else "no place is labelled"
        notes.append(f"There is no location: {said}. Every unit is a bin of the route.")
    notes += _off_route(people, models, units)
    if not crowd.consensus.any():
        notes.append(
            "No unit was marked by at least half of the people: there is no consensus, so that "
            "recall, F, d' and what is made of them are empty."
        )
    notes += _undecided(people, models, marked, len(units))
    return tuple(notes)


def _off_route(people: Sequence[Marker], models: Sequence[Model], units: Units) -> list[str]:
    notes = []
    route = units.route
    far = [units.locations[i].id for i in np.flatnonzero(~units.on_route)]
    if far:
        notes.append(
            f"Fewer than half of the runs came within {route.radius_m:g} m of "
            f"{_listed('location', far)}: in the table of locations only."
        )
    if route.dropped:
        notes.append(f"{route.dropped} bins that fewer than half of the runs came by are left out.")
    for name, markers in ((PEOPLE, people), *((m.name, m.runs) for m in models)):
        fell = np.concatenate([units.of(marker.xy_m) for marker in markers])
        off = int((fell == NONE).sum())
        if off:
            notes.append(
                f"{off} of {len(fell)} marks of {name} lie off the route and count for no unit."
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
                    f"{_listed('', who)} of {name} marked {said}: kappa of two such is not defined."
                )
    return notes


def _listed(what: str, names: Sequence[str]) -> str:
    """Return names in a row: ``locations 1, 2 and 3``; at most six of them."""
    most = 6
    shown = [*names[:most], f"{len(names) - most} others"] if len(names) > most else list(names)
    text = shown[0] if len(shown) == 1 else f"{', '.join(shown[:-1])} and {shown[-1]}"
    if not what:
        return text
    return f"{what}{'s' if len(names) > 1 else ''} {text}"
