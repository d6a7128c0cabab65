"""What is counted of one run or of several together, and the figures that follow."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, fields

from ssrics_like.comparison.proportions import chance_corrected, harmonic_mean, share, wilson


@dataclass(frozen=True, slots=True)
class Tally:
    """Counts; they add up over runs. Every figure is NaN where it has no meaning.

    Attributes
    ----------
    runs : int
        How many runs.
    marks : int
        Declared and recognised reflexes.
    merged : int
        Groups of marks, those of one place taken together.
    right : int
        Groups that lie at a labelled place of any kind.
    designated : int
        Places that should be found, each counted once a run.
    found : int
        Of these, how many were.
    repeats : int
        Marks at places that were found, but for the one that found it.
    expected : float
        How many designated places as many marks at random would have found.
    by_clock : float
        How many designated places as many marks by a clock would have found.
    length_m : float
        Metres driven.
    """

    runs: int
    marks: int
    merged: int
    right: int
    designated: int
    found: int
    repeats: int
    expected: float
    by_clock: float
    length_m: float

    @property
    def recall(self) -> float:
        """Share of the designated places that were found."""
        return share(self.found, self.designated)

    @property
    def interval(self) -> tuple[float, float]:
        """Wilson 95 % interval of recall."""
        return wilson(self.found, self.designated)

    @property
    def chance(self) -> float:
        """Recall of as many marks at random along the path."""
        return share(self.expected, self.designated)

    @property
    def clock(self) -> float:
        """Recall of as many marks at equal intervals of time."""
        return share(self.by_clock, self.designated)

    @property
    def corrected_recall(self) -> float:
        """Recall above chance, over what there is above chance."""
        return chance_corrected(self.recall, self.chance)

    @property
    def precision(self) -> float:
        """Share of the merged marks that lie at a labelled place."""
        return share(self.right, self.merged)

    @property
    def f(self) -> float:
        """Harmonic mean of recall and precision."""
        return harmonic_mean(self.recall, self.precision)

    @property
    def marks_per_100_m(self) -> float:
        """Marks, repetitions included, per 100 m driven."""
        return share(100.0 * self.marks, self.length_m)

    @property
    def duplicates(self) -> float:
        """Repeated marks per place found."""
        return share(self.repeats, self.found)

    def figures(self) -> dict[str, float]:
        """Return every figure by its name."""
        low, high = self.interval
        return {
            "recall": self.recall,
            "low": low,
            "high": high,
            "chance": self.chance,
            "clock": self.clock,
            "corrected_recall": self.corrected_recall,
            "precision": self.precision,
            "f": self.f,
            "marks_per_100_m": self.marks_per_100_m,
            "duplicates": self.duplicates,
        }


def pooled(tallies: Iterable[Tally]) -> Tally:
    """Add tallies up: every run's places and marks count alike."""
    every = list(tallies)
    sums = {field.name: sum(getattr(one, field.name) for one in every) for field in fields(Tally)}
    return Tally(**sums) if every else Tally(0, 0, 0, 0, 0, 0, 0, math.nan, math.nan, 0.0)
