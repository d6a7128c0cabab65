"""The map and the walls as small PNG pictures, which the page colours."""

from __future__ import annotations

import base64
import io
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from ssrics_like.report.frames import Frame
from ssrics_like.report.pictures import Outline
from ssrics_like.report.walls import raster
from ssrics_like.world.grid import GridMap

LEVEL = 100
"""Grey level of a cell: this times FREE, OCCUPIED or UNKNOWN."""
STRAY = 0.001
"""Share of the walls' cells that may lie beyond each edge of what is shown of them."""


def map_picture(grid: GridMap) -> dict[str, Any]:
    """Return a floor plan: a picture, row 0 at the top, and where it lies."""
    rows, columns = grid.cells.shape
    o = grid.origin
    return {
        "png": _png(grid.cells[::-1] * np.uint8(LEVEL)),
        "rows": rows,
        "columns": columns,
        "cell_m": grid.cell_m,
        "origin": [o.x_m, o.y_m, o.theta_rad],
    }


def walls_picture(outline: Outline) -> dict[str, Any] | None:
    """Return cells where beams ended, or furniture, as a picture; None where there are none.

    A grey level is the share of a pixel that is filled.
    """
    if len(outline.x) == 0:
        return None
    cells = np.column_stack([outline.x, outline.y]).astype(np.float64) * outline.cell_m
    low, high = np.quantile(cells, [STRAY, 1.0 - STRAY], axis=0)
    frame = Frame(low[0], high[0] + outline.cell_m, low[1], high[1] + outline.cell_m, 1.0)
    share, (left, right, bottom, top) = raster(outline, frame)
    levels = np.rint(share[::-1] * 255.0).astype(np.uint8)
    return {"png": _png(levels), "left": left, "right": right, "bottom": bottom, "top": top}


def _png(levels: NDArray[np.uint8]) -> str:
    buffer = io.BytesIO()
    Image.fromarray(levels).save(buffer, "PNG", optimize=True)
    return base64.b64encode(buffer.getvalue()).decode("ascii")
