"""Poses in the plane, and how one lies in the frame of another."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Pose:
    """A position and heading; the frame is stated by whoever hands it out.

    Attributes
    ----------
    x_m, y_m : float
        Metres.
    theta_rad : float
        Radians, counter-clockwise, 0 along the x axis.
    """

    x_m: float
    y_m: float
    theta_rad: float

    def distance_m(self, other: Pose) -> float:
        """Return how far another pose lies from this one; not finite where one of them is not."""
        return math.hypot(float(other.x_m) - float(self.x_m), float(other.y_m) - float(self.y_m))

    def onward(self, step: Pose) -> Pose:
        """Return the pose that `step` is, seen from this one; undoes `seen_from`."""
        cos, sin = math.cos(self.theta_rad), math.sin(self.theta_rad)
        return Pose(
            self.x_m + cos * step.x_m - sin * step.y_m,
            self.y_m + sin * step.x_m + cos * step.y_m,
            math.remainder(self.theta_rad + step.theta_rad, math.tau),
        )

    def seen_from(self, origin: Pose) -> Pose:
        """Return this pose in the frame of another one."""
        cos, sin = math.cos(origin.theta_rad), math.sin(origin.theta_rad)
        dx, dy = self.x_m - origin.x_m, self.y_m - origin.y_m
        return Pose(
            cos * dx + sin * dy,
            cos * dy - sin * dx,
            math.remainder(self.theta_rad - origin.theta_rad, math.tau),
        )
