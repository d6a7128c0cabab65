"""Reads what is compared: results folders, people's choices, and where locations lie."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ssrics_like.comparison.folder import MAP, building_of
from ssrics_like.comparison.way import Way
from ssrics_like.errors import MapError, ResultsError
from ssrics_like.maps import load_building
from ssrics_like.maps.places import load_choices
from ssrics_like.people.clusters import found_locations
from ssrics_like.people.figures import Model
from ssrics_like.people.markers import PEOPLE, Marker, people_of, runs_of, silent_people
from ssrics_like.people.participants import NONE, Listed, list_beside, read_participants
from ssrics_like.results.folder import MANIFEST
from ssrics_like.results.reading import read_records
from ssrics_like.results.records import Records
from ssrics_like.world.building import Building
from ssrics_like.world.locations import Location

CLUSTER = "cluster"
"""Instead of a map: locations are to be found from people's marks."""
OUTSIDE = 0.5
"""If more of people's marks than this lie outside the map, they are of another frame."""


@dataclass(frozen=True, eq=False)
class Folders:
    """What is compared, as it was read.

    Attributes
    ----------
    choices : Path
        The file of people's choices.
    listed : Listed or None
        Who took part, and what list says so; None if only who has choices is known.
    people : tuple of Marker
        The participants; those who marked nothing last.
    models : tuple of Model
        The models.
    records : tuple of Records
        The results folder of each model.
    building : Building or None
        The map; None for runs of a log, without a map named.
    locations : tuple of Location
        Labelled, or found from people's marks.
    clustered : bool
        Whether they were found.
    """

    choices: Path
    listed: Listed | None
    people: tuple[Marker, ...]
    models: tuple[Model, ...]
    records: tuple[Records, ...]
    building: Building | None
    locations: tuple[Location, ...]
    clustered: bool


def read_folders(
    folders: Sequence[Path],
    choices: Path,
    locations: str | Path | None,
    radius_m: float,
    participants: str | Path | None = None,
) -> Folders:
    """Read results folders and people's choices.

    Parameters
    ----------
    folders : sequence of Path
        Folders that ``ssrics run`` or ``ssrics replay`` wrote, one a model; at least one.
    choices : Path
        CSV file of people's choices, in the frame of the map.
    locations : str or Path, optional
        A map's YAML file that labels locations, or ``cluster`` to find them from people's marks.
        If left out, the locations of the map that the runs were made on, and found ones where it
        has none.
    radius_m : float
        Of a found location, metres.
    participants : str or Path, optional
        CSV file of who took part, or ``none``. If left out, the list that ``ssrics study export``
        wrote beside the choices, where there is one.

    Raises
    ------
    ResultsError, MapError
        With one line for each thing that is wrong.
    """
    choosing = people_of(load_choices(choices))
    listed = _listed(participants, choices, choosing)
    people = choosing + silent_people(listed.silent if listed else ())
    records = tuple(read_records(folder) for folder in folders)
    for one in records:
        _check_frame(one)
    building = _building(folders)
    named = None
    if locations is not None and locations != CLUSTER:
        named = _labelled(Path(locations))
        building = building or named
    if building is not None:
        _check_on_map(people, building, choices)
    labelled = named if named is not None else building
    clustered = locations == CLUSTER or labelled is None or not labelled.locations
    if clustered:
        who = np.repeat(np.arange(len(people)), [len(person) for person in people])
        places = found_locations(
            np.concatenate([person.xy_m for person in people]), who, radius_m, len(people)
        )
    else:
        assert labelled is not None
        places = labelled.locations
    models = tuple(
        Model(
            name,
            runs_of(one, name),
            tuple(Way.through(run.path[:, 1:]) for run in one.runs),
        )
        for name, one in zip(_names(folders), records, strict=True)
    )
    return Folders(choices, listed, people, models, records, building, places, clustered)


def _listed(
    participants: str | Path | None, choices: Path, choosing: Sequence[Marker]
) -> Listed | None:
    if participants == NONE:
        return None
    file = list_beside(choices) if participants is None else Path(participants)
    return read_participants(file, choices, (p.name for p in choosing)) if file else None


def _names(folders: Sequence[Path]) -> list[str]:
    """Return a name for each folder: its own, or where two share one, its path.

    A model cannot be called as the people are.
    """
    names = [folder.resolve().name for folder in folders]
    if len(set(names)) < len(names):
        names = [str(folder) for folder in folders]
    names = [f"{name}/" if name == PEOPLE else name for name in names]
    for name in names:
        if names.count(name) > 1:
            raise ResultsError(f"{name}: is named twice; expected every folder once")
    return names


def _labelled(path: Path) -> Building:
    building = load_building(path)
    if not building.locations:
        raise MapError(f"{path}: locations: no place is labelled, expected at least one")
    return building


def _building(folders: Sequence[Path]) -> Building | None:
    """Return the map of the first folder that has one; all must have the same."""
    first: tuple[Path, Building] | None = None
    for folder in folders:
        building = building_of(folder)
        if building is None:
            continue
        if first is None:
            first = folder, building
        elif not np.array_equal(building.grid.cells, first[1].grid.cells):
            raise ResultsError(
                f"{folder / MAP}: is another map than {first[0] / MAP}; people's marks can be on "
                "one of them only"
            )
    return first[1] if first else None


def _check_frame(records: Records) -> None:
    """Complain of positions that are not on the map."""
    if records.manifest.get("frame") == "odometry" and not records.runs[0].is_true:
        raise ResultsError(
            f"{records.folder / MANIFEST}: frame: 'odometry': expected positions on the map that "
            "people marked; if they are, say so by ssrics replay --frame map"
        )


def _check_on_map(people: Sequence[Marker], building: Building, choices: Path) -> None:
    """Complain of people's marks most of which lie outside the map."""
    places = np.concatenate([person.xy_m for person in people])
    x, y = building.grid.points_in_grid(places).T
    width_m, height_m = building.grid.size_m
    outside = ~((x >= 0) & (x <= width_m) & (y >= 0) & (y <= height_m))
    if outside.mean() > OUTSIDE:
        raise MapError(
            f"{choices}: {outside.sum()} of {len(places)} marks lie outside the map "
            f"'{building.title}', expected metres in its frame"
        )
