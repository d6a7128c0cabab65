"""Marks where the robot passes a neck between obstacles to its left and right."""

from __future__ import annotations

import math
from collections import deque
from typing import TYPE_CHECKING, Annotated, ClassVar, NamedTuple

import numpy as np
from pydantic import Field

from ssrics_like.designators.path import STEP_M, Steps
from ssrics_like.designators.peaks import Peaks
from ssrics_like.designators.readings import ReadingSettings, read

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ssrics_like.designators.protocol import DesignatorSettings, Grid, Mark
    from ssrics_like.perception.observation import Observation, Pose

    Array = NDArray[np.float64]

LAG_M = 0.6  # a neck is judged so far behind the robot, when the space after it is known
SIDES_M = (0.2, 1.0)  # from here to there before and after the neck it must be wider
BEHIND_M = LAG_M + SIDES_M[1]
REACH_M = 4.0  # an obstacle farther aside leaves that side as wide as this
SLAB_M = 0.1  # half the thickness of the slice across the path in which obstacles are sought
BODY_M = 0.1  # nothing that stands can lie nearer to the path: the robot has passed
LOST_M = 2.0  # over a longer step the way between is not known

_FAN_RAD = np.radians((-40.0, -20.0, 0.0, 20.0, 40.0))  # a door may be crossed obliquely
_ROUNDING_M = 1e-9


class DoorwayGapSettings(ReadingSettings):
    """Settings of `DoorwayGap`.

    Attributes
    ----------
    max_gap_m : float
        Widest neck that is marked.
    widen_m : float
        How much wider it must be within a metre before and after.
    apart_m : float
        Least distance between two marks, metres of path.
    """

    max_gap_m: Annotated[float, Field(gt=0.0, le=2.0 * REACH_M)] = 1.2
    widen_m: Annotated[float, Field(ge=0.0, le=2.0 * REACH_M)] = 0.3
    apart_m: Annotated[float, Field(gt=0.0, le=100.0)] = 1.0


class _Way(NamedTuple):
    """Places along the recent path: metres travelled, position, direction, scan, free sides."""

    at_m: Array
    x_m: Array
    y_m: Array
    direction_rad: Array
    scan: Array
    left_m: Array  # shape (places, directions), as is the next
    right_m: Array

    @property
    def width_m(self) -> Array:
        """Free width across the path, the least over the fan of directions."""
        width: Array = (self.left_m + self.right_m).min(axis=1)
        return width


