"""The perception buffer: scans in, orienting reflexes out.

Novelty and structure are perceived below the level of productions. Only when
something stands out does the buffer fire a reflex, the chunk that the productions
attend to.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ssrics_like.errors import ScanError
from ssrics_like.perception.conditioning import condition
from ssrics_like.perception.novelty_watch import IntervalExample, Moment, NoveltyWatch
from ssrics_like.perception.sectors import SectorClassifier
from ssrics_like.perception.sensed import Sensed
from ssrics_like.perception.view import describe_view

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ssrics_like.perception.doorways import DoorwayCue
    from ssrics_like.perception.egomotion import Egomotion
    from ssrics_like.perception.observation import LaserScan, Observation, Pose
    from ssrics_like.perception.profile import PerceptionProfile
    from ssrics_like.perception.sectors import Sector
    from ssrics_like.perception.sights import Sights
    from ssrics_like.perception.structure import StructureCue

__all__ = ["IntervalExample", "PerceptionBuffer", "Reflex"]

_SAME_ANGLE_RAD = 1e-6  # geometry that is written anew in each record may be rounded differently


@dataclass(frozen=True, eq=False)
class Reflex:
    """An orienting reflex: something in the surroundings stands out.

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
        What the place looks like: doorway, opening, junction, corner, corridor or room; "unknown"
        where the profile names no cue.
    place : Pose
        Where it is by path integration, in a frame that begins as that of `pose`: the middle of a
        doorway and the direction through, else where the laser was.
    directed : bool
        Whether the direction of `place` is the doorway's own, and not only the robot's heading.
    turned_rad : float
        Sum of all turns, whichever way, from the first observation to the anchor.
    carried : int
        How often the robot found itself suddenly elsewhere by then.
    view : ndarray, shape (view_length,), float32
        What it looks like there: see `describe_view` and `Surroundings.view_of`.
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
    place: Pose
    directed: bool
    turned_rad: float
    carried: int
    view: NDArray[np.float32]


