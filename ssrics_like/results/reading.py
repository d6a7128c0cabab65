"""Reads the tables of a results folder into records."""

from __future__ import annotations

import csv
from collections import defaultdict
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from ssrics_like.errors import ResultsError
from ssrics_like.results.manifest import read_manifest
from ssrics_like.results.records import Landmark, Records, Reflex, Run

Row = dict[str, str]
Item = TypeVar("Item")


def read_records(folder: Path) -> Records:
    """Read the manifest and the tables of a results folder.

    Parameters
    ----------
    folder : Path
        A folder that ``ssrics run`` or ``ssrics replay`` wrote.

    Raises
    ------
    ResultsError
        There is no folder, it holds no results or no complete run, or a table is missing or
        damaged (named with its line).
    """
    manifest = read_manifest(folder)
    try:
        entries = {int(entry["run"]): entry for entry in manifest["runs"]}
        started = {number: float(entry["start_s"]) for number, entry in entries.items()}
    except (KeyError, TypeError, ValueError) as e:
        raise ResultsError(f"{folder / 'manifest.json'}: is damaged: runs: {e!r}") from None
    if not entries:
        raise ResultsError(f"{folder}: holds no complete run; there is nothing to report")
    carried = _carried(folder, manifest)
    paths = _by_run(folder / "path.csv", started, _pose)
    reflexes = _by_run(folder / "decisions.csv", started, _reflex)
    landmarks = _by_run(folder / "landmarks.csv", started, _landmark)
    _check_whole(folder, entries, paths, reflexes, landmarks)
    runs = tuple(
        replace(
            _run(entries[n], started[n], paths[n], reflexes[n], landmarks[n]), carried_s=carried
        )
        for n in sorted(entries)
    )
    return Records(folder, manifest, runs)


def _check_whole(
    folder: Path,
    entries: dict[int, dict[str, Any]],
    paths: dict[int, list[tuple[float, ...]]],
    reflexes: dict[int, list[Reflex]],
    landmarks: dict[int, list[Landmark]],
) -> None:
    """Check that no table was cut short, or figures would be made of what is left."""
    for n, entry in entries.items():
        if entry.get("scans") and not paths[n]:
            raise ResultsError(f"{folder / 'path.csv'}: has no pose of run {n}")
        counts = entry.get("decisions")
        decided = sum(counts.values()) if isinstance(counts, dict) else 0
        marked = entry.get("landmarks") or 0
        for name, rows, wanted in (
            ("decisions.csv", reflexes[n], decided), ("landmarks.csv", landmarks[n], marked),
        ):  # fmt: skip
            if len(rows) < wanted:
                raise ResultsError(
                    f"{folder / name}: has {len(rows)} rows of run {n}, the manifest {wanted}"
                )


def _carried(folder: Path, manifest: dict[str, Any]) -> tuple[float, ...]:
    """Return when the scenario has the robot carried elsewhere."""
    try:
        world = manifest["scenario"].get("world") or {}
        return tuple(sorted(float(kidnap["at_s"]) for kidnap in world.get("kidnaps") or ()))
    except (KeyError, TypeError, ValueError, AttributeError) as e:
        raise ResultsError(f"{folder / 'manifest.json'}: is damaged: kidnaps: {e!r}") from None


def _run(
    entry: dict[str, Any],
    start_s: float,
    poses: list[tuple[float, ...]],
    reflexes: list[Reflex],
    landmarks: list[Landmark],
) -> Run:
    """Put a run together; at the simulator's true positions where they are known."""
    path = np.array(poses, np.float64).reshape(-1, 5)
    is_true = len(path) > 0 and bool(np.isfinite(path[:, 3:]).all())
    if is_true:
        places = {r.landmark: (r.x_m, r.y_m) for r in reflexes if r.decision == "declared"}
        landmarks = [
            replace(mark, drawn_x_m=places[mark.name][0], drawn_y_m=places[mark.name][1])
            if mark.name in places
            else mark
            for mark in landmarks
        ]
    return Run(
        number=int(entry["run"]),
        entry=entry,
        start_s=start_s,
        path=path[:, [0, 3, 4] if is_true else [0, 1, 2]],
        is_true=is_true,
        reflexes=tuple(reflexes),
        landmarks=tuple(landmarks),
    )


def _by_run(
    file: Path, started: dict[int, float], convert: Callable[[Row, float], Item]
) -> defaultdict[int, list[Item]]:
    """Read a table: by the number of the run, what `convert` makes of a row and the run's start.

    Rows of a run that the manifest does not list are left out: a command that is interrupted
    between tables and manifest leaves such rows.
    """
    found: defaultdict[int, list[Item]] = defaultdict(list)
    for line, row in _rows(file):
        try:
            run = int(row["run"])
            if run in started:
                found[run].append(convert(row, started[run]))
        except (KeyError, TypeError, ValueError) as e:
            raise ResultsError(f"{file}:{line}: is damaged: {e!r}") from None
    return found


def _rows(file: Path) -> Iterator[tuple[int, Row]]:
    try:
        with file.open(encoding="utf-8", newline="") as lines:
            reader = csv.DictReader(lines)
            for row in reader:
                yield reader.line_num, row
    except OSError as e:
        raise ResultsError(f"{file}: cannot be read ({e.strerror})") from None


def _pose(row: Row, start_s: float) -> tuple[float, ...]:
    places = (row[name] for name in ("x_m", "y_m", "true_x_m", "true_y_m"))
    return (float(row["t_s"]) - start_s, *(float(v) if v else np.nan for v in places))


def _reflex(row: Row, start_s: float) -> Reflex:
    prefix = "true_" if row["true_x_m"] else ""
    return Reflex(
        event=int(row["event"]),
        t_s=float(row["t_s"]) - start_s,
        decided_s=float(row["decided_s"]) - start_s,
        x_m=float(row[f"{prefix}x_m"]),
        y_m=float(row[f"{prefix}y_m"]),
        novelty=float(row["novelty"]),
        sector=row["sector"],
        structure=row["structure"],
        decision=row["decision"],
        landmark=row["landmark"],
        rule=row["rule"],
    )


def _landmark(row: Row, start_s: float) -> Landmark:
    x_m, y_m = float(row["x_m"]), float(row["y_m"])
    return Landmark(
        name=row["landmark"],
        t_s=float(row["t_s"]) - start_s,
        x_m=x_m,
        y_m=y_m,
        theta_rad=float(row["theta_rad"]),
        drawn_x_m=x_m,
        drawn_y_m=y_m,
        sector=row["sector"],
        structure=row["structure"],
        salience=float(row["salience"]) if row["salience"] else None,
        relevance=float(row["relevance"]),
        permanence=float(row["permanence"]) if row["permanence"] else None,
        visits=int(row["visits"]),
    )
