"""Metres travelled, and the steps along them at which designators look.

Counting scans confounds speed, scan rate and place: a robot that waits would fill
any window with one view. So whatever can be counted by metres is.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ssrics_like.perception.observation import Pose

STEP_M = 0.1
"""Designators look at the first scan of each step of this length."""

CARRIED_M = 5.0
"""Between two scans no robot drives so far: it was carried, or its position was corrected."""

_STILL_M = 0.01  # moves below this may be the jitter of a position that is estimated
_ROUNDING = 1e-9


class Odometer:
    """Length of the path so far.

    A move counts once it reaches 1 cm, so that the jitter of a robot at rest does not
    add up; one of 5 m or more between two scans was not driven and does not count. A
    pose that is not finite is passed over.

    Attributes
    ----------
    travelled_m : float
        Metres since the first pose.
    """

    def __init__(self) -> None:
        self.travelled_m = 0.0
        self._last: Pose | None = None

    def update(self, pose: Pose) -> float:
        """Take the next pose; return `travelled_m`."""
        if not (math.isfinite(pose.x_m) and math.isfinite(pose.y_m)):
            return self.travelled_m
        if self._last is None:
            self._last = pose
        moved_m = math.hypot(pose.x_m - self._last.x_m, pose.y_m - self._last.y_m)
        if moved_m >= _STILL_M:
            self._last = pose
            if moved_m < CARRIED_M:
                self.travelled_m += moved_m
        return self.travelled_m


class Steps:
    """Picks the first scan, and then the first at or past each multiple of `step_m` of path.

    Where scans are farther apart than that, every scan that moved is a step.

    Parameters
    ----------
    step_m : float
        Metres.
    """

    def __init__(self, step_m: float = STEP_M) -> None:
        self._step_m = step_m
        self._odometer = Odometer()
        self._done = -1

    def update(self, pose: Pose) -> float | None:
        """Take the next pose; return the metres travelled if a step begins here, else None."""
        travelled_m = self._odometer.update(pose)
        step = math.floor(travelled_m / self._step_m + _ROUNDING)
        if step <= self._done:
            return None
        self._done = step
        return travelled_m
