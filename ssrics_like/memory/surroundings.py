"""How alike the surroundings of two places are, whichever way one went through them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.memory.chunks import View
from ssrics_like.memory.columns import SimilarityScale, SlotColumn
from ssrics_like.memory.continuous import ViewColumn

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ssrics_like.memory.chunks import Value

UNKNOWN_M = 1.0
"""A direction of which more is unknown is not compared."""
SAME_M, SAME = 0.3, 0.12
"""Two lengths agree if they differ by less than the former, or than this share of the longer."""
ASIDE = 1
"""Directions by which one view may be turned: a doorway's own is known to some ten degrees only."""
FEWEST = 10
"""Fewer directions to compare say nothing."""
STRANGE, KNOWN = 0.4, 0.75
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
    """Surroundings of many places: lengths in directions all around, then what of them is unknown.

    Two agree as far as the directions do of which both are known, one of them turned by up to ten
    degrees, or by those and half a turn.
    """

    def _row(self, view: View) -> NDArray[np.float32]:
        return view.descriptor

    def similarity(self, requested: Value) -> NDArray[np.float64]:
        """``different + (equal - different) * u`` for each place, shape (n,).

        u is 0 where 40 % of the directions agree or fewer, 1 where 75 % do or more, and 0.5 where
        too few can be compared.
        """
        self.check(requested)
        assert isinstance(requested, View)
        if self._rows is None:
            return np.full(len(self._views), self._scale.different)
        agreeing = agreement(requested.descriptor, self._rows.used)
        u = np.clip((agreeing - STRANGE) / (KNOWN - STRANGE), 0.0, 1.0)
        u[np.isnan(agreeing)] = NEITHER
        return np.asarray(self._scale.different + (self._scale.equal - self._scale.different) * u)


def agreement(view: NDArray[np.float32], places: NDArray[np.float32]) -> NDArray[np.float64]:
    """Return the share of directions in which surroundings agree; NaN where too few are known.

    Parameters
    ----------
    view : ndarray, shape (2 directions,)
        Of one place.
    places : ndarray, shape (n, 2 directions)
        Of others.

    Returns
    -------
    ndarray, shape (n,), float64
        The best of all turns.
    """
    directions = len(view) // 2
    lengths, known = places[:, :directions], places[:, directions:] < UNKNOWN_M
    # What agrees with each length: from so short to so long.
    short = lengths - np.maximum(SAME_M, SAME * lengths)
    long = np.maximum(lengths + SAME_M, lengths / (1.0 - SAME))
    best = np.full(len(places), -1.0)
    for half in (0, directions // 2):
        for aside in range(-ASIDE, ASIDE + 1):
            length = np.roll(view[:directions], half + aside)
            seen = np.flatnonzero(np.roll(view[directions:], half + aside) < UNKNOWN_M)
            both = known[:, seen]
            agree = both & (length[seen] > short[:, seen]) & (length[seen] < long[:, seen])
            compared = np.count_nonzero(both, axis=1)
            share = np.count_nonzero(agree, axis=1) / np.maximum(compared, 1)
            np.maximum(best, np.where(compared >= FEWEST, share, -1.0), out=best)
    return np.where(best < 0.0, np.nan, best)
