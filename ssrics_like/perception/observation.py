"""What the robot senses at one moment: a laser scan and where it was taken."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ssrics_like.poses import Pose

__all__ = ["LaserScan", "Observation", "Pose"]


@dataclass(frozen=True)
class LaserScan:
    """One sweep of a planar laser.

    Attributes
    ----------
    ranges_m : ndarray, shape (beams,), float64
        Range of each beam in metres, in order of rising bearing (from the right
        to the left). Infinity marks a beam that met nothing, NaN one without any
        answer; conditioning deals with both.
    angle_min_rad : float
        Bearing of the first beam; 0 is straight ahead, positive is left.
    angle_increment_rad : float
        Step between neighbouring beams, positive.
    """

    ranges_m: NDArray[np.float64]
    angle_min_rad: float
    angle_increment_rad: float

    @cached_property
    def bearings_rad(self) -> NDArray[np.float64]:
        """Bearing of each beam, shape (beams,)."""
        beams = np.arange(len(self.ranges_m), dtype=np.float64)
        return self.angle_min_rad + self.angle_increment_rad * beams


@dataclass(frozen=True, slots=True)
class Observation:
    """One record of a source: what was sensed, when and from where.

    Attributes
    ----------
    index : int
        0-based order of the scan in its source.
    t_s : float
        Seconds, never falling within a source.
    pose : Pose
        Pose of the sensor in the frame that the source states.
    scan : LaserScan
        The laser's readings.
    true_pose : Pose or None
        The true pose where a simulator knows it.
    """

    index: int
    t_s: float
    pose: Pose
    scan: LaserScan
    true_pose: Pose | None = None
