"""An array that grows at its end: appending costs O(1) on average."""

from __future__ import annotations

from typing import Any, Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

Scalar = TypeVar("Scalar", bound=np.generic)
FIRST_CAPACITY = 16


class GrowingArray(Generic[Scalar]):
    """Rows of one type in a block that doubles when it is full.

    Parameters
    ----------
    dtype : type
        Type of the elements.
    width : int, optional
        Length of a row; without it rows are scalars.
    """

    def __init__(self, dtype: type[Scalar], width: int | None = None) -> None:
        shape = (FIRST_CAPACITY,) if width is None else (FIRST_CAPACITY, width)
        self._block: NDArray[Scalar] = np.zeros(shape, dtype)
        self._length = 0

    def __len__(self) -> int:
        return self._length

    def append(self, row: Any) -> None:
        """Add one row at the end."""
        if self._length == len(self._block):
            block = np.zeros((2 * self._length, *self._block.shape[1:]), self._block.dtype)
            block[: self._length] = self._block
            self._block = block
        self._block[self._length] = row
        self._length += 1

    @property
    def used(self) -> NDArray[Scalar]:
        """The rows appended so far; a view, so writing to it changes this array."""
        return self._block[: self._length]
