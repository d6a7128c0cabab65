"""Where the body of a disc-shaped robot fits and can get to on a floor plan."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from scipy import ndimage

from ssrics_like.errors import MapError
from ssrics_like.perception.observation import Pose

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ssrics_like.world.grid import GridMap


def clearance(grid: GridMap) -> NDArray[np.float64]:
    """Return how far the centre of each cell is from the nearest solid cell's edge.

    What lies outside the grid counts as solid.

    Parameters
    ----------
    grid : GridMap
        The floor plan.

    Returns
    -------
    ndarray, shape (rows, columns), float64
        Metres; 0 in solid cells.

    Notes
    -----
    It is the distance between the centres of the two cells, less half a cell: exact straight
    ahead of a wall, and too large by at most a fifth of a cell off its corner.
    """
    free = np.pad(~grid.solid, 1)
    distance: NDArray[np.float64] = ndimage.distance_transform_edt(free)[1:-1, 1:-1]
    return np.maximum(distance - 0.5, 0.0) * grid.cell_m


def reachable(grid: GridMap, x_m: float, y_m: float, radius_m: float) -> NDArray[np.bool_]:
    """Return which cells a disc-shaped robot can cover with its body, starting from a place.

    Parameters
    ----------
    grid : GridMap
        The floor plan.
    x_m, y_m : float
        Where the robot's centre starts, in the grid frame.
    radius_m : float
        The robot's radius, metres.

    Returns
    -------
    ndarray, shape (rows, columns), bool
        Free cells whose centre comes under the body; all False where the robot does not fit
        at its start.

    Notes
    -----
    The centre may be in any cell whose clearance is greater than the radius, and moves to the
    four cells that share an edge with its own.
    """
    return covered(grid, standing(grid, x_m, y_m, radius_m), radius_m)


def standing(grid: GridMap, x_m: float, y_m: float, radius_m: float) -> NDArray[np.bool_]:
    """Return the cells that the *centre* of the robot can get to; parameters as `reachable`."""
    fits = clearance(grid) > radius_m
    row, column = grid.cell_of(x_m, y_m)
    rows, columns = fits.shape
    if not (0 <= row < rows and 0 <= column < columns and fits[row, column]):
        return np.zeros_like(fits)
    parts, _ = ndimage.label(fits)
    there: NDArray[np.bool_] = parts == parts[row, column]
    return there


def covered(grid: GridMap, centres: NDArray[np.bool_], radius_m: float) -> NDArray[np.bool_]:
    """Return the cells that a disc of `radius_m` covers when its centre is in any of `centres`."""
    if not centres.any():
        return centres
    under: NDArray[np.bool_] = ndimage.distance_transform_edt(~centres) <= radius_m / grid.cell_m
    return under & ~grid.solid


def roomiest(grid: GridMap) -> Pose:
    """Return the middle of the free cell with the most clearance, heading 0, in the grid frame.

    Only the largest connected part of the free space is looked at: what lies around a building
    or in a closed shaft may be roomier, but leads nowhere. Of equals, the lowest row and then
    the lowest column wins.

    Raises
    ------
    MapError
        No cell is free.
    """
    parts, count = ndimage.label(~grid.solid)
    if not count:
        raise MapError("no cell of the map is free")
    largest = 1 + int(np.argmax(np.bincount(parts.ravel(), minlength=count + 1)[1:]))
    room = np.where(parts == largest, clearance(grid), -math.inf)
    row, column = divmod(int(np.argmax(room)), room.shape[1])
    return Pose((column + 0.5) * grid.cell_m, (row + 0.5) * grid.cell_m, 0.0)
