"""Carries a scenario out: runs into results folders."""

from __future__ import annotations

import platform
import time
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, field
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np

import ssrics_like
from ssrics_like.comparison import write_scores
from ssrics_like.maps import save_building
from ssrics_like.results.folder import ResultsFolder
from ssrics_like.scenarios.feeds import DriveFeed, open_source
from ssrics_like.scenarios.one_run import Part, Task
from ssrics_like.scenarios.pool import carry_out_all
from ssrics_like.scenarios.resolving import Resolved
from ssrics_like.scenarios.run_id import run_id

Progress = Callable[[int, float], None]
"""Called now and then with a run's number and the share of it that is done."""

Say = Callable[[str], None]
"""Called with a line that the user should read, before the runs begin."""

JOINING_SHARE = 0.1
"""Tables are put together anew after a run, but for no more than this share of the time."""


def run_scenario(
    resolved: Resolved,
    out: Path,
    *,
    resume: bool = False,
    jobs: int = 1,
    progress: Progress = lambda _run, _share: None,
    say: Say = lambda _: None,
) -> dict[str, Any]:
    """Carry out every run of a scenario.

    Parameters
    ----------
    resolved : Resolved
        The scenario with its files read.
    out : Path
        Results folder, made if need be.
    resume : bool
        Keep the complete runs that are there and do only the others.
    jobs : int
        How many runs at the same time, each in a process of its own; the results are the same.
    progress : callable
        See `Progress`.
    say : callable
        See `Say`.

    Returns
    -------
    dict
        The manifest.

    Raises
    ------
    SourceError, ResultsError, EngineError
        The log cannot be read, the folder cannot be written, the rules never come to rest.
    MemoryFileError
        What is remembered has its positions in another frame.
    """
    (manifest,) = run_side_by_side(
        [(resolved, out)], resume=resume, jobs=jobs, progress=progress, say=say
    )
    return manifest


def run_side_by_side(
    scenarios: Sequence[tuple[Resolved, Path]],
    *,
    resume: bool = False,
    jobs: int = 1,
    progress: Progress = lambda _task, _share: None,
    say: Say = lambda _: None,
) -> list[dict[str, Any]]:
    """Carry out several scenarios; those with the same drives share them.

    Parameters
    ----------
    scenarios : sequence of (Resolved, Path)
        Each with its results folder.
    resume, jobs, say : as `run_scenario`
    progress : callable
        Called with the number of a task: of a run, shared by the scenarios with the same drives.

    Returns
    -------
    list of dict
        The manifests.

    Raises
    ------
    SourceError, ResultsError, EngineError, MemoryFileError
        As `run_scenario`.
    """
    descriptions = [_description(resolved) for resolved, _ in scenarios]  # before folders are made
    with ExitStack() as stack:
        works = [
            _Work(resolved, stack.enter_context(ResultsFolder(out)), description)
            for (resolved, out), description in zip(scenarios, descriptions, strict=True)
        ]
        for work in works:
            work.begin(resume=resume)
            for notice in work.folder.notices:
                say(f"{work.folder.path}: {notice}")
        shared: dict[tuple[str, int], list[_Work]] = {}
        for work in works:
            for run in work.missing:
                shared.setdefault((drive_key(work.resolved), run), []).append(work)
        tasks, owners = [], []
        for (_, run), members in sorted(shared.items(), key=lambda item: item[0][1]):
            parts = tuple(w.part(run) for w in members)
            tasks.append(Task(run, parts))
            owners.append(members)
        of_task = dict(zip(map(id, tasks), owners, strict=True))

        def done(task: Task, entries: list[dict[str, Any]]) -> None:
            for work, entry in zip(of_task[id(task)], entries, strict=True):
                work.folder.close_run(task.run, entry)
                work.join(only_if_cheap=True)

        try:
            # A scenario of its own counts runs, several count what they have in common.
            names = [task.run if len(works) == 1 else i for i, task in enumerate(tasks)]
            carry_out_all(tasks, jobs, lambda i, share: progress(names[i], share), done)
        except BaseException:
            for work in works:
                if work.folder.has_runs:
                    work.join()
            raise
        return [work.finish() for work in works]


