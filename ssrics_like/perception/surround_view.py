"""The view of what surrounds a place, in the place's own frame.

A scan looks from where the robot happened to stand, the way it happened to go. What surrounds a
doorway, looked at from its middle, along the direction through, is the same from either side and
whichever way one goes, half a turn aside: by that a place is known again.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.perception import surround_kernels
from ssrics_like.perception.wide_map import SCALE, WideMap

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ssrics_like.perception.observation import Pose

DIRECTIONS = 36
"""Ten degrees apart."""
REACH_M = 6.0


def surround_view(wide: WideMap, place: Pose, travelled_m: float) -> NDArray[np.float32]:
    """Describe what surrounds a place.

    Parameters
    ----------
    wide : WideMap
        The surroundings.
    place : Pose
        Where, and which direction is ahead; frame of odometry.
    travelled_m : float
        Metres travelled so far.

    Returns
    -------
    ndarray, shape (72,), float32
        How far it goes on in 36 directions, the first one ahead, then counter-clockwise, 6 m at
        most; then how much of each of these is unknown. Metres.
    """
    view = np.empty((2, DIRECTIONS))
    surround_kernels.look_round(
        wide.scaled.evidence, wide.scaled.seen_m,
        (place.x_m / SCALE, place.y_m / SCALE, place.theta_rad),
        REACH_M / SCALE, WideMap.oldest(travelled_m), view,
    )  # fmt: skip
    described: NDArray[np.float32] = (view * SCALE).astype(np.float32).ravel()
    return described
