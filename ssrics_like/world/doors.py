"""Door leaves: which cells a closed door fills."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.errors import MapError
from ssrics_like.world import ray_kernels
from ssrics_like.world.laser import leaps

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ssrics_like.world.grid import GridMap

WIDEST_M = 3.0  # a wider gap is no doorway
LEAF_M = 0.06
ANGLES = 180


def door_leaf(grid: GridMap, x_m: float, y_m: float) -> NDArray[np.bool_]:
    """Return the free cells that a door at a place fills when it is closed.

    The leaf stands across the narrowest part of the gap: on the shortest straight line through
    the place that ends at walls on both sides.

    Parameters
    ----------
    grid : GridMap
        The floor plan, with the door open.
    x_m, y_m : float
        A place in the doorway, grid frame.

    Returns
    -------
    ndarray, shape (rows, columns), bool

    Raises
    ------
    MapError
        The place is not in a gap that a door could close.
    """
    if not grid.is_free(x_m, y_m):
        raise MapError("there is no doorway here: the place is inside a wall or off the map")
    angles = np.pi * np.arange(ANGLES) / ANGLES
    directions = np.column_stack([np.cos(angles), np.sin(angles)])
    leap, cell = leaps(grid.solid), grid.cell_m
    reach = np.empty((2, ANGLES))
    for side, sign in enumerate((1.0, -1.0)):
        ray_kernels.cast_scan(leap, cell, (x_m, y_m, 0.0), sign * directions, WIDEST_M, reach[side])
    widths = reach.sum(axis=0)
    best = int(np.argmin(widths))
    if not math.isfinite(widths[best]) or widths[best] > WIDEST_M:
        raise MapError(f"there is no doorway here: no gap of up to {WIDEST_M:g} m between walls")
    # Lines that are as short to a hundredth differ by rounding only; take the middle one, or the
    # leaf would stand askew.
    equal = np.flatnonzero(widths <= widths[best] + 0.01 * cell)
    best = int(equal[np.argmin(np.abs(equal - equal.mean()))])
    rows, columns = grid.cells.shape
    row, column = np.mgrid[:rows, :columns]
    ox, oy = (column + 0.5) * cell - x_m, (row + 0.5) * cell - y_m
    dx, dy = directions[best]
    along, aside = ox * dx + oy * dy, np.abs(oy * dx - ox * dy)
    half = max(LEAF_M / 2, 0.75 * cell)  # thinner, a leaf askew to the grid would have holes
    within = (along < reach[0, best] + cell) & (along > -reach[1, best] - cell)
    leaf: NDArray[np.bool_] = within & (aside <= half) & ~grid.solid
    return leaf
