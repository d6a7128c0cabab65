"""Furniture on any floor plan, put at random: what is moved about between two runs."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import ndimage

from ssrics_like.world.buildings.pieces import Piece, PieceKind
from ssrics_like.world.buildings.placing import Placing
from ssrics_like.world.grid import GridMap

TRIES = 40
"""Places that are tried for a piece before it is left out."""


class Sort(NamedTuple):
    """A sort of furniture: how large it is, and whether its back stands at a wall."""

    kind: PieceKind
    width_m: tuple[float, float]
    depth_m: tuple[float, float]
    at_wall: bool


SORTS = (
    Sort("box", (0.8, 2.4), (0.3, 0.45), at_wall=True),  # shelf
    Sort("box", (0.8, 1.6), (0.45, 0.65), at_wall=True),  # cupboard
    Sort("box", (1.4, 2.2), (0.75, 0.95), at_wall=True),  # sofa
    Sort("box", (0.4, 0.8), (0.4, 0.7), at_wall=False),  # crate
    Sort("desk", (1.2, 1.8), (0.7, 0.8), at_wall=True),
    Sort("table", (1.0, 2.0), (0.7, 1.0), at_wall=False),
    Sort("chair", (0.42, 0.5), (0.42, 0.5), at_wall=False),
    Sort("round", (0.3, 0.6), (0.3, 0.6), at_wall=False),  # bin, plant
)
WEIGHTS = (0.2, 0.12, 0.08, 0.12, 0.12, 0.1, 0.16, 0.1)


def furnish(
    grid: GridMap,
    rng: np.random.Generator,
    pieces: int,
    keep_clear: ArrayLike,
    radius_m: float,
) -> GridMap:
    """Put furniture on a floor plan at random.

    Parameters
    ----------
    grid : GridMap
        The plan; it is left as it is.
    rng : numpy.random.Generator
        Where chance comes from.
    pieces : int
        How many. One that finds no place is left out.
    keep_clear : array_like, shape (n, 2)
        Places in the grid frame that furniture keeps 0.9 m away from. The first is where the
        robot starts.
    radius_m : float
        The robot's radius. It gets to everywhere that it got to before, but for what the
        furniture covers or comes nearer to than that.

    Returns
    -------
    GridMap
        The plan with its furniture.

    Raises
    ------
    MapError
        The robot does not fit at the first place.
    """
    placing = Placing(grid, keep_clear, radius_m)
    floor = np.argwhere(placing.standing)
    nearest = ndimage.distance_transform_edt(
        ~grid.solid, return_distances=False, return_indices=True
    )
    for _ in range(pieces):
        sort = SORTS[int(rng.choice(len(SORTS), p=WEIGHTS))]
        width_m, depth_m = rng.uniform(*sort.width_m), rng.uniform(*sort.depth_m)
        for _ in range(TRIES):
            cell = floor[rng.integers(len(floor))]
            x_m, y_m, turn_rad = _pose(sort, depth_m, cell, nearest[:, cell[0], cell[1]], grid, rng)
            piece = Piece(
                kind=sort.kind, x_m=x_m, y_m=y_m, width_m=width_m, depth_m=depth_m,
                turn_rad=turn_rad,
            )  # fmt: skip
            if placing.put(piece):
                break
    return GridMap(placing.cells, grid.cell_m, grid.origin)


def _pose(
    sort: Sort,
    depth_m: float,
    cell: NDArray[np.intp],
    wall: NDArray[np.intp],
    grid: GridMap,
    rng: np.random.Generator,
) -> tuple[float, float, float]:
    """Return middle and turn of a piece: with its back at the wall nearest to a cell, or there."""
    y, x = (cell + 0.5) * grid.cell_m
    if not sort.at_wall:
        square = rng.integers(4) * math.pi / 2
        loose = rng.uniform(-math.pi, math.pi)
        return float(x), float(y), float(loose if rng.random() < 0.3 else square)  # noqa: PLR2004
    wall_y, wall_x = (wall + 0.5) * grid.cell_m
    away_x, away_y = x - wall_x, y - wall_y
    length = math.hypot(away_x, away_y)
    away_x, away_y = away_x / length, away_y / length
    # A cell of slack: the wall's edge is not its middle, and walls of real maps are rough.
    off = depth_m / 2 + 1.5 * grid.cell_m
    turn_rad = math.atan2(away_y, away_x) - math.pi / 2
    return float(wall_x + off * away_x), float(wall_y + off * away_y), turn_rad
