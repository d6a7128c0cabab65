"""Reads all that the page shows of one run of a results folder."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ssrics_like.comparison import building_of
from ssrics_like.comparison.folder import MAP
from ssrics_like.errors import ResultsError
from ssrics_like.memory.store import load_topology
from ssrics_like.report.pictures import Pictures
from ssrics_like.report.reading import read_pictures
from ssrics_like.results.manifest import unfinished
from ssrics_like.results.reading import read_records
from ssrics_like.results.records import Run
from ssrics_like.viewer.arcs import Came, came
from ssrics_like.viewer.manifest import Said, said_in
from ssrics_like.viewer.notes import scans_note
from ssrics_like.viewer.scans import Scans, cast_anew, read_from_log
from ssrics_like.viewer.story import Story, told
from ssrics_like.viewer.tables import read_confidences, read_poses
from ssrics_like.viewer.trace import read_trace
from ssrics_like.world.building import Building


@dataclass(frozen=True, eq=False)
class Watched:
    """One run, as the page shows it.

    Attributes
    ----------
    said : Said
        What the manifest of its folder says.
    runs : int
        How many runs the folder holds.
    run : Run
        The run.
    poses : ndarray, shape (poses, 4)
        Time (seconds since the start), x, y (metres) and heading (radians) of the laser.
    scans : Scans or None
        Its scans, where they could be had.
    building : Building or None
        The map; None for a log.
    pictures : Pictures
        Walls, novelty and activation.
    arcs : list of Came
        Of topological memory.
    story : Story or None
        What the trace tells; None where the scenario keeps no trace.
    notes : tuple of str
        What the page must say of where this is from.
    """

    said: Said
    runs: int
    run: Run
    poses: NDArray[np.float64]
    scans: Scans | None
    building: Building | None
    pictures: Pictures
    arcs: list[Came]
    story: Story | None
    notes: tuple[str, ...]


def read_watched(folder: Path, number: int | None, log: Path | None) -> Watched:
    """Read a run.

    Parameters
    ----------
    folder : Path
        A folder that ``ssrics run`` or ``ssrics replay`` wrote.
    number : int or None
        Number of the run; its first one if left out.
    log : Path or None
        The log that the folder was made from, for its scans.

    Raises
    ------
    ResultsError
        The folder holds no results, several variants or no such run; a file is missing or damaged;
        the log is another one.
    MapError, MemoryFileError, SourceError
        The map, the saved topological memory or the log is damaged or missing.
    """
    if (folder / "variants.json").is_file():
        raise ResultsError(f"{folder}: holds the results of variants; name the folder of one")
    records = read_records(folder)
    run = _chosen(folder, records.runs, number)
    if len(run.path) == 0:
        raise ResultsError(f"{folder / 'path.csv'}: has no pose of run {run.number}")
    said = said_in(folder, records.manifest)
    building = building_of(folder)
    poses = read_poses(folder, run)
    scans = _scans(folder, said, run, poses, building, log)
    trace = folder / "trace" / f"{run.name}.jsonl"
    events = read_trace(trace, run.start_s)
    if events is None and said.has_trace:
        raise ResultsError(f"{trace}: is missing")
    poses[:, 0] -= run.start_s
    notes = [scans_note(said.file, said.world, is_read=scans is not None)]
    if events is None:
        notes.append("The scenario keeps no trace, so that buffers and productions are not shown.")
    return Watched(
        said=said,
        runs=len(records.runs),
        run=run,
        poses=poses,
        scans=scans,
        building=building,
        pictures=read_pictures(folder, run),
        arcs=came(load_topology(folder / "topology" / f"{run.name}.json").arcs, run.reflexes),
        story=None if events is None else told(events, said.rules, read_confidences(folder, run)),
        notes=tuple(note for note in (*notes, unfinished(records.manifest)) if note),
    )


def _chosen(folder: Path, runs: tuple[Run, ...], number: int | None) -> Run:
    """Return the run of a number."""
    if number is None:
        return runs[0]
    for run in runs:
        if run.number == number:
            return run
    first, last = runs[0].number, runs[-1].number
    known = f"run {first}" if first == last else f"runs {first} to {last}"
    raise ResultsError(f"--run: {number}: {folder} holds {known}")


def _scans(
    folder: Path,
    said: Said,
    run: Run,
    poses: NDArray[np.float64],
    building: Building | None,
    log: Path | None,
) -> Scans | None:
    """Return the scans, where there is something to have them from."""
    if said.robot is None:
        return None if log is None else read_from_log(log, said, poses[:, 0])
    if log is not None:
        raise ResultsError(f"--log: {log}: {folder} is of a simulated building, not of a log")
    if building is None:
        raise ResultsError(f"{folder / MAP}: is missing")
    if not run.is_true:
        raise ResultsError(f"{folder / 'path.csv'}: has no true pose of run {run.number}")
    return cast_anew(building.grid, said.robot.laser, poses[:, 1:])
