"""All candidates on all courses."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.bench.drives import OnPlan, Spec, make_drive
from ssrics_like.bench.scoring import Result, score_marks
from ssrics_like.comparison.agreement import consistency
from ssrics_like.comparison.proportions import harmonic_mean, share
from ssrics_like.comparison.tally import Tally, pooled
from ssrics_like.designators import designate
from ssrics_like.workers import in_order

if TYPE_CHECKING:
    from ssrics_like.bench.candidates import Candidate
    from ssrics_like.bench.courses import Course
    from ssrics_like.bench.settings import BenchSettings

Say = Callable[[str], None]
RESAMPLED, FEWEST = 1000, 5
"""So many sets of drives are drawn for the interval of F; of fewer drives there is none."""
INTERVAL = (2.5, 97.5)
TELL = 10
"""Progress is told after so many drives."""


@dataclass(frozen=True)
class Figures:
    """What a candidate reached on a course.

    Attributes
    ----------
    tally : Tally
        Counts of all its drives.
    interval : tuple of float
        F at the 2.5 % and 97.5 % points, drives drawn anew with replacement; NaN of fewer than
        five drives.
    consistency : float
        Agreement of the drives through one place about what was found, the mean over places that
        were driven through several times; NaN without any.
    """

    tally: Tally
    interval: tuple[float, float]
    consistency: float


@dataclass(frozen=True)
class Bench:
    """A benchmark.

    Attributes
    ----------
    settings : BenchSettings
        How it was made.
    candidates : tuple of Candidate
        In the order of the tables.
    courses : tuple of Course
        Those of the table first, then the points of the curves.
    figures : dict
        (name of a course, name of a candidate) -> Figures.
    """

    settings: BenchSettings
    candidates: tuple[Candidate, ...]
    courses: tuple[Course, ...]
    figures: Mapping[tuple[str, str], Figures]


def run_bench(
    settings: BenchSettings,
    candidates: Sequence[Candidate],
    courses: Sequence[Course],
    jobs: int = 1,
    say: Say = lambda _: None,
) -> Bench:
    """Let every candidate mark every drive, and score it.

    A drive that several courses have is made once. The result depends on `jobs` in nothing.

    Parameters
    ----------
    settings : BenchSettings
        The radius.
    candidates : sequence of Candidate
        With their settings.
    courses : sequence of Course
        With their drives.
    jobs : int
        How many drives at the same time.
    say : callable
        Is told how far it is, a line at a time.

    Raises
    ------
    SsricsError
        As making a drive, or a candidate, does.
    """
    specs = list(dict.fromkeys(spec for course in courses for spec in course.drives))
    work = partial(_all_on, candidates=tuple(candidates), radius_m=settings.radius_m)
    results: dict[Spec, list[Result]] = {}
    for spec, made in zip(specs, in_order(work, specs, jobs), strict=True):
        results[spec] = made
        if len(results) % TELL == 0 or len(results) == len(specs):
            say(f"{len(results)} of {len(specs)} drives")
    figures = {}
    for course in courses:
        for i, candidate in enumerate(candidates):
            some = [results[spec][i] for spec in course.drives]
            figures[course.name, candidate.name] = Figures(
                pooled(one.tally for one in some),
                f_interval([one.tally for one in some]),
                _consistency(course.drives, some),
            )
    return Bench(settings, tuple(candidates), tuple(courses), figures)


def _all_on(spec: Spec, candidates: tuple[Candidate, ...], radius_m: float) -> list[Result]:
    """Make a drive and score every candidate on it."""
    drive = make_drive(spec)
    return [
        score_marks(
            drive,
            designate(candidate.make(spec.seed, drive.frame), drive.observations),
            radius_m,
            spec.seed,
        )
        for candidate in candidates
    ]


def f_interval(tallies: Sequence[Tally]) -> tuple[float, float]:
    """Return the bootstrap interval of the pooled F, drives being drawn with replacement."""
    if len(tallies) < FEWEST:
        return math.nan, math.nan
    counts = np.array([(t.passed, t.passages, t.right, t.merged) for t in tallies], np.float64)
    drawn = np.random.default_rng(0).integers(len(counts), size=(RESAMPLED, len(counts)))
    values = [
        harmonic_mean(share(passed, passages), share(right, merged))
        for passed, passages, right, merged in counts[drawn].sum(axis=1).tolist()
    ]
    known = [value for value in values if not math.isnan(value)]
    if not known:
        return math.nan, math.nan
    low, high = np.percentile(known, INTERVAL).tolist()
    return low, high


def _consistency(specs: Sequence[Spec], results: Sequence[Result]) -> float:
    places: dict[object, list[tuple[bool, ...]]] = {}
    for spec, result in zip(specs, results, strict=True):
        if isinstance(spec, OnPlan):
            places.setdefault(spec.folder, []).append(result.found)
    values = [consistency(np.array(rows, bool)) for rows in places.values()]
    known = [value for value in values if not math.isnan(value)]
    return sum(known) / len(known) if known else math.nan
