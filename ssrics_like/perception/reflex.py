"""The perception buffer: scans in, orienting reflexes out.

The novelty algorithm runs below the level of productions. Only when an interval
is marked does the buffer fire a reflex, the chunk that the productions attend to.
"""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ssrics_like.errors import ScanError
from ssrics_like.perception.conditioning import condition
from ssrics_like.perception.marking import make_marker
from ssrics_like.perception.novelty import NoveltyDetector, is_novel, scan_correlations
from ssrics_like.perception.sectors import SectorClassifier
from ssrics_like.perception.view import describe_view

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ssrics_like.perception.observation import LaserScan, Observation, Pose
    from ssrics_like.perception.profile import PerceptionProfile
    from ssrics_like.perception.sectors import Sector

REPORT_NOVEL_TAU = 0.34  # report, section 2.2, the interval of figure 1
REPORT_BORED_TAU = 0.96  # report, section 2.2, the interval of figure 2

_SAME_ANGLE_RAD = 1e-6  # geometry that is written anew in each record may be rounded differently


@dataclass(frozen=True, eq=False)
class Reflex:
    """An orienting reflex: something in the surroundings has changed.

    Attributes
    ----------
    event : int
        0-based number of the reflex.
    scan : int
        Index of the observation at the interval's anchor.
    t_s, pose, true_pose
        Time in seconds, pose, and true pose where known, of that observation.
    perceived_s : float
        Time of the newest scan when the buffer fired; later than `t_s` where a
        peak had to be awaited or the anchor is not the newest scan.
    travelled_m : float
        Length of the path from the first observation to the anchor, metres.
    modality : str
        The sense, "laser".
    novelty : float
        1 - tau of the marked interval.
    sector : {"left", "front", "right"}
        Where the anchor's scan reaches farthest.
    structure : str
        What was seen there; "unknown" until structure is perceived.
    view : ndarray, shape (view_beams,), float32
        The anchor's view descriptor; see `describe_view`.
    """

    event: int
    scan: int
    t_s: float
    pose: Pose
    true_pose: Pose | None
    perceived_s: float
    travelled_m: float
    modality: str
    novelty: float
    sector: Sector
    structure: str
    view: NDArray[np.float32]


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


class _Sensed(NamedTuple):
    observation: Observation
    ranges_m: NDArray[np.float64]
    travelled_m: float


class _Moment(NamedTuple):
    anchor: _Sensed
    novelty: float


class _Example(NamedTuple):
    interval: int
    scan: int
    tau: float
    ranges_m: tuple[NDArray[np.float64], ...]


