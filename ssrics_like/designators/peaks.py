"""From a score along the path to marks: one rule for every designator that scores."""

from __future__ import annotations

import math
from collections import deque
from typing import TYPE_CHECKING, ClassVar, NamedTuple

from ssrics_like.designators.path import STEP_M, Steps
from ssrics_like.designators.protocol import Mark

if TYPE_CHECKING:
    from ssrics_like.perception.observation import Observation

AHEAD_MAX_M = 0.8
"""A peak waits no longer; the step that decides comes up to 0.2 m later, within 1 m in all."""

_ROUNDING_M = 1e-9


class _Scored(NamedTuple):
    at_m: float
    score: float
    scan: int


class Peaks:
    """Marks the places whose score is a local maximum and high enough.

    A place is marked if its score is not below the threshold, is above every earlier
    score within `apart_m`, is not below any later one within `ahead_m`, and no mark was
    set within `apart_m` before. Of equal scores so the first counts, and a plateau has
    one mark. Memory is that of the scores within `apart_m`.

    Parameters
    ----------
    threshold : float
        Least score, in the score's units.
    apart_m : float
        Metres of path.
    lag_m : float
        How far the place scored lies behind the robot, metres; it shortens `ahead_m` so
        that place and decision stay within 1 m of path where scans are dense.

    Attributes
    ----------
    ahead_m : float
        Metres of path that are awaited after a candidate: `apart_m`, or what remains.
    """

    def __init__(self, threshold: float, apart_m: float, lag_m: float = 0.0) -> None:
        self.threshold = threshold
        self.apart_m = apart_m
        self.ahead_m = max(min(apart_m, AHEAD_MAX_M - lag_m), 0.0)
        self._marked_m = -math.inf
        self._recent: deque[_Scored] = deque()  # falling scores: the first is the highest
        self._candidate: _Scored | None = None

    def update(self, at_m: float, score: float, scan: int, now: int) -> list[Mark]:
        """Take the score of the next place.

        Parameters
        ----------
        at_m : float
            Metres travelled at the place, rising.
        score : float
            Its score; NaN for a place without one.
        scan, now : int
            Index of the observation of the place, and of the newest observation.
        """
        marks = self._settle(at_m - _ROUNDING_M, now, beyond=True)
        if math.isnan(score):
            return marks
        recent = self._recent
        while recent and recent[0].at_m < at_m - self.apart_m - _ROUNDING_M:
            recent.popleft()
        here = _Scored(at_m, score, scan)
        if (
            score >= self.threshold
            and (not recent or score > recent[0].score)
            and at_m > self._marked_m + self.apart_m + _ROUNDING_M
        ):
            self._candidate = here
        while recent and recent[-1].score <= score:
            recent.pop()
        recent.append(here)
        return marks + self._settle(at_m + _ROUNDING_M, now, beyond=False)

    def flush(self, now: int) -> list[Mark]:
        """Return the mark of the candidate that still waits, if there is one."""
        return self._settle(math.inf, now, beyond=True)

    def _settle(self, at_m: float, now: int, *, beyond: bool) -> list[Mark]:
        """Mark the candidate if what it awaits ends before (`beyond`) or at `at_m`."""
        waiting = self._candidate
        if waiting is None:
            return []
        end_m = waiting.at_m + self.ahead_m
        if not (at_m > end_m or (at_m >= end_m and not beyond)):
            return []
        self._candidate = None
        self._marked_m = waiting.at_m
        return [Mark(waiting.scan, now, waiting.score)]


class ScoredDesignator:
    """Base of the designators that give each step of the path a score.

    A subclass says in `score` what the step is worth. One whose score belongs to a place
    that the robot has passed overrides `place_and_score` instead.

    Parameters
    ----------
    peaks : Peaks
        Turns scores into marks.
    step_m : float
        Length of a step, metres.

    Attributes
    ----------
    at_m : float
        Metres travelled at the newest step.
    """

    hindsight: ClassVar[bool] = False

    def __init__(self, peaks: Peaks, step_m: float = STEP_M) -> None:
        self._peaks = peaks
        self._steps = Steps(step_m)
        self._newest = 0
        self.at_m = 0.0

    def update(self, observation: Observation) -> list[Mark]:
        """Take the next observation; see `Designator`.

        Raises
        ------
        ScanError
            The scan has no beams.
        """
        self._newest = observation.index
        at_m = self._steps.update(observation.pose)
        if at_m is None:
            return []
        self.at_m = at_m
        found = self.place_and_score(at_m, observation)
        return [] if found is None else self._peaks.update(*found, observation.index)

    def flush(self) -> list[Mark]:
        """End the drive; see `Designator`."""
        return self._peaks.flush(self._newest)

    def place_and_score(
        self, at_m: float, observation: Observation
    ) -> tuple[float, float, int] | None:
        """Return metres travelled at the place scored, its score, its scan; or None."""
        return at_m, self.score(observation), observation.index

    def score(self, observation: Observation) -> float:
        """Return the score of the step that begins here; NaN if it has none."""
        raise NotImplementedError
