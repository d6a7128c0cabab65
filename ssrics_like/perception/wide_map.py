"""A coarser and wider map of the last metres: what a hallway leads to is not seen in five.

It is a local map at a scale of 1:2, so that cells are 10 cm, beams are followed for 8 m, and a
cell that was not seen for 10 m of path is forgotten. Size and cost are those of the local map.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from ssrics_like.perception.local_map import MEMORY_M, LocalMap
from ssrics_like.perception.observation import Pose

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

SCALE = 2.0
"""Metres of the world to a metre of the map; a power of 2, so that nothing is rounded."""


class WideMap:
    """Where something stands in the wider surroundings of the robot.

    Attributes
    ----------
    scaled : LocalMap
        The map; all its lengths are those of the world divided by `SCALE`.
    """

    def __init__(self) -> None:
        self.scaled = LocalMap()

    def take(
        self,
        pose: Pose,
        bearings_rad: NDArray[np.float64],
        ranges_m: NDArray[np.float64],
        travelled_m: float,
    ) -> None:
        """Take a scan; the parameters are those of `LocalMap.take`, in metres of the world."""
        self.scaled.take(
            Pose(pose.x_m / SCALE, pose.y_m / SCALE, pose.theta_rad),
            bearings_rad,
            ranges_m / SCALE,
            travelled_m / SCALE,
        )

    def state(self, x_m: float, y_m: float, travelled_m: float) -> int:
        """Return whether a place is occupied (1), free (-1) or unknown (0)."""
        return self.scaled.state(x_m / SCALE, y_m / SCALE, travelled_m / SCALE)

    @staticmethod
    def oldest(travelled_m: float) -> float:
        """Return what was seen before counts as unknown, in metres of the map."""
        return travelled_m / SCALE - MEMORY_M
