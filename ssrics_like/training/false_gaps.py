"""Gaps that are as wide as doorways and are none: between two crates, a shelf and a table."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.training.obstacles import Obstacles
from ssrics_like.training.probing import near_any
from ssrics_like.world.buildings.pieces import Piece
from ssrics_like.world.reachable import reachable

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from ssrics_like.perception.observation import Pose
    from ssrics_like.world.grid import GridMap

KEPT = 0.93
TRIES = 6
"""Places that are tried for each gap."""
APART_M = 1.3
"""The middle of a gap keeps away from what is labelled."""
ROOM_M = 0.45
"""Gaps are made where a disc of this radius gets to, so that the robot goes through some."""
GAP_M = (0.75, 1.5)
LENGTH_M, DEPTH_M, SHIFT_M = (0.1, 1.2), (0.05, 0.7), 0.2
OBLIQUE = 0.4
"""Share of gaps that stand at any angle, not along a wall."""


def false_gaps(
    grid: GridMap,
    labelled: ArrayLike,
    count: int,
    start: Pose,
    radius_m: float,
    rng: np.random.Generator,
) -> GridMap:
    """Put pairs of obstacles with a gap between them on the floor, away from labelled places.

    Parameters
    ----------
    grid : GridMap
        The floor plan; it is left as it is.
    labelled : array_like, shape (n, 2)
        Labelled places, grid frame, metres.
    count : int
        How many gaps. Those that find no place are left out.
    start : Pose
        Where the robot starts, grid frame.
    radius_m : float
        The robot's radius.
    rng : numpy.random.Generator
        Where chance comes from.

    Returns
    -------
    GridMap
        The plan with what was put.
    """
    obstacles = Obstacles(grid, start, radius_m, KEPT)
    floor = np.argwhere(reachable(grid, start.x_m, start.y_m, ROOM_M))
    if not len(floor):
        return grid
    made = 0
    for _ in range(TRIES * count):
        if made == count:
            break
        y, x = ((floor[rng.integers(len(floor))] + 0.5) * grid.cell_m).tolist()
        if not near_any(x, y, labelled, APART_M):
            made += obstacles.put(_pair(x, y, rng))
    return obstacles.grid


def _pair(x_m: float, y_m: float, rng: np.random.Generator) -> list[Piece]:
    """Make the two obstacles around the middle of a gap."""
    if rng.random() < OBLIQUE:
        turn_rad = float(rng.uniform(0.0, math.pi))
    else:
        turn_rad = int(rng.integers(2)) * math.pi / 2
    cos, sin = math.cos(turn_rad), math.sin(turn_rad)
    gap_m = rng.uniform(*GAP_M)
    pair = []
    for side in (1, -1):
        length_m, depth_m = float(rng.uniform(*LENGTH_M)), float(rng.uniform(*DEPTH_M))
        along, off = side * float(gap_m + length_m) / 2, float(rng.uniform(-SHIFT_M, SHIFT_M))
        pair.append(
            Piece(
                kind="box",
                x_m=x_m + along * cos - off * sin,
                y_m=y_m + along * sin + off * cos,
                width_m=length_m,
                depth_m=depth_m,
                turn_rad=turn_rad,
            )
        )
    return pair
