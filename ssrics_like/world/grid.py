"""A floor plan as square cells, and the two frames that it is spoken of in.

Files and users speak in the *map* frame, in which the grid may lie shifted and
turned. Everything that is computed is computed in the *grid* frame: metres from
the corner of cell (0, 0), x along the columns, y along the rows.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.perception.observation import Pose

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

AT_ORIGIN = Pose(0.0, 0.0, 0.0)
FREE, OCCUPIED, UNKNOWN = 0, 1, 2
"""What a cell is. An unknown cell is where nobody looked; nothing passes through it."""


@dataclass(frozen=True, eq=False)
class GridMap:
    """A floor plan.

    Attributes
    ----------
    cells : ndarray, shape (rows, columns), uint8
        FREE, OCCUPIED or UNKNOWN. Row 0 is the lowest: y rises with the row, x with the column.
    cell_m : float
        Side of a cell, metres.
    origin : Pose
        Pose of the grid in the map frame: where the outer corner of cell (0, 0) lies, and how
        far the grid is turned counter-clockwise (the ``origin`` of ROS map_server).
    """

    cells: NDArray[np.uint8]
    cell_m: float
    origin: Pose = AT_ORIGIN

    @property
    def solid(self) -> NDArray[np.bool_]:
        """Which cells stop a beam and a robot, shape (rows, columns)."""
        solid: NDArray[np.bool_] = self.cells != FREE
        return solid

    @property
    def size_m(self) -> tuple[float, float]:
        """Width and height of the grid in metres."""
        rows, columns = self.cells.shape
        return columns * self.cell_m, rows * self.cell_m

    def pose_in_map(self, pose: Pose) -> Pose:
        """Turn a pose of the grid frame into one of the map frame."""
        o = self.origin
        cos, sin = math.cos(o.theta_rad), math.sin(o.theta_rad)
        return Pose(
            o.x_m + cos * pose.x_m - sin * pose.y_m,
            o.y_m + sin * pose.x_m + cos * pose.y_m,
            math.remainder(pose.theta_rad + o.theta_rad, math.tau),
        )

    def pose_in_grid(self, pose: Pose) -> Pose:
        """Turn a pose of the map frame into one of the grid frame."""
        o = self.origin
        cos, sin = math.cos(o.theta_rad), math.sin(o.theta_rad)
        x, y = pose.x_m - o.x_m, pose.y_m - o.y_m
        theta_rad = math.remainder(pose.theta_rad - o.theta_rad, math.tau)
        return Pose(cos * x + sin * y, cos * y - sin * x, theta_rad)

    def points_in_map(self, places: ArrayLike) -> NDArray[np.float64]:
        """Turn places of the grid frame, shape (n, 2), into places of the map frame."""
        x, y = np.asarray(places, np.float64).T
        cos, sin = math.cos(self.origin.theta_rad), math.sin(self.origin.theta_rad)
        return np.column_stack(
            [self.origin.x_m + cos * x - sin * y, self.origin.y_m + sin * x + cos * y]
        )

    def points_in_grid(self, places: ArrayLike) -> NDArray[np.float64]:
        """Turn places of the map frame, shape (n, 2), into places of the grid frame."""
        x, y = (np.asarray(places, np.float64) - [self.origin.x_m, self.origin.y_m]).T
        cos, sin = math.cos(self.origin.theta_rad), math.sin(self.origin.theta_rad)
        return np.column_stack([cos * x + sin * y, cos * y - sin * x])

    def cell_of(self, x_m: float, y_m: float) -> tuple[int, int]:
        """Return (row, column) of a place in the grid frame; it may lie outside the grid."""
        return math.floor(y_m / self.cell_m), math.floor(x_m / self.cell_m)

    def is_free(self, x_m: float, y_m: float) -> bool:
        """Tell whether a place in the grid frame lies in a free cell."""
        row, column = self.cell_of(x_m, y_m)
        rows, columns = self.cells.shape
        inside = 0 <= row < rows and 0 <= column < columns
        return inside and bool(self.cells[row, column] == FREE)
