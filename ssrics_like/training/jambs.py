"""Panels and posts at the jambs of doorways: a door in a corner, its open leaf, a stub of wall."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.training.obstacles import Obstacles
from ssrics_like.training.probing import ACROSS, free_way
from ssrics_like.world.buildings.pieces import Piece

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from ssrics_like.perception.observation import Pose
    from ssrics_like.world.grid import GridMap

KEPT = 0.93
WALL_M = (0.8, 1.0, 1.2)
"""So far to both sides of a doorway its wall is looked for."""
HALF_WIDTH_M = 1.2
"""A jamb is looked for no farther from the middle than this."""
PANELS, POSTS = 0.3, 0.1
"""Shares of the four corners of each doorway that have one."""
PANEL_ASIDE_M, PANEL_M = (0.0, 0.25), (0.4, 2.5)
POST_ASIDE_M, POST_M = (-0.05, 0.6), (0.1, 0.5)
AWAY_M = THICK_M = (0.05, 0.1, 0.3)
"""How far from the doorway's line it begins, and how thick it is."""


def clutter_jambs(
    grid: GridMap, doorways: ArrayLike, start: Pose, radius_m: float, rng: np.random.Generator
) -> GridMap:
    """Put panels and posts beside the jambs of doorways, square to their walls.

    Parameters
    ----------
    grid : GridMap
        The floor plan; it is left as it is.
    doorways : array_like, shape (n, 2)
        Their middles, grid frame, metres.
    start : Pose
        Where the robot starts, grid frame.
    radius_m : float
        The robot's radius.
    rng : numpy.random.Generator
        Where chance comes from.

    Returns
    -------
    GridMap
        The plan with what was put; what would shut the robot off is left out.
    """
    obstacles = Obstacles(grid, start, radius_m, KEPT)
    for x, y in np.asarray(doorways, np.float64).reshape(-1, 2).tolist():
        wall = _wall(grid, x, y)
        for towards in (1, -1):
            jamb_m = free_way(grid, x, y, (towards * wall[0], towards * wall[1]), HALF_WIDTH_M)
            for side in (1, -1):
                piece = _piece((x, y), wall, towards, jamb_m, side, rng)
                if piece is not None:
                    obstacles.put([piece])
    return obstacles.grid


def _wall(grid: GridMap, x_m: float, y_m: float) -> tuple[int, int]:
    """Return the direction that a doorway's wall runs in: that with more wall to both sides."""

    def solid(direction: tuple[int, int]) -> int:
        return sum(
            not grid.is_free(x_m + s * far * direction[0], y_m + s * far * direction[1])
            for s in (1, -1)
            for far in WALL_M
        )

    return max(ACROSS, key=solid)


def _piece(
    doorway: tuple[float, float],
    wall: tuple[int, int],
    towards: int,
    jamb_m: float,
    side: int,
    rng: np.random.Generator,
) -> Piece | None:
    """Make what stands at one corner of a doorway; mostly there is nothing."""
    drawn = rng.random()
    if drawn < PANELS:
        aside_m, length_m = rng.uniform(*PANEL_ASIDE_M), rng.uniform(*PANEL_M)
    elif drawn < PANELS + POSTS:
        aside_m, length_m = rng.uniform(*POST_ASIDE_M), rng.uniform(*POST_M)
    else:
        return None
    away_m, thick_m = rng.choice(AWAY_M), rng.choice(THICK_M)
    along = towards * float(jamb_m + aside_m + thick_m / 2)
    off = side * float(away_m + length_m / 2)
    return Piece(
        kind="box",
        x_m=doorway[0] + along * wall[0] + off * wall[1],
        y_m=doorway[1] + along * wall[1] + off * wall[0],
        width_m=float(thick_m if wall[0] else length_m),
        depth_m=float(length_m if wall[0] else thick_m),
    )
