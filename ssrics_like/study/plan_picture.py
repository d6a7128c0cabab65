"""The floor plan as participants see it, and how places on it relate to the map.

A place on the picture is told in metres to the right of its left edge and below
its top edge, whatever the zoom; the map may lie shifted and turned.
"""

from __future__ import annotations

import io
from typing import TYPE_CHECKING

import numpy as np
from PIL import Image

from ssrics_like.study.furniture import furniture_of
from ssrics_like.world.grid import FREE, UNKNOWN

if TYPE_CHECKING:
    from ssrics_like.world.grid import GridMap

FLOOR, WALL, NOBODY_LOOKED, FURNITURE = 0, 1, 2, 3
COLOURS = ("#ffffff", "#3d4852", "#e4e8ec", "#c2ccd6")


def picture_of(grid: GridMap) -> bytes:
    """Return a plan as a PNG picture of a pixel a cell, its highest row on top."""
    shown = np.full(grid.cells.shape, WALL, np.uint8)
    shown[grid.cells == FREE] = FLOOR
    shown[grid.cells == UNKNOWN] = NOBODY_LOOKED
    shown[furniture_of(grid)] = FURNITURE
    image = Image.fromarray(shown[::-1])
    image.putpalette(bytes.fromhex("".join(colour[1:] for colour in COLOURS)))
    stream = io.BytesIO()
    image.save(stream, "PNG", optimize=True)
    return stream.getvalue()


def on_map(grid: GridMap, right_m: float, down_m: float) -> tuple[float, float]:
    """Return the place of the map frame that a place on the picture shows."""
    height_m = grid.size_m[1]
    x_m, y_m = grid.points_in_map([[right_m, height_m - down_m]])[0].tolist()
    return x_m, y_m


def on_picture(grid: GridMap, x_m: float, y_m: float) -> tuple[float, float]:
    """Return how far right and down on the picture a place of the map frame is; undoes `on_map`."""
    height_m = grid.size_m[1]
    right_m, up_m = grid.points_in_grid([[x_m, y_m]])[0].tolist()
    return right_m, height_m - up_m


def is_on_picture(grid: GridMap, right_m: float, down_m: float) -> bool:
    """Tell whether a place lies on the picture, its edges included."""
    width_m, height_m = grid.size_m
    return 0.0 <= right_m <= width_m and 0.0 <= down_m <= height_m
