"""One slot of many chunks, stored so that a request is compared with all at once."""

from __future__ import annotations

import operator
from collections.abc import Callable, Iterable, Mapping
from typing import Any, NamedTuple, Protocol, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ssrics_like.memory.chunks import Value
from ssrics_like.memory.growing import GrowingArray

ABSENT = -1
ORDERS: Mapping[str, Callable[[Any, Any], Any]] = {
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
}


class SimilarityScale(NamedTuple):
    """Similarity of equal values, and of values about which nothing is known."""

    equal: float
    different: float


class SlotColumn(Protocol):
    """The values of one slot, one row a chunk."""

    def check(self, value: Value) -> None:
        """Raise ValueError or TypeError if the slot cannot hold this value."""

    def append(self, value: Value | None) -> None:
        """Add the value of the next chunk; None if it lacks the slot."""

    def replace(self, row: int, value: Value) -> None:
        """Change one value, where the column allows it."""

    @property
    def present(self) -> NDArray[np.bool_]:
        """Which chunks have the slot, shape (n,)."""

    def equals(self, requested: Value) -> NDArray[np.bool_]:
        """Which chunks have exactly this value, shape (n,)."""

    def ordered(self, order: str, bound: Value) -> NDArray[np.bool_]:
        """Which chunks have a number so ordered to `bound`, shape (n,)."""

    def similarity(self, requested: Value) -> NDArray[np.float64]:
        """Similarity of each value to the requested one, shape (n,)."""

    def fully_similar(self, requested: Value) -> NDArray[np.bool_]:
        """Which values count as equal to the requested one under partial matching."""


Exceptions: TypeAlias = Callable[[Value, Mapping[Value, int]], Iterable[tuple[int, float]]]
"""From a requested value and the codes of the column's values: codes and similarities."""


class CodedColumn:
    """Values that are equal or not: symbols and numbers, kept as integer codes.

    Parameters
    ----------
    slot : str
        Its name, for messages.
    scale : SimilarityScale
        Similarity of an equal and of any other value.
    exceptions : callable, optional
        Names the values whose similarity to a requested one is something else.
    """

    def __init__(
        self, slot: str, scale: SimilarityScale, exceptions: Exceptions | None = None
    ) -> None:
        self.slot = slot
        self._scale = scale
        self._exceptions = exceptions
        self._codes = GrowingArray(np.int32)
        self._code_of: dict[Value, int] = {}

    def check(self, value: Value) -> None:
        """Accept any value that can be hashed."""
        hash(value)

    def append(self, value: Value | None) -> None:
        """Add the value of the next chunk; None if it lacks the slot."""
        code = ABSENT if value is None else self._code_of.setdefault(value, len(self._code_of))
        self._codes.append(code)

    def replace(self, row: int, value: Value) -> None:
        """Refuse: what a chunk is called by does not change.

        Raises
        ------
        ValueError
            Always.
        """
        raise ValueError(
            f"slot '{self.slot}' of chunk {row} cannot become {value!r}: only a slot with a "
            "continuous similarity (view, place) can be replaced"
        )

    @property
    def present(self) -> NDArray[np.bool_]:
        """Which chunks have the slot, shape (n,)."""
        return np.asarray(self._codes.used != ABSENT)

    def equals(self, requested: Value) -> NDArray[np.bool_]:
        """Which chunks have exactly this value, shape (n,)."""
        code = self._code_of.get(requested)
        if code is None:
            return np.zeros(len(self._codes), np.bool_)
        return np.asarray(self._codes.used == code)

    def ordered(self, order: str, bound: Value) -> NDArray[np.bool_]:
        """Which chunks have a number so ordered to `bound`, shape (n,).

        Raises
        ------
        TypeError
            If `bound` is not a number.
        """
        if not isinstance(bound, int | float):
            raise TypeError(f"slot '{self.slot}': {order} needs a number, got {bound!r}")
        holds = np.zeros(len(self._code_of) + 1, np.bool_)  # the last stands for ABSENT
        for value, code in self._code_of.items():
            holds[code] = isinstance(value, int | float) and ORDERS[order](value, bound)
        return holds[self._codes.used]

    def similarity(self, requested: Value) -> NDArray[np.float64]:
        """Similarity of each value to the requested one, shape (n,)."""
        table = np.full(len(self._code_of) + 1, self._scale.different)
        if (code := self._code_of.get(requested)) is not None:
            table[code] = self._scale.equal
        if self._exceptions is not None:
            for other, similarity in self._exceptions(requested, self._code_of):
                table[other] = similarity
        return table[self._codes.used]

    def fully_similar(self, requested: Value) -> NDArray[np.bool_]:
        """Which values have the similarity of equal ones, as ACT-R asks of a negation."""
        return np.asarray((self.similarity(requested) == self._scale.equal) & self.present)
