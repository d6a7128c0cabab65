"""Whoever marks landmarks: one participant, or one run of a robot."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ssrics_like.comparison.driven import marks_of
from ssrics_like.comparison.matching import points
from ssrics_like.results.records import Records
from ssrics_like.world.choices import Choice

PEOPLE = "people"
"""The group of all participants; every other group is a model."""


@dataclass(frozen=True, eq=False)
class Marker:
    """One participant or one run, with what it marked.

    Attributes
    ----------
    name : str
        The participant, or ``run N``.
    group : str
        `PEOPLE`, or the name of the model.
    xy_m : ndarray, shape (marks, 2)
        Where the marks lie, in the frame of the map, metres.
    t_s : ndarray, shape (marks,)
        When they were made, seconds since the start; NaN where that is not known.
    names : tuple of str
        What each mark is called; may be empty.
    """

    name: str
    group: str
    xy_m: NDArray[np.float64]
    t_s: NDArray[np.float64]
    names: tuple[str, ...]

    def __len__(self) -> int:
        return len(self.xy_m)


def people_of(choices: Iterable[Choice]) -> tuple[Marker, ...]:
    """Return the participants, in the order in which they first appear."""
    by_name: dict[str, list[Choice]] = {}
    for choice in choices:
        by_name.setdefault(choice.participant, []).append(choice)
    return tuple(
        Marker(
            name,
            PEOPLE,
            points([(c.x_m, c.y_m) for c in made]),
            np.array([math.nan if c.t_s is None else c.t_s for c in made], np.float64),
            tuple(c.label or c.landmark for c in made),
        )
        for name, made in by_name.items()
    )


def silent_people(names: Iterable[str]) -> tuple[Marker, ...]:
    """Return participants who marked nothing."""
    return tuple(Marker(name, PEOPLE, np.empty((0, 2)), np.empty(0), ()) for name in names)


def runs_of(records: Records, model: str) -> tuple[Marker, ...]:
    """Return the runs of a results folder as the markers of one model.

    A mark is what `ssrics_like.comparison` takes for one: a reflex at which a landmark was
    declared, recognised, or known to be one without knowing which. It lies where the robot was
    when it perceived it, at the true position where that is known.
    """
    found = []
    for run in records.runs:
        marks = marks_of(run)
        found.append(
            Marker(
                f"run {run.number}",
                model,
                points([(mark.x_m, mark.y_m) for mark in marks]),
                np.array([mark.t_s for mark in marks], np.float64),
                tuple(mark.landmark for mark in marks),
            )
        )
    return tuple(found)
