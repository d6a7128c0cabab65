"""The floor plan under a map of a simulated building: walls as sharp areas, not as pixels."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ssrics_like.report import style
from ssrics_like.report.contours import coarser, polygons
from ssrics_like.report.frames import Frame
from ssrics_like.world.grid import OCCUPIED, UNKNOWN, GridMap

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from matplotlib.path import Path as Outlines

CELL_PT = 0.45
"""Cells that would be drawn smaller are joined."""


def bounds_of(grid: GridMap) -> NDArray[np.float64]:
    """Return the corners of what is known of a plan, shape (4, 2), in the frame of the map."""
    rows, columns = np.nonzero(grid.cells != UNKNOWN)
    if len(rows) == 0:
        return np.empty((0, 2))
    x, y = (columns.min(), columns.max() + 1), (rows.min(), rows.max() + 1)
    corners = np.array([(x[i], y[j]) for i in (0, 1) for j in (0, 1)], np.float64)
    return grid.points_in_map(corners * grid.cell_m)


def draw_plan(axes: Axes, grid: GridMap, frame: Frame, *, strength: float = 1.0) -> None:
    """Draw a plan under everything else.

    Parameters
    ----------
    axes : Axes
        A map's axes, in metres of the frame of the map.
    grid : GridMap
        The plan.
    frame : Frame
        What the axes show.
    strength : float
        How dark walls are, 0 to 1.
    """
    from matplotlib.patches import PathPatch

    axes.set_facecolor(style.UNKNOWN)
    for outlines, look in _layers(grid, frame, strength):
        axes.add_patch(PathPatch(outlines, **look))


def draw_plans(
    figure: Figure,
    grid: GridMap,
    frame: Frame,
    corners_pt: list[tuple[float, float]],
    *,
    strength: float = 1.0,
) -> None:
    """Draw one plan several times in a figure that holds it only once.

    Parameters
    ----------
    figure : Figure
        Its axes must be transparent.
    grid, frame, strength
        As of `draw_plan`; every copy shows the same frame.
    corners_pt : list of tuple of float
        Lower left corners of the frames, points from that of the figure.
    """
    from matplotlib.collections import PathCollection
    from matplotlib.path import Path as Outlines
    from matplotlib.transforms import Affine2D

    points = Affine2D().scale(1 / style.POINTS) + figure.dpi_scale_trans
    sheet = Outlines.unit_rectangle().transformed(Affine2D().scale(frame.width_pt, frame.height_pt))
    to_points = Affine2D().translate(-frame.left, -frame.bottom).scale(frame.points_per_m)
    layers: list[tuple[Outlines, dict[str, Any]]] = [
        (sheet, {"facecolor": style.UNKNOWN, "linewidth": 0, "zorder": -1.0})
    ]
    layers += [
        (outlines.transformed(to_points), look) for outlines, look in _layers(grid, frame, strength)
    ]
    for outlines, look in layers:
        copies = PathCollection([outlines], offsets=corners_pt, offset_transform=points, **look)
        # Collections scale their paths by a transform of their own, apart from the offsets.
        copies.set_transform(points)
        figure.add_artist(copies)


def _layers(grid: GridMap, frame: Frame, strength: float) -> list[tuple[Outlines, dict[str, Any]]]:
    """Return what is drawn from below to the top: what is known, then its walls upon it."""
    times = max(1, math.ceil(CELL_PT / (grid.cell_m * frame.points_per_m)))
    wall = style.mixed(style.PLAN_WALL, strength)
    return [
        (
            _outlines(grid, coarser(mask, times), times),
            {"facecolor": colour, "linewidth": 0, "zorder": zorder},
        )
        for mask, colour, zorder in (
            (grid.cells != UNKNOWN, "white", -0.9),
            (grid.cells == OCCUPIED, wall, -0.8),
        )
        if mask.any()
    ]


def _outlines(grid: GridMap, mask: NDArray[np.bool_], times: int) -> Outlines:
    """Return the outlines of the filled cells as one path, in the frame of the map."""
    from matplotlib.path import Path as Outlines

    side_m = grid.cell_m * times
    rings = [grid.points_in_map(ring * side_m) for ring in polygons(mask)]
    codes = [
        [Outlines.MOVETO, *[Outlines.LINETO] * (len(ring) - 1), Outlines.CLOSEPOLY]
        for ring in rings
    ]
    closed = [np.vstack([ring, ring[:1]]) for ring in rings]
    return Outlines(np.concatenate(closed), np.concatenate(codes))
