"""Reads a results folder for the report: the records, and what is only drawn."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ssrics_like.comparison import building_of, score_records
from ssrics_like.errors import ResultsError
from ssrics_like.memory.store import load_topology
from ssrics_like.report.pictures import Activation, Histogram, Novelty, Outline, Pictures
from ssrics_like.report.records import Results
from ssrics_like.results.reading import read_records
from ssrics_like.results.records import Run


def read_results(folder: Path) -> Results:
    """Read all that the report shows of a results folder.

    Parameters
    ----------
    folder : Path
        A folder that ``ssrics run`` or ``ssrics replay`` wrote.

    Raises
    ------
    ResultsError
        There is no folder, it holds no results or no complete run, or a file is missing or
        damaged (named with its line).
    MapError
        The map of the building is damaged.
    MemoryFileError
        The saved topological memory is damaged.
    """
    records = read_records(folder)
    shown = records.runs[0]
    building = building_of(folder)
    return Results(
        folder=folder,
        manifest=records.manifest,
        runs=records.runs,
        pictures=read_pictures(folder, shown),
        arcs=load_topology(folder / "topology" / f"{shown.name}.json").arcs,
        building=building,
        scores=score_records(records, building) if building else None,
    )


def read_pictures(folder: Path, run: Run) -> Pictures:
    """Read what only the figures of a run need.

    Raises
    ------
    ResultsError
        figures/run-NNN.json is missing or damaged.
    """
    file = folder / "figures" / f"{run.name}.json"
    try:
        data = json.loads(file.read_text(encoding="utf-8"))
        return Pictures(
            outline=_outline(data["outline"]),
            novelty=_novelty(data["novelty"], run.start_s),
            novel=_histogram(data["histograms"]["novel"]),
            bored=_histogram(data["histograms"]["bored"]),
            activation=_activation(data["activation"], run.start_s),
        )
    except OSError as e:
        raise ResultsError(f"{file}: cannot be read ({e.strerror})") from None
    except (KeyError, TypeError, ValueError) as e:
        raise ResultsError(f"{file}: is damaged: {e!r}") from None


def _outline(data: dict[str, Any]) -> Outline:
    return Outline(
        float(data["cell_m"]), np.array(data["x"], np.int64), np.array(data["y"], np.int64)
    )


def _floats(values: list[float | None]) -> NDArray[np.float64]:
    return np.array(values, np.float64)  # None becomes NaN


def _novelty(data: dict[str, Any], start_s: float) -> Novelty:
    columns = (_floats(data[name]) for name in ("mean", "least", "largest"))
    return Novelty(_floats(data["t_s"]) - start_s, *columns)


def _histogram(data: dict[str, Any] | None) -> Histogram | None:
    if data is None:
        return None
    return Histogram(
        int(data["scan"]),
        float(data["tau"]),
        tuple(int(n) for n in data["counts"]),
        tuple(float(e) for e in data["edges"]),
    )


def _activation(data: dict[str, Any], start_s: float) -> Activation:
    levels = {str(name): _floats(values) for name, values in data["base_level"].items()}
    return Activation(_floats(data["t_s"]) - start_s, levels)
