"""How well the marks of some runs meet the labelled places of a building."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ssrics_like.comparison.agreement import consistency
from ssrics_like.comparison.batches import merged, passages_found, places_found
from ssrics_like.comparison.chance import DRAWS, clock_marks, random_marks
from ssrics_like.comparison.drive import Drive
from ssrics_like.comparison.matching import points
from ssrics_like.comparison.outcome import Outcome, outcome_of
from ssrics_like.comparison.proportions import share, wilson
from ssrics_like.comparison.tally import Blind, Tally, pooled
from ssrics_like.comparison.way import Way
from ssrics_like.world.locations import Location

DESIGNATED = "doorway"
"""The kind of place that people designated: "These locations, all doorways" (report, section 4)."""


@dataclass(frozen=True, slots=True)
class PlaceScore:
    """How often one place was found.

    Attributes
    ----------
    location : Location
        The place.
    designated : bool
        Whether it is one that should be found.
    runs, found : int
        How many runs there were, and in how many it was found.
    chance : float
        Share of runs in which as many marks at random would have found it.
    clock : float
        Share of runs in which as many marks by a clock would have found it.
    """

    location: Location
    designated: bool
    runs: int
    found: int
    chance: float
    clock: float

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
    outcomes : tuple of Outcome
        Which mark found what, one a run.
    """

    radius_m: float
    places: tuple[PlaceScore, ...]
    runs: tuple[Tally, ...]
    outcomes: tuple[Outcome, ...]

    @property
    def pooled(self) -> Tally:
        """All runs together."""
        return pooled(self.runs)

    @property
    def found(self) -> NDArray[np.bool_]:
        """Which run found which place, shape (runs, places)."""
        rows = [outcome.found for outcome in self.outcomes]
        return np.array(rows, bool).reshape(len(rows), len(self.places))

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
    designated: ArrayLike | None = None,
) -> Scores:
    """Score runs against labelled places.

    A mark at a labelled place that is not designated is no error, but finds none that is. Marks
    are matched to the designated places and to the others apart, so that a junction labelled
    beside a doorway does not take its mark.

    Parameters
    ----------
    drives : sequence of Drive
        The runs.
    locations : sequence of Location
        The places, in the frame of the marks.
    radius_m : float
        How far from a place, or along the path from a passage, a mark still finds it.
    generator : numpy.random.Generator
        Source of the marks that know nothing.
    draws : int
        How often they are drawn for each run.
    designated : array_like of bool, shape (locations,), optional
        Which places should be found; the doorways if left out.
    """
    places = points([(place.x_m, place.y_m) for place in locations])
    wanted = np.array(
        [p.kind == DESIGNATED for p in locations] if designated is None else designated, bool
    ).reshape(len(locations))
    outcomes, tallies = [], []
    chance, clock = np.zeros((2, len(drives), len(places)))
    for i, drive in enumerate(drives):
        outcome = outcome_of(drive, places, wanted, radius_m)
        blind = []
        for shares, placing in ((chance, random_marks), (clock, clock_marks)):
            if len(drive.way.xy_m) == 0:
                shares[i] = np.nan
                blind.append(Blind())
                continue
            along = placing(drive.way, len(drive.marks), generator, draws)
            shares[i], reached = _reached(drive.way, along, outcome, places, radius_m)
            blind.append(reached)
        outcomes.append(outcome)
        tallies.append(_tally(drive, outcome, *blind))
    none = np.full(len(places), np.nan)
    by_chance, by_clock = (table.mean(axis=0) if len(drives) else none for table in (chance, clock))
    found = sum((outcome.found.astype(int) for outcome in outcomes), np.zeros(len(places), int))
    scored = tuple(
        PlaceScore(
            location, bool(wanted[j]), len(drives), int(found[j]),
            float(by_chance[j]), float(by_clock[j]),
        )
        for j, location in enumerate(locations)
    )  # fmt: skip
    return Scores(radius_m, scored, tuple(tallies), tuple(outcomes))


def _reached(
    way: Way,
    along_m: NDArray[np.float64],
    outcome: Outcome,
    places: NDArray[np.float64],
    radius_m: float,
) -> tuple[NDArray[np.float64], Blind]:
    """Return how often marks on the way find each place, and what they reach on average.

    `along_m` holds the metres driven up to each mark, shape (draws, marks), rising.
    """
    marks = way.at(along_m)
    designated, passages = outcome.designated, outcome.passages
    shares = np.zeros(len(places))
    for kind in (designated, ~designated):
        shares[kind] = places_found(marks, places[kind], radius_m).mean(axis=0)
    passed = 0.0
    if passages is not None:
        passed = float(passages_found(along_m, passages.along_m, radius_m).mean())
    groups = merged(marks, radius_m)
    blind = Blind(
        found=float(shares[designated].sum()),
        passed=passed,
        merged=float(np.isfinite(groups[..., 0]).sum(axis=1).mean()),
        right=float(places_found(groups, places, radius_m).sum(axis=1).mean()),
    )
    return shares, blind


def _tally(drive: Drive, outcome: Outcome, at_random: Blind, by_clock: Blind) -> Tally:
    """Count what a run found."""
    delays = drive.marks.decided_m - drive.marks.along_m
    known = np.isfinite(delays)
    return Tally(
        runs=1,
        marks=len(drive.marks),
        merged=len(outcome.group_place),
        right=outcome.right,
        designated=int(outcome.designated.sum()),
        found=int(outcome.found[outcome.designated].sum()),
        repeats=outcome.repeats,
        passages=len(outcome.passed),
        passed=int(outcome.passed.sum()),
        length_m=drive.length_m,
        timed=int(known.sum()),
        delays_m=float(delays[known].sum()),
        at_random=at_random,
        by_clock=by_clock,
    )