class DoorwayGap:
    """Marks the narrowest place of a neck that is wider before and after.

    Obstacles are the points that scans of the last metres of path met, kept in the frame
    of the poses; local odometry is enough. At each 0.1 m of path, also between scans that
    are farther apart, the free width is the distance to the nearest obstacle on the left
    plus that on the right, in a slice of 0.2 m across the path, the least over five
    directions within 40 degrees. A place is a neck if it is at most `max_gap_m` wide and
    both before and after it the path gets `widen_m` wider. The strength is `max_gap_m`
    less the width, metres. The last 0.6 m of a drive are not judged.

    Parameters
    ----------
    settings : DoorwayGapSettings
        The widths.

    References
    ----------
    Thrun (1998), "Learning metric-topological maps for indoor mobile robot navigation",
    Artificial Intelligence 99: narrow passages are where clearance has a local minimum.
    Here clearance is taken along the path, not over a map.
    """

    Settings: ClassVar[type[DesignatorSettings]] = DoorwayGapSettings
    GRID: ClassVar[Grid] = {
        "max_gap_m": (0.95, 1.05, 1.2, 1.5, 1.9),
        "widen_m": (0.15, 0.3, 0.5, 0.8, 1.2),
        "apart_m": (1.0, 2.0, 4.0),
    }
    hindsight: ClassVar[bool] = False
    source: ClassVar[str] = "Thrun 1998"

    def __init__(self, settings: DoorwayGapSettings) -> None:
        self._settings = settings
        self._steps = Steps()
        self._peaks = Peaks(0.0, settings.apart_m, LAG_M)
        self._points: deque[tuple[float, Array, Array]] = deque()
        self._way: _Way | None = None
        self._last: tuple[float, Pose, int] | None = None
        self._judged_m = -math.inf
        self._newest = 0

    def update(self, observation: Observation) -> list[Mark]:
        """Take the next observation; see `Designator`.

        Raises
        ------
        ScanError
            The scan has no beams.
        """
        self._newest = observation.index
        at_m = self._steps.update(observation.pose)
        pose = observation.pose
        if at_m is None or not math.isfinite(pose.theta_rad + pose.x_m + pose.y_m):
            return []
        last, self._last = self._last, (at_m, pose, observation.index)
        if last is not None and math.dist(_place(last[1]), _place(pose)) > LOST_M:
            self._points.clear()
            self._way = last = None
        x_m, y_m = self._obstacles(observation)
        self._points.append((at_m, x_m, y_m))
        while self._points[0][0] < at_m - BEHIND_M:
            self._points.popleft()
        if self._way is not None:
            self._way = _narrowed(self._way, x_m, y_m)
        if last is not None:
            self._go_on(last, at_m, observation)
        return self._judge(at_m)

    def flush(self) -> list[Mark]:
        """End the drive; see `Designator`."""
        return self._peaks.flush(self._newest)

    def _obstacles(self, observation: Observation) -> tuple[Array, Array]:
        """Return the points that a scan met near the robot, in the frame of the poses."""
        ranges, bearings, measured = read(observation.scan, self._settings)
        near = measured & (ranges < REACH_M + BEHIND_M)
        pose = observation.pose
        angles = bearings[near] + pose.theta_rad
        ranges = ranges[near]
        return pose.x_m + ranges * np.cos(angles), pose.y_m + ranges * np.sin(angles)

    def _go_on(self, last: tuple[float, Pose, int], at_m: float, observation: Observation) -> None:
        """Add the places from the last step to this one."""
        last_m, before, scan = last
        pose = observation.pose
        dx, dy = pose.x_m - before.x_m, pose.y_m - before.y_m
        places = max(round(math.hypot(dx, dy) / STEP_M), 1)
        share = np.arange(1, places + 1) / places
        wide = np.full((places, _FAN_RAD.size), REACH_M)
        added = _Way(
            last_m + share * (at_m - last_m),
            before.x_m + share * dx,
            before.y_m + share * dy,
            np.full(places, math.atan2(dy, dx)),
            np.where(share < 0.5, float(scan), float(observation.index)),  # noqa: PLR2004 - nearer
            wide,
            wide,
        )
        _, x_m, y_m = zip(*self._points, strict=True)
        added = _narrowed(added, np.concatenate(x_m), np.concatenate(y_m))
        if self._way is None:
            self._way = added
            return
        recent = self._way.at_m >= at_m - BEHIND_M - LOST_M
        self._way = _Way(
            *(np.concatenate([old[recent], new]) for old, new in zip(self._way, added, strict=True))
        )

    def _judge(self, now_m: float) -> list[Mark]:
        """Score the places that lie a lag behind the robot."""
        marks: list[Mark] = []
        way = self._way
        if way is None:
            return marks
        due = (way.at_m > self._judged_m) & (way.at_m <= now_m - LAG_M + _ROUNDING_M)
        width_m = way.width_m if due.any() else way.at_m
        for i in np.flatnonzero(due):
            far = way.at_m - way.at_m[i]
            score = math.nan
            if width_m[i] <= self._settings.max_gap_m:
                widest = [
                    width_m[(side >= SIDES_M[0]) & (side <= SIDES_M[1])].max(initial=0.0)
                    for side in (-far, far)
                ]
                if min(widest) >= width_m[i] + self._settings.widen_m:
                    score = self._settings.max_gap_m - float(width_m[i])
            self._judged_m = float(way.at_m[i])
            marks += self._peaks.update(self._judged_m, score, int(way.scan[i]), self._newest)
        return marks


def _place(pose: Pose) -> tuple[float, float]:
    return pose.x_m, pose.y_m


def _narrowed(way: _Way, x_m: Array, y_m: Array) -> _Way:
    """Return the places with the obstacles at `x_m`, `y_m` taken into account."""
    if x_m.size == 0:
        return way
    angles = way.direction_rad[:, None] + _FAN_RAD
    cos, sin = np.cos(angles)[..., None], np.sin(angles)[..., None]
    dx = (x_m - way.x_m[:, None])[:, None]
    dy = (y_m - way.y_m[:, None])[:, None]
    beside = np.abs(cos * dx + sin * dy) <= SLAB_M
    aside = cos * dy - sin * dx
    left = np.where(beside & (aside >= BODY_M), aside, REACH_M).min(axis=2)
    right = np.where(beside & (aside <= -BODY_M), -aside, REACH_M).min(axis=2)
    return way._replace(left_m=np.minimum(way.left_m, left), right_m=np.minimum(way.right_m, right))
