"""A figure with its interval, and what is worked out from."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ssrics_like.comparison.way import Way
from ssrics_like.people.consensus import consensus_of, consensus_of_others
from ssrics_like.people.hits import Hits, hits, paired_hits
from ssrics_like.people.markers import Marker
from ssrics_like.people.resampling import UNKNOWN, Interval, Weights


@dataclass(frozen=True, slots=True)
class Figure:
    """A value with its interval; NaN for what cannot be said."""

    value: float = math.nan
    interval: Interval = UNKNOWN


@dataclass(frozen=True, eq=False)
class Model:
    """The runs of one results folder.

    Attributes
    ----------
    name : str
        What the model is called.
    runs : tuple of Marker
        What each run marked.
    ways : tuple of Way
        The way of each run.
    """

    name: str
    runs: tuple[Marker, ...]
    ways: tuple[Way, ...]


@dataclass(frozen=True, eq=False)
class DrawnRuns:
    """The runs of a model, and how often each counts when they are drawn anew.

    Attributes
    ----------
    marked : ndarray of bool, shape (runs, units)
        Which run marked which unit.
    weights : ndarray, shape (draws, runs)
        How often each counts in each draw.
    """

    marked: NDArray[np.bool_]
    weights: Weights

    def __len__(self) -> int:
        return len(self.marked)


@dataclass(frozen=True, eq=False)
class Crowd:
    """The people of a comparison, and how often each counts when they are drawn anew.

    Attributes
    ----------
    marked : ndarray of bool, shape (people, units)
        Who marked which unit.
    weights : ndarray, shape (draws, people)
        How often each counts in each draw.
    consensus : ndarray of bool, shape (units,)
        What at least half of them marked.
    others : ndarray of bool, shape (people, units)
        For each person, what at least half of all the others marked.
    drawn_consensus : ndarray of bool, shape (draws, units)
        The consensus of each draw.
    """

    marked: NDArray[np.bool_]
    weights: Weights
    consensus: NDArray[np.bool_]
    others: NDArray[np.bool_]
    drawn_consensus: NDArray[np.bool_]

    @classmethod
    def of(cls, marked: NDArray[np.bool_], weights: Weights) -> Crowd:
        """Work out the consensus of people, all together and in each draw."""
        return cls(
            marked,
            weights,
            consensus_of(marked)[0],
            consensus_of_others(marked),
            consensus_of(marked, weights),
        )

    @property
    def against_others(self) -> Hits:
        """How each person meets the consensus of the others, shape (people,)."""
        return paired_hits(self.marked[:, self._judged], self.others[:, self._judged])

    def meet_others(self, marked: NDArray[np.bool_]) -> Hits:
        """Return how each of some sets of marks meets the others of each person.

        Parameters
        ----------
        marked : ndarray of bool, shape (sets, units)
            Which set has which unit.

        Returns
        -------
        Hits
            Arrays of shape (people, sets).
        """
        return hits(marked[:, self._judged], self.others[:, self._judged])

    @property
    def _judged(self) -> slice:
        """The units that others can tell of: of a single person there are no others, and none."""
        return slice(None) if len(self) > 1 else slice(0)

    def __len__(self) -> int:
        return len(self.marked)
