"""Compiled: how far lengths agree at most with a view that is looked at from all points and sides.

Lengths are coded in steps, and a table bounds how far a direction agrees whose length is in some
step. Eight such bounds make a word, a byte each, so that one sum of words bounds how far a place
agrees with a view, wherever that is looked at from. Float32 adds these bounds without rounding.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.compiling import compiled

if TYPE_CHECKING:
    from numpy.typing import NDArray

POINTS, HALVES, TURNS = 3, 2, 5
"""A view is looked at from so many points, as it is and half a turn aside, and turned in so many
ways."""
LANES = POINTS + 1
"""Bytes for a side: a bound for each point, and how many directions are compared."""
LEVEL_M, LEVELS = 0.0625, 96
"""How long a step is, and in how many lengths are coded."""
MOST = 63
"""A byte bounds how far so many directions agree at most, those of strange places in half."""
QUARTERS = 4
"""Bounds are told in quarters of a direction: float32 adds those without rounding."""
ROUNDING = 1e-5
"""What a bound has to spare: more than float32 is wrong by in how far a direction agrees."""


@compiled
def bounds_by_level(
    views: NDArray[np.float32],
    seen: NDArray[np.bool_],
    same_m: float,
    same: float,
    nearly: float,
    neutral: int,
) -> NDArray[np.uint64]:
    """Return how far each step of length agrees with each direction at most, as words.

    Parameters
    ----------
    views, seen, same_m, same, nearly : as for `surroundings_kernels.best_agreements`
    neutral : int
        Quarters for what cannot be compared.

    Returns
    -------
    ndarray, shape (LEVELS + 1, directions + TURNS - 1)
        From the column of a direction of a place on: for views turned by 2, 1, 0, -1 and -2.
    """
    directions = len(seen)
    told = np.empty((LEVELS + 1, directions, LANES), np.uint8)
    told[:, :, :POINTS] = neutral
    told[:, :, POINTS] = 0
    for level in range(LEVELS):
        shortest = LEVEL_M * level if level else -math.inf
        longest = LEVEL_M * (level + 1) if level + 1 < LEVELS else math.inf
        for j in range(directions):
            if not seen[j]:
                continue
            told[level, j, POINTS] = 1
            for point in range(POINTS):
                length = float(views[point, j])
                nearest = min(max(length, shortest), longest)
                less = abs(length - nearest) / max(same_m, same * max(length, nearest))
                agreeing = min(1.0, max(0.0, 1.0 + nearly + ROUNDING - less))
                told[level, j, point] = math.ceil(QUARTERS * agreeing)
    columns = directions + TURNS - 1
    bounds = np.empty((LEVELS + 1, columns, HALVES * LANES), np.uint8)
    for column in range(columns):
        for side in range(HALVES):
            j = (column - TURNS // 2 - side * (directions // HALVES)) % directions
            bounds[:, column, side * LANES : (side + 1) * LANES] = told[:, j]
    return bounds.view(np.uint64)[:, :, 0]
