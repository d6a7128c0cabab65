"""What is counted of one run or of several together, and the figures that follow."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, fields
from typing import Any

from ssrics_like.comparison.proportions import chance_corrected, harmonic_mean, share, wilson


@dataclass(frozen=True, slots=True)
class Blind:
    """What as many marks that know nothing would have reached: means over draws.

    Attributes
    ----------
    found : float
        Designated places found.
    passed : float
        Passages found.
    merged : float
        Groups of marks.
    right : float
        Groups that lie at a labelled place of any kind.
    """

    found: float = math.nan
    passed: float = math.nan
    merged: float = math.nan
    right: float = math.nan

    @property
    def precision(self) -> float:
        """Share of the merged marks that lie at a labelled place."""
        return share(self.right, self.merged)


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
    passages : int
        Passages through designated places; 0 where none is known.
    passed : int
        Of these, how many were found.
    length_m : float
        Metres driven.
    timed : int
        Marks of which it is known where the robot was when it decided.
    delays_m : float
        Metres driven between perceiving and deciding, the sum over these marks.
    at_random : Blind
        What as many marks at random would have reached.
    by_clock : Blind
        What as many marks at equal intervals of time would have reached.
    """

    runs: int = 0
    marks: int = 0
    merged: int = 0
    right: int = 0
    designated: int = 0
    found: int = 0
    repeats: int = 0
    passages: int = 0
    passed: int = 0
    length_m: float = 0.0
    timed: int = 0
    delays_m: float = 0.0
    at_random: Blind = Blind()
    by_clock: Blind = Blind()

    @property
    def recall(self) -> float:
        """Share of the designated places that were found: place recall."""
        return share(self.found, self.designated)

    @property
    def interval(self) -> tuple[float, float]:
        """Wilson 95 % interval of place recall."""
        return wilson(self.found, self.designated)

    @property
    def chance(self) -> float:
        """Place recall of as many marks at random along the path."""
        return share(self.at_random.found, self.designated)

    @property
    def clock(self) -> float:
        """Place recall of as many marks at equal intervals of time."""
        return share(self.by_clock.found, self.designated)

    @property
    def corrected_recall(self) -> float:
        """Place recall above chance, over what there is above chance."""
        return chance_corrected(self.recall, self.chance)

    @property
    def pass_recall(self) -> float:
        """Share of the passages with a mark near by on the path."""
        return share(self.passed, self.passages)

    @property
    def pass_interval(self) -> tuple[float, float]:
        """Wilson 95 % interval of pass recall."""
        return wilson(self.passed, self.passages)

    @property
    def pass_chance(self) -> float:
        """Pass recall of as many marks at random along the path."""
        return share(self.at_random.passed, self.passages)

    @property
    def pass_clock(self) -> float:
        """Pass recall of as many marks at equal intervals of time."""
        return share(self.by_clock.passed, self.passages)

    @property
    def corrected_pass_recall(self) -> float:
        """Pass recall above chance, over what there is above chance."""
        return chance_corrected(self.pass_recall, self.pass_chance)

    @property
    def precision(self) -> float:
        """Share of the merged marks that lie at a labelled place."""
        return share(self.right, self.merged)

    @property
    def f(self) -> float:
        """Harmonic mean of pass recall and precision."""
        return harmonic_mean(self.pass_recall, self.precision)

    @property
    def f_place(self) -> float:
        """Harmonic mean of place recall and precision."""
        return harmonic_mean(self.recall, self.precision)

    @property
    def marks_per_100_m(self) -> float:
        """Marks, repetitions included, per 100 m driven."""
        return share(100.0 * self.marks, self.length_m)

    @property
    def duplicates(self) -> float:
        """Repeated marks per place found."""
        return share(self.repeats, self.found)

    @property
    def delay_m(self) -> float:
        """Metres driven between perceiving and deciding, the mean over marks."""
        return share(self.delays_m, self.timed)

    def figures(self) -> dict[str, float]:
        """Return every figure by its name."""
        low, high = self.interval
        pass_low, pass_high = self.pass_interval
        by_chance, by_clock = self.at_random.precision, self.by_clock.precision
        return {
            "recall": self.recall,
            "low": low,
            "high": high,
            "chance": self.chance,
            "clock": self.clock,
            "corrected_recall": self.corrected_recall,
            "pass_recall": self.pass_recall,
            "pass_low": pass_low,
            "pass_high": pass_high,
            "pass_chance": self.pass_chance,
            "pass_clock": self.pass_clock,
            "corrected_pass_recall": self.corrected_pass_recall,
            "precision": self.precision,
            "precision_chance": by_chance,
            "precision_clock": by_clock,
            "f": self.f,
            "f_chance": harmonic_mean(self.pass_chance, by_chance),
            "f_clock": harmonic_mean(self.pass_clock, by_clock),
            "f_place": self.f_place,
            "f_place_chance": harmonic_mean(self.chance, by_chance),
            "f_place_clock": harmonic_mean(self.clock, by_clock),
            "marks_per_100_m": self.marks_per_100_m,
            "duplicates": self.duplicates,
            "delay_m": self.delay_m,
        }


def pooled(tallies: Iterable[Tally]) -> Tally:
    """Add tallies up: every run's places, passages and marks count alike."""
    every = list(tallies)
    if not every:
        return Tally()
    sums: dict[str, Any] = {}
    for field in fields(Tally):
        values = [getattr(one, field.name) for one in every]
        sums[field.name] = _added(values) if isinstance(values[0], Blind) else sum(values)
    return Tally(**sums)


def _added(blind: list[Blind]) -> Blind:
    sums = {field.name: sum(getattr(one, field.name) for one in blind) for field in fields(Blind)}
    return Blind(**sums)
