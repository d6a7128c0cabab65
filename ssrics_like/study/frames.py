"""What a participant sees of a walk: views from the robot, and the outline its laser draws.

A view is a row of columns, as a pinhole camera has them: for each the distance of
the wall along the optical axis, which of the two sides of a cell was hit, where on
the wall, and the distance of furniture in front of it. That tells what stands
around the robot and nothing of where on the plan it is.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.study.furniture import furniture_of
from ssrics_like.world import ray_kernels
from ssrics_like.world.laser import leaps

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ssrics_like.study.replay import Replay
    from ssrics_like.world.grid import GridMap
    from ssrics_like.world.robot import LaserProfile

COLUMNS = 240
VIEW_RAD = math.radians(90.0)
RATE_HZ = 20
BEAMS_MAX = 181
FAR_M = 32.767  # 15 bits of millimetres
FAN_FAR_M = 655.34
NOTHING = 0xFFFF
TIE_CELLS = 1e-6
PANEL_M = 1.0
"""Walls are panelled, so that motion along them shows; the period of the panels."""


@dataclass(frozen=True, eq=False)
class Frames:
    """The frames of a walk, in order of time.

    Attributes
    ----------
    wall_m : ndarray, shape (frames, columns)
        Distance of the wall along the optical axis; columns from left to right.
    along_y : ndarray, shape (frames, columns), bool
        Whether the side that was hit runs along y of the grid.
    panel : ndarray, shape (frames, columns)
        Where on its panel the wall was hit, 0 to 1.
    furniture_m : ndarray, shape (frames, columns)
        Distance of furniture before the wall; infinity where there is none.
    fan_m : ndarray, shape (frames, beams)
        Ranges of the laser; infinity without a return.
    bearings_rad : ndarray, shape (beams,)
        Bearing of each beam, positive to the left.
    """

    wall_m: NDArray[np.float64]
    along_y: NDArray[np.bool_]
    panel: NDArray[np.float64]
    furniture_m: NDArray[np.float64]
    fan_m: NDArray[np.float64]
    bearings_rad: NDArray[np.float64]

    def __len__(self) -> int:
        return len(self.wall_m)

    def packed(self) -> bytes:
        """Return the frames one after the other, numbers with the low byte first.

        A frame is, for each column, 16 bits of twice the wall's distance in millimetres plus 1
        where the side runs along y; for each column 16 bits of the furniture's distance in
        millimetres, 65535 for none; for each beam 16 bits of the range in centimetres, 65535 for
        none; for each column a byte of the place on the panel.
        """
        wall = 2 * np.round(np.minimum(self.wall_m, FAR_M) * 1000) + self.along_y
        near = _numbers(self.furniture_m, 1000, NOTHING - 1)
        fan = _numbers(self.fan_m, 100, NOTHING - 1)
        words = np.hstack([wall, near, fan]).astype("<u2")
        panel = np.minimum(self.panel * 256, 255).astype(np.uint8)
        return np.hstack([words.view(np.uint8), panel]).tobytes()


def directions() -> NDArray[np.float64]:
    """Return cosine and sine of each column's bearing, shape (columns, 2), from left to right."""
    across = (2 * (np.arange(COLUMNS) + 0.5) / COLUMNS - 1) * math.tan(VIEW_RAD / 2)
    bearings = -np.arctan(across)
    return np.column_stack([np.cos(bearings), np.sin(bearings)])


def shown_bearings(laser: LaserProfile) -> NDArray[np.float64]:
    """Return the bearings of the beams that are shown: every one, or every second, and so on."""
    return laser.bearings_rad[:: -(-laser.beams // BEAMS_MAX)]


def frames_of(replay: Replay, grid: GridMap) -> Frames:
    """Look around from each place of a walk, twenty times a second.

    Parameters
    ----------
    replay : Replay
        Where the laser is, map frame.
    grid : GridMap
        The floor plan; furniture is what `furniture_of` takes for it.
    """
    count = math.floor(replay.length_s * RATE_HZ) + 1
    poses = replay.at(np.arange(count) / RATE_HZ)
    places = grid.points_in_grid(poses[:, :2])
    headings = poses[:, 2] - grid.origin.theta_rad
    furniture = furniture_of(grid)
    walls, everything = leaps(grid.solid & ~furniture), leaps(grid.solid)
    laser = replay.robot.laser
    bearings = shown_bearings(laser)
    beams = np.column_stack([np.cos(bearings), np.sin(bearings)])
    columns = directions()
    wall, near = np.empty((count, COLUMNS)), np.empty((count, COLUMNS))
    fan = np.empty((count, len(beams)))
    for i in range(count):
        at = (float(places[i, 0]), float(places[i, 1]), float(headings[i]))
        ray_kernels.cast_scan(walls, grid.cell_m, at, columns, FAR_M, wall[i])
        ray_kernels.cast_scan(everything, grid.cell_m, at, columns, FAR_M, near[i])
        ray_kernels.cast_scan(everything, grid.cell_m, at, beams, laser.range_max_m, fan[i])
    along_y, panel = _sides(wall, places, headings, columns, grid.cell_m)
    axis = columns[:, 0]  # from the length of a ray to the distance along the optical axis
    return Frames(
        np.minimum(wall, FAR_M) * axis,
        along_y,
        panel,
        np.where(near < wall, near, np.inf) * axis,
        fan,
        bearings,
    )


def _sides(
    ranges: NDArray[np.float64],
    places: NDArray[np.float64],
    headings: NDArray[np.float64],
    columns: NDArray[np.float64],
    cell_m: float,
) -> tuple[NDArray[np.bool_], NDArray[np.float64]]:
    """Tell which side of a cell each ray ended on, and where on a panel."""
    reach = np.where(np.isfinite(ranges), ranges, 0.0)
    cos, sin = np.cos(headings)[:, np.newaxis], np.sin(headings)[:, np.newaxis]
    c, s = columns.T
    x = places[:, :1] + reach * (cos * c - sin * s)
    y = places[:, 1:] + reach * (sin * c + cos * s)
    # A ray ends on a line between cells: on that of the two that it is nearer to.
    off_x = np.abs(x / cell_m - np.round(x / cell_m))
    off_y = np.abs(y / cell_m - np.round(y / cell_m))
    along_y: NDArray[np.bool_] = off_x < off_y
    # On the corner of four cells either would do: it is as beside it.
    beside = np.roll(along_y, 1, axis=1)
    beside[:, 0] = along_y[:, 1]
    along_y = np.where(np.abs(off_x - off_y) < TIE_CELLS, beside, along_y)
    return along_y, np.mod(np.where(along_y, y, x), PANEL_M) / PANEL_M


def _numbers(values: NDArray[np.float64], scale: float, most: int) -> NDArray[np.uint16]:
    """Return values as whole numbers of 16 bits, `NOTHING` for infinity."""
    finite = np.isfinite(values)
    scaled = np.round(np.where(finite, values, 0.0) * scale)
    return np.where(finite, np.minimum(scaled, most), NOTHING).astype(np.uint16)
