"""How alike a slot's values are: by table, by function, by list, by view.

A `SlotSimilarity` describes; the column that it makes stores the slot's values and
compares. So one description serves several memories and several chunk types.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from ssrics_like.memory.chunks import Value
from ssrics_like.memory.columns import CodedColumn, SimilarityScale, SlotColumn
from ssrics_like.memory.continuous import ViewColumn


class SlotSimilarity(Protocol):
    """How to store and compare the values of one slot."""

    def column(self, slot: str, scale: SimilarityScale) -> SlotColumn:
        """Make an empty column for the slot of that name."""


class TableSimilarity:
    """Similarities set for pairs of values (ACT-R's set-similarities).

    Parameters
    ----------
    pairs : mapping of (Value, Value) to float, optional
        Similarity of two values, in either order. A pair of a value with itself
        overrides the similarity of equal values. All other pairs are equal
        (max_similarity) or different (max_difference).
    """

    def __init__(self, pairs: Mapping[tuple[Value, Value], float] | None = None) -> None:
        self._partners: dict[Value, dict[Value, float]] = {}
        for (one, other), similarity in (pairs or {}).items():
            self._partners.setdefault(one, {})[other] = similarity
            self._partners.setdefault(other, {})[one] = similarity

    def column(self, slot: str, scale: SimilarityScale) -> SlotColumn:
        """Make an empty column for the slot of that name."""
        return CodedColumn(slot, scale, self._exceptions if self._partners else None)

    def _exceptions(
        self, requested: Value, codes: Mapping[Value, int]
    ) -> Iterator[tuple[int, float]]:
        for other, similarity in self._partners.get(requested, {}).items():
            if other in codes:
                yield codes[other], similarity


class FunctionSimilarity:
    """Similarity computed by a function (ACT-R's :sim-hook).

    Parameters
    ----------
    function : callable
        From the requested value and a chunk's value to a similarity; None where it has
        no answer, and equality decides. Called once for each distinct value in memory
        at each retrieval; need not be symmetric.
    """

    def __init__(self, function: Callable[[Value, Value], float | None]) -> None:
        self._function = function

    def column(self, slot: str, scale: SimilarityScale) -> SlotColumn:
        """Make an empty column for the slot of that name."""
        return CodedColumn(slot, scale, self._exceptions)

    def _exceptions(
        self, requested: Value, codes: Mapping[Value, int]
    ) -> Iterator[tuple[int, float]]:
        for value, code in codes.items():
            similarity = self._function(requested, value)
            if similarity is not None:
                yield code, similarity


class ViewSimilarity:
    """Similarity of views: Pearson's r of their descriptors, no less than 0.

    r is what the novelty algorithm compares scans by (report, section 2.1), so memory
    and perception agree on what looks alike; it ignores an offset and a scale of the
    ranges. Below 0 it carries no more news: two unrelated views correlate at about 0,
    and a view is no less a match for being the reverse of another.

    Parameters
    ----------
    difference : float, optional
        Similarity at r = 0 and below; the memory's max_difference if left out.
    """

    def __init__(self, difference: float | None = None) -> None:
        self._difference = difference

    def column(self, slot: str, scale: SimilarityScale) -> SlotColumn:
        """Make an empty column for the slot of that name."""
        if self._difference is not None:
            scale = scale._replace(different=self._difference)
        return ViewColumn(slot, scale)


class Listed(NamedTuple):
    """Similarities to one value.

    Attributes
    ----------
    similarities : mapping
        Of a few values.
    otherwise : float
        Of every other.
    """

    similarities: Mapping[Value, float]
    otherwise: float


class ListedSimilarity:
    """Similarities that are reckoned anew for each request, of a few values of many.

    Parameters
    ----------
    listed : callable
        From the requested value to the similarities of all others.
    """

    def __init__(self, listed: Callable[[Value], Listed]) -> None:
        self._listed = listed

    def column(self, slot: str, scale: SimilarityScale) -> SlotColumn:
        """Make an empty column for the slot of that name."""
        return ListedColumn(slot, scale, self._listed)


class ListedColumn(CodedColumn):
    """Values of which a few are listed for each request."""

    def __init__(
        self, slot: str, scale: SimilarityScale, listed: Callable[[Value], Listed]
    ) -> None:
        super().__init__(slot, scale)
        self._listed = listed

    def similarity(self, requested: Value) -> NDArray[np.float64]:
        """Similarity of each value to the requested one, shape (n,)."""
        similarities, otherwise = self._listed(requested)
        table = np.full(len(self._code_of) + 1, otherwise)
        for value, similarity in {requested: self._scale.equal, **similarities}.items():
            if (code := self._code_of.get(value)) is not None:
                table[code] = similarity
        return np.asarray(table[self._codes.used])
