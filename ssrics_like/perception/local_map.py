"""A map of the last metres: where walls and free space are around the robot.

Constant in size and cost: the cells repeat themselves every 12.8 m, and what was seen more than
some metres of path ago counts as unknown. So odometry has no time to drift, and what has been
moved does not stay.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.perception import local_map_kernels as kernels

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ssrics_like.perception.observation import Pose

CELLS = 256
"""Cells of 5 cm along each side, a power of 2: 12.8 m. Twice the reach and most of the way
remembered fit in; a robot that drives 5 m straight on meets a few cells again, which it then sees
anew."""
REACH_M = 4.0
"""Beams are followed so far; what lies beyond says little about the place that the robot is at."""
MEMORY_M = 5.0
"""Metres of path after which a cell that was not seen again is forgotten."""


class LocalMap:
    """Where something stands around the robot.

    Attributes
    ----------
    evidence : ndarray, shape (256, 256), int8
        Above 0 occupied, below 0 free.
    seen_m : ndarray, shape (256, 256), float64
        Metres travelled when each cell was last seen.
    """

    def __init__(self) -> None:
        self.evidence = np.zeros((CELLS, CELLS), np.int8)
        self.seen_m = np.full((CELLS, CELLS), -np.inf)

    def take(
        self,
        pose: Pose,
        bearings_rad: NDArray[np.float64],
        ranges_m: NDArray[np.float64],
        travelled_m: float,
    ) -> None:
        """Take a scan.

        Parameters
        ----------
        pose : Pose
            Of the laser, in the frame of odometry.
        bearings_rad, ranges_m : ndarray, shape (beams,), float64
            The conditioned scan: NaN where nothing is known, beyond the reach where nothing stands.
        travelled_m : float
            Length of the path so far, metres; must not fall.
        """
        kernels.take_scan(
            self.evidence, self.seen_m, (pose.x_m, pose.y_m, pose.theta_rad), bearings_rad,
            ranges_m, REACH_M, travelled_m, MEMORY_M,
        )  # fmt: skip

    def state(self, x_m: float, y_m: float, travelled_m: float) -> int:
        """Return whether a place is occupied (1), free (-1) or unknown (0)."""
        oldest_m = travelled_m - MEMORY_M
        return int(kernels.state(self.evidence, self.seen_m, x_m, y_m, oldest_m))
