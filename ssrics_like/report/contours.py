"""The edges of areas of cells as polygons, so that walls are drawn sharp at any size."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def polygons(mask: NDArray[np.bool_]) -> list[NDArray[np.int64]]:
    """Return the outlines of the filled cells.

    Parameters
    ----------
    mask : ndarray of bool, shape (rows, columns)
        Which cells are filled.

    Returns
    -------
    list of ndarray of int64, shape (corners, 2)
        Closed polygons as (x, y) corners of cells, the last joined to the first. Filled cells lie
        to the left, so that outer edges run counter-clockwise and holes clockwise: together they
        have the winding number 1 in every filled cell and 0 elsewhere.
    """
    filled = np.pad(np.asarray(mask, bool), 1)
    columns = filled.shape[1]
    y, x = np.nonzero(filled[1:, 1:] != filled[:-1, 1:])  # the edge above (x, y) to (x + 1, y)
    above = filled[1:, 1:][y, x]
    corner = y * columns + x
    starts = [np.where(above, corner, corner + 1)]
    ends = [np.where(above, corner + 1, corner)]
    y, x = np.nonzero(filled[1:, 1:] != filled[1:, :-1])  # from (x, y) to (x, y + 1)
    right = filled[1:, 1:][y, x]
    corner = y * columns + x
    starts.append(np.where(right, corner + columns, corner))
    ends.append(np.where(right, corner, corner + columns))
    following: dict[int, list[int]] = {}
    for start, end in zip(
        np.concatenate(starts).tolist(), np.concatenate(ends).tolist(), strict=True
    ):
        following.setdefault(start, []).append(end)
    found = []
    while following:
        first = here = next(iter(following))
        ring = []
        while True:
            ring.append(here)
            onward = following[here]
            after = onward.pop()
            if not onward:
                del following[here]
            here = after
            if here == first:
                break
        found.append(_corners(np.array(ring), columns))
    return found


def _corners(ring: NDArray[np.int64], columns: int) -> NDArray[np.int64]:
    """Leave out the points at which a ring goes straight on."""
    before = ring - np.roll(ring, 1)
    turns = ring[before != np.roll(before, -1)]
    return np.column_stack([turns % columns, turns // columns])


def coarser(mask: NDArray[np.bool_], times: int) -> NDArray[np.bool_]:
    """Join squares of `times` by `times` cells; a square is filled if any of its cells is."""
    if times == 1:
        return mask
    rows, columns = (-(-side // times) for side in mask.shape)
    padded = np.zeros((rows * times, columns * times), bool)
    padded[: mask.shape[0], : mask.shape[1]] = mask
    return np.asarray(padded.reshape(rows, times, columns, times).any(axis=(1, 3)))
