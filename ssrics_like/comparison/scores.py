"""How well the marks of some runs meet the labelled places of a building."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.distance import cdist

from ssrics_like.comparison.agreement import consistency
from ssrics_like.comparison.chance import DRAWS, clock_marks, mean_by_chance
from ssrics_like.comparison.matching import NONE, match, points
from ssrics_like.comparison.merging import merge
from ssrics_like.comparison.proportions import share, wilson
from ssrics_like.comparison.tally import Tally, pooled
from ssrics_like.world.locations import Location

DESIGNATED = "doorway"
"""The kind of place that people designated: "These locations, all doorways" (report, section 4)."""


@dataclass(frozen=True, eq=False)
class Drive:
    """What is scored of one run.

    Attributes
    ----------
    marks : ndarray, shape (n, 2)
        Where something was marked, in order of time, metres.
    path : ndarray, shape (poses, 2)
        Where the robot was, metres.
    length_m : float
        Metres driven.
    """

    marks: NDArray[np.float64]
    path: NDArray[np.float64]
    length_m: float


@dataclass(frozen=True, slots=True)
class PlaceScore:
    """How often one place was found.

    Attributes
    ----------
    location : Location
        The place.
    runs, found : int
        How many runs there were, and in how many it was found.
    chance : float
        Share of runs in which as many marks at random would have found it.
    clock : float
        Share of runs in which as many marks by a clock would have found it.
    """

    location: Location
    runs: int
    found: int
    chance: float
    clock: float

    @property
    def designated(self) -> bool:
        """Whether it is one that should be found."""
        return self.location.kind == DESIGNATED

    @property
    def share(self) -> float:
        """Share of the runs in which it was found."""
        return share(self.found, self.runs)

    @property
    def interval(self) -> tuple[float, float]:
        """Wilson 95 % interval of the share."""
        return wilson(self.found, self.runs)


@dataclass(frozen=True, eq=False)
class Scores:
    """Scores of a set of runs.

    Attributes
    ----------
    radius_m : float
        A mark finds a place at most this far away.
    places : tuple of PlaceScore
        Every labelled place, in the order of the map.
    runs : tuple of Tally
        One a run.
    found : ndarray of bool, shape (runs, places)
        Which run found which place.
    """

    radius_m: float
    places: tuple[PlaceScore, ...]
    runs: tuple[Tally, ...]
    found: NDArray[np.bool_]

    @property
    def pooled(self) -> Tally:
        """All runs together."""
        return pooled(self.runs)

    @property
    def consistency(self) -> float:
        """Mean pairwise agreement of the runs about which designated places were found."""
        return consistency(self.found[:, [place.designated for place in self.places]])


def score_runs(
    drives: Sequence[Drive],
    locations: Sequence[Location],
    radius_m: float,
    generator: np.random.Generator,
    draws: int = DRAWS,
) -> Scores:
    """Score runs against labelled places.

    Doorways are the designated places, which should be found; a mark at a labelled place of
    another kind is no error, but finds none of them. Marks are matched to the doorways and to the
    other places apart, so that a junction labelled beside a doorway does not take its mark.

    Parameters
    ----------
    drives : sequence of Drive
        The runs.
    locations : sequence of Location
        The places, in the frame of the marks.
    radius_m : float
        A mark finds a place at most this far away.
    generator : numpy.random.Generator
        Source of the marks at random.
    draws : int
        How often they are drawn for each run.
    """
    places = points([(place.x_m, place.y_m) for place in locations])
    designated = np.array([place.kind == DESIGNATED for place in locations], bool)

    def found_by(marks: NDArray[np.float64]) -> NDArray[np.bool_]:
        found = np.zeros(len(places), bool)
        for group in (designated, ~designated):
            found[group] = match(marks, places[group], radius_m) != NONE
        return found

    found = np.zeros((len(drives), len(places)), bool)
    chance = np.zeros((len(drives), len(places)))
    clock = np.zeros((len(drives), len(places)))
    tallies = []
    for i, drive in enumerate(drives):
        found[i] = found_by(drive.marks)
        chance[i] = mean_by_chance(drive.path, len(drive.marks), found_by, generator, draws)
        clock[i] = mean_by_chance(
            drive.path, len(drive.marks), found_by, generator, draws, clock_marks
        )
        merged = merge(drive.marks, radius_m)
        at_found = _marks_nearest(drive.marks, places[designated], radius_m)[found[i][designated]]
        tallies.append(
            Tally(
                runs=1,
                marks=len(drive.marks),
                merged=len(merged),
                right=int((match(merged, places, radius_m) != NONE).sum()),
                designated=int(designated.sum()),
                found=int(found[i][designated].sum()),
                repeats=int(np.maximum(at_found - 1, 0).sum()),
                expected=float(chance[i][designated].sum()),
                by_clock=float(clock[i][designated].sum()),
                length_m=drive.length_m,
            )
        )
    none = np.full(len(places), np.nan)
    by_place = chance.mean(axis=0) if len(drives) else none
    by_clock = clock.mean(axis=0) if len(drives) else none
    scored = tuple(
        PlaceScore(
            location, len(drives), int(found[:, j].sum()), float(by_place[j]), float(by_clock[j])
        )
        for j, location in enumerate(locations)
    )
    return Scores(radius_m, scored, tuple(tallies), found)


def _marks_nearest(
    marks: NDArray[np.float64], places: NDArray[np.float64], radius_m: float
) -> NDArray[np.int64]:
    """Count for each place the marks within the radius that lie nearer to it than to another."""
    if len(marks) == 0 or len(places) == 0:
        return np.zeros(len(places), np.int64)
    distances = cdist(marks, places)
    nearest = distances.argmin(axis=1)[distances.min(axis=1) <= radius_m]
    return np.bincount(nearest, minlength=len(places)).astype(np.int64)