class PerceptionBuffer:
    """Turns observations into reflexes, one at a time.

    A log whose laser changes (another number of beams, another first bearing or
    step) cannot be correlated across the change: the buffer reports what it
    still holds, starts its interval anew, and counts that in `restarts`.

    Parameters
    ----------
    profile : PerceptionProfile
        The settings.

    Attributes
    ----------
    tau, novelty : float or None
        Boredom quotient of the latest complete interval, and 1 - tau; None
        before the first.
    intervals, novel_intervals : int
        Complete intervals so far, and those that were novel.
    onsets : int
        Novel intervals that follow one that is not, or the beginning.
    restarts : int
        Times that the interval began anew because the laser changed.
    """

    def __init__(self, profile: PerceptionProfile) -> None:
        self.profile = profile
        self.tau: float | None = None
        self.intervals = 0
        self.novel_intervals = 0
        self.onsets = 0
        self.restarts = 0
        self._events = 0
        self._detector = NoveltyDetector(profile.interval, profile.gradient, profile.advance)
        self._marker = make_marker(
            profile.mark,
            profile.threshold,
            profile.prominence,
            # As many intervals as pass before one shares no scan with the candidate.
            patience=profile.interval if profile.advance == "sliding" else 1,
        )
        self._held: deque[_Sensed] = deque(maxlen=profile.interval)
        self._anchor = {"oldest": 0, "middle": profile.interval // 2, "newest": -1}[profile.anchor]
        self._laser: LaserScan | None = None
        self._sectors: SectorClassifier | None = None
        self._novel = False
        self._pending: _Moment | None = None
        self._newest: Observation | None = None
        self._travelled_m = 0.0
        self._examples: dict[bool, _Example] = {}

    @property
    def novelty(self) -> float | None:
        """1 - tau of the latest complete interval; None before the first."""
        return None if self.tau is None else 1.0 - self.tau

    def update(self, observation: Observation) -> list[Reflex]:
        """Take one observation; return the reflexes that it fires, mostly none.

        Raises
        ------
        ScanError
            The scan has no beams.
        """
        fired = self._meet_laser(observation)
        profile = self.profile
        ranges_m = condition(
            observation.scan.ranges_m, profile.range_cap_m, profile.repair_window
        ).ranges_m
        if self._newest is not None:
            here, before = observation.pose, self._newest.pose
            self._travelled_m += math.hypot(here.x_m - before.x_m, here.y_m - before.y_m)
        self._newest = observation
        self._held.append(_Sensed(observation, ranges_m, self._travelled_m))
        tau = self._detector.update(ranges_m)
        if tau is not None:
            self._take_interval(tau, fired)
        return fired

    def flush(self) -> list[Reflex]:
        """End the novel stretch, as at the end of a log; return a reflex kept back so far."""
        self._novel = False
        marked = self._marker.flush()
        pending, self._pending = self._pending, None
        return [self._fire(pending)] if marked is not None and pending is not None else []

    @property
    def example_novel(self) -> IntervalExample | None:
        """The novel interval so far whose tau is nearest to that of the report's figure 1."""
        return self._example(novel=True)

    @property
    def example_bored(self) -> IntervalExample | None:
        """The bored interval so far whose tau is nearest to that of the report's figure 2."""
        return self._example(novel=False)

    def _meet_laser(self, observation: Observation) -> list[Reflex]:
        """Start the interval anew, and return what is still held, if the laser is another."""
        scan = observation.scan
        if self._laser is not None and _same_geometry(self._laser, scan):
            return []
        if len(scan.ranges_m) == 0:
            raise ScanError(f"observation {observation.index} has no beams")
        sectors = SectorClassifier(scan.bearings_rad, self.profile.sector_rule)
        fired: list[Reflex] = []
        if self._laser is not None:
            fired = self.flush()
            self.restarts += 1
            self._detector.reset()
            self._held.clear()
        self._laser = scan
        self._sectors = sectors
        return fired

    def _take_interval(self, tau: float, fired: list[Reflex]) -> None:
        index = self._marker.intervals
        novel = is_novel(tau, self.profile.threshold)
        self.tau = tau
        self.intervals += 1
        self.novel_intervals += novel
        self.onsets += novel and not self._novel
        self._novel = novel
        self._keep_example(index, tau, novel=novel)
        moment = _Moment(self._held[self._anchor], 1.0 - tau)
        marked = self._marker.update(tau)
        if marked == index:
            fired.append(self._fire(moment))
        elif marked is not None and self._pending is not None:
            fired.append(self._fire(self._pending))
        if self._marker.candidate == index:
            self._pending = moment

    def _fire(self, moment: _Moment) -> Reflex:
        observation, ranges_m, travelled_m = moment.anchor
        assert self._sectors is not None  # both are set by the first observation
        assert self._newest is not None
        reflex = Reflex(
            event=self._events,
            scan=observation.index,
            t_s=observation.t_s,
            pose=observation.pose,
            true_pose=observation.true_pose,
            perceived_s=self._newest.t_s,
            travelled_m=travelled_m,
            modality="laser",
            novelty=moment.novelty,
            sector=self._sectors.classify(ranges_m),
            structure="unknown",
            view=describe_view(ranges_m, self.profile.view_beams),
        )
        self._events += 1
        return reflex

    def _keep_example(self, index: int, tau: float, *, novel: bool) -> None:
        wanted = REPORT_NOVEL_TAU if novel else REPORT_BORED_TAU
        kept = self._examples.get(novel)
        if kept is None or abs(tau - wanted) < abs(kept.tau - wanted):
            # Only references are kept; the correlations are computed when asked for.
            scans = tuple(sensed.ranges_m for sensed in self._held)
            self._examples[novel] = _Example(index, self._held[-1].observation.index, tau, scans)

    def _example(self, *, novel: bool) -> IntervalExample | None:
        kept = self._examples.get(novel)
        if kept is None:
            return None
        correlations = scan_correlations(np.array(kept.ranges_m))
        return IntervalExample(kept.interval, kept.scan, kept.tau, correlations)


def _same_geometry(one: LaserScan, other: LaserScan) -> bool:
    return (
        len(one.ranges_m) == len(other.ranges_m)
        and abs(one.angle_min_rad - other.angle_min_rad) < _SAME_ANGLE_RAD
        and abs(one.angle_increment_rad - other.angle_increment_rad) < _SAME_ANGLE_RAD
    )
