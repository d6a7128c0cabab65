"""The files of a results folder that hold its scores: locations.csv and scores.json."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ssrics_like.comparison.chance import DRAWS
from ssrics_like.comparison.definitions import DEFINITIONS
from ssrics_like.comparison.folder import FolderScores, score_folder
from ssrics_like.comparison.proportions import LEVEL
from ssrics_like.comparison.scores import DESIGNATED, PlaceScore, Scores
from ssrics_like.comparison.tally import Tally
from ssrics_like.errors import ResultsError
from ssrics_like.results.files import csv_text, json_text, write_atomically

LOCATIONS, SCORES = "locations.csv", "scores.json"
FORMAT, VERSION = "ssrics-scores", 1
COLUMNS = [
    "location",
    "kind",
    "label",
    "x_m",
    "y_m",
    "runs",
    "found",
    "share",
    "low",
    "high",
    "chance",
    "clock",
    "published",
]


def write_scores(folder: Path) -> FolderScores | None:
    """Score a results folder and write ``locations.csv`` and ``scores.json`` into it.

    The same results give the same bytes. Where there is nothing to score, such files of an
    earlier time are removed.

    Parameters
    ----------
    folder : Path
        A folder that ``ssrics run`` or ``ssrics replay`` wrote.

    Returns
    -------
    FolderScores or None
        What was written; None without a map or locations on it.

    Raises
    ------
    ResultsError, MapError
        The folder holds no results, a file is missing or damaged, or it cannot be written.
    """
    folder = Path(folder)
    made = score_folder(folder)
    try:
        if made is None:
            for name in (LOCATIONS, SCORES):
                (folder / name).unlink(missing_ok=True)
        else:
            rows = [[row[name] for name in COLUMNS] for row in location_rows(made)]
            write_atomically(folder / LOCATIONS, csv_text(COLUMNS, rows))
            write_atomically(folder / SCORES, json_text(as_data(made)))
    except OSError as e:
        raise ResultsError(f"{e.filename or folder}: cannot be written ({e.strerror})") from None
    return made


def location_rows(made: FolderScores) -> list[dict[str, Any]]:
    """Return what is known of each labelled place, in the order of the map."""
    return [
        place_row(place) | {"published": made.published.get(place.location.id)}
        for place in made.scores.places
    ]


def place_row(place: PlaceScore) -> dict[str, Any]:
    """Return what is known of a labelled place."""
    location, (low, high) = place.location, place.interval
    return {
        "location": location.id,
        "kind": location.kind,
        "label": location.label,
        "x_m": location.x_m,
        "y_m": location.y_m,
        "runs": place.runs,
        "found": place.found,
        "share": place.share,
        "low": low,
        "high": high,
        "chance": place.chance,
        "clock": place.clock,
    }


def as_data(made: FolderScores) -> dict[str, Any]:
    """Return scores as plain values, as they stand in scores.json."""
    scores = made.scores
    return {
        "format": FORMAT,
        "version": VERSION,
        "radius_m": scores.radius_m,
        "designated_kind": DESIGNATED,
        "interval_level": LEVEL,
        "chance_draws": DRAWS,
        "chance_seed": made.seed,
        "published_in": made.published_in,
        "definitions": DEFINITIONS,
        **run_figures(scores, made.numbers),
        "locations": location_rows(made),
    }


def run_figures(scores: Scores, numbers: tuple[int, ...]) -> dict[str, Any]:
    """Return counts and figures of all runs together, and of each by its number."""
    return {
        "pooled": {
            "runs": len(scores.runs),
            **counted(scores.pooled),
            "consistency": scores.consistency,
        },
        "runs": [
            {"run": number, **counted(one)}
            for number, one in zip(numbers, scores.runs, strict=True)
        ],
    }


def counted(tally: Tally) -> dict[str, Any]:
    """Return the counts of a tally, and the figures."""
    return {
        "path_m": tally.length_m,
        "marks": tally.marks,
        "merged": tally.merged,
        "right": tally.right,
        "designated": tally.designated,
        "found": tally.found,
        "passages": tally.passages,
        "passed": tally.passed,
        **tally.figures(),
    }
