"""Settings for every designator, from drives that nothing is reported on."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

from ssrics_like.bench.candidates import JOINT, TRAINED
from ssrics_like.bench.conditions import CONDITIONS
from ssrics_like.bench.drives import TRAINING, TUNING, BenchDrive, Simulated, make_drive
from ssrics_like.bench.scoring import score_marks
from ssrics_like.bench.tuned import Tuned, TunedDesignator
from ssrics_like.comparison.tally import pooled
from ssrics_like.designators import ScanModel, designator_kind, train, trials
from ssrics_like.designators.optional import optional
from ssrics_like.designators.path import Steps
from ssrics_like.workers import in_order

if TYPE_CHECKING:
    from ssrics_like.bench.settings import BenchSettings
    from ssrics_like.designators import Mark
    from ssrics_like.perception.observation import LaserScan

Say = Callable[[str], None]
NEAR_M = 0.5
"""A scan taken this near to a doorway's middle is one in the doorway, for training."""
COARSE_DRAWS = 1
"""The marks that know nothing do not matter here."""


@dataclass(frozen=True)
class _Job:
    """One designator to tune, with the model of one that is trained."""

    name: str
    drives: int
    radius_m: float
    model: ScanModel | None


def drives_of(purpose: int, count: int) -> list[Simulated]:
    """Return drives whose conditions are those of the simulated courses, in turn."""
    conditions = [condition for _, condition in CONDITIONS.values()]
    return [Simulated(conditions[i % len(conditions)], i, purpose) for i in range(count)]


def pooled_f(
    drives: Sequence[BenchDrive], marks: Sequence[Sequence[Mark]], radius_m: float
) -> float:
    """Return F of the marks on some drives together; NaN without a meaning."""
    return pooled(
        score_marks(drive, some, radius_m, draws=COARSE_DRAWS).tally
        for drive, some in zip(drives, marks, strict=True)
    ).f


def trained_model(count: int, jobs: int = 1) -> ScanModel:
    """Train the classifier of single scans.

    It learns from a scan every 0.1 m of path; one taken within 0.5 m of a doorway's middle is
    one in a doorway.

    Parameters
    ----------
    count : int
        How many drives, through buildings that serve nothing else.
    jobs : int
        How many drives at the same time.

    Raises
    ------
    MissingPackageError
        scikit-learn is not installed.
    """
    optional("sklearn", "scikit-learn", TRAINED)  # before the drives, which take long
    scans: list[LaserScan] = []
    labels: list[bool] = []
    for some, told in in_order(_labelled, drives_of(TRAINING, count), jobs):
        scans += some
        labels += told
    return train(scans, labels, seed=TRAINING)


def _labelled(spec: Simulated) -> tuple[list[LaserScan], list[bool]]:
    """Return scans of a drive, and whether each was taken in a doorway."""
    drive = make_drive(spec)
    places = np.array([(place.x_m, place.y_m) for place in drive.locations])
    doorways = places[drive.designated]
    scans, labels, steps = [], [], Steps()
    for observation, at in zip(drive.observations, drive.way.xy_m, strict=True):
        if steps.update(observation.pose) is not None:
            scans.append(observation.scan)
            labels.append(bool((np.hypot(*(doorways - at).T) < NEAR_M).any()))
    return scans, labels


def tune_designators(
    names: Sequence[str],
    settings: BenchSettings,
    jobs: int = 1,
    model: ScanModel | None = None,
    say: Say = lambda _: None,
) -> Tuned:
    """Tune designators by F, pooled over drives through buildings that serve nothing else.

    Parameters
    ----------
    names : sequence of str
        Candidates; models among them are passed over, for nothing of them is tuned.
    settings : BenchSettings
        How many drives, and the radius.
    jobs : int
        How many designators at the same time.
    model : ScanModel, optional
        Of `boosted-scan`, needed if that is among them.
    say : callable
        Is told how far it is, a line at a time.
    """
    work = [
        _Job(name, settings.tuning, settings.radius_m, model if name == TRAINED else None)
        for name in names
        if JOINT not in name
    ]
    found = {}
    for job, chosen in zip(work, _in_order(work, jobs), strict=True):
        found[job.name] = chosen
        given = ", ".join(
            f"{key} {value}" + (" (edge of the grid)" if key in chosen.edges else "")
            for key, value in chosen.settings.items()
        )
        say(f"tuned {job.name}: {given or 'nothing to choose'}")
    return Tuned(
        tuning=settings.tuning,
        training=settings.training,
        radius_m=settings.radius_m,
        designators=found,
    )


def _in_order(work: Sequence[_Job], jobs: int) -> Iterator[TunedDesignator]:
    return in_order(_tuned, work, jobs)


def _tuned(job: _Job) -> TunedDesignator:
    drives = _tuning_drives(job.drives)
    fixed: dict[str, Any] = {} if job.model is None else {"model": job.model}
    done = trials(
        job.name,
        [drive.observations for drive in drives],
        lambda marks: pooled_f(drives, marks, job.radius_m),
        **fixed,
    )
    best = max(done, key=lambda one: -math.inf if math.isnan(one.score) else one.score)
    chosen = {key: value for key, value in best.settings.items() if key not in fixed}
    f = None if math.isnan(best.score) else round(best.score, 6)
    return TunedDesignator(
        settings=chosen,
        f=f,
        tried=len(done),
        edges=at_edges(chosen, designator_kind(job.name).GRID),
    )


def at_edges(chosen: Mapping[str, Any], grid: Mapping[str, Sequence[Any]]) -> list[str]:
    """Return the settings whose number is the least or the greatest of those tried."""
    return [
        key
        for key, value in chosen.items()
        if isinstance(value, int | float)
        and not isinstance(value, bool)
        and value in (min(grid[key]), max(grid[key]))
    ]


@lru_cache(maxsize=1)
def _tuning_drives(count: int) -> tuple[BenchDrive, ...]:
    """Simulate them once a process; they serve every designator that it tunes."""
    return tuple(make_drive(spec) for spec in drives_of(TUNING, count))
