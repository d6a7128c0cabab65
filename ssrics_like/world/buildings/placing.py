"""Putting furniture on a floor plan so that a robot can still get everywhere it could before."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import ndimage

from ssrics_like.errors import MapError
from ssrics_like.world.buildings.pieces import Patch, Piece, patch
from ssrics_like.world.grid import OCCUPIED, GridMap
from ssrics_like.world.reachable import standing

CLEAR_M = 0.9
"""No furniture comes this near to a place that is to be kept clear."""


class Placing:
    """A floor plan that furniture is put on, piece by piece.

    Parameters
    ----------
    grid : GridMap
        The plan; it is left as it is.
    keep_clear : array_like, shape (n, 2)
        Places in the grid frame, metres. The first is where the robot starts.
    radius_m : float
        The robot's radius.
    clear_m : float
        How near furniture may come to a place that is kept clear.

    Attributes
    ----------
    cells : ndarray, shape (rows, columns), uint8
        The plan with the furniture that has been put.
    standing : ndarray, shape (rows, columns), bool
        Where the robot's centre can get to.

    Raises
    ------
    MapError
        The robot does not fit at the first place, or there is none.
    """

    def __init__(
        self, grid: GridMap, keep_clear: ArrayLike, radius_m: float, clear_m: float = CLEAR_M
    ) -> None:
        places = np.asarray(keep_clear, np.float64).reshape(-1, 2)
        if not len(places):
            raise MapError("no place is kept clear: name at least where the robot starts")
        self.grid = grid
        self.cells = grid.cells.copy()
        self.standing = standing(grid, float(places[0, 0]), float(places[0, 1]), radius_m)
        if not self.standing.any():
            raise MapError(
                f"a robot of radius {radius_m:g} m does not fit at ({places[0, 0]:g}, "
                f"{places[0, 1]:g}), where it is to start"
            )
        self._start = grid.cell_of(float(places[0, 0]), float(places[0, 1]))
        self._barred = _near(grid, places, clear_m)
        self._reach = radius_m / grid.cell_m + 0.5  # as `clearance` measures it, in cells

    def put(self, piece: Piece, *, leaning: bool = False) -> bool:
        """Put a piece if it may stand there, and tell whether it did.

        It may stand on free cells only and away from what is kept clear; and it may take from
        the robot no place but those that it touches or covers.

        Parameters
        ----------
        piece : Piece
            The piece, in the grid frame.
        leaning : bool
            It may touch walls and what is kept clear, as the leaf of a door does.
        """
        shape = (self.cells.shape[0], self.cells.shape[1])
        under = patch(piece, shape, self.grid.cell_m, whole=True)
        window = (under.rows, under.columns)
        taken = self.cells[window] != 0
        if not leaning and (under.cells & (taken | self._barred[window])).any():
            return False
        solid = patch(piece, shape, self.grid.cell_m)
        left = self._left_for_the_robot(solid, under)
        if left is None:
            return False
        self.standing = left
        self.cells[window][solid.cells] = OCCUPIED
        return True

    def _left_for_the_robot(self, solid: Patch, under: Patch) -> NDArray[np.bool_] | None:
        """Return where the robot can get to with a piece in place; None if it is cut off."""
        rows, columns = _widened(solid, int(self._reach) + 2, self.standing.shape)
        free = np.ones((rows.stop - rows.start, columns.stop - columns.start), np.bool_)
        inner = (
            slice(solid.rows.start - rows.start, solid.rows.stop - rows.start),
            slice(solid.columns.start - columns.start, solid.columns.stop - columns.start),
        )
        free[inner] = ~solid.cells
        blocked = ndimage.distance_transform_edt(free) <= self._reach
        before = self.standing[rows, columns]
        after = before & ~blocked
        if not (before & blocked).any():
            return self.standing
        left = self.standing.copy()
        left[rows, columns] = after
        if not left[self._start]:
            return None
        # What was one part and is one part near the piece is one part still.
        if ndimage.label(after)[1] == 1:
            return left
        parts, _ = ndimage.label(left)
        main: NDArray[np.bool_] = parts == parts[self._start]
        lost = left & ~main
        lost[under.rows, under.columns] &= ~under.cells
        return None if lost.any() else main


def _near(grid: GridMap, places: NDArray[np.float64], distance_m: float) -> NDArray[np.bool_]:
    """Return the cells whose middle lies within a distance of any place."""
    near = np.zeros(grid.cells.shape, np.bool_)
    reach = distance_m / grid.cell_m
    for x, y in places / grid.cell_m:
        low_x, low_y = max(0, int(x - reach) - 1), max(0, int(y - reach) - 1)
        part = near[low_y : int(y + reach) + 2, low_x : int(x + reach) + 2]
        rows, columns = np.indices(part.shape, dtype=np.float64)
        part |= np.hypot(columns + low_x + 0.5 - x, rows + low_y + 0.5 - y) <= reach
    return near


def _widened(of: Patch, by: int, shape: tuple[int, ...]) -> tuple[slice, slice]:
    return (
        slice(max(of.rows.start - by, 0), min(of.rows.stop + by, shape[0])),
        slice(max(of.columns.start - by, 0), min(of.columns.stop + by, shape[1])),
    )
