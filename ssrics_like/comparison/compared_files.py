"""Comparisons as files: comparison.csv and .json, and what became of each mark and label."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

from ssrics_like.comparison.chance import DRAWS
from ssrics_like.comparison.compared import Compared
from ssrics_like.comparison.definitions import DEFINITIONS
from ssrics_like.comparison.driven import marks_of
from ssrics_like.comparison.matching import NONE
from ssrics_like.comparison.outcome import Outcome
from ssrics_like.comparison.proportions import LEVEL
from ssrics_like.comparison.scores import Scores
from ssrics_like.comparison.tally import Tally
from ssrics_like.comparison.truth import Truth
from ssrics_like.comparison.writing import counted, place_row, run_figures
from ssrics_like.errors import ResultsError
from ssrics_like.results.files import csv_text, json_text, write_atomically

FORMAT, VERSION = "ssrics-comparison", 1
NAME = "comparison"
KEYS = ("folder", "radius_m")
MARK_COLUMNS = (
    *KEYS, "run", "event", "x_m", "y_m", "path_m", "delay_m", "fate", "place", "passage", "group",
    "group_place",
)  # fmt: skip
PLACE_COLUMNS = (*KEYS, "run", "place", "kind", "designated", "x_m", "y_m", "found", "event")
PASSAGE_COLUMNS = (*KEYS, "run", "passage", "place", "path_m", "found", "event")

Rows = Callable[[Compared, Scores, int], Iterator[dict[str, Any]]]
"""Gives the rows of a table for one run, the index of which comes last."""


def write_comparison(
    made: Sequence[Compared], folder: Path, picture: str | None = None
) -> list[Path]:
    """Write comparisons into a folder.

    Parameters
    ----------
    made : sequence of Compared
        The comparisons; at least one.
    folder : Path
        Where to; made if it is not there.
    picture : str, optional
        SVG text to write beside.

    Returns
    -------
    list of Path
        The files: ``comparison.csv`` (one row a folder and radius), ``comparison.json``,
        ``comparison-marks.csv``, ``comparison-places.csv`` and ``comparison-passages.csv`` (what
        became of each), and ``comparison.svg``.

    Raises
    ------
    ResultsError
        They cannot be written.
    """
    figures = ("runs", *counted(Tally()), "consistency")
    rows = [
        {**_keys(one, scores), **run_figures(scores, one.numbers)["pooled"]}
        for one in made
        for scores in one.scores
    ]
    tables = {
        "": ((*KEYS, *figures), rows),
        "-marks": (MARK_COLUMNS, _each(made, _marks)),
        "-places": (PLACE_COLUMNS, _each(made, _places)),
        "-passages": (PASSAGE_COLUMNS, _each(made, _passages)),
    }
    texts = {
        f"{NAME}{name}.csv": csv_text(columns, ([row[c] for c in columns] for row in lines))
        for name, (columns, lines) in tables.items()
    }
    texts[f"{NAME}.json"] = json_text(comparison_data(made))
    if picture is not None:
        texts[f"{NAME}.svg"] = picture
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for name, text in texts.items():
            write_atomically(folder / name, text)
    except OSError as e:
        raise ResultsError(f"{e.filename or folder}: cannot be written ({e.strerror})") from None
    return [folder / name for name in texts]


def comparison_data(made: Sequence[Compared]) -> dict[str, Any]:
    """Return comparisons as plain values, as they stand in comparison.json."""
    return {
        "format": FORMAT,
        "version": VERSION,
        "interval_level": LEVEL,
        "chance_draws": DRAWS,
        "definitions": DEFINITIONS,
        "folders": [
            {
                "folder": str(one.records.folder),
                "labels": labels_name(one),
                "chance_seed": one.seed,
                "radii": [
                    {
                        "radius_m": scores.radius_m,
                        **run_figures(scores, one.numbers),
                        "places": [
                            {**place_row(place), "designated": place.designated}
                            for place in scores.places
                        ],
                    }
                    for scores in one.scores
                ],
            }
            for one in made
        ],
    }


def labels_name(made: Compared) -> str:
    """Return what the labels are called: the name of their folder, or the map's title."""
    return made.truth.folder.name if isinstance(made.truth, Truth) else made.truth.title


def _keys(made: Compared, scores: Scores) -> dict[str, Any]:
    return {"folder": str(made.records.folder), "radius_m": scores.radius_m}


def _each(made: Sequence[Compared], rows: Rows) -> Iterator[dict[str, Any]]:
    """Return the rows of a table, for each folder, radius and run."""
    for one in made:
        for scores in one.scores:
            for i, run in enumerate(one.records.runs):
                for row in rows(one, scores, i):
                    yield {**_keys(one, scores), "run": run.number, **row}


def _marks(made: Compared, scores: Scores, run: int) -> Iterator[dict[str, Any]]:
    outcome, marks = scores.outcomes[run], made.drives[run].marks
    names = [place.location.id for place in scores.places]
    places = {m: names[j] for j, m in enumerate(outcome.place_mark.tolist()) if m != NONE}
    passages = {m: j for j, m in enumerate(outcome.passage_mark.tolist()) if m != NONE}
    fates, events = outcome.fates(), _events(made, run)
    for i, event in enumerate(events):
        group = int(outcome.group[i])
        at = int(outcome.group_place[group])
        yield {
            "event": event,
            "x_m": float(marks.xy_m[i, 0]),
            "y_m": float(marks.xy_m[i, 1]),
            "path_m": float(marks.along_m[i]),
            "delay_m": float(marks.decided_m[i] - marks.along_m[i]),
            "fate": fates[i],
            "place": places.get(i),
            "passage": passages.get(i),
            "group": group,
            "group_place": names[at] if at != NONE else None,
        }


def _places(made: Compared, scores: Scores, run: int) -> Iterator[dict[str, Any]]:
    events, outcome = _events(made, run), scores.outcomes[run]
    for place, mark in zip(scores.places, outcome.place_mark.tolist(), strict=True):
        yield {
            "place": place.location.id,
            "kind": place.location.kind,
            "designated": int(place.designated),
            "x_m": place.location.x_m,
            "y_m": place.location.y_m,
            **_finder(events, mark),
        }


def _passages(made: Compared, scores: Scores, run: int) -> Iterator[dict[str, Any]]:
    outcome: Outcome = scores.outcomes[run]
    if outcome.passages is None:
        return
    events = _events(made, run)
    for j, mark in enumerate(outcome.passage_mark.tolist()):
        yield {
            "passage": j,
            "place": scores.places[outcome.passages.place[j]].location.id,
            "path_m": float(outcome.passages.along_m[j]),
            **_finder(events, mark),
        }


def _finder(events: list[int], mark: int) -> dict[str, Any]:
    """Return whether something was found, and by which event."""
    return {"found": int(mark != NONE), "event": events[mark] if mark != NONE else None}


def _events(made: Compared, run: int) -> list[int]:
    return [mark.event for mark in marks_of(made.records.runs[run])]
