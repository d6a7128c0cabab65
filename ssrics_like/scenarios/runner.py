"""Carries a scenario out: runs into a results folder."""

from __future__ import annotations

import itertools
import platform
import time
from collections.abc import Callable
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np

import ssrics_like
from ssrics_like.model import CognitiveModel
from ssrics_like.results.folder import ResultsFolder
from ssrics_like.results.recorder import JUMP_M, JUMP_M_S, Recorder
from ssrics_like.scenarios.schema import Resolved
from ssrics_like.sources import LogSource, open_log

Progress = Callable[[int, float], None]
"""Called now and then with the run's number and the share of it that is done."""

PROGRESS_EVERY = 64  # scans


def run_scenario(
    resolved: Resolved,
    out: Path,
    *,
    resume: bool = False,
    progress: Progress = lambda _run, _share: None,
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
    progress : callable
        See `Progress`.

    Returns
    -------
    dict
        The manifest.

    Raises
    ------
    SourceError, ResultsError, EngineError
        The log cannot be read, the folder cannot be written, the rules never come to rest.
    """
    started = time.time()
    settings = resolved.scenario.source
    source = open_log(
        resolved.log,
        format=settings.format,
        strict=settings.strict,
        fallback_rate_hz=settings.fallback_rate_hz,
        frame=settings.frame,
    )
    description = {
        "scenario": resolved.as_data(),
        "versions": versions(),
        "seed": resolved.scenario.seed,
        "frame": source.frame,
        "input": {"file": source.path.name, "format": source.format, "sha256": source.sha256},
    }
    with ResultsFolder(out) as folder:
        finished = folder.complete(description) if resume else None
        if finished is not None:
            return finished
        done = folder.begin(description, resume=resume)
        manifest: dict[str, Any] = {}
        for run in range(resolved.scenario.runs):
            if run not in done:
                entry = _one_run(resolved, source, folder.open_run(run), run, progress)
                folder.close_run(run, entry)
            manifest = folder.combine({**description, "wall_clock": _wall_clock(started)})
        folder.tidy()
    return manifest


def _one_run(
    resolved: Resolved, source: LogSource, folder: Path, run: int, progress: Progress
) -> dict[str, Any]:
    """Carry out one run into its own folder; return its entry for the manifest."""
    seed = int(np.random.SeedSequence([resolved.scenario.seed, run]).generate_state(1)[0])
    observations = iter(source)
    first = next(observations)  # a source without any scan has raised already
    with Recorder(folder, run, first.t_s, resolved.perception.range_cap_m) as recorder:
        model = CognitiveModel(
            resolved.perception,
            resolved.productions,
            resolved.memory,
            seed=seed,
            frame=source.frame,
            trace=recorder.traced,
            retrieved=recorder.retrieved,
        )
        for observation in itertools.chain([first], observations):
            recorder.decided_all(model.observe(observation))
            recorder.observed(observation, model.perception.novelty)
            if observation.index % PROGRESS_EVERY == 0:
                progress(run, source.progress)
        recorder.decided_all(model.finish())
        progress(run, 1.0)
        entry = recorder.finish(model)
    warnings = source.report.warnings()
    if not entry["novelty"]["intervals"]:
        warnings.append(
            f"the log has {entry['scans']} scans, fewer than one interval of "
            f"{resolved.perception.interval}: nothing can be novel"
        )
    if entry["jumps"]:
        warnings.append(
            f"the robot's pose jumped {entry['jumps']} times by more than {JUMP_M:g} m and faster "
            f"than {JUMP_M_S:g} m/s; the path's length and the places of landmarks suffer from it"
        )
    if entry["undecided"]:
        warnings.append(f"{entry['undecided']} reflexes were still undecided at the end of the run")
    if entry["restarts"]:
        warnings.append(
            f"the laser changed {entry['restarts']} times (beams or angles); each time the "
            "interval of the novelty algorithm began anew"
        )
    return {**entry, "seed": seed, "ended": "end of log", "warnings": warnings}


def versions() -> dict[str, str]:
    """Return the versions that results depend on."""
    return {
        "ssrics-like": ssrics_like.__version__,
        "pyactr": version("pyactr"),
        "numpy": np.__version__,
        "numba": version("numba"),
        "python": platform.python_version(),
    }


def _wall_clock(started: float) -> dict[str, Any]:
    stamp = datetime.fromtimestamp(started, tz=UTC).isoformat(timespec="seconds")
    return {"started": stamp, "seconds": time.time() - started}
