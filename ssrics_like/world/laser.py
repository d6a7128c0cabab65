"""The simulated laser: exact ranges, and what a real sensor makes of them."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.perception.observation import LaserScan, Pose
from ssrics_like.world import ray_kernels

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ssrics_like.world.robot import LaserProfile

LEAP_MAX = 255  # what a byte holds; a wider free square is crossed in several leaps
NO_DISCS = np.empty((0, 3))


def leaps(solid: NDArray[np.bool_]) -> NDArray[np.uint8]:
    """Return how far each cell is from the nearest solid one, in moves of a chess king.

    Parameters
    ----------
    solid : ndarray, shape (rows, columns), bool
        Which cells stop a beam; all cells outside do.

    Returns
    -------
    ndarray, shape (rows, columns), uint8
        0 for a solid cell, at most 255: what `ray_kernels.cast_ray` leaps by.
    """
    from scipy import ndimage  # noqa: PLC0415 - takes long to import

    far = ndimage.distance_transform_cdt(np.pad(~solid, 1), metric="chessboard")
    leap: NDArray[np.uint8] = np.minimum(far[1:-1, 1:-1], LEAP_MAX).astype(np.uint8)
    return leap


class Laser:
    """A laser at work.

    Parameters
    ----------
    profile : LaserProfile
        Its geometry and faults.
    rng : numpy.random.Generator
        Source of its noise.
    """

    def __init__(self, profile: LaserProfile, rng: np.random.Generator) -> None:
        self.profile = profile
        self._rng = rng
        self._first_rad = math.radians(profile.first_bearing_deg)
        self._step_rad = math.radians(profile.step_deg)

    def pose_at(self, body: Pose) -> Pose:
        """Return where the laser is when the robot's centre is at `body`."""
        ahead = self.profile.x_m
        return Pose(
            body.x_m + ahead * math.cos(body.theta_rad),
            body.y_m + ahead * math.sin(body.theta_rad),
            body.theta_rad,
        )

    def scan(
        self,
        leap: NDArray[np.uint8],
        cell_m: float,
        pose: Pose,
        discs: NDArray[np.float64] = NO_DISCS,
    ) -> LaserScan:
        """Sense from a pose.

        Parameters
        ----------
        leap : ndarray, shape (rows, columns), uint8
            Of the building, from `leaps`.
        cell_m : float
            Side of a cell, metres.
        pose : Pose
            Of the laser, in the grid frame.
        discs : ndarray, shape (n, 3)
            People: x, y, radius, metres.
        """
        p = self.profile
        ranges = np.empty(p.beams)
        at = (pose.x_m, pose.y_m, pose.theta_rad)
        ray_kernels.cast_scan(leap, cell_m, at, p.directions, p.range_max_m, ranges)
        if len(discs):
            ray_kernels.cast_discs(at, p.directions, discs, ranges)
            ranges[ranges > p.range_max_m] = np.inf
        if p.mixed:
            chances, where = self._rng.random((2, p.beams))
            ray_kernels.mix_edges(ranges, chances, where, p.mixed, p.edge_m)
        if p.noise_m:
            ranges += self._rng.normal(0.0, p.noise_m, p.beams)
            np.maximum(ranges, 0.0, out=ranges)
        if p.dropout:
            ranges[self._rng.random(p.beams) < p.dropout] = np.inf
        return LaserScan(ranges, self._first_rad, self._step_rad)
