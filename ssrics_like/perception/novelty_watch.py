"""Watches novelty over time or along the way, and says which moments stand out."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ssrics_like.perception.marking import make_marker
from ssrics_like.perception.novelty import NoveltyDetector, is_novel, scan_correlations

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ssrics_like.perception.profile import PerceptionProfile
    from ssrics_like.perception.sensed import Sensed

REPORT_NOVEL_TAU = 0.34  # report, section 2.2, the interval of figure 1
REPORT_BORED_TAU = 0.96  # report, section 2.2, the interval of figure 2


@dataclass(frozen=True, eq=False)
class IntervalExample:
    """An interval shown in the report's figures 1 and 2.

    Attributes
    ----------
    interval : int
        0-based number of the interval.
    scan : int
        Index of the observation that completed it.
    tau : float
        Its boredom quotient.
    correlations : ndarray, shape ((interval^2 - interval) / 2,)
        Its pair correlations, for `correlation_histogram`.
    """

    interval: int
    scan: int
    tau: float
    correlations: NDArray[np.float64]


class Moment(NamedTuple):
    """What stands out.

    Attributes
    ----------
    anchor : Sensed
        The interval's scan that stands for it.
    novelty : float
        1 - tau of the interval.
    """

    anchor: Sensed
    novelty: float


class _Held(NamedTuple):
    sensed: Sensed
    ranges_m: NDArray[np.float64]


class _Example(NamedTuple):
    interval: int
    scan: int
    tau: float
    ranges_m: tuple[NDArray[np.float64], ...]


class NoveltyWatch:
    """Runs the novelty algorithm and the marking rule.

    Parameters
    ----------
    profile : PerceptionProfile
        The settings.

    Attributes
    ----------
    tau : float or None
        Boredom quotient of the latest complete interval; None before the first.
    intervals, novel_intervals : int
        Complete intervals so far, and those that were novel.
    onsets : int
        Novel intervals that follow one that is not, or the beginning.
    """

    def __init__(self, profile: PerceptionProfile) -> None:
        self.tau: float | None = None
        self.intervals = 0
        self.novel_intervals = 0
        self.onsets = 0
        self._threshold = profile.threshold
        self._detector = NoveltyDetector(profile.interval, profile.gradient, profile.advance)
        self._marker = make_marker(
            profile.mark,
            profile.threshold,
            profile.prominence,
            # As many intervals as pass before one shares no scan with the candidate.
            patience=profile.interval if profile.advance == "sliding" else 1,
        )
        self._held: deque[_Held] = deque(maxlen=profile.interval)
        self._anchor = {"oldest": 0, "middle": profile.interval // 2, "newest": -1}[profile.anchor]
        self._novel = False
        self._pending: Moment | None = None
        self._recent: deque[Moment] = deque(maxlen=profile.interval)
        self._examples: dict[bool, _Example] = {}

    def update(self, sensed: Sensed, ranges_m: NDArray[np.float64]) -> list[Moment]:
        """Take what was sensed, in the form that is to be correlated; return what stands out."""
        self._held.append(_Held(sensed, ranges_m))
        tau = self._detector.update(ranges_m)
        return [] if tau is None else self._take_interval(tau)

    @property
    def longest(self) -> int:
        """How many scans or places back, at most, the anchor of a moment that stands out lies.

        Patience ends after so many as an interval has, and its anchor may be its oldest.
        """
        return 2 * (self._held.maxlen or 0)

    def flush(self) -> list[Moment]:
        """End the novel stretch, as at the end of a log; return a moment kept back so far."""
        self._novel = False
        marked = self._marker.flush()
        pending, self._pending = self._pending, None
        return [pending] if marked is not None and pending is not None else []

    def restart(self) -> None:
        """Begin the interval anew."""
        self._detector.reset()
        self._held.clear()

    def novelty_at(self, travelled_m: float) -> float | None:
        """Return the novelty of the recent interval whose anchor lies nearest to a place.

        Parameters
        ----------
        travelled_m : float
            Where the place is along the way, metres.
        """
        if not self._recent:
            return None
        return min(self._recent, key=lambda m: abs(m.anchor.travelled_m - travelled_m)).novelty

    def example(self, *, novel: bool) -> IntervalExample | None:
        """Return the novel or bored interval so far that is most like the report's figure."""
        kept = self._examples.get(novel)
        if kept is None:
            return None
        correlations = scan_correlations(np.array(kept.ranges_m))
        return IntervalExample(kept.interval, kept.scan, kept.tau, correlations)

    def _take_interval(self, tau: float) -> list[Moment]:
        index = self._marker.intervals
        novel = is_novel(tau, self._threshold)
        self.tau = tau
        self.intervals += 1
        self.novel_intervals += novel
        self.onsets += novel and not self._novel
        self._novel = novel
        self._keep_example(index, tau, novel=novel)
        moment = Moment(self._held[self._anchor].sensed, 1.0 - tau)
        self._recent.append(moment)
        found: list[Moment] = []
        marked = self._marker.update(tau)
        if marked == index:
            found.append(moment)
        elif marked is not None and self._pending is not None:
            found.append(self._pending)
        if self._marker.candidate == index:
            self._pending = moment
        return found

    def _keep_example(self, index: int, tau: float, *, novel: bool) -> None:
        wanted = REPORT_NOVEL_TAU if novel else REPORT_BORED_TAU
        kept = self._examples.get(novel)
        if kept is None or abs(tau - wanted) < abs(kept.tau - wanted):
            # Only references are kept; the correlations are computed when asked for.
            scans = tuple(held.ranges_m for held in self._held)
            self._examples[novel] = _Example(
                index, self._held[-1].sensed.observation.index, tau, scans
            )
