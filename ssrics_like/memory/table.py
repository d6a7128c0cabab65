"""All chunks of one type, column by column."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from ssrics_like.memory.base_level import ReferenceLog
from ssrics_like.memory.chunks import Chunk, Request, SlotTest, Value
from ssrics_like.memory.columns import CodedColumn, SimilarityScale, SlotColumn
from ssrics_like.memory.growing import GrowingArray
from ssrics_like.memory.parameters import MemoryParameters
from ssrics_like.memory.similarity import SlotSimilarity, TableSimilarity

EQUAL_OR_DIFFERENT = TableSimilarity()


class ChunkTable:
    """Chunks of one type: names, references, and a column for each slot ever filled.

    Parameters
    ----------
    parameters : MemoryParameters
        How base levels and similarities are reckoned.
    similarities : mapping of str to SlotSimilarity
        By slot; the values of any other slot are equal or different.
    """

    def __init__(
        self, parameters: MemoryParameters, similarities: Mapping[str, SlotSimilarity]
    ) -> None:
        self._parameters = parameters
        self._scale = SimilarityScale(parameters.max_similarity, parameters.max_difference)
        self._similarities = similarities
        self._columns: dict[str, SlotColumn] = {}
        self.chunks: list[Chunk] = []
        self.names = GrowingArray(np.object_)
        self.positions = GrowingArray(np.int64)  # of each chunk in the whole memory
        self.references = ReferenceLog()

    def __len__(self) -> int:
        return len(self.chunks)

    def append(self, chunk: Chunk, t_s: float, position: int) -> int:
        """Add a chunk with its first reference; return its row.

        Raises
        ------
        ValueError
            If a value does not suit its slot; the table is unchanged then.
        """
        new = {slot: self._new_column(slot) for slot in chunk.slots if slot not in self._columns}
        for slot, value in chunk.slots.items():
            (new.get(slot) or self._columns[slot]).check(value)
        self._columns |= new
        for slot, column in self._columns.items():
            column.append(chunk.slots.get(slot))
        self.chunks.append(chunk)
        self.names.append(chunk.name)
        self.positions.append(position)
        return self.references.add_chunk(t_s)

    def _new_column(self, slot: str) -> SlotColumn:
        column = self._similarities.get(slot, EQUAL_OR_DIFFERENT).column(slot, self._scale)
        for _ in self.chunks:
            column.append(None)
        return column

    def replace(self, row: int, slot: str, value: Value) -> None:
        """Change the value of a continuous slot that the chunk has.

        Raises
        ------
        ValueError
            If the chunk lacks the slot, or the slot's values are symbols or numbers.
        """
        chunk = self.chunks[row]
        if slot not in chunk.slots:
            raise ValueError(f"chunk '{chunk.name}' has no slot '{slot}' to replace")
        self._columns[slot].replace(row, value)
        self.chunks[row] = Chunk(chunk.name, chunk.type, {**chunk.slots, slot: value})

    def base_levels(
        self, t_s: float, wanted: NDArray[np.bool_] | None = None
    ) -> NDArray[np.float64]:
        """Return each chunk's base level; -inf for one not wanted or not yet there."""
        parameters = self._parameters
        return self.references.base_levels(
            t_s,
            decay=parameters.decay if parameters.subsymbolic else None,
            optimized=parameters.optimized_learning,
            constant=parameters.base_level_constant if parameters.subsymbolic else 0.0,
            wanted=wanted,
        )

    def fits(self, request: Request, *, partial: bool) -> NDArray[np.bool_]:
        """Which chunks are candidates, shape (n,).

        With partial matching the tests for equal and not equal admit any value, but the
        first still wants the slot filled (ACT-R 7, start-retrieval).
        """
        fitting = np.ones(len(self), np.bool_)
        for test in request.slots:
            fitting &= self._passes(test, partial=partial)
        return fitting

    def _passes(self, test: SlotTest, *, partial: bool) -> NDArray[np.bool_] | bool:
        slot, value, modifier = test
        column = self._columns.get(slot)
        if value is None:
            filled = False if column is None else column.present
            return filled if modifier is True else np.logical_not(filled)
        if modifier is True:
            return True if partial or column is None else ~column.equals(value)
        if column is None:
            return False
        if modifier is False:
            return column.present if partial else column.equals(value)
        return column.ordered(modifier, value)

    def partial_match(self, request: Request) -> NDArray[np.float64]:
        """Sum the weighted similarities to what is requested, shape (n,).

        ``sum of P M_li`` over the slots asked to be equal, and ``P max_difference`` for
        each slot asked to differ whose value counts as equal.
        """
        total = np.zeros(len(self))
        penalty = self._parameters.mismatch_penalty
        if penalty is None:
            return total
        for slot, value, modifier in request.slots:
            column = self._columns.get(slot)
            if value is None or column is None:
                continue
            if modifier is False:
                total += penalty * column.similarity(value)
            elif modifier is True:
                total[column.fully_similar(value)] += penalty * self._scale.different
        return total

    def likeness(self, slot: str, value: Value, without: int | None) -> NDArray[np.float64]:
        """Weigh how alike a slot's values are to one, as partial matching does, 0 for equal ones.

        ``min(0, P (M_li - max_similarity))`` for each chunk that has the slot, but for the one in
        row `without`; P is 1 where there is no partial matching. Shape (m,).
        """
        column = self._columns.get(slot)
        if column is None:
            return np.empty(0)
        wanted = column.present.copy()
        if without is not None:
            wanted[without] = False
        penalty = self._parameters.mismatch_penalty
        weight = 1.0 if penalty is None else penalty
        weighed = weight * (column.similarity(value)[wanted] - self._scale.equal)
        return np.asarray(np.minimum(0.0, weighed))

    def occurrences(self, symbol: str) -> NDArray[np.float64]:
        """How often a symbol stands in each chunk's slots, once more for its namesake."""
        count = np.zeros(len(self))
        for column in self._columns.values():
            if isinstance(column, CodedColumn):
                count += column.equals(symbol)
        count += self.names.used == symbol
        return count
