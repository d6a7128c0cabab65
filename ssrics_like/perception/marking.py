"""Which of the novel intervals are marked: every one, onsets, or peaks of novelty.

The report says "when a novel location was identified", which fits all three. A
marker takes the boredom quotients of successive intervals, counts them from 0,
and names the one that is to be marked as soon as that can be known.
"""

from __future__ import annotations

from typing import Literal, Protocol

from ssrics_like.perception.checks import MARKS, require_choice, require_fraction
from ssrics_like.perception.novelty import is_novel

Mark = Literal["every", "onset", "peak"]


class Marker(Protocol):
    """What every marking rule offers.

    Attributes
    ----------
    intervals : int
        Intervals taken so far; the next one has this index.
    candidate : int or None
        Index of an earlier interval that may yet be marked.
    """

    intervals: int
    candidate: int | None

    def update(self, tau: float) -> int | None:
        """Take the next interval; return the index of the interval to mark, if any."""

    def flush(self) -> int | None:
        """End the novel stretch, as at the end of a log; return an index still to be marked."""


class EveryMarker:
    """Marks every novel interval."""

    def __init__(self, threshold: float) -> None:
        self.threshold = require_fraction("threshold", threshold)
        self.intervals = 0
        self.candidate: int | None = None

    def update(self, tau: float) -> int | None:
        """Return this interval's index if it is novel."""
        self.intervals += 1
        return self.intervals - 1 if is_novel(tau, self.threshold) else None

    def flush(self) -> int | None:
        """Return None: nothing is ever kept back."""
        return None


class OnsetMarker:
    """Marks the first interval of each novel stretch; a log's first interval can be one."""

    def __init__(self, threshold: float) -> None:
        self.threshold = require_fraction("threshold", threshold)
        self.intervals = 0
        self.candidate: int | None = None
        self._novel = False

    def update(self, tau: float) -> int | None:
        """Return this interval's index if it is novel and the one before was not."""
        was_novel, self._novel = self._novel, is_novel(tau, self.threshold)
        self.intervals += 1
        return self.intervals - 1 if self._novel and not was_novel else None

    def flush(self) -> int | None:
        """Return None, and take the next novel interval for an onset."""
        self._novel = False
        return None


class PeakMarker:
    """Marks the local maxima of novelty = 1 - tau inside each novel stretch.

    The first of the highest intervals is the candidate. It is marked once
    novelty has dropped by `prominence` below it, when the stretch ends, or when
    no higher one has come for `patience` intervals: where novelty stays at its
    highest, waiting for the drop could take minutes. After a mark, novelty must
    rise by `prominence` from its lowest value since before there is a candidate
    again, so that ripples are not marked.

    Parameters
    ----------
    threshold : float
        An interval with a larger tau is not novel.
    prominence : float
        Novelty, a fraction.
    patience : int
        Intervals, 1 or more.
    """

    def __init__(self, threshold: float, prominence: float, patience: int) -> None:
        self.threshold = require_fraction("threshold", threshold)
        self.prominence = require_fraction("prominence", prominence)
        self.patience = patience
        self.intervals = 0
        self.candidate: int | None = None
        self._extreme: float | None = None  # the candidate's novelty, or the lowest since a mark

    def update(self, tau: float) -> int | None:
        """Return the candidate's index if this interval shows that it was a peak."""
        index = self.intervals
        self.intervals += 1
        if not is_novel(tau, self.threshold):
            return self.flush()
        novelty = 1.0 - tau
        if self._extreme is None:
            self.candidate, self._extreme = index, novelty
        elif self.candidate is not None:
            if novelty > self._extreme:
                self.candidate, self._extreme = index, novelty
            elif (
                novelty <= self._extreme - self.prominence
                or index - self.candidate >= self.patience
            ):
                marked, self.candidate, self._extreme = self.candidate, None, novelty
                return marked
        elif novelty >= self._extreme + self.prominence:
            self.candidate, self._extreme = index, novelty
        else:
            self._extreme = min(self._extreme, novelty)
        return None

    def flush(self) -> int | None:
        """Return the index of the candidate, if there is one, and forget the stretch."""
        marked, self.candidate, self._extreme = self.candidate, None, None
        return marked


def make_marker(mark: str, threshold: float, prominence: float, patience: int) -> Marker:
    """Return the marker named "every", "onset" or "peak"; only the last uses the rest."""
    require_choice("mark", mark, MARKS)
    if mark == "every":
        return EveryMarker(threshold)
    if mark == "onset":
        return OnsetMarker(threshold)
    return PeakMarker(threshold, prominence, patience)
