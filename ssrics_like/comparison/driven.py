"""The runs of a results folder as drives: on the map that they are of, or along a labelled log."""

from __future__ import annotations

import csv
from collections import defaultdict
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ssrics_like.comparison.drive import Drive, Marks
from ssrics_like.comparison.passages import passages_through
from ssrics_like.comparison.truth import POSES, Truth
from ssrics_like.comparison.way import Way
from ssrics_like.errors import ResultsError
from ssrics_like.results.records import MARKS, Records, Reflex, Run


def marks_of(run: Run) -> list[Reflex]:
    """Return the reflexes that called a place a landmark, in order of time."""
    marks = (reflex for reflex in run.reflexes if reflex.decision in MARKS)
    return sorted(marks, key=lambda reflex: (reflex.t_s, reflex.x_m, reflex.y_m))


def drives_on_map(records: Records, thresholds: NDArray[np.float64]) -> list[Drive]:
    """Return each run with its marks at their positions in the results folder.

    Parameters
    ----------
    records : Records
        The results folder; its positions are in the frame of the map.
    thresholds : ndarray, shape (locations, 2, 2)
        The line across each location, from `ssrics_like.comparison.passages.thresholds`.
    """
    drives = []
    for run in records.runs:
        way, marks = Way.through(run.path[:, 1:]), marks_of(run)
        drives.append(
            Drive(
                way,
                Marks.of(
                    [(mark.x_m, mark.y_m) for mark in marks],
                    _driven(run, way, [mark.t_s for mark in marks]),
                    _driven(run, way, [mark.decided_s for mark in marks]),
                ),
                passages_through(way, thresholds),
                run.length_m,
            )
        )
    return drives


def drives_along(records: Records, truth: Truth) -> list[Drive]:
    """Return each run of a labelled log with its marks where the labels' poses put their scans.

    A decision falls between scans, so that it has no pose: the metres driven until then are
    those of path.csv, in which times are those of the decisions.

    Raises
    ------
    ResultsError
        The runs are not of the log that was labelled, or decisions.csv is damaged.
    """
    scans = _scans(records)
    drives = []
    for run in records.runs:
        marks, count = marks_of(run), len(truth.way.xy_m)
        said = run.entry.get("scans")
        if said != count:
            raise ResultsError(
                f"{records.folder}: run {run.number} has {said} scans, but {truth.folder / POSES} "
                f"{count}: the labels are of another log"
            )
        numbers = [scans[run.number, mark.event] for mark in marks]
        if any(not 0 <= number < count for number in numbers):
            raise ResultsError(
                f"{records.folder / 'decisions.csv'}: is damaged: a scan of run {run.number} lies "
                f"outside 0 to {count - 1}"
            )
        way = Way.through(run.path[:, 1:])
        delays = _driven(run, way, [mark.decided_s for mark in marks])
        delays -= _driven(run, way, [mark.t_s for mark in marks])
        along = truth.way.along_m[numbers]
        drives.append(
            Drive(truth.way, Marks.of(truth.way.xy_m[numbers], along, along + delays),
                  truth.passages)
        )  # fmt: skip
    return drives


def _driven(run: Run, way: Way, times_s: list[float]) -> NDArray[np.float64]:
    """Return the metres driven up to times; NaN where the run has no path."""
    if len(way.xy_m) == 0:
        return np.full(len(times_s), np.nan)
    return np.interp(times_s, run.path[:, 0], way.along_m)


def _scans(records: Records) -> dict[tuple[int, int], int]:
    """Read which scan each event of each run perceived."""
    file: Path = records.folder / "decisions.csv"
    found: defaultdict[tuple[int, int], int] = defaultdict(lambda: -1)
    with file.open(encoding="utf-8", newline="") as lines:
        reader = csv.DictReader(lines)
        for row in reader:
            try:
                found[int(row["run"]), int(row["event"])] = int(row["scan"])
            except (KeyError, TypeError, ValueError) as e:
                raise ResultsError(f"{file}:{reader.line_num}: is damaged: {e!r}") from None
    return found
