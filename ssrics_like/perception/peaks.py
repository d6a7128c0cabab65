"""Local maxima of something measured along the way, found online."""

from __future__ import annotations

import math
from collections import deque
from typing import Generic, NamedTuple, TypeVar

T = TypeVar("T")

_ROUNDING_M = 1e-9


class _Scored(NamedTuple, Generic[T]):
    at_m: float
    score: float
    tag: T


class Peaks(Generic[T]):
    """Finds the places whose score is a local maximum and high enough.

    A place is found if its score is not below the threshold, is above every earlier score within
    `ahead_m`, is not below any later one within `ahead_m`, and no place was found within `apart_m`
    before. Of equal scores so the first counts. Memory is that of the scores within `ahead_m`.

    Parameters
    ----------
    threshold : float
        Least score.
    apart_m : float
        Least distance along the way between two places found, metres.
    ahead_m : float
        How far around a maximum there must be none greater, metres.
    """

    def __init__(self, threshold: float, apart_m: float, ahead_m: float) -> None:
        self.threshold = threshold
        self.apart_m = apart_m
        self.ahead_m = ahead_m
        self._found_m = -math.inf
        self._recent: deque[_Scored[T]] = deque()  # falling scores: the first is the highest
        self._candidate: _Scored[T] | None = None

    def update(self, at_m: float, score: float, tag: T) -> list[tuple[float, T]]:
        """Take the score of the next place; return score and tag of what is now found.

        Parameters
        ----------
        at_m : float
            Metres travelled at the place, rising.
        score : float
            Its score.
        tag : object
            Returned with it.
        """
        found = self._settle(at_m - _ROUNDING_M, beyond=True)
        recent = self._recent
        while recent and recent[0].at_m < at_m - self.ahead_m - _ROUNDING_M:
            recent.popleft()
        here = _Scored(at_m, score, tag)
        if (
            score >= self.threshold
            and (not recent or score > recent[0].score)
            and at_m >= self._found_m + self.apart_m - _ROUNDING_M
        ):
            self._candidate = here
        while recent and recent[-1].score <= score:
            recent.pop()
        recent.append(here)
        return found + self._settle(at_m + _ROUNDING_M, beyond=False)

    def flush(self) -> list[tuple[float, T]]:
        """Return the candidate that still waits, if there is one."""
        return self._settle(math.inf, beyond=True)

    def _settle(self, at_m: float, *, beyond: bool) -> list[tuple[float, T]]:
        """Find the candidate if what it awaits ends before (`beyond`) or at `at_m`."""
        waiting = self._candidate
        if waiting is None:
            return []
        end_m = waiting.at_m + self.ahead_m
        if not (at_m > end_m or (at_m >= end_m and not beyond)):
            return []
        self._candidate = None
        self._found_m = waiting.at_m
        return [(waiting.score, waiting.tag)]