@dataclass
class _Work:
    """A scenario on its way into a results folder."""

    resolved: Resolved
    folder: ResultsFolder
    description: dict[str, Any]
    missing: list[int] = field(default_factory=list)
    manifest: dict[str, Any] | None = None
    started: float = field(default_factory=time.time)
    joining_s: float = 0.0
    is_whole: bool = False

    def begin(self, *, resume: bool) -> None:
        """Find out which runs are to be done."""
        finished = self.folder.complete(self.description) if resume else None
        if finished is not None:
            self.manifest, self.is_whole = finished, True
            return
        there = self.folder.begin(self.description, resume=resume)
        self.missing = [n for n in range(self.resolved.scenario.runs) if n not in there]

    def part(self, run: int) -> Part:
        """Return one of the runs, its folder made."""
        folder = self.folder.open_run(run)
        return Part(self.resolved.of_run(run), folder, run_id(self.description, run))

    def join(self, *, only_if_cheap: bool = False) -> None:
        """Put the complete runs together, so that an interrupted command leaves them readable."""
        begun = time.time()
        spent = begun - self.started
        if self.is_whole or (only_if_cheap and self.joining_s > JOINING_SHARE * spent):
            return
        clock = {"wall_clock": _wall_clock(self.started)}
        self.manifest = self.folder.combine({**self.description, **clock})
        self._write_map()
        self.joining_s += time.time() - begun

    def _write_map(self) -> None:
        """Put the building beside the tables, or take away that of an earlier scenario."""
        folder = self.folder.path / "map"
        if self.resolved.place is not None:
            save_building(self.resolved.place.building, folder)
            return
        for name in ("map.yaml", "map.png"):
            (folder / name).unlink(missing_ok=True)
        if folder.is_dir() and not any(folder.iterdir()):
            folder.rmdir()

    def finish(self) -> dict[str, Any]:
        """Put everything together; return the manifest."""
        if not self.is_whole:
            self.join()
            write_scores(self.folder.path)
            self.folder.tidy()
        assert self.manifest is not None
        return self.manifest


def drive_key(resolved: Resolved) -> str:
    """Return a text that is equal for scenarios whose observations are equal."""
    if resolved.place is not None:
        if any(leg.goto for leg in resolved.place.settings.journey):  # where to is the model's say
            return f"led {id(resolved)}"
        return f"{resolved.place.as_data()} {resolved.place.sha256} {resolved.scenario.seed}"
    return f"{resolved.log} {resolved.scenario.source}"


def _description(resolved: Resolved) -> dict[str, Any]:
    """Return all that decides the results."""
    if resolved.place is not None:
        frame = DriveFeed.frame
        source = {"file": resolved.place.name, "format": "map", "sha256": resolved.place.sha256}
    else:
        log = open_source(resolved)
        frame = log.frame
        source = {"file": log.path.name, "format": log.format, "sha256": log.sha256}
    if resolved.recollection is not None:
        resolved.recollection.check_frame(frame)
    return {
        "scenario": resolved.as_data(),
        "versions": versions(),
        "seed": resolved.scenario.seed,
        "frame": frame,
        "input": source,
    }


def versions() -> dict[str, str]:
    """Return the versions that results depend on."""
    return {
        "ssrics-like": ssrics_like.__version__,
        "pyactr": version("pyactr"),
        "numpy": np.__version__,
        "numba": version("numba"),
        "scipy": version("scipy"),
        "python": platform.python_version(),
    }


def _wall_clock(started: float) -> dict[str, Any]:
    stamp = datetime.fromtimestamp(started, tz=UTC).isoformat(timespec="seconds")
    return {"started": stamp, "seconds": time.time() - started}
