"""What became of each mark, place and passage of one run."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.distance import cdist

from ssrics_like.comparison.drive import Drive, Passages
from ssrics_like.comparison.matching import NONE, match
from ssrics_like.comparison.merging import groups_of, merge

HIT, REPEAT, OTHER, FALSE = "hit", "repeat", "other", "false"
FATES = (HIT, REPEAT, OTHER, FALSE)
"""What a mark can be: see `Outcome.fates`."""


@dataclass(frozen=True, eq=False)
class Outcome:
    """Which mark found what in one run; -1 stands for none.

    Attributes
    ----------
    place_mark : ndarray of int64, shape (places,)
        The mark that found each place. Designated places and others are matched apart.
    passages : Passages or None
        The passages through designated places; None where they are not known.
    passage_mark : ndarray of int64, shape (passages,)
        The mark that found each of them.
    group : ndarray of int64, shape (marks,)
        The group that each mark was merged into.
    group_place : ndarray of int64, shape (groups,)
        The place, of whatever kind, that each group lies at.
    repeats : int
        Marks at designated places that were found, but for the one that found it.
    designated : ndarray of bool, shape (places,)
        Which places are designated.
    """

    place_mark: NDArray[np.int64]
    passages: Passages | None
    passage_mark: NDArray[np.int64]
    group: NDArray[np.int64]
    group_place: NDArray[np.int64]
    repeats: int
    designated: NDArray[np.bool_]

    @property
    def found(self) -> NDArray[np.bool_]:
        """Which places were found, shape (places,)."""
        found: NDArray[np.bool_] = self.place_mark != NONE
        return found

    @property
    def passed(self) -> NDArray[np.bool_]:
        """Which passages were found, shape (passages,)."""
        passed: NDArray[np.bool_] = self.passage_mark != NONE
        return passed

    @property
    def right(self) -> int:
        """How many groups lie at a place."""
        return int((self.group_place != NONE).sum())

    def fates(self) -> list[str]:
        """Say what each mark is.

        ``hit``, if it found a designated place; ``repeat``, if it was merged with a hit or with
        an earlier mark; ``other``, if its group lies at a labelled place all the same; else
        ``false``.
        """
        hits = set(self.place_mark[self.designated].tolist()) - {NONE}
        told = {int(self.group[mark]) for mark in hits}
        fates = []
        for mark, group in enumerate(self.group.tolist()):
            if mark in hits:
                fates.append(HIT)
            elif group in told:
                fates.append(REPEAT)
            else:
                told.add(group)
                fates.append(OTHER if self.group_place[group] != NONE else FALSE)
        return fates


def outcome_of(
    drive: Drive,
    places: NDArray[np.float64],
    designated: NDArray[np.bool_],
    radius_m: float,
) -> Outcome:
    """Match the marks of a run with places and passages.

    Parameters
    ----------
    drive : Drive
        The run.
    places : ndarray, shape (m, 2)
        Every labelled place, metres, in the frame of the marks.
    designated : ndarray of bool, shape (m,)
        Which of them should be found.
    radius_m : float
        How far from a place, or along the path from a passage, a mark still finds it.
    """
    marks = drive.marks
    place_mark = np.full(len(places), NONE, np.int64)
    for kind in (designated, ~designated):
        place_mark[kind] = match(marks.xy_m, places[kind], radius_m)
    passages = None if drive.passages is None else drive.passages.through(designated)
    passage_mark = np.empty(0, np.int64)
    if passages is not None:
        known = np.flatnonzero(np.isfinite(marks.along_m))
        found = match(_on_line(marks.along_m[known]), _on_line(passages.along_m), radius_m)
        passage_mark = np.where(found == NONE, NONE, np.append(known, NONE)[found])
    group = groups_of(marks.xy_m, radius_m)
    groups = merge(marks.xy_m, radius_m)
    group_place = np.full(len(groups), NONE, np.int64)
    at = match(groups, places, radius_m)
    group_place[at[at != NONE]] = np.flatnonzero(at != NONE)
    near = _marks_nearest(marks.xy_m, places[designated], radius_m)[place_mark[designated] != NONE]
    repeats = int(np.maximum(near - 1, 0).sum())
    return Outcome(place_mark, passages, passage_mark, group, group_place, repeats, designated)


def _on_line(along_m: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return metres driven as places on a straight line."""
    return np.column_stack([along_m, np.zeros(len(along_m))])


def _marks_nearest(
    marks: NDArray[np.float64], places: NDArray[np.float64], radius_m: float
) -> NDArray[np.int64]:
    """Count for each place the marks within the radius that lie nearer to it than to another."""
    if len(marks) == 0 or len(places) == 0:
        return np.zeros(len(places), np.int64)
    distances = cdist(marks, places)
    nearest = distances.argmin(axis=1)[distances.min(axis=1) <= radius_m]
    return np.bincount(nearest, minlength=len(places)).astype(np.int64)
