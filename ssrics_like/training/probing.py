"""How far it is from a place on a floor plan to a wall, straight along the axes."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from ssrics_like.world.grid import GridMap

ACROSS = ((1, 0), (0, 1))
"""The directions that walls and gaps of generated buildings run in: along x, along y."""


def free_way(
    grid: GridMap, x_m: float, y_m: float, direction: tuple[int, int], limit_m: float
) -> float:
    """Return how far one can go before a solid cell or the grid's edge, metres, a cell at a time.

    Parameters
    ----------
    grid : GridMap
        The floor plan.
    x_m, y_m : float
        Where from, grid frame.
    direction : tuple of int
        Along which axis: 1 or -1 for one of x and y, 0 for the other.
    limit_m : float
        No farther than this is looked.
    """
    steps = math.ceil(limit_m / grid.cell_m)
    for step in range(steps):
        gone_m = step * grid.cell_m
        if not grid.is_free(x_m + gone_m * direction[0], y_m + gone_m * direction[1]):
            return gone_m
    return limit_m


def near_any(x_m: float, y_m: float, places: ArrayLike, distance_m: float) -> bool:
    """Tell whether any of some places, shape (n, 2), metres, is nearer than a distance."""
    known = np.asarray(places, np.float64).reshape(-1, 2)
    return bool((np.hypot(known[:, 0] - x_m, known[:, 1] - y_m) < distance_m).any())
