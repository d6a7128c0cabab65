"""Columns of continuous values: views as a matrix."""

from __future__ import annotations

from typing import NoReturn

import numpy as np
from numpy.typing import NDArray

from ssrics_like.memory.chunks import Value, View
from ssrics_like.memory.columns import SimilarityScale
from ssrics_like.memory.growing import GrowingArray


def _expect_view(slot: str, value: Value) -> View:
    if not isinstance(value, View):
        raise TypeError(f"slot '{slot}' takes a View, got {value!r}")
    return value


def _unordered(slot: str, order: str) -> NoReturn:
    raise TypeError(f"slot '{slot}': {order} needs numbers; views have no order")


def _level(view: View) -> float:
    """Return the value of a constant view, NaN for any other."""
    return np.nan if view.direction.any() else float(view.descriptor[0])


class ViewColumn:
    """Views of many chunks: a matrix of centred rows of length 1.

    Pearson's r of the requested view with every stored one is then one matrix-vector
    product. A constant view has no direction: it correlates 1 with a view of the same
    constant and 0 with any other, as the novelty algorithm defines it for scans.

    Parameters
    ----------
    slot : str
        Its name, for messages.
    scale : SimilarityScale
        Similarity at r = 1, and at r = 0 and below.
    """

    def __init__(self, slot: str, scale: SimilarityScale) -> None:
        self.slot = slot
        self._scale = scale
        self._views: list[View | None] = []
        self._present = GrowingArray(np.bool_)
        self._level = GrowingArray(np.float64)  # of a constant view, else NaN
        self._rows: GrowingArray[np.float32] | None = None  # made when the length is known

    def check(self, value: Value) -> None:
        """Raise TypeError unless it is a View, ValueError unless as long as the others."""
        view = _expect_view(self.slot, value)
        if self._rows is None:
            return
        length = self._rows.used.shape[1]
        if len(view.descriptor) != length:
            raise ValueError(
                f"slot '{self.slot}': view '{view.name}' has {len(view.descriptor)} numbers, "
                f"the others have {length}"
            )

    def append(self, value: Value | None) -> None:
        """Add the view of the next chunk; None if it lacks the slot."""
        view = None if value is None else _expect_view(self.slot, value)
        if self._rows is None and view is not None:
            self._rows = GrowingArray(np.float32, len(view.descriptor))
            for _ in self._views:
                self._rows.append(0.0)
        if self._rows is not None:
            self._rows.append(0.0 if view is None else self._row(view))
        self._views.append(view)
        self._present.append(view is not None)
        self._level.append(np.nan if view is None else _level(view))

    def replace(self, row: int, value: Value) -> None:
        """Store another view for a chunk that has one."""
        self.check(value)
        view = _expect_view(self.slot, value)
        if self._rows is None or self._views[row] is None:
            raise ValueError(f"slot '{self.slot}' of chunk {row} is empty: nothing to replace")
        self._views[row] = view
        self._level.used[row] = _level(view)
        self._rows.used[row] = self._row(view)

    def _row(self, view: View) -> NDArray[np.float32]:
        """Return what is kept of a view to compare it with others."""
        return view.direction

    @property
    def present(self) -> NDArray[np.bool_]:
        """Which chunks have the slot, shape (n,)."""
        return self._present.used

    def equals(self, requested: Value) -> NDArray[np.bool_]:
        """Which chunks have exactly this view, shape (n,)."""
        return np.fromiter((view == requested for view in self._views), np.bool_, len(self._views))

    def ordered(self, order: str, bound: Value) -> NDArray[np.bool_]:
        """Refuse: views have no order."""
        del bound
        _unordered(self.slot, order)

    def similarity(self, requested: Value) -> NDArray[np.float64]:
        """``different + (equal - different) * clip(r, 0, 1)`` for each view, shape (n,).

        Numbers are float32 inside; the error of r is below 1e-6.
        """
        self.check(requested)
        view = _expect_view(self.slot, requested)
        level = _level(view)
        if self._rows is None:
            return np.full(len(self._views), self._scale.different)
        if np.isnan(level):
            # einsum, not BLAS: BLAS sums a row differently by its position and by the
            # number of threads, so equal views would differ and runs would not repeat.
            r = np.einsum("ij,j->i", self._rows.used, view.direction).astype(np.float64)
            np.clip(r, 0.0, 1.0, out=r)
        else:
            r = (self._level.used == level).astype(np.float64)
        return np.asarray(self._scale.different + (self._scale.equal - self._scale.different) * r)

    def fully_similar(self, requested: Value) -> NDArray[np.bool_]:
        """Which views are the requested one."""
        return self.equals(requested)
