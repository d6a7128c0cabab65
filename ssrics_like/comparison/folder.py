"""Scores of a results folder: its marks against the labelled places of its map."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ssrics_like.comparison.driven import drives_on_map
from ssrics_like.comparison.passages import thresholds
from ssrics_like.comparison.scores import Scores, score_runs
from ssrics_like.errors import ResultsError
from ssrics_like.maps import load_building
from ssrics_like.results.folder import read_manifest
from ssrics_like.results.reading import read_records
from ssrics_like.results.records import Records
from ssrics_like.world.building import Building

MAP = "map/map.yaml"
RADIUS_M = 1.0
CHANCE_STREAM = 1
"""Keeps the random marks apart from whatever else is drawn with a scenario's seed."""


@dataclass(frozen=True, eq=False)
class FolderScores:
    """Scores of a results folder.

    Attributes
    ----------
    scores : Scores
        Of all its runs.
    numbers : tuple of int
        The numbers of the runs.
    seed : int
        Seed of the random marks.
    published : dict of str to float
        Shares that somebody published, by the id of a location; may be empty.
    published_in : str
        Where; empty without any.
    """

    scores: Scores
    numbers: tuple[int, ...]
    seed: int
    published: dict[str, float]
    published_in: str


def building_of(folder: Path) -> Building | None:
    """Read the building that a results folder was made in; None for a log.

    Raises
    ------
    MapError
        Its map is damaged.
    """
    file = folder / MAP
    return load_building(file) if file.is_file() else None


def score_folder(folder: Path) -> FolderScores | None:
    """Score a results folder against the labelled places of its map.

    Parameters
    ----------
    folder : Path
        A folder that ``ssrics run`` wrote.

    Returns
    -------
    FolderScores or None
        None where there is no map, or nothing is labelled on it.

    Raises
    ------
    ResultsError, MapError
        The folder holds no results, or a file is missing or damaged.
    """
    read_manifest(folder)  # a folder that holds no results is an error, not a lack of labels
    building = building_of(folder)
    if building is None or not building.locations:
        return None
    return score_records(read_records(folder), building)


def score_records(records: Records, building: Building) -> FolderScores | None:
    """Score what was read of a results folder; None where nothing is labelled on the map.

    Raises
    ------
    ResultsError
        The manifest is damaged.
    """
    if not building.locations:
        return None
    try:
        radius_m = float(records.scenario.get("match_radius_m", RADIUS_M))
        published = records.scenario.get("published") or {"source": "", "found": {}}
        source = str(published["source"])
        shares = {str(name): float(value) for name, value in published["found"].items()}
    except (KeyError, TypeError, ValueError, AttributeError) as e:
        raise ResultsError(f"{records.folder / 'manifest.json'}: is damaged: {e!r}") from None
    seed = seed_of(records)
    drives = drives_on_map(records, thresholds(building.grid, building.locations))
    scores = score_runs(drives, building.locations, radius_m, generator_of(seed))
    return FolderScores(scores, tuple(run.number for run in records.runs), seed, shares, source)


def seed_of(records: Records) -> int:
    """Return the seed of the marks that know nothing: the scenario's.

    Raises
    ------
    ResultsError
        The manifest is damaged.
    """
    try:
        return int(records.manifest["seed"])
    except (KeyError, TypeError, ValueError) as e:
        raise ResultsError(f"{records.folder / 'manifest.json'}: is damaged: {e!r}") from None


def generator_of(seed: int) -> np.random.Generator:
    """Return the source of the marks that know nothing."""
    return np.random.default_rng([seed, CHANCE_STREAM])
