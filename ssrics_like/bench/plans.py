"""Furnished floor plans with labelled doors, as drives need them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ssrics_like.errors import MapError, nearest
from ssrics_like.maps import load_building
from ssrics_like.maps.tables import Table
from ssrics_like.world.grid import GridMap
from ssrics_like.world.locations import Location

MAP, DOORS = "map_furnished.yaml", "doors.csv"
KINDS = {"doorway": "doorway", "cut": "opening"}
"""Kind in the table -> kind of the place: a cut between two rooms without a door's frame."""


@dataclass(frozen=True, eq=False)
class FloorPlan:
    """A furnished plan and its truth.

    Attributes
    ----------
    grid : GridMap
        With its furniture.
    locations : tuple of Location
        Doorways and openings, in the frame of the map.
    lines_m : ndarray, shape (locations, 2, 2)
        Both ends of the line across each, x and y.
    """

    grid: GridMap
    locations: tuple[Location, ...]
    lines_m: NDArray[np.float64]


@lru_cache(maxsize=2)
def load_plan(folder: Path) -> FloorPlan:
    """Read a folder with a furnished map and the doors on it.

    ``doors.csv`` has ``id``, ``x_m``, ``y_m``, ``width_m``, ``angle_rad`` (the direction through
    the door) and ``kind``, doorway or cut.

    Raises
    ------
    MapError
        With one line for each thing that is wrong.
    """
    if not folder.is_dir():
        raise MapError(f"{folder}: no such folder")
    locations, lines = _doors(folder / DOORS)
    return FloorPlan(load_building(folder / MAP).grid, tuple(locations), np.array(lines))


def check_plans(folders: Sequence[Path]) -> None:
    """Complain of the first plan that cannot be used, or of none without a doorway.

    Raises
    ------
    MapError
        As `load_plan` does.
    """
    for folder in folders:
        plan = load_plan(folder)
        if not any(place.kind == "doorway" for place in plan.locations):
            raise MapError(f"{folder / DOORS}: no door is a doorway, expected at least one")


def _doors(path: Path) -> tuple[list[Location], list[NDArray[np.float64]]]:
    table = Table(path, ("id", "x_m", "y_m", "width_m", "angle_rad", "kind"), ())
    locations, lines = [], []
    for line, cells in table.rows:
        x_m, y_m, width_m, angle_rad = (
            table.number(line, cells, name) for name in ("x_m", "y_m", "width_m", "angle_rad")
        )
        if cells["kind"] not in KINDS:
            table.problems.append(
                f"{path}:{line}: kind: '{cells['kind']}'{nearest(cells['kind'], KINDS)}; "
                "expected doorway or cut"
            )
        kind = KINDS.get(cells["kind"], "other")
        locations.append(Location(table.word(line, cells, "id"), x_m, y_m, kind=kind))
        half = 0.5 * width_m * np.array([-math.sin(angle_rad), math.cos(angle_rad)])
        lines.append(np.array([x_m, y_m]) + np.array([half, -half]))
    table.finish()
    return locations, lines