class PerceptionBuffer:
    """Turns observations into reflexes, one at a time.

    A log whose laser changes (another number of beams, another first bearing or
    step) cannot be correlated scan by scan across the change: the buffer reports
    what it still holds, starts its interval anew, and counts that in `restarts`.

    Parameters
    ----------
    profile : PerceptionProfile
        The settings.
    doorways : DoorwayCue, optional
        What was learned of doorways. A profile that names a cue needs it.
    structure : StructureCue, optional
        What was learned of other structure. A profile that names a cue needs it.

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

    Raises
    ------
    ValueError
        The profile names a cue and none is given, or the other way round.
    """

    def __init__(
        self,
        profile: PerceptionProfile,
        doorways: DoorwayCue | None = None,
        structure: StructureCue | None = None,
    ) -> None:
        for key, cue in (("doorways", doorways), ("structure", structure)):
            named = getattr(profile, key)
            if bool(named) != (cue is not None):
                raise ValueError(
                    f"the profile's {key}: '{named}'; expected "
                    f"{'that cue' if named else 'no cue'} (see `ssrics_like.cues`)"
                )
        self.profile = profile
        self.restarts = 0
        self._events = 0
        self._watch = NoveltyWatch(profile)
        self._sights: Sights | None = None
        if profile.along == "metres":
            # Compiled code is loaded only where it is needed.
            from ssrics_like.perception.sights import Sights  # noqa: PLC0415

            self._sights = Sights(
                self._watch, doorways, structure, around=profile.view == "surroundings"
            )
        self._egomotion: Egomotion | None = None
        if profile.egomotion == "laser":
            from ssrics_like.perception.egomotion import Egomotion  # noqa: PLC0415 - as above

            self._egomotion = Egomotion()
        self._laser: LaserScan | None = None
        self._sectors: SectorClassifier | None = None
        self._newest: Observation | None = None
        self._here: Pose | None = None
        self._travelled_m = self._turned_rad = 0.0

    @property
    def tau(self) -> float | None:
        """Boredom quotient of the latest complete interval; None before the first."""
        return self._watch.tau

    @property
    def novelty(self) -> float | None:
        """1 - tau of the latest complete interval; None before the first."""
        return None if self.tau is None else 1.0 - self.tau

    @property
    def intervals(self) -> int:
        """Complete intervals so far."""
        return self._watch.intervals

    @property
    def novel_intervals(self) -> int:
        """Complete intervals so far that were novel."""
        return self._watch.novel_intervals

    @property
    def onsets(self) -> int:
        """Novel intervals that follow one that is not, or the beginning."""
        return self._watch.onsets

    @property
    def here(self) -> Pose | None:
        """Where the laser is now by path integration, as `Reflex.place`; None at the beginning."""
        return self._here

    @property
    def travelled_m(self) -> float:
        """Length of the path by odometry, metres."""
        return self._travelled_m

    @property
    def carried(self) -> int:
        """How often the robot has found itself suddenly elsewhere."""
        return 0 if self._egomotion is None else self._egomotion.carried

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
            before = self._newest.pose
            step_m = before.distance_m(observation.pose)
            self._travelled_m += step_m if math.isfinite(step_m) else 0.0
            # As plain floats: numpy's warn of infinity less infinity.
            turn_rad = float(observation.pose.theta_rad) - float(before.theta_rad)
            if math.isfinite(turn_rad):
                self._turned_rad += abs(math.remainder(turn_rad, math.tau))
        self._newest = observation
        here = observation.pose
        if self._egomotion is not None:
            here = self._egomotion.update(
                here, observation.scan.bearings_rad, observation.scan.ranges_m
            )
        self._here = here
        sensed = Sensed(
            observation, ranges_m, self._travelled_m, here, self._turned_rad, self.carried
        )
        found = (
            self._watch.update(sensed, ranges_m)
            if self._sights is None
            else self._sights.update(sensed)
        )
        return fired + [self._fire(moment) for moment in found]

    @property
    def looks_round(self) -> bool:
        """Whether views are of what surrounds a place."""
        return self._sights is not None and self._sights.around

    def view_of(self, place: Pose, *, far: bool = True) -> NDArray[np.float32]:
        """Describe what surrounds a place near the robot, as `Surroundings.view_of`.

        Parameters
        ----------
        place : Pose
            Frame of `here`, which must not be None; views must be of surroundings.
        far : bool
            Whether it is looked into the distance.

        Returns
        -------
        ndarray, shape (108,), float32
        """
        assert self._sights is not None
        assert self._here is not None
        assert self._newest is not None
        place = self._newest.pose.onward(place.seen_from(self._here))
        return self._sights.view_of(place, far=far)

    def flush(self) -> list[Reflex]:
        """End the novel stretch, as at the end of a log; return reflexes kept back so far."""
        found = self._watch.flush() if self._sights is None else self._sights.flush()
        return [self._fire(moment) for moment in found]

    @property
    def example_novel(self) -> IntervalExample | None:
        """The novel interval so far whose tau is nearest to that of the report's figure 1."""
        return self._watch.example(novel=True)

    @property
    def example_bored(self) -> IntervalExample | None:
        """The bored interval so far whose tau is nearest to that of the report's figure 2."""
        return self._watch.example(novel=False)

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
            self._watch.restart()
        self._laser = scan
        self._sectors = sectors
        return fired

    def _fire(self, moment: Moment) -> Reflex:
        anchor = moment.anchor
        observation, gap = anchor.observation, anchor.gap
        assert self._sectors is not None  # both are set by the first observation
        assert self._newest is not None
        reflex = Reflex(
            event=self._events,
            scan=observation.index,
            t_s=observation.t_s,
            pose=observation.pose,
            true_pose=observation.true_pose,
            perceived_s=self._newest.t_s,
            travelled_m=anchor.travelled_m,
            modality="laser",
            novelty=moment.novelty,
            sector=self._sectors.classify(anchor.ranges_m),
            structure=anchor.structure,
            place=(
                anchor.here if gap is None else anchor.here.onward(gap.seen_from(observation.pose))
            ),
            directed=gap is not None,
            turned_rad=anchor.turned_rad,
            carried=anchor.carried,
            view=(
                describe_view(anchor.ranges_m, self.profile.view_beams)
                if anchor.around is None
                else anchor.around
            ),
        )
        self._events += 1
        return reflex


def _same_geometry(one: LaserScan, other: LaserScan) -> bool:
    return (
        len(one.ranges_m) == len(other.ranges_m)
        and abs(one.angle_min_rad - other.angle_min_rad) < _SAME_ANGLE_RAD
        and abs(one.angle_increment_rad - other.angle_increment_rad) < _SAME_ANGLE_RAD
    )
