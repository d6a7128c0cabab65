"""The building as the laser saw it: the outline's cells as one image."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ssrics_like.report.frames import Frame
from ssrics_like.report.pictures import Outline
from ssrics_like.report.style import WALL

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Extent = tuple[float, float, float, float]

SIDE_MAX = 1800
"""Most pixels along a side of the image; what is finer is joined."""


def raster(outline: Outline, frame: Frame) -> tuple[NDArray[np.float64], Extent]:
    """Draw the cells inside a frame into a grid.

    Parameters
    ----------
    outline : Outline
        The cells.
    frame : Frame
        What is shown.

    Returns
    -------
    share : ndarray, shape (rows, columns)
        Share of each pixel that is filled, 0 to 1; row 0 is the lowest.
    extent : tuple of float
        left, right, bottom, top of the grid, metres.
    """
    cell = outline.cell_m
    low = np.floor(np.array([frame.left, frame.bottom]) / cell).astype(np.int64)
    high = np.ceil(np.array([frame.right, frame.top]) / cell).astype(np.int64)
    columns, rows = (int(n) for n in np.maximum(high - low, 1))
    joined = -(-max(columns, rows) // SIDE_MAX)
    columns, rows = -(-columns // joined), -(-rows // joined)
    x, y = outline.x - low[0], outline.y - low[1]
    inside = (x >= 0) & (y >= 0) & (x < columns * joined) & (y < rows * joined)
    share = np.zeros((rows, columns))
    np.add.at(share, (y[inside] // joined, x[inside] // joined), 1.0)
    # A wall is one cell thick: a pixel that it crosses is counted as filled.
    share = np.minimum(share / joined, 1.0)
    left, bottom = low * cell
    side = joined * cell
    return share, (left, left + columns * side, bottom, bottom + rows * side)


def draw_walls(
    axes: Axes, outline: Outline, frame: Frame, *, strength: float = 1.0, side_px: int = SIDE_MAX
) -> None:
    """Draw the outline under everything else.

    Parameters
    ----------
    axes : Axes
        A map's axes.
    outline : Outline
        The cells.
    frame : Frame
        What the axes show.
    strength : float
        Opacity of a filled cell.
    side_px : int
        About how many pixels the image has: cells are enlarged to it, so that their edges stay
        sharp in browsers, which smooth what they enlarge.
    """
    from matplotlib.colors import to_rgb

    if len(outline.x) == 0:
        return
    share, extent = raster(outline, frame)
    image = np.zeros((*share.shape, 4), np.uint8)
    image[..., :3] = np.round(np.array(to_rgb(WALL)) * 255)
    image[..., 3] = np.round(share * 255 * strength)
    times = max(1, side_px // max(share.shape))
    image = image.repeat(times, axis=0).repeat(times, axis=1)
    axes.imshow(image, extent=extent, origin="lower", interpolation="none", zorder=0)
    axes.set_xlim(frame.left, frame.right)
    axes.set_ylim(frame.bottom, frame.top)
