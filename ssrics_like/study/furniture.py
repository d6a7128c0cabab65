"""Which solid cells are furniture that one looks over, and which are walls."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ssrics_like.world.grid import GridMap

FURNITURE_M = 2.5
"""What stands free and is no longer than this is taken for furniture. Ours."""


def furniture_of(grid: GridMap) -> NDArray[np.bool_]:
    """Return the cells of what is small and touches no wall, shape (rows, columns)."""
    from scipy import ndimage  # noqa: PLC0415 - takes long to import

    parts, _ = ndimage.label(grid.solid, structure=np.ones((3, 3)))
    most = FURNITURE_M / grid.cell_m
    small = [
        max(side.stop - side.start for side in extent) <= most
        for extent in ndimage.find_objects(parts)
    ]
    is_furniture = np.array([False, *small])
    for edge in (parts[0], parts[-1], parts[:, 0], parts[:, -1]):
        is_furniture[edge] = False
    chosen: NDArray[np.bool_] = is_furniture[parts]
    return chosen
