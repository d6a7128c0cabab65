"""Door frames across hallways: doorways that part no room from a hallway.

Generated buildings have doorways only between rooms and hallways. Real ones have fire doors and
frames in the middle of a hallway, which look different: the same width on both sides.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ssrics_like.training.obstacles import Obstacles
from ssrics_like.training.probing import ACROSS, free_way, near_any
from ssrics_like.world.buildings.pieces import Piece

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from ssrics_like.perception.observation import Pose
    from ssrics_like.world.grid import GridMap

KEPT = 0.95
TRIES = 60
"""Places that are looked at for all frames together."""
APART_M = 1.6
"""A frame keeps away from what is labelled already."""
HALLWAY_M = (1.3, 3.2)
ALONG_M = (-0.8, -0.4, 0.0, 0.4, 0.8)
EVEN_M = 0.2
"""A hallway is so evenly wide over the 1.6 m around a frame."""
GAP_M = (0.85, 1.7)
JAMBS_M = 0.25
"""What the two jambs take of the hallway at least."""
HALF_DEPTH_M = (0.03, 0.2)
ASIDE = 0.3
"""Share of frames whose gap is not in the middle."""


class _Frame(NamedTuple):
    middle: tuple[float, float]
    jambs: list[Piece]


def door_frames(
    grid: GridMap,
    labelled: ArrayLike,
    count: int,
    start: Pose,
    radius_m: float,
    rng: np.random.Generator,
) -> tuple[GridMap, NDArray[np.float64]]:
    """Put door frames across hallways.

    Parameters
    ----------
    grid : GridMap
        The floor plan; it is left as it is.
    labelled : array_like, shape (n, 2)
        Labelled places, grid frame, metres.
    count : int
        How many frames. Those that find no place are left out.
    start : Pose
        Where the robot starts, grid frame.
    radius_m : float
        The robot's radius.
    rng : numpy.random.Generator
        Where chance comes from.

    Returns
    -------
    grid : GridMap
        The plan with its frames.
    doorways : ndarray, shape (frames, 2)
        The middles of the new doorways, grid frame, metres.
    """
    obstacles = Obstacles(grid, start, radius_m, KEPT)
    floor = np.argwhere(~grid.solid)
    known = np.asarray(labelled, np.float64).reshape(-1, 2)
    made: list[tuple[float, float]] = []
    for _ in range(TRIES):
        if len(made) == count:
            break
        y, x = ((floor[rng.integers(len(floor))] + 0.5) * grid.cell_m).tolist()
        if near_any(x, y, [*known, *made], APART_M):
            continue
        for across in ACROSS:
            frame = _frame(grid, (x, y), across, rng)
            if frame is not None and obstacles.put(frame.jambs):
                made.append(frame.middle)
                break
    return obstacles.grid, np.array(made, np.float64).reshape(-1, 2)


def _frame(
    grid: GridMap, place: tuple[float, float], across: tuple[int, int], rng: np.random.Generator
) -> _Frame | None:
    """Make a frame through a place, or None if no hallway is crossed there in this direction."""
    ax, ay = across
    ways = np.array(
        [
            [
                free_way(grid, place[0] + u * ay, place[1] + u * ax, (s * ax, s * ay), HALLWAY_M[1])
                for s in (1, -1)
            ]
            for u in ALONG_M
        ]
    )
    widths = ways.sum(axis=1)
    ahead, behind = ways[len(ALONG_M) // 2].tolist()
    width = ahead + behind
    if not HALLWAY_M[0] < width < HALLWAY_M[1] or np.ptp(widths) > EVEN_M:
        return None
    gap = float(rng.uniform(GAP_M[0], min(GAP_M[1], width - JAMBS_M)))
    slack = max(0.0, width - gap - JAMBS_M)
    aside = slack * float(rng.uniform(-0.5, 0.5)) if rng.random() < ASIDE else 0.0
    middle = (ahead - behind) / 2 + aside
    half_depth = float(rng.uniform(*HALF_DEPTH_M))
    jambs = []
    for first, last in (
        (middle + gap / 2, ahead + 2 * grid.cell_m),  # well into the wall, so that nothing is left
        (-behind - 2 * grid.cell_m, middle - gap / 2),
    ):
        at, long = (first + last) / 2, last - first
        jambs.append(
            Piece(
                kind="box",
                x_m=place[0] + at * ax,
                y_m=place[1] + at * ay,
                width_m=long if ax else 2 * half_depth,
                depth_m=2 * half_depth if ax else long,
            )
        )
    return _Frame((place[0] + middle * ax, place[1] + middle * ay), jambs)
