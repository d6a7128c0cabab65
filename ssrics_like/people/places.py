"""Where simulated participants stand: at labelled places, and elsewhere on the floor."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from ssrics_like.comparison.matching import points
from ssrics_like.comparison.scores import DESIGNATED
from ssrics_like.world.building import Building
from ssrics_like.world.reachable import clearance, roomiest, standing

SPACING_M = 2.0
"""How far apart the places are at which there is nothing to mark, and from labelled ones."""
BODY_M = 0.25
"""Half the width of whoever walks there, metres."""


def standing_places(
    building: Building, spacing_m: float = SPACING_M
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return where participants stand.

    Parameters
    ----------
    building : Building
        The map, with locations.
    spacing_m : float
        Metres between places at which there is nothing to mark.

    Returns
    -------
    targets : ndarray, shape (n, 2)
        The labelled doorways, in the frame of the map; every location where there is none.
    others : ndarray, shape (m, 2)
        The other locations, and places on the floor that a person can walk to from the roomiest of
        all, on a square grid, leaving out those nearer than the spacing to a location.

    Raises
    ------
    MapError
        No cell of the map is free.
    """
    grid = building.grid
    labelled = points([(place.x_m, place.y_m) for place in building.locations])
    wanted = np.array([place.kind == DESIGNATED for place in building.locations], bool)
    if not wanted.any():
        wanted[:] = True
    start = roomiest(grid)
    floor = standing(grid, start.x_m, start.y_m, min(BODY_M, 0.5 * clearance(grid).max()))
    width_m, height_m = grid.size_m
    x, y = (np.arange(spacing_m / 2, side, spacing_m) for side in (width_m, height_m))
    places = np.array([(a, b) for b in y for a in x], np.float64).reshape(-1, 2)
    rows, columns = (
        np.minimum((places[:, axis] / grid.cell_m).astype(np.int64), floor.shape[1 - axis] - 1)
        for axis in (1, 0)
    )
    others = grid.points_in_map(places[floor[rows, columns]])
    if len(labelled):
        away_m, _ = cKDTree(labelled).query(others)
        others = others[away_m >= spacing_m]
    return labelled[wanted], np.vstack([labelled[~wanted], others])
