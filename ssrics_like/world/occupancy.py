"""The robot's own map: an occupancy grid made from its scans.

References
----------
Moravec and Elfes (1985) for the grid; here evidence is a small count, and cells that are too close
to an obstacle for the body are counted as the map grows, so that planning need not inflate it.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from ssrics_like.world import occupancy_kernels, way_kernels

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ssrics_like.perception.observation import LaserScan, Pose

REACH_M = 8.0  # beams are mapped up to here; what is farther will be seen from nearer
SILENT_RUN = 5  # beams that no laser loses side by side, unless it loses many
SQUEEZE_M = 0.05  # nearer than this to a wall it goes only where there is no other way,
BERTH_M = 0.25  # and nearer than this only where the way around is long
BLOCKED, SQUEEZE, TIGHT, OPEN = 255, 10, 3, 1
UNSEEN = 2
"""What it costs to pass a cell: see `OccupancyGrid.costs`; 0 cannot be passed. UNSEEN is for a
robot that goes where it has not looked yet."""


class OccupancyGrid:
    """What the robot knows of the building.

    Parameters
    ----------
    shape : tuple of int
        Rows and columns.
    cell_m : float
        Side of a cell, metres.
    radius_m : float
        Radius of the robot's body.
    reach_m : float
        Beams are mapped up to here.
    silent_run : int
        So many neighbouring beams without return have met nothing; fewer may have been lost.

    Attributes
    ----------
    evidence : ndarray, shape (rows, columns), int8
        Above 0 occupied, below 0 free, 0 never seen.
    """

    def __init__(
        self,
        shape: tuple[int, int],
        cell_m: float,
        radius_m: float,
        *,
        reach_m: float = REACH_M,
        silent_run: int = SILENT_RUN,
    ) -> None:
        self.cell_m = cell_m
        self._reach_m, self._silent_run = reach_m, silent_run
        self._discs = _offsets(
            [radius_m / cell_m, (radius_m + SQUEEZE_M) / cell_m, (radius_m + BERTH_M) / cell_m]
        )
        self._clear(shape)

    def _clear(self, shape: tuple[int, ...]) -> None:
        """Begin with nothing known, and nowhere to go outside."""
        self.evidence = np.zeros(shape, np.int8)
        self._history = np.zeros(shape, np.uint8)
        self._counts = np.zeros((3, *shape), np.int16)
        occupancy_kernels.count_outside(self._counts, self._discs)

    def take(self, scan: LaserScan, pose: Pose, directions: NDArray[np.float64]) -> int:
        """Take a scan from a pose in the grid frame; return how many cells became known."""
        new: int = occupancy_kernels.take_scan(
            self.evidence, self._history, self._counts, self._discs, self.cell_m,
            (pose.x_m, pose.y_m, pose.theta_rad), directions, scan.ranges_m, self._reach_m,
            self._silent_run,
        )  # fmt: skip
        return new

    def meet(self, x_m: float, y_m: float) -> None:
        """Note that something is at a place, grid frame, which must have been seen before."""
        row, column = int(y_m / self.cell_m), int(x_m / self.cell_m)
        rows, columns = self.evidence.shape
        if 0 <= row < rows and 0 <= column < columns and self.evidence[row, column]:
            self._add(row, column, 2 * occupancy_kernels.MOST)

    def _add(self, row: int, column: int, weight: int) -> None:
        """Add evidence to a single cell."""
        occupancy_kernels.add_evidence(
            self.evidence, self._history, self._counts, self._discs, row, column, weight
        )

    def forget_moved(self) -> int:
        """Take what has come to stand where it was free for gone; return how many cells that is.

        A person may have walked on, a door may be open again.
        """
        cells = np.argwhere(
            (self._history == occupancy_kernels.MOVED) & (self.evidence > 0)
        ).tolist()
        for row, column in cells:
            self._add(row, column, -int(self.evidence[row, column]) - 1)
        return len(cells)

    def know(self, solid: NDArray[np.bool_]) -> None:
        """Take a floor plan for granted until scans say otherwise."""
        most = occupancy_kernels.MOST
        for row, column in np.argwhere(solid).tolist():
            self._add(row, column, most)
        self.evidence[~solid] = -most

    def is_open(self, way: NDArray[np.float64], at: int) -> bool:
        """Tell whether the body can pass a way, shape (n, 2), from its place `at` on."""
        return bool(way_kernels.is_open(self._counts[0], way, at, self.cell_m))

    def shift(self, rows: int, columns: int) -> None:
        """Let the grid begin so many cells later; what it covered and still covers stays known."""
        evidence, history = self.evidence, self._history
        self._clear(evidence.shape)
        kept = _overlap(evidence, rows, columns)
        _overlap(self.evidence, -rows, -columns)[:] = np.minimum(kept, 0)
        _overlap(self._history, -rows, -columns)[:] = _overlap(history, rows, columns)
        top, left = max(-rows, 0), max(-columns, 0)
        for row, column in np.argwhere(kept > 0).tolist():
            self._add(top + row, left + column, int(kept[row, column]))

    def costs(self, unknown: int = 0) -> NDArray[np.uint8]:
        """Return what it costs to pass each cell.

        Parameters
        ----------
        unknown : int
            What it costs to pass a cell that was never seen; 0 for what cannot be passed.

        Returns
        -------
        ndarray, shape (rows, columns), uint8
            0 where a cell is occupied, `unknown` where it was never seen; BLOCKED where the body
            would touch something, which only a robot that is there already may pass; SQUEEZE and
            TIGHT close to an obstacle; OPEN.
        """
        costs = np.empty(self.evidence.shape, np.uint8)
        prices = (BLOCKED, SQUEEZE, TIGHT, OPEN)
        occupancy_kernels.passing_costs(self.evidence, self._counts, prices, unknown, costs)
        return costs


def _overlap(cells: NDArray[Any], rows: int, columns: int) -> NDArray[Any]:
    """Return the part of a grid that one which begins so many cells later covers too."""
    height, width = cells.shape
    return cells[
        max(rows, 0) : height + min(rows, 0),
        max(columns, 0) : width + min(columns, 0),
    ]


def _offsets(radii: list[float]) -> NDArray[np.int32]:
    """Return offsets of cells around an occupied one: row, column, index of the least radius.

    Radii rise, in cells. A disc touches a cell whose near edge is within its radius.
    """
    most = math.ceil(radii[-1] + 1.0)
    row, column = np.mgrid[-most : most + 1, -most : most + 1]
    edge = np.hypot(row, column) - 0.5
    layer = np.searchsorted(radii, edge)
    near = layer < len(radii)
    return np.column_stack([row[near], column[near], layer[near]]).astype(np.int32)
