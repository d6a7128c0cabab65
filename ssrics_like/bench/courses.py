"""Courses: named sets of drives with their labels."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from pathlib import Path

from ssrics_like.bench.conditions import CONDITIONS, SWEEPS
from ssrics_like.bench.drives import OfLog, OnPlan, Simulated, Spec
from ssrics_like.bench.plans import check_plans
from ssrics_like.bench.settings import BenchSettings
from ssrics_like.comparison import load_truth
from ssrics_like.errors import LibraryError, choices, nearest
from ssrics_like.results.counts import counted
from ssrics_like.sources import open_log

PLANS, LOGS = "plans", "logs"


@dataclass(frozen=True)
class Course:
    """Drives that are pooled.

    Attributes
    ----------
    name, title : str
        What it is called, and what it is.
    drives : tuple of Spec
        At least one.
    sweep : str
        The curve that it is a point of; empty for one of the table.
    value : float
        Where on that curve, in the unit of its axis.
    """

    name: str
    title: str
    drives: tuple[Spec, ...]
    sweep: str = ""
    value: float = 0.0


def course_names() -> tuple[str, ...]:
    """Return every name that can be chosen; `logs` stands for each log that is given."""
    return (*CONDITIONS, PLANS, LOGS, *SWEEPS)


def make_courses(
    settings: BenchSettings,
    *,
    maps: Sequence[Path] = (),
    logs: Sequence[tuple[Path, Path]] = (),
    chosen: Collection[str] = (),
) -> tuple[list[Course], list[str]]:
    """Return the courses, and a line for each that is left out for lack of data.

    Parameters
    ----------
    settings : BenchSettings
        How many drives.
    maps : sequence of Path
        Folders for `ssrics_like.bench.plans.load_plan`.
    logs : sequence of (Path, Path)
        A log, and the folder of its labels.
    chosen : collection of str
        Names of courses, all if empty; a log's name is that of its file up to the first dot.

    Raises
    ------
    LibraryError
        A course that was chosen is unknown, lacks its data, or nothing is left.
    SourceError, MapError
        A log, a map or labels are wrong: before any drive.
    """
    _check_names(chosen, logs)
    check_plans(maps)
    for log, truth in logs:
        open_log(log)
        load_truth(truth)
    left_out = []
    for name, given, option in ((PLANS, maps, "--maps FOLDER..."), (LOGS, logs, "--log LOG TRUTH")):
        if not given and (not chosen or name in chosen):
            if name in chosen:
                raise LibraryError(f"course '{name}' needs data: {option}")
            left_out.append(f"left out: {name}, which need {option}")
    seeds = range(settings.seeds)
    courses = [
        Course(name, title, tuple(Simulated(condition, seed) for seed in seeds))
        for name, (title, condition) in CONDITIONS.items()
    ]
    if maps:
        driven = tuple(OnPlan(folder, seed) for folder in maps for seed in seeds)
        courses.append(Course(PLANS, counted(len(maps), "furnished floor plan"), driven))
    courses += [
        Course(name, f"the log {name}", (OfLog(log, truth),))
        for name, (log, truth) in zip(_log_names(logs), logs, strict=True)
    ]
    every_log = _log_names(logs) if LOGS in chosen else []
    wanted = {*chosen, *every_log}
    courses = [course for course in courses if not chosen or course.name in wanted]
    for name, sweep in SWEEPS.items():
        if chosen and name not in chosen:
            continue
        for value in sweep.values:
            condition, at = sweep.condition(value), sweep.shown * value
            drives = tuple(
                Simulated(condition, seed)
                for seed in range(min(settings.seeds, settings.sweep_seeds))
            )
            courses.append(Course(f"{name} {at:g}", sweep.title, drives, name, at))
    return courses, left_out


def _check_names(chosen: Collection[str], logs: Sequence[tuple[Path, Path]]) -> None:
    known = [*course_names(), *_log_names(logs)]
    for name in chosen:
        if name not in known:
            raise LibraryError(
                f"no course '{name}'{nearest(name, known)}; known are {choices(known)}"
            )


def _log_names(logs: Sequence[tuple[Path, Path]]) -> list[str]:
    """Name each log by its file; one whose name is taken gets a number behind it."""
    names: list[str] = []
    for log, _ in logs:
        plain = log.name.split(".")[0] or log.name
        taken, number, name = {*course_names(), *names}, 2, plain
        while name in taken:
            name, number = f"{plain}-{number}", number + 1
        names.append(name)
    return names
