"""Rough walls: radiators, skirting, pin boards, and whatever makes real maps uneven."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy import ndimage

from ssrics_like.training.obstacles import Obstacles

if TYPE_CHECKING:
    from ssrics_like.perception.observation import Pose
    from ssrics_like.world.grid import GridMap

KEPT = 0.9
MOST = 0.25
"""Share of the cells along walls that are filled at most."""


def rough_walls(grid: GridMap, start: Pose, radius_m: float, rng: np.random.Generator) -> GridMap:
    """Fill some of the free cells that share an edge with a solid one.

    Parameters
    ----------
    grid : GridMap
        The floor plan; it is left as it is.
    start : Pose
        Where the robot starts, grid frame.
    radius_m : float
        The robot's radius.
    rng : numpy.random.Generator
        Where chance comes from: how many cells, and which.

    Returns
    -------
    GridMap
        The plan; as it was if the robot would be shut off from more than a tenth of it.
    """
    obstacles = Obstacles(grid, start, radius_m, KEPT)
    along_walls = ndimage.binary_dilation(grid.solid) & ~grid.solid
    density = rng.uniform(0.0, MOST)
    obstacles.fill(along_walls & (rng.random(along_walls.shape) < density))
    return obstacles.grid
