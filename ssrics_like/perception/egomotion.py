"""Egomotion: how the robot moves, from its wheels and from what stays where it is.

Wheels mismeasure ways and turns by a few per cent. What a laser sees does not move, so that two
scans taken near each other tell exactly how the robot moved between them, as optic flow tells
people and animals (Gibson 1950). Nothing is remembered but one scan: this is path integration, in
which small errors still add up.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.perception import egomotion_kernels as kernels
from ssrics_like.poses import Pose

if TYPE_CHECKING:
    from numpy.typing import NDArray

REACH_M = 25.0
"""Readings beyond this are not used: too few hit the same wall."""
POINTS = 180
"""At most so many points of a scan, spread evenly, are matched."""
KEY_M, KEY_RAD = 0.5, 0.5
"""A scan is matched with the last key scan; after so much way or turning it becomes the next."""
ODOMETRY_M, ODOMETRY_RAD = 0.05, 0.05
"""Share of way and turning that odometry is expected to be off, one standard deviation."""
FLOOR_M, FLOOR_RAD, SWERVE_RAD = 0.004, 0.004, 0.005
"""What it may be off besides: always, and in heading for the square root of each metre."""
ROUNDS = 12
FEW = 20
"""Fewer points near lines say nothing."""
SHARE = 0.4
"""Where a smaller share of the points lies near lines, scans do not fit: then odometry counts."""
ELSEWHERE = 0.6
"""Where fewer of the readings lie about where those of the scan just before do, the robot was
carried. `benchmarks/bench_egomotion.py` says how often that is noticed, and how often without
reason."""
ONWARD_M, ONWARD_RAD = 0.5, 0.5
"""Scans farther apart than this cannot be compared so."""
FAR_M, FAR_RAD = 0.15, 0.15
"""A match farther from what odometry says is a mistake."""
STILL_M, STILL_RAD = 1e-4, 1e-4


class Egomotion:
    """Corrects odometry by matching scans.

    Each scan's points are laid on the lines of the last key scan: the method of Censi (2008), "An
    ICP variant using a point-to-line metric", with odometry as a prior, so that along a bare
    corridor, where scans say nothing, odometry alone counts.

    Attributes
    ----------
    pose : Pose
        Where the laser is, in a frame that begins as odometry's and drifts far less.
    carried : int
        How often it was suddenly elsewhere.
    """

    def __init__(self) -> None:
        self.pose = Pose(0.0, 0.0, 0.0)
        self.carried = 0
        self._odometry: Pose | None = None
        self._key = Pose(0.0, 0.0, 0.0)
        self._lines = np.empty((0, 4))
        self._beams = (0.0, 1.0)
        self._last = np.empty(0)
        self._way_m = self._turn_rad = 0.0

    def update(
        self, odometry: Pose, bearings_rad: NDArray[np.float64], ranges_m: NDArray[np.float64]
    ) -> Pose:
        """Take a scan.

        Parameters
        ----------
        odometry : Pose
            Of the laser, as the wheels have it. One that is not finite moves nothing.
        bearings_rad, ranges_m : ndarray, shape (beams,), float64
            The scan as the laser gave it: infinity or NaN where nothing came back.

        Returns
        -------
        Pose
            The corrected pose.
        """
        if not math.isfinite(odometry.x_m + odometry.y_m + odometry.theta_rad):
            return self.pose
        before, self._odometry = self._odometry, odometry
        if before is None:
            self.pose = odometry
            self._keep(bearings_rad, ranges_m)
            return odometry
        step = odometry.seen_from(before)
        way_m, turn_rad = math.hypot(step.x_m, step.y_m), abs(step.theta_rad)
        self._way_m += way_m
        self._turn_rad += turn_rad
        if way_m < STILL_M and turn_rad < STILL_RAD:
            return self.pose
        usable = _usable(ranges_m)
        points = _points(bearings_rad, usable)
        if max(way_m / ONWARD_M, turn_rad / ONWARD_RAD) < 1.0 and self._is_elsewhere(points, step):
            self.carried += 1
        self._last = usable
        guess = self.pose.onward(step).seen_from(self._key)
        found = self._matched(guess, points)
        seen = guess if found is None else found
        self.pose = self._key.onward(seen)
        far = math.hypot(seen.x_m, seen.y_m) > KEY_M or abs(seen.theta_rad) > KEY_RAD
        if far or found is None:
            self._keep(bearings_rad, ranges_m)
        return self.pose

    def _is_elsewhere(self, points: NDArray[np.float64], step: Pose) -> bool:
        """Tell whether this scan cannot have been taken a step from the one before."""
        agree, compared = kernels.agreeing(
            self._last, *self._beams, points, (step.x_m, step.y_m, step.theta_rad)
        )
        return bool(compared >= FEW and agree < ELSEWHERE * compared)

    def _keep(self, bearings_rad: NDArray[np.float64], ranges_m: NDArray[np.float64]) -> None:
        """Make this scan the key scan."""
        beams = len(bearings_rad)
        self._key = self.pose
        self._lines = np.empty((beams, 4))
        self._last = _usable(ranges_m)
        kernels.fit_lines(bearings_rad, self._last, self._lines)
        step_rad = float(bearings_rad[-1] - bearings_rad[0]) / max(beams - 1, 1)
        self._beams = 0.5 * float(bearings_rad[0] + bearings_rad[-1]), step_rad or 1.0
        self._way_m = self._turn_rad = 0.0

    def _matched(self, guess: Pose, points: NDArray[np.float64]) -> Pose | None:
        """Return the pose in the frame of the key scan; None where the scans do not fit."""
        x_m, y_m, theta_rad, near = kernels.match(
            self._lines, *self._beams, points, (guess.x_m, guess.y_m, guess.theta_rad),
            ODOMETRY_M * self._way_m + FLOOR_M,
            ODOMETRY_RAD * self._turn_rad + FLOOR_RAD + SWERVE_RAD * math.sqrt(self._way_m),
            ROUNDS,
        )  # fmt: skip
        if near < max(FEW, SHARE * len(points)):
            return None
        found = Pose(x_m, y_m, theta_rad)
        turned = abs(math.remainder(theta_rad - guess.theta_rad, math.tau))
        return found if guess.distance_m(found) < FAR_M and turned < FAR_RAD else None


def _points(
    bearings_rad: NDArray[np.float64], ranges_m: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return where readings met something, frame of the laser, shape (points, 2)."""
    seen = np.flatnonzero(np.isfinite(ranges_m))
    seen = seen[:: max(math.ceil(len(seen) / POINTS), 1)]
    directions = np.column_stack([np.cos(bearings_rad[seen]), np.sin(bearings_rad[seen])])
    points: NDArray[np.float64] = ranges_m[seen, None] * directions
    return points


def _usable(ranges_m: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the readings with infinity where nothing came back, or from too far away."""
    usable: NDArray[np.float64] = np.where(ranges_m < REACH_M, ranges_m, np.inf)  # so NaN too
    return usable
