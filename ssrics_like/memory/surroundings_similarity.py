"""Surroundings as a slot of declarative memory: how similar they are, from either side."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.memory.chunks import View
from ssrics_like.memory.columns import SimilarityScale, SlotColumn
from ssrics_like.memory.continuous import ViewColumn
from ssrics_like.memory.sides import Side, Sides
from ssrics_like.memory.surroundings import (
    ALIKE,
    STRANGE,
    BothSides,
    Places,
    both_sides,
    by_direction,
)

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ssrics_like.memory.chunks import Value

KNOWN = 0.72
"""Share of directions that agree from which on a place is as similar as can be: more says little.
Chosen on simulated drives through furnished plans."""
NEITHER = 0.5
"""As similar a place is, of all between different and the same, of which too little is known."""
MISTAKEN = 0.01
"""Share of places of which the wrong side is taken for the one that they are seen from."""


class SurroundingsSimilarity:
    """Similarity of the surroundings of two places, from either side.

    Parameters
    ----------
    difference : float
        Similarity where no more directions agree than by chance.
    vista_difference : float
        By how much it is less where what is seen in the distance contradicts.
    equal : float
        Similarity where as many directions agree as in one place met twice.
    """

    def __init__(self, difference: float, vista_difference: float, equal: float = 0.0) -> None:
        self._difference = difference
        self._vista_difference = vista_difference
        self._equal = equal

    def column(self, slot: str, scale: SimilarityScale) -> SlotColumn:
        """Make an empty column for the slot of that name."""
        own = SurroundingsSimilarity(self._difference, self._vista_difference, scale.equal)
        return SurroundingsColumn(slot, scale._replace(different=self._difference), own)

    def of(self, sides: BothSides) -> NDArray[np.float64]:
        """``different + (equal - different) * u + vista_difference * v``, for each side.

        u is 0 where half of the directions agree or fewer, 1 where 72 % do or more. v is what
        `vistas.contradiction` says.

        Returns
        -------
        ndarray, shape (2, n)
            NaN where too little can be compared.
        """
        u = np.clip((sides.agreeing - STRANGE) / (KNOWN - STRANGE), 0.0, 1.0)
        return self._between(u) + self._vista_difference * sides.apart

    @property
    def neither(self) -> float:
        """Similarity where too little can be compared."""
        return float(self._between(np.array(NEITHER)))

    def _between(self, u: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.asarray(self._difference + (self._equal - self._difference) * u)

    def sides(self, view: NDArray[np.float32], places: NDArray[np.float32]) -> list[Sides]:
        """Tell from which side each place would be seen, and how turned, if it is that place.

        Parameters
        ----------
        view : ndarray, shape (3 directions,)
            What is seen.
        places : ndarray, shape (n, 3 directions)
            What is remembered.
        """
        both = both_sides(view, by_direction(places), exact=False)
        similarity = self.of(both)
        similarity[np.isnan(similarity)] = self.neither
        less = similarity - similarity.max(axis=0)
        nats = np.log(MISTAKEN + (1.0 - MISTAKEN) * np.exp(less))
        known = both.agreeing >= ALIKE
        ahead, behind = (
            [Side(n, turn if told else None) for n, turn, told in zip(*of, strict=True)]
            for of in zip(nats.tolist(), both.turned_rad.tolist(), known.tolist(), strict=True)
        )
        return list(map(Sides, ahead, behind))


class SurroundingsColumn(ViewColumn):
    """Surroundings of many places: lengths all around, what is unknown of them, and vistas.

    Parameters
    ----------
    slot, scale : as for `ViewColumn`
    compared : SurroundingsSimilarity
        How similar two are.
    """

    def __init__(self, slot: str, scale: SimilarityScale, compared: SurroundingsSimilarity) -> None:
        super().__init__(slot, scale)
        self._compared = compared
        self._ready: Places | None = None
        self._row_of: dict[str, int] = {}

    def append(self, value: Value | None) -> None:
        """Add the view of the next chunk; None if it lacks the slot."""
        if isinstance(value, View):
            self._row_of[value.name] = len(self._views)
        super().append(value)

    def replace(self, row: int, value: Value) -> None:
        """Store another view for a chunk that has one."""
        super().replace(row, value)
        if isinstance(value, View):
            self._row_of[value.name] = row
        if self._rows is not None and self._ready is not None and row < len(self._ready.lengths):
            self._ready.replace(row, by_direction(self._rows.used[row : row + 1]))

    def _row(self, view: View) -> NDArray[np.float32]:
        return view.descriptor

    def similarity(self, requested: Value) -> NDArray[np.float64]:
        """Similarity of each view to the requested one, from the side that suits best, shape (n,).

        Where something is seen now where a view was taken, that counts if it is more similar: the
        place is perceived astray then.
        """
        self.check(requested)
        assert isinstance(requested, View)
        if self._rows is None:
            return np.full(len(self._views), self._scale.different)
        similarity = self._best(requested.descriptor, self._made_ready(self._rows.used))
        for name, seen in requested.there.items():
            if (row := self._row_of.get(name)) is not None:
                again = self._best(seen, by_direction(self._rows.used[row : row + 1]))
                similarity[row] = np.fmax(similarity[row], again[0])
        similarity[np.isnan(similarity)] = self._compared.neither
        return similarity

    def _made_ready(self, rows: NDArray[np.float32]) -> Places:
        """Return all views, ready to be compared; those that came first are ready already."""
        ready = self._ready
        if ready is None:
            self._ready = ready = by_direction(rows)
        elif len(ready.lengths) < len(rows):
            self._ready = ready = ready.and_these(by_direction(rows[len(ready.lengths) :]))
        return ready

    def _best(self, view: NDArray[np.float32], places: Places) -> NDArray[np.float64]:
        return np.asarray(np.fmax(*self._compared.of(both_sides(view, places, exact=False))))
