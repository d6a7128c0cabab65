"""How alike the surroundings of two places are, whichever way one went through them."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ssrics_like.memory.chunks import View
from ssrics_like.memory.columns import SimilarityScale, SlotColumn
from ssrics_like.memory.continuous import ViewColumn

if TYPE_CHECKING:
    from typing import Any

    from numpy.typing import NDArray

    from ssrics_like.memory.chunks import Value

UNKNOWN_M = 1.0
"""A direction of which more is unknown is not compared."""
SAME_M, SAME = 0.35, 0.12
"""Two lengths that differ by the former, or by this share of the longer, if that is more, nearly
agree: 0.7 of wholly. They wholly agree if they differ by 0.7 of that or less, by 1.7 not at all."""
NEARLY = 0.7
ASIDE = 2
"""Directions by which one view may be turned: a doorway's own is known to twenty degrees only."""
AHEAD_M = (-0.3, 0.0, 0.3)
"""How far from the middle one may be looked at: a doorway is deep."""
REACH_M = 6.0
"""Views end there."""
FEWEST = 10
"""Fewer directions to compare say nothing."""
STRANGE, KNOWN = 0.5, 0.8
"""Share of directions that agree in two places that are different, and in one met twice (medians of
pairs of doorways in simulated buildings, `benchmarks/bench_views.py`)."""
NEITHER = 0.5


class SurroundingsSimilarity:
    """Similarity of the surroundings of two places, from either side.

    Parameters
    ----------
    difference : float
        Similarity where no more directions agree than by chance.
    """

    def __init__(self, difference: float) -> None:
        self._difference = difference

    def column(self, slot: str, scale: SimilarityScale) -> SlotColumn:
        """Make an empty column for the slot of that name."""
        return SurroundingsColumn(slot, scale._replace(different=self._difference))


class SurroundingsColumn(ViewColumn):
    """Surroundings of many places: lengths all around, then what is unknown of them."""

    def __init__(self, slot: str, scale: SimilarityScale) -> None:
        super().__init__(slot, scale)
        self._turned: _Places | None = None
        self._row_of: dict[str, int] = {}

    def append(self, value: Value | None) -> None:
        """Add the view of the next chunk; None if it lacks the slot."""
        if isinstance(value, View):
            self._row_of[value.name] = len(self._views)
        super().append(value)
        self._turned = None

    def replace(self, row: int, value: Value) -> None:
        """Store another view for a chunk that has one."""
        super().replace(row, value)
        if isinstance(value, View):
            self._row_of[value.name] = row
        self._turned = None

    def _row(self, view: View) -> NDArray[np.float32]:
        return view.descriptor

    def similarity(self, requested: Value) -> NDArray[np.float64]:
        """``different + (equal - different) * u`` for each place, shape (n,).

        u is 0 where half of the directions agree or fewer, 1 where 80 % do or more, and 0.5 where
        too few can be compared. Where something is seen now where a view was taken, that counts if
        it agrees more: the place is perceived astray then.
        """
        self.check(requested)
        assert isinstance(requested, View)
        if self._rows is None:
            return np.full(len(self._views), self._scale.different)
        if self._turned is None:
            self._turned = _by_direction(self._rows.used)
        agreeing = _agreement(requested.descriptor, self._turned)
        for name, seen in requested.there.items():
            if (row := self._row_of.get(name)) is not None:
                again = agreement(seen, self._rows.used[row : row + 1])[0]
                agreeing[row] = np.fmax(agreeing[row], again)
        u = np.clip((agreeing - STRANGE) / (KNOWN - STRANGE), 0.0, 1.0)
        u[np.isnan(agreeing)] = NEITHER
        return np.asarray(self._scale.different + (self._scale.equal - self._scale.different) * u)


def agreement(view: NDArray[np.float32], places: NDArray[np.float32]) -> NDArray[np.float64]:
    """Return the share of directions in which surroundings agree; NaN where too few are known.

    One of them may be looked at from 0.3 m before or behind the middle, be turned by up to twenty
    degrees, and by half a turn. A direction agrees by 1 where two lengths are nearly the same, less
    where they differ more (`SAME_M`).

    Parameters
    ----------
    view : ndarray, shape (2 directions,)
        Of one place.
    places : ndarray, shape (n, 2 directions)
        Of others.

    Returns
    -------
    ndarray, shape (n,), float64
        The best of all ways of looking at it.
    """
    return _agreement(view, _by_direction(places))


class _Places(NamedTuple):
    """Surroundings of many places, by direction, shape (directions, places).

    Attributes
    ----------
    lengths : ndarray of float32
        Metres; infinite where unknown.
    per_m : ndarray of float32
        By how much a direction agrees less for each metre of difference.
    known : ndarray of float32
        1 for known, else 0.
    """

    lengths: NDArray[np.float32]
    per_m: NDArray[np.float32]
    known: NDArray[np.float32]


def _by_direction(places: NDArray[np.float32]) -> _Places:
    lengths, unknown = np.split(places.T, 2)
    known = unknown < UNKNOWN_M
    return _Places(
        np.ascontiguousarray(np.where(known, lengths, np.float32(np.inf))),
        np.ascontiguousarray(_per_m(lengths)),
        np.ascontiguousarray(known, np.float32),
    )


def _per_m(lengths: NDArray[np.floating[Any]]) -> NDArray[np.float32]:
    return np.asarray(1.0 / np.maximum(SAME_M, SAME * lengths), np.float32)


def _agreement(view: NDArray[np.float32], places: _Places) -> NDArray[np.float64]:
    # Compiled code is loaded only where it is needed.
    from ssrics_like.memory import surroundings_kernels  # noqa: PLC0415

    directions = len(places.lengths)
    lengths, seen = view[:directions].astype(np.float64), view[directions:] < UNKNOWN_M
    looked = np.empty((len(AHEAD_M), directions))
    for ahead_m, out in zip(AHEAD_M, looked, strict=True):
        surroundings_kernels.looked_at_from(lengths, ahead_m, REACH_M, out)
    turns = [half + aside for half in (0, directions // 2) for aside in range(-ASIDE, ASIDE + 1)]
    views = np.array([np.roll(looked, turn, axis=1) for turn in turns], np.float32)
    best = np.empty(places.lengths.shape[1])
    surroundings_kernels.best_agreements(
        views, _per_m(views), np.array([np.roll(seen, turn) for turn in turns]),
        *places, NEARLY, FEWEST, best,
    )  # fmt: skip
    return np.where(best < 0.0, np.nan, best)
