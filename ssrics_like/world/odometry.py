"""Dead reckoning: where the robot believes it is, from what its wheels count."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from ssrics_like.perception.observation import Pose

if TYPE_CHECKING:
    import numpy as np

    from ssrics_like.world.robot import OdometryProfile


class Odometry:
    """A drifting estimate of the pose.

    Parameters
    ----------
    profile : OdometryProfile
        How it errs.
    start : Pose
        Where it begins, without error.
    rng : numpy.random.Generator
        Source of its errors; the systematic ones are drawn now.

    Attributes
    ----------
    pose : Pose
        The estimate.
    """

    def __init__(self, profile: OdometryProfile, start: Pose, rng: np.random.Generator) -> None:
        self.pose = start
        self._profile = profile
        self._rng = rng
        self._scale = 1.0 + profile.scale * float(rng.standard_normal())
        self._turn_scale = 1.0 + profile.turn_scale * float(rng.standard_normal())

    def advance(self, way_m: float, turn_rad: float) -> Pose:
        """Add a short stretch, as the wheels counted it, and return the new estimate."""
        p = self._profile
        root_way, root_turn = math.sqrt(abs(way_m)), math.sqrt(abs(turn_rad))
        of_way, of_turn, drift = self._rng.standard_normal(3).tolist()
        way = self._scale * way_m + p.way_noise_m * root_way * of_way
        turn = (
            self._turn_scale * turn_rad
            + p.turn_noise_rad * root_turn * of_turn
            + p.drift_rad * root_way * drift
        )
        heading = self.pose.theta_rad + 0.5 * turn
        self.pose = Pose(
            self.pose.x_m + way * math.cos(heading),
            self.pose.y_m + way * math.sin(heading),
            math.remainder(self.pose.theta_rad + turn, math.tau),
        )
        return self.pose
