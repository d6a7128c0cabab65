"""The robot's way in steps of equal length: places to look at, some way behind the robot."""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass
from typing import TYPE_CHECKING, Generic, NamedTuple, TypeVar

if TYPE_CHECKING:
    from collections.abc import Iterator

    from ssrics_like.perception.observation import Pose

T = TypeVar("T")

STEP_M = 0.1
"""Metres of path between the places that are looked at."""
CHORD_M = 0.2
"""The direction of travel at a place is that of the chord from so far before it to so far after."""
JUMP_M = 5.0
"""A robot that is so far from where it was last was carried, or its odometry was set anew."""
KEPT_M = 0.02
"""Observations nearer to the one before are not kept: a robot that stands needs no memory."""


@dataclass(frozen=True, slots=True)
class Place(Generic[T]):
    """A place on the robot's way.

    Attributes
    ----------
    at_m : float
        Metres of path from the start.
    x_m, y_m, heading_rad : float
        Where it is, and the direction of travel there; frame of odometry.
    nearest : T
        What was sensed nearest to it.
    """

    at_m: float
    x_m: float
    y_m: float
    heading_rad: float
    nearest: T


class _Kept(NamedTuple, Generic[T]):
    at_m: float
    pose: Pose
    sensed: T


class Walk(Generic[T]):
    """Hands out a place every so many metres, once the robot is some way past it.

    Parameters
    ----------
    step_m : float
        Metres between places.
    lag_m : float
        How far the robot must be past a place, metres; at least half a chord.

    Attributes
    ----------
    travelled_m : float
        Length of the path so far.
    """

    def __init__(self, step_m: float, lag_m: float) -> None:
        self.travelled_m = 0.0
        self._step_m = step_m
        self._lag_m = max(lag_m, CHORD_M)
        self._next = math.ceil(CHORD_M / step_m)
        self._kept: deque[_Kept[T]] = deque()
        self._newest: _Kept[T] | None = None

    def advance(self, pose: Pose, sensed: T) -> bool:
        """Go on to a pose, frame of odometry, where something was sensed.

        Returns
        -------
        bool
            False if the robot cannot have driven there; then its way begins anew.
        """
        before = self._newest
        driven = True
        if before is not None:
            step_m = before.pose.distance_m(pose)
            driven = step_m < JUMP_M  # so that one that is not a number is no step either
            if driven:
                self.travelled_m += step_m
            else:
                self._kept.clear()
                self._next = math.ceil((self.travelled_m + CHORD_M) / self._step_m)
        here = _Kept(self.travelled_m, pose, sensed)
        if not self._kept or here.at_m - self._kept[-1].at_m >= KEPT_M:
            self._kept.append(here)
        self._newest = here
        return driven

    def places(self) -> Iterator[Place[T]]:
        """Hand out the places that the robot is now far enough past."""
        while self._next * self._step_m + self._lag_m <= self.travelled_m:
            at_m = self._next * self._step_m
            self._next += 1
            while len(self._kept) > 2 and self._kept[1].at_m < at_m - CHORD_M:  # noqa: PLR2004
                self._kept.popleft()
            from_x, from_y = self._at(at_m - CHORD_M)
            to_x, to_y = self._at(at_m + CHORD_M)
            x_m, y_m = self._at(at_m)
            nearest = min(self._kept, key=lambda kept: abs(kept.at_m - at_m))
            yield Place(at_m, x_m, y_m, math.atan2(to_y - from_y, to_x - from_x), nearest.sensed)

    def _at(self, at_m: float) -> tuple[float, float]:
        """Return where the path was after so many metres."""
        assert self._newest is not None
        before = self._kept[0]
        for after in (*self._kept, self._newest):
            if after.at_m >= at_m:
                between = after.at_m - before.at_m
                part = (at_m - before.at_m) / between if between > 0.0 else 1.0
                one, other = before.pose, after.pose
                return (
                    one.x_m + part * (other.x_m - one.x_m),
                    one.y_m + part * (other.y_m - one.y_m),
                )
            before = after
        return self._newest.pose.x_m, self._newest.pose.y_m
