"""Egomotion: how the robot moves, from its wheels and from what stays where it is.

Wheels mismeasure ways and turns by a few per cent. What a laser sees does not move, so that a scan
laid on what was seen shortly before tells how the robot moved since, as optic flow tells people and
animals (Gibson 1950). What was seen is forgotten after some way: this is path integration, in which
small errors still add up, and no map.
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
CELL_M, CELLS, LINES = 0.25, 208, 3
"""What was seen is kept in cells of this side, so many each way (more than twice the reach), with
so many lines in each at most."""
WITHIN_M = 60.0
"""What was seen is forgotten after so much way."""
ADDED_M, ADDED_RAD = 0.2, 0.2
"""After so much way or turning what a scan shows is added."""
ODOMETRY_M, ODOMETRY_RAD = 0.05, 0.05
"""Share of way and turning that odometry is expected to be off, one standard deviation."""
FLOOR_M, FLOOR_RAD = 0.004, 0.004
"""What it may be off besides, from scan to scan."""
ROUNDS = 12
FEW, SHARE = 20, 0.3
"""Fewer points near lines, or a smaller share, say nothing: then odometry alone counts."""
FAR_M, FAR_RAD = 0.1, 0.1
"""A match farther from what odometry says is a mistake."""
ELSEWHERE = 0.6
"""Where fewer of the readings lie about where those of the scan just before do, the robot was
carried. `benchmarks/bench_egomotion.py` says how often that is noticed, and how often without
reason."""
SLIPS_RAD = tuple(np.linspace(-0.3, 0.3, 13).tolist())
SLIPPED = 0.8
"""Unless that share does if it has turned by so much more than its wheels say: they slip."""
ONWARD_M, ONWARD_RAD = 0.5, 0.5
"""Scans farther apart than this cannot be compared so."""
STILL_M, STILL_RAD = 1e-4, 1e-4


class Egomotion:
    """Corrects odometry by matching scans.

    Each scan's points are laid on the lines that were seen lately: the distance is that of Censi
    (2008), "An ICP variant using a point-to-line metric", what they are laid on a grid of what came
    before, as in Vizzo et al. (2023), "KISS-ICP". Odometry is the prior, so that along a bare
    corridor, where scans say nothing, odometry alone counts. The first line that was seen of a wall
    stays until it is forgotten, so that errors do not add up while the robot goes about in a room.

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
        self._lines = np.zeros((CELLS, CELLS, LINES, 4))
        self._seen_m = np.zeros((CELLS, CELLS, LINES))
        self._cells = np.zeros((CELLS, CELLS, 3), np.int64)
        self._added = self.pose
        self._travelled_m = 0.0
        self._last = np.empty(0)

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
        readings_m = _usable(ranges_m)
        if before is None:
            self.pose = odometry
            self._add(bearings_rad, readings_m)
            self._last = readings_m
            return odometry
        step = odometry.seen_from(before)
        way_m, turn_rad = math.hypot(step.x_m, step.y_m), abs(step.theta_rad)
        self._travelled_m += way_m
        if way_m < STILL_M and turn_rad < STILL_RAD:
            return self.pose
        points = _points(bearings_rad, readings_m)
        elsewhere = False
        if way_m < ONWARD_M and turn_rad < ONWARD_RAD:
            seen = self._seen_step(bearings_rad, points, step)
            elsewhere = seen is None
            step = seen or step
        if elsewhere:
            self.carried += 1
            self._cells[:] = 0
        self._last = readings_m
        self.pose = self._matched(self.pose.onward(step), points, way_m, turn_rad)
        if elsewhere or not _is_about(self.pose, self._added, ADDED_M, ADDED_RAD):
            self._add(bearings_rad, readings_m)
        return self.pose

    def _seen_step(
        self, bearings_rad: NDArray[np.float64], points: NDArray[np.float64], step: Pose
    ) -> Pose | None:
        """Return the step, turned as the scans have it if they disagree; None if none fits."""
        first_rad, last_rad = float(bearings_rad[0]), float(bearings_rad[-1])
        step_rad = (last_rad - first_rad) / max(len(bearings_rad) - 1, 1) or 1.0

        def agreement(turn_rad: float) -> tuple[float, int]:
            agree, compared = kernels.agreeing(
                self._last, 0.5 * (first_rad + last_rad), step_rad, points,
                (step.x_m, step.y_m, step.theta_rad + turn_rad),
            )  # fmt: skip
            return (agree / compared if compared else 0.0), int(compared)

        share, compared = agreement(0.0)
        if compared < FEW or share >= SLIPPED:
            return step
        shares = [share if n >= FEW else 0.0 for share, n in map(agreement, SLIPS_RAD)]
        best = int(np.argmax(shares))
        if shares[best] < SLIPPED:
            return step if share >= ELSEWHERE else None
        return Pose(step.x_m, step.y_m, step.theta_rad + SLIPS_RAD[best])

    def _add(self, bearings_rad: NDArray[np.float64], ranges_m: NDArray[np.float64]) -> None:
        """Add what a scan shows to what was seen lately."""
        here = (self.pose.x_m, self.pose.y_m, self.pose.theta_rad)
        lines = np.empty((len(bearings_rad), 4))
        kernels.fit_lines(bearings_rad, ranges_m, lines)
        kernels.remember(
            self._lines, self._seen_m, self._cells, CELL_M, here, lines, self._travelled_m,
            WITHIN_M,
        )  # fmt: skip
        self._added = self.pose

    def _matched(
        self, guess: Pose, points: NDArray[np.float64], way_m: float, turn_rad: float
    ) -> Pose:
        """Return where a scan was taken, by what was seen lately; the guess where nothing fits."""
        x_m, y_m, theta_rad, near = kernels.match(
            self._lines, self._seen_m, self._cells, CELL_M, points,
            (guess.x_m, guess.y_m, guess.theta_rad),
            (ODOMETRY_M * way_m + FLOOR_M, ODOMETRY_RAD * turn_rad + FLOOR_RAD),
            ROUNDS, self._travelled_m - WITHIN_M,
        )  # fmt: skip
        found = Pose(x_m, y_m, math.remainder(theta_rad, math.tau))
        fits = near >= max(FEW, SHARE * len(points)) and _is_about(found, guess, FAR_M, FAR_RAD)
        return found if fits else guess


def _is_about(one: Pose, other: Pose, within_m: float, within_rad: float) -> bool:
    turned = abs(math.remainder(one.theta_rad - other.theta_rad, math.tau))
    return one.distance_m(other) < within_m and turned < within_rad


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
