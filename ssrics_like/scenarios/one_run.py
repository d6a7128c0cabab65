"""Carries out one run: observations through the model into a folder of its own."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from ssrics_like.model import CognitiveModel
from ssrics_like.perception.observation import Observation
from ssrics_like.perception.walk import STEP_M
from ssrics_like.results.counts import counted
from ssrics_like.results.recorder import JUMP_M, JUMP_M_S, Recorder
from ssrics_like.scenarios.feeds import Feed, make_feed
from ssrics_like.scenarios.resolving import Resolved

PROGRESS_EVERY = 64  # scans


@dataclass(frozen=True)
class Part:
    """A model that a run's observations go to.

    Attributes
    ----------
    resolved : Resolved
        The scenario, or a variant of it.
    folder : Path
        Where its run is written; empty.
    run_id : str
        Names the run among all runs; see `run_id`.
    """

    resolved: Resolved
    folder: Path
    run_id: str


@dataclass(frozen=True)
class Task:
    """One run of one drive or log, for one model or several.

    Attributes
    ----------
    run : int
        Its number.
    parts : tuple of Part
        They have the same source, and get the same observations.
    """

    run: int
    parts: tuple[Part, ...]


def carry_out(task: Task, progress: Callable[[float], None]) -> list[dict[str, Any]]:
    """Carry out a task and return, for each part, the run's entry for the manifest.

    Raises
    ------
    SourceError, ResultsError, EngineError
        The log cannot be read, a folder cannot be written, the rules never come to rest.
    """
    feed = make_feed(task.parts[0].resolved, task.run)
    if len(task.parts) == 1:
        observed = _watched(feed, progress, lambda: feed.progress)
        entry = _through(task.parts[0], task.run, feed, observed)
        progress(1.0)
        return [entry]
    # pyactr keeps state for the whole process, so models follow each other, and the drive waits.
    whole = len(task.parts) + 1
    observations = list(
        _watched(feed, lambda share: progress(share / whole), lambda: feed.progress)
    )
    entries = []
    for done, part in enumerate(task.parts, 1):
        observed = _watched(observations, progress, partial(float, done / whole))
        entries.append(_through(part, task.run, feed, observed))
    progress(1.0)
    return entries


def _watched(
    observations: Iterable[Observation],
    progress: Callable[[float], None],
    so_far: Callable[[], float],
) -> Iterable[Observation]:
    """Hand observations on, and tell now and then how far it is."""
    for observation in observations:
        yield observation
        if observation.index % PROGRESS_EVERY == 0:
            progress(so_far())


def _through(
    part: Part, run: int, feed: Feed, observations: Iterable[Observation]
) -> dict[str, Any]:
    """Let a model observe, and write what it does."""
    resolved = part.resolved
    recollection = resolved.recollection
    remembered = None if recollection is None else recollection.by_run[run]
    seed = int(np.random.SeedSequence([resolved.scenario.seed, run]).generate_state(1)[0])
    rest = iter(observations)
    first = next(rest)  # a source without any scan has raised already
    with Recorder(
        part.folder,
        run,
        first.t_s,
        resolved.perception.range_cap_m,
        outline=feed.outline,
        trace=resolved.scenario.trace,
    ) as recorder:
        model = CognitiveModel(
            resolved.perception,
            resolved.productions,
            resolved.memory,
            seed=seed,
            frame=feed.frame,
            trace=recorder.traced,
            retrieved=recorder.retrieved,
            remembered=None if remembered is None else remembered.memory,
            at_home=recollection is not None and recollection.at_home,
        )
        feed.be_led(model.wayfinder)
        for observation in itertools.chain([first], rest):
            recorder.decided_all(model.observe(observation))
            recorder.observed(observation, model.perception.novelty)
        recorder.decided_all(model.finish())
        entry = {**recorder.finish(model, part.run_id), **feed.entry(), "seed": seed}
    if model.wayfinder.errands:
        entry["errands"] = [errand.as_data() for errand in model.wayfinder.errands]
    if remembered is not None:
        entry["memory_from"] = remembered.as_data()
    return {**entry, "warnings": [*feed.warnings(), *_warnings(resolved, entry)]}


def _warnings(resolved: Resolved, entry: dict[str, Any]) -> list[str]:
    """Say what in a run's counts the user should know."""
    found = []
    if not entry["novelty"]["intervals"]:
        what = "log" if resolved.log else "drive"
        length = (
            f"has {counted(entry['scans'], 'scan')}, fewer than one interval of "
            f"{resolved.perception.interval}"
            if resolved.perception.along == "scans"
            else f"is {entry['path_length_m']:.3g} m long, hardly longer than one interval of "
            f"{resolved.perception.interval * STEP_M:.3g} m"
        )
        found.append(f"the {what} {length}: nothing can be novel")
    if entry["jumps"] and resolved.log:
        found.append(
            f"the robot's pose jumped {counted(entry['jumps'], 'time')} by more than "
            f"{JUMP_M:g} m and faster than {JUMP_M_S:g} m/s; the path's length and the places of "
            "landmarks suffer from it"
        )
    if entry["undecided"]:
        count = entry["undecided"]
        reflexes = "1 reflex was" if count == 1 else f"{count} reflexes were"
        found.append(f"{reflexes} still undecided at the end of the run")
    if entry["restarts"]:
        found.append(
            f"the laser changed {counted(entry['restarts'], 'time')} (beams or angles); "
            "each time the interval of the novelty algorithm began anew"
        )
    return found
