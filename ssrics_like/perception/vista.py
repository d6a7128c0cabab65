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
"""Ten degrees apart. What is seen up to ten degrees aside counts: what lies at the end of a hallway
is narrow, and where a doorway faces is not known that well."""
NEAR_M = 1.5
"""From so near a place one sees as far as from the place, but for what is near itself."""
NEAREST_M, FARTHEST_M = 6.0, 60.0
"""What is nearer is told by the view of surroundings. A longer reading is taken for none: many
lasers say so by a large number."""
RATIO = 1.06
"""Lengths that differ by so much at most are of one wall."""
FEWEST = 3
"""Beams that make an end, or show that it goes on: one or two slip through any gap."""
FAR_M = 12.0
"""Where no end is seen it matters how far it goes on at least, if it is farther than this."""
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
            Metres to the widest wall that faces it, the first one ahead, then counter-clockwise;
            below 0 where there is none and it goes on at least so far; 0 where neither is known.
        """
        classes = math.ceil(math.log(FARTHEST_M / NEAREST_M) / math.log(RATIO)) + 1
        lengths_m = np.zeros((DIRECTIONS, classes))
        counts, beams = np.zeros((2, DIRECTIONS, classes), np.int64)
        at = (place.x_m, place.y_m, place.theta_rad)
        for kept in self._kept:
            if kept.pose.distance_m(place) < NEAR_M:
                pose = (kept.pose.x_m, kept.pose.y_m, kept.pose.theta_rad)
                vista_kernels.look_far(
                    pose, kept.bearings_rad, kept.ranges_m, at, FARTHEST_M, NEAREST_M, RATIO,
                    lengths_m, counts, beams,
                )  # fmt: skip
        ends = _ends(lengths_m, counts)
        return np.where(ends > 0.0, ends, _goes_on(beams)).astype(np.float32)


def _ends(lengths_m: NDArray[np.float64], counts: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return how far the widest wall is in each direction, 0 for none; see `look_far`.

    A wall may lie where two classes of lengths meet. Far beams lie farther apart, so that each
    counts for as much as it is long.
    """
    width, walls = (
        lengths + np.pad(lengths[:, 1:], ((0, 0), (0, 1))) for lengths in (lengths_m, counts)
    )
    widest = np.arange(DIRECTIONS), np.argmax(width, axis=1)
    return np.where(walls[widest] >= FEWEST, width[widest] / np.maximum(walls[widest], 1), 0.0)


def _goes_on(beams: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return how far it goes on in each direction at least, below 0; 0 where that is not far."""
    farther = np.cumsum(beams[:, ::-1], axis=1)[:, ::-1]
    lengths_m = NEAREST_M * RATIO ** ((farther >= FEWEST).sum(axis=1) - 1.0)
    return np.where(lengths_m > FAR_M, -lengths_m, 0.0)
