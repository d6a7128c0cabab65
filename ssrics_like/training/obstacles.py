"""Obstacles on a floor plan, put only where the robot still gets nearly everywhere."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.world.buildings.plan import put
from ssrics_like.world.grid import OCCUPIED, GridMap
from ssrics_like.world.reachable import reachable

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ssrics_like.perception.observation import Pose
    from ssrics_like.world.buildings.pieces import Piece


class Obstacles:
    """A floor plan that obstacles are put on, one group after the other.

    Parameters
    ----------
    grid : GridMap
        The plan; it is left as it is.
    start : Pose
        Where the robot's centre starts, grid frame.
    radius_m : float
        The robot's radius.
    kept : float
        Share of the floor that the robot's body reached at first and must reach still, 0 to 1.
        Obstacles take some floor themselves, so that 1 would allow none.
    """

    def __init__(self, grid: GridMap, start: Pose, radius_m: float, kept: float) -> None:
        self.grid = grid
        self._start = start
        self._radius_m = radius_m
        self._enough = kept * self._reached(grid)

    def put(self, pieces: Sequence[Piece]) -> bool:
        """Put pieces, all or none, and tell whether they could stay."""
        cells = self.grid.cells.copy()
        for piece in pieces:
            put(piece, cells, self.grid.cell_m)
        return self._keep(cells)

    def fill(self, taken: NDArray[np.bool_]) -> bool:
        """Fill cells, bool of shape (rows, columns), and tell whether they could stay."""
        return self._keep(np.where(taken, np.uint8(OCCUPIED), self.grid.cells))

    def _keep(self, cells: NDArray[np.uint8]) -> bool:
        changed = GridMap(cells, self.grid.cell_m, self.grid.origin)
        if self._reached(changed) <= self._enough:
            return False
        self.grid = changed
        return True

    def _reached(self, grid: GridMap) -> int:
        """Return how many cells the robot's body can cover."""
        there = reachable(grid, self._start.x_m, self._start.y_m, self._radius_m)
        return int(there.sum())
