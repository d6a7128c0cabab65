"""What somebody labelled of a log: places, passages through them, and where the laser really was.

A folder of three tables, each with its header; columns that are not named here are passed over:

* ``truth.csv``: ``id``, ``kind``, ``crossed`` (1 or 0: whether the robot went through), ``x_m``,
  ``y_m``, and if you like ``jamb_ax_m``, ``jamb_ay_m``, ``jamb_bx_m``, ``jamb_by_m``, the two
  ends of the gap;
* ``crossings.csv``: ``id`` and ``scan``, one row a passage;
* ``poses.csv``: ``scan``, ``x_m``, ``y_m``, one row for each laser record of the log, from 0.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ssrics_like.comparison.drive import Passages
from ssrics_like.comparison.scores import DESIGNATED
from ssrics_like.comparison.way import Way
from ssrics_like.maps.places import read_locations
from ssrics_like.maps.tables import Table
from ssrics_like.world.locations import Location

PLACES, CROSSINGS, POSES = "truth.csv", "crossings.csv", "poses.csv"
JAMBS = ("jamb_ax_m", "jamb_ay_m", "jamb_bx_m", "jamb_by_m")


@dataclass(frozen=True, eq=False)
class Truth:
    """What was labelled of a log.

    Attributes
    ----------
    folder : Path
        Where it was read from.
    locations : tuple of Location
        Every labelled place, in the frame of the poses.
    designated : ndarray of bool, shape (locations,)
        Which of them should be found: the doorways that the robot went through.
    jambs_m : ndarray, shape (locations, 2, 2)
        Both ends of the gap at each place, x and y; NaN where they are not given.
    way : Way
        The laser's positions, one for each record of the log.
    passages : Passages
        The times it went through the places.
    """

    folder: Path
    locations: tuple[Location, ...]
    designated: NDArray[np.bool_]
    jambs_m: NDArray[np.float64]
    way: Way
    passages: Passages


def load_truth(folder: Path) -> Truth:
    """Read a folder of labels.

    Raises
    ------
    MapError
        With one line for each thing that is wrong in one of its tables.
    """
    way = Way.through(_poses(folder / POSES))
    places = read_locations(folder / PLACES)
    locations = tuple(place for _, place in places)
    crossed, jambs_m = _crossed(folder / PLACES)
    passages = _passages(folder / CROSSINGS, locations, crossed, way)
    doorways = np.array([place.kind == DESIGNATED for place in locations])
    return Truth(folder, locations, doorways & crossed, jambs_m, way, passages)


def _poses(path: Path) -> list[tuple[float, float]]:
    table = Table(path, ("scan", "x_m", "y_m"), ())
    poses = []
    for row, (line, cells) in enumerate(table.rows):
        if cells["scan"] != str(row):
            table.problems.append(
                f"{path}:{line}: scan: '{cells['scan']}': expected {row}, one row for each laser "
                "record in their order"
            )
            break  # all rows below are shifted, too
        poses.append((table.number(line, cells, "x_m"), table.number(line, cells, "y_m")))
    table.finish()
    return poses


def _crossed(path: Path) -> tuple[NDArray[np.bool_], NDArray[np.float64]]:
    """Read which places were gone through, and the ends of their gaps."""
    table = Table(path, ("id", "crossed"), JAMBS)
    crossed, jambs = [], []
    for line, cells in table.rows:
        said = cells["crossed"]
        if said not in ("0", "1"):
            table.problems.append(f"{path}:{line}: crossed: '{said}': expected 1 or 0")
        crossed.append(said == "1")
        given = all(cells.get(name) for name in JAMBS)
        jambs.append([table.number(line, cells, n) if given else np.nan for n in JAMBS])
    table.finish()
    return np.array(crossed, bool), np.array(jambs, np.float64).reshape(-1, 2, 2)


def _passages(
    path: Path, locations: Sequence[Location], crossed: NDArray[np.bool_], way: Way
) -> Passages:
    """Read the passages; they are of places that were crossed, and all of these have some."""
    table = Table(path, ("id", "scan"), ())
    numbers = {location.id: number for number, location in enumerate(locations)}
    found = []
    for line, cells in table.rows:
        name, scan = cells["id"], cells["scan"]
        if name not in numbers:
            table.problems.append(f"{path}:{line}: id: '{name}': no such id in {PLACES}")
            continue
        if not crossed[numbers[name]]:
            table.problems.append(
                f"{path}:{line}: id: '{name}': has crossed 0 in {PLACES}, expected 1 with a passage"
            )
        if not (scan.isascii() and scan.isdigit() and int(scan) < len(way.xy_m)):
            table.problems.append(
                f"{path}:{line}: scan: '{scan}': expected a scan of {POSES}, "
                f"0 to {len(way.xy_m) - 1}"
            )
            continue
        found.append((numbers[name], int(scan)))
    for number in np.flatnonzero(crossed).tolist():
        if locations[number].id not in {cells["id"] for _, cells in table.rows}:
            table.problems.append(
                f"{path}:1: id: '{locations[number].id}': has crossed 1 in {PLACES}, expected at "
                "least one passage"
            )
    table.finish()
    return Passages.of(
        [number for number, _ in found], [float(way.along_m[scan]) for _, scan in found]
    )
