"""A results folder against labels, at several radii."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ssrics_like.comparison.drive import Drive
from ssrics_like.comparison.driven import drives_along, drives_on_map
from ssrics_like.comparison.folder import MAP, building_of, generator_of, seed_of
from ssrics_like.comparison.passages import thresholds
from ssrics_like.comparison.scores import DESIGNATED, Scores, score_runs
from ssrics_like.comparison.truth import PLACES, Truth, load_truth
from ssrics_like.errors import MapError, ResultsError
from ssrics_like.maps import load_building
from ssrics_like.results.folder import MANIFEST
from ssrics_like.results.reading import read_records
from ssrics_like.results.records import Records
from ssrics_like.world.building import Building

RADII_M = (0.5, 1.0, 1.5, 2.0)
"""The report does not say how near a mark had to lie."""
ON_FLOOR = 0.5
"""Less of a path than this on the floor of a map was not driven there."""


@dataclass(frozen=True, eq=False)
class Compared:
    """A results folder and its scores against labels.

    Attributes
    ----------
    records : Records
        The results folder.
    truth : Truth or Building
        The labels: those of a log, or a map with its locations.
    lines_m : ndarray, shape (locations, 2, 2)
        Both ends of the gap at each label, x and y; NaN where there is none.
    drives : tuple of Drive
        The runs as they were scored.
    seed : int
        Seed of the marks that know nothing.
    scores : tuple of Scores
        One for each radius, in order.
    """

    records: Records
    truth: Truth | Building
    lines_m: NDArray[np.float64]
    drives: tuple[Drive, ...]
    seed: int
    scores: tuple[Scores, ...]

    @property
    def numbers(self) -> tuple[int, ...]:
        """The numbers of the runs."""
        return tuple(run.number for run in self.records.runs)


def truth_at(path: Path) -> Truth | Building | None:
    """Read labels: a folder of a labelled log, or a map's YAML file; None for a results folder.

    Raises
    ------
    MapError
        It is none of these, or wrong.
    """
    if (path / MANIFEST).is_file():
        return None
    if not path.exists():
        raise MapError(f"{path}: no such file or folder")
    if path.is_dir():
        if not (path / PLACES).is_file():
            raise MapError(
                f"{path}: expected a results folder, which has {MANIFEST}, or a folder of labels, "
                f"which has {PLACES}"
            )
        return load_truth(path)
    if path.suffix not in (".yaml", ".yml"):
        raise MapError(f"{path}: expected a folder of labels, or a map's file ending in .yaml")
    building = load_building(path)
    if not building.locations:
        raise MapError(f"{path}: locations: no place is labelled, expected at least one")
    return building


def compare_folder(
    folder: Path, truth: Truth | Building | None = None, radii_m: Sequence[float] = RADII_M
) -> Compared:
    """Score a results folder against labels.

    Parameters
    ----------
    folder : Path
        A folder that ``ssrics run`` or ``ssrics replay`` wrote.
    truth : Truth or Building, optional
        The labels; those of the map that the runs were made on, if left out.
    radii_m : sequence of float
        How far from a place, or along the path from a passage, a mark still finds it. At each
        the same marks know nothing, so that radii can be compared.

    Raises
    ------
    ResultsError, MapError
        The folder holds no results, a file is missing or damaged, or the labels are none of it.
    """
    records = read_records(folder)
    labels = _own(folder) if truth is None else truth
    if isinstance(labels, Truth):
        lines_m, designated = labels.jambs_m, labels.designated
        drives = drives_along(records, labels)
    else:
        _check_frame(records, labels)
        lines_m = thresholds(labels.grid, labels.locations)
        designated = np.array([place.kind == DESIGNATED for place in labels.locations], bool)
        drives = drives_on_map(records, lines_m)
    seed = seed_of(records)
    scores = tuple(
        score_runs(
            drives, labels.locations, radius_m, generator_of(seed), designated=designated
        )
        for radius_m in radii_m
    )  # fmt: skip
    return Compared(records, labels, lines_m, tuple(drives), seed, scores)


def _own(folder: Path) -> Building:
    """Read the map that a folder's runs were made on."""
    building = building_of(folder)
    if building is None:
        raise ResultsError(
            f"{folder}: holds no {MAP}, for its runs are of a log; name labels after it: a folder "
            "of labels, or a map"
        )
    if not building.locations:
        raise ResultsError(
            f"{folder / MAP}: locations: no place is labelled; name labels after the folder"
        )
    return building


def _check_frame(records: Records, building: Building) -> None:
    """Complain of positions that are not on the map: odometry goes astray, a map may be another."""
    manifest = records.folder / MANIFEST
    if records.manifest.get("frame") == "odometry" and not records.runs[0].is_true:
        raise ResultsError(
            f"{manifest}: frame: 'odometry': expected positions on the map; if they are, say so "
            "by ssrics replay --frame map"
        )
    for run in records.runs:
        places = building.grid.points_in_grid(run.path[:, 1:])
        on_floor = [building.grid.is_free(*place) for place in places.tolist()]
        share = sum(on_floor) / max(len(on_floor), 1)
        if on_floor and share < ON_FLOOR:
            raise ResultsError(
                f"{records.folder}: {100 * share:.0f} % of the path of run {run.number} lies on "
                f"the floor of '{building.title}', expected most of it: it is another map, or its "
                "frame is another"
            )
