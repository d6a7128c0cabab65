"""The compiled inner loop of the view of what surrounds a place."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from ssrics_like.compiling import compiled
from ssrics_like.perception.local_map_kernels import march

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


@compiled
def look_round(
    evidence: NDArray[np.int8],
    seen_m: NDArray[np.float64],
    place: tuple[float, float, float],
    limit_m: float,
    oldest_m: float,
    out: NDArray[np.float64],
) -> None:
    """Look in all directions, the first one ahead, going counter-clockwise.

    Parameters
    ----------
    evidence, seen_m, oldest_m : as for `local_map_kernels.cell_state`
    place : tuple of float
        x, y and the direction ahead; metres of the map, radians.
    limit_m : float
        As far as it is looked, metres of the map.
    out : ndarray, shape (2, directions)
        Filled with how far it goes on, and how much of that is unknown.
    """
    directions = out.shape[1]
    for k in range(directions):
        angle = place[2] + math.tau * k / directions
        out[0, k], out[1, k] = march(
            evidence, seen_m, (place[0], place[1]), (math.cos(angle), math.sin(angle)), limit_m,
            oldest_m,
        )  # fmt: skip
