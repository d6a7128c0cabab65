"""Tuning on drives whose truth is known: every designator the same way."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ssrics_like.designators.protocol import Mark, designate
from ssrics_like.designators.registry import designator_kind, make_designator
from ssrics_like.errors import SettingsError

if TYPE_CHECKING:
    from ssrics_like.perception.observation import Observation

Score = Callable[[list[list[Mark]]], float]
"""From the marks of each drive to how good they are; more is better, NaN is worst."""


@dataclass(frozen=True, slots=True)
class Trial:
    """One choice of settings and what it reached.

    Attributes
    ----------
    settings : dict
        What `make_designator` was given.
    score : float
        By the caller's measure.
    """

    settings: dict[str, Any]
    score: float


def trials(
    name: str,
    drives: Sequence[Iterable[Observation]],
    score: Score,
    grid: Mapping[str, Sequence[Any]] | None = None,
    **fixed: Any,
) -> list[Trial]:
    """Score every choice of settings from a grid.

    Parameters
    ----------
    name : str
        Of the designator.
    drives : sequence of sequence of Observation
        Each is gone through once for every choice.
    score : callable
        Takes the marks of each drive, in the order of `drives`.
    grid : mapping, optional
        Name of a setting -> values to try; the designator's own `GRID` if not given.
    **fixed
        Settings that stay; one that is also in the grid is not varied.

    Returns
    -------
    list of Trial
        In the order of the grid, the last setting varying fastest.

    Raises
    ------
    SettingsError
        There are no drives, or a setting is unknown or out of range.
    """
    if not drives:
        raise SettingsError(f"tuning '{name}' needs at least one drive")
    grid = designator_kind(name).GRID if grid is None else grid
    varied = {key: tuple(values) for key, values in grid.items() if key not in fixed}
    done = []
    for values in itertools.product(*varied.values()):
        settings = {**fixed, **dict(zip(varied, values, strict=True))}
        marks = [designate(make_designator(name, **settings), drive) for drive in drives]
        done.append(Trial(settings, float(score(marks))))
    return done


def tune(
    name: str,
    drives: Sequence[Iterable[Observation]],
    score: Score,
    grid: Mapping[str, Sequence[Any]] | None = None,
    **fixed: Any,
) -> dict[str, Any]:
    """Return the settings that score best; of equals, the first of the grid.

    Takes and raises what `trials` does.
    """
    done = trials(name, drives, score, grid, **fixed)
    best = max(done, key=lambda trial: -math.inf if math.isnan(trial.score) else trial.score)
    return best.settings
