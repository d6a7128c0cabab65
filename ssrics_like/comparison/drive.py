"""One run as it is scored: the way, the marks on it, the passages through places."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ssrics_like.comparison.matching import points
from ssrics_like.comparison.way import Way


@dataclass(frozen=True, eq=False)
class Marks:
    """What a robot marked, in order of time.

    Attributes
    ----------
    xy_m : ndarray, shape (n, 2)
        Where the robot was when it perceived what it marked, metres.
    along_m : ndarray, shape (n,)
        Metres driven up to there; NaN where that is not known.
    decided_m : ndarray, shape (n,)
        Metres driven up to the decision to mark; NaN where that is not known.
    """

    xy_m: NDArray[np.float64]
    along_m: NDArray[np.float64]
    decided_m: NDArray[np.float64]

    def __post_init__(self) -> None:
        _check(len(self.xy_m), along_m=self.along_m, decided_m=self.decided_m)

    @classmethod
    def of(
        cls, xy_m: ArrayLike, along_m: ArrayLike | None = None, decided_m: ArrayLike | None = None
    ) -> Marks:
        """Return marks at places, shape (n, 2); what is left out is not known."""
        places = points(xy_m)
        unknown = np.full(len(places), np.nan)
        along = unknown if along_m is None else np.asarray(along_m, np.float64)
        decided = unknown if decided_m is None else np.asarray(decided_m, np.float64)
        return cls(places, along, decided)

    @classmethod
    def on(cls, way: Way, along_m: ArrayLike, decided_m: ArrayLike | None = None) -> Marks:
        """Return marks on a way, at metres driven, shape (n,)."""
        along = np.asarray(along_m, np.float64).reshape(-1)
        return cls.of(way.at(along), along, decided_m)

    def __len__(self) -> int:
        return len(self.xy_m)


@dataclass(frozen=True, eq=False)
class Passages:
    """The times that a robot went through places, such as doorways.

    Attributes
    ----------
    place : ndarray of int64, shape (k,)
        Index of the place that each passage leads through, among the places that are scored.
    along_m : ndarray, shape (k,)
        Metres driven up to it.
    """

    place: NDArray[np.int64]
    along_m: NDArray[np.float64]

    @classmethod
    def of(cls, place: ArrayLike = (), along_m: ArrayLike = ()) -> Passages:
        """Return passages, in order of the way."""
        places = np.asarray(place, np.int64).reshape(-1)
        along = np.asarray(along_m, np.float64)
        _check(len(places), along_m=along)
        order = np.argsort(along, kind="stable")
        return cls(places[order], along[order])

    def through(self, chosen: NDArray[np.bool_]) -> Passages:
        """Return those through chosen places, bool of shape (places,)."""
        kept = chosen[self.place]
        return Passages(self.place[kept], self.along_m[kept])

    def __len__(self) -> int:
        return len(self.along_m)


@dataclass(frozen=True, eq=False)
class Drive:
    """What is scored of one run.

    Attributes
    ----------
    way : Way
        Where the robot was.
    marks : Marks
        What it marked.
    passages : Passages or None
        The times it went through places; None where that is not known. Those through places
        that are not designated are passed over.
    driven_m : float or None
        Metres driven, where a better figure is known than the length of the way.
    """

    way: Way
    marks: Marks
    passages: Passages | None = None
    driven_m: float | None = None

    @property
    def length_m(self) -> float:
        """Metres driven."""
        return self.way.length_m if self.driven_m is None else self.driven_m


def _check(count: int, **columns: NDArray[np.float64]) -> None:
    """Complain of columns that do not have an entry for each mark or passage."""
    for name, column in columns.items():
        if column.shape != (count,):
            raise ValueError(f"{name} has shape {column.shape}, expected ({count},)")
