"""How far one sees from a place, in all directions: what is at the end of the hallway.

Rooms along a hallway are alike as far as a local map reaches. How far the hallway goes on from
their doors, this way and that way, is not.
"""

from __future__ import annotations

import math
from collections import deque
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ssrics_like.perception import vista_kernels

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ssrics_like.perception.observation import Pose

DIRECTIONS = 36
"""Ten degrees apart. What is seen up to seven degrees aside counts: a beam that goes down a hallway
is narrow, and where a doorway faces is not known that well."""
NEAR_M = 1.5
"""From so near a place one sees as far as from the place, but for what is near itself."""
FARTHEST_M = 60.0
"""A longer reading is taken for none: many lasers say so by a large number."""
MEMORY_M = 10.0
"""Metres of path after which a scan is forgotten, as is a cell of the wide map."""
MOVED_M, TURNED_RAD = 0.1, 0.05
"""A scan taken nearer to the one kept last, and less turned, shows nothing new."""
MOST = 500
"""Scans that are kept, of a robot that turns and turns."""


class _Kept(NamedTuple):
    travelled_m: float
    pose: Pose
    bearings_rad: NDArray[np.float64]
    ranges_m: NDArray[np.float64]


class Vista:
    """Keeps the scans of the last metres of path, as the laser gave them."""

    def __init__(self) -> None:
        self._kept: deque[_Kept] = deque(maxlen=MOST)

    def take(
        self,
        pose: Pose,
        bearings_rad: NDArray[np.float64],
        ranges_m: NDArray[np.float64],
        travelled_m: float,
    ) -> None:
        """Take a scan; the parameters are those of `LocalMap.take`, but for `ranges_m`.

        These are the readings as they came; one that is not above 0 and below `FARTHEST_M` says
        nothing.
        """
        if self._kept:
            before = self._kept[-1]
            turn_rad = math.remainder(pose.theta_rad - before.pose.theta_rad, math.tau)
            if travelled_m - before.travelled_m < MOVED_M and abs(turn_rad) < TURNED_RAD:
                return
        self._kept.append(_Kept(travelled_m, pose, bearings_rad, ranges_m))
        while self._kept[0].travelled_m < travelled_m - MEMORY_M:
            self._kept.popleft()

    def view_of(self, place: Pose) -> NDArray[np.float32]:
        """Tell how far was seen from a place.

        Returns
        -------
        ndarray, shape (36,), float32
            Metres, the first one ahead, then counter-clockwise; 0 where nothing was seen.
        """
        out = np.zeros(DIRECTIONS)
        at = (place.x_m, place.y_m, place.theta_rad)
        for kept in self._kept:
            if kept.pose.distance_m(place) < NEAR_M:
                pose = (kept.pose.x_m, kept.pose.y_m, kept.pose.theta_rad)
                vista_kernels.look_far(pose, kept.bearings_rad, kept.ranges_m, at, FARTHEST_M, out)
        return out.astype(np.float32)
