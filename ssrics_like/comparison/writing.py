"""The files of a results folder that hold its scores: locations.csv and scores.json."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ssrics_like.comparison.chance import DRAWS
from ssrics_like.comparison.folder import FolderScores, score_folder
from ssrics_like.comparison.proportions import LEVEL
from ssrics_like.comparison.scores import DESIGNATED
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
DEFINITIONS = {
    "mark": "a reflex that was declared or recognised, at its true position where that is known",
    "found": "a place is found by one mark at most, a mark finds one place at most, within the "
    "radius; as many pairs as can be, and of these the shortest",
    "recall": "designated places found, over all runs and designated places",
    "low, high": "Wilson score interval at the level stated",
    "chance": "recall of as many marks at random along the driven path, uniform by length; mean "
    "of the draws",
    "clock": "recall of as many marks at equal intervals of time, from a random moment on; mean of "
    "the draws",
    "corrected_recall": "(recall - chance) / (1 - chance)",
    "precision": "marks within the radius of an earlier one are merged; share of what is left "
    "that lies at a labelled place of any kind, one to one, within the radius",
    "f": "harmonic mean of recall and precision",
    "marks_per_100_m": "marks, repetitions included, per 100 m driven",
    "duplicates": "marks at a designated place that was found, but for the one that found it, "
    "per place found",
    "consistency": "two runs agree about a designated place if both found it or both missed it; "
    "mean share of agreement over all pairs of runs",
}


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
    rows = []
    for place in made.scores.places:
        location, (low, high) = place.location, place.interval
        rows.append(
            {
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
                "published": made.published.get(location.id),
            }
        )
    return rows


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
        "pooled": {
            "runs": len(scores.runs),
            **_counted(scores.pooled),
            "consistency": scores.consistency,
        },
        "runs": [
            {"run": number, **_counted(one)}
            for number, one in zip(made.numbers, scores.runs, strict=True)
        ],
        "locations": location_rows(made),
    }


def _counted(tally: Tally) -> dict[str, Any]:
    return {
        "path_m": tally.length_m,
        "marks": tally.marks,
        "merged": tally.merged,
        "right": tally.right,
        "designated": tally.designated,
        "found": tally.found,
        **tally.figures(),
    }
