"""The leg ``goto``: the robot is led by its mind, and only gets around what it meets.

Other legs know the true pose. This one knows what the robot knows: its pose by path integration, a
window of its own map, and where it is told to go. What it plans is turned into the grid's frame
afresh at every scan, so that it steers by what it believes.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Protocol

import numpy as np

from ssrics_like.perception.observation import Pose
from ssrics_like.world import way_kernels
from ssrics_like.world.exploration import Exploration
from ssrics_like.world.motion_kernels import ARRIVED
from ssrics_like.world.navigation import Errand
from ssrics_like.world.occupancy import SQUEEZE, UNSEEN
from ssrics_like.world.own_map import OwnMap

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ssrics_like.world.navigation import Navigator

CHECK_S = 0.5  # between looks at whether the way is still open, or has become shorter
PATIENCE_S = 8.0  # for a way to open, before it is called shut
STUCK_MOST = 3
BESIDE_M, AS_NEAR_M = 0.6, 0.8  # beside a place that something stands on; that is near enough
BORDER_M = 1.0  # a place beyond the window is driven towards up to so far from its edge
ROOM_M = 1.5  # there, anything so near will do
SILENCE_S = 60.0  # rules that have not answered after so long will not


class Ordered(Protocol):
    """What the mind wants of the body.

    Attributes
    ----------
    what : str
        drive, search or wait.
    to : Pose or None
        Where to drive, own frame.
    near_m, limit_m : float
        How near is near enough; a longer way does not count.
    """

    @property
    def what(self) -> str: ...  # noqa: D102 - see the class

    @property
    def to(self) -> Pose | None: ...  # noqa: D102

    @property
    def near_m(self) -> float: ...  # noqa: D102

    @property
    def limit_m(self) -> float: ...  # noqa: D102


class Guide(Protocol):
    """The mind, as the body sees it."""

    @property
    def here(self) -> Pose | None:
        """Where the laser is by path integration: the own frame."""

    @property
    def carried(self) -> int:
        """How often the robot has found itself suddenly elsewhere."""

    @property
    def command(self) -> Ordered | None:
        """What to do now; None once the errand is over."""

    def order(self, errand: str) -> None:
        """Set the errand."""

    def tell(self, event: str, reason: str = ...) -> None:
        """Say what has become of the command: arrived, blocked or nowhere."""


class Lead:
    """The leg ``goto``.

    Parameters
    ----------
    errand : str
        The name of a landmark, home or visit-all.

    Attributes
    ----------
    guide : Guide or None
        Who leads; to be set before the journey begins.
    """

    def __init__(self, errand: str) -> None:
        self.ending = f"end of the errand {errand}"
        self.notes: list[str] = []
        self.guide: Guide | None = None
        self._errand = errand
        self._map: OwnMap | None = None
        self._centre: Pose | None = None
        self._aim: Pose | None = None
        self._exploration: Exploration | None = None
        self._waiting_s: float | None = None

    def begin(self, navigator: Navigator, t_s: float) -> None:
        """Set the errand."""
        if self.guide is None:
            raise RuntimeError("nobody leads: set `guide` before the journey begins")
        self._carried = self.guide.carried
        self._map = None
        self._begin_command(None, t_s)
        navigator.errand = Errand(status=ARRIVED)
        self.guide.order(self._errand)

    def next(self, navigator: Navigator, t_s: float, *, stuck: bool) -> Errand | None:
        """Do as the guide says."""
        guide = self.guide
        assert guide is not None
        command, here = guide.command, guide.here
        if command is None or here is None:
            return None
        centre = here.onward(Pose(-navigator.robot.laser.x_m, 0.0, 0.0))
        own = self._look(navigator, centre, here)
        own.errand.at, own.errand.status = navigator.errand.at, navigator.errand.status
        if navigator.moved_away:
            own.errand = Errand(status=ARRIVED)
        if command.what != self._what or command.limit_m != self._limit_m:
            self._begin_command(command, t_s)
            own.errand = Errand(status=ARRIVED)
        self._way_m += centre.distance_m(self._centre) if self._centre is not None else 0.0
        self._centre = centre
        if command.what == "drive":
            own.errand = self._drive(own, command, centre, t_s, stuck=stuck)
        elif command.what == "search":
            own.errand = self._search(navigator, own, t_s, stuck=stuck)
        else:
            own.errand = Errand()
            if t_s - self._began_s > SILENCE_S:
                self.notes.append(
                    f"errand {self._errand} was given up: no rule answered what had happened "
                    f"within {SILENCE_S:g} s"
                )
                return None
        return _elsewhere(own, centre, navigator.pose)

    def _begin_command(self, command: Ordered | None, t_s: float) -> None:
        self._what = "" if command is None else command.what
        self._limit_m = math.inf if command is None else command.limit_m
        self._began_s = self._checked_s = t_s
        self._aim = self._centre = None
        self._way_m = 0.0
        self._stuck = 0
        self._waiting_s = None
        self._exploration = None

    def _look(self, navigator: Navigator, centre: Pose, laser: Pose) -> OwnMap:
        """Take the scan into the robot's own map; begin another one where it was carried."""
        assert self.guide is not None
        if self._map is None or self.guide.carried > self._carried:
            self._carried = self.guide.carried
            self._map = OwnMap(navigator.robot, navigator.cell_m, centre)
            self._exploration = None
        before = self._map.origin_m
        if self._map.take(centre, laser, navigator.scan):
            self._exploration = None
            x_m, y_m = self._map.origin_m
            self._map.errand.way = np.add(self._map.errand.way, [before[0] - x_m, before[1] - y_m])
        return self._map

    def _search(self, navigator: Navigator, own: OwnMap, t_s: float, *, stuck: bool) -> Errand:
        """Look about until the guide knows where it is."""
        assert self.guide is not None
        if self._exploration is None:
            self._exploration = Exploration()
            own.moved_away = navigator.moved_away
            self._exploration.begin(own, t_s)
        errand = self._exploration.next(own, t_s, stuck=stuck)
        if errand is None:
            self.guide.tell("nowhere", "lost")
            return Errand()
        return errand

    def _drive(
        self, own: OwnMap, command: Ordered, centre: Pose, t_s: float, *, stuck: bool
    ) -> Errand:
        """Go on to where the guide wants to be."""
        guide, to = self.guide, command.to
        assert guide is not None
        assert to is not None
        away_m = centre.distance_m(to)
        arrived = own.errand.status == ARRIVED and bool(len(own.errand.way))
        if away_m <= command.near_m or (arrived and away_m <= AS_NEAR_M):
            guide.tell("arrived")
            return Errand()
        if stuck and self._waiting_s is None:
            self._stuck += 1
            if self._stuck > STUCK_MOST:
                guide.tell("blocked", "stuck")
                return Errand()
        moved = self._aim is None or self._aim.distance_m(to) > 0.5 * command.near_m
        due = t_s - self._checked_s >= CHECK_S
        if not (due or moved or stuck or arrived or not len(own.errand.way)):
            return own.errand
        if self._waiting_s is not None and not due:
            return own.errand
        self._checked_s, self._aim = t_s, to
        left_m = command.limit_m - self._way_m
        way = _within(own, own.within(to), command.near_m, left_m)
        if way is None and own.explored.forget_moved():
            way = _within(own, own.within(to), command.near_m, left_m)
        if way is not None:
            self._waiting_s = None
            return Errand(way)
        if self._waiting_s is None:
            self._waiting_s = t_s
        if t_s - self._waiting_s >= PATIENCE_S:
            guide.tell("blocked", "shut")
        return Errand()


def _within(own: OwnMap, to: Pose, near_m: float, left_m: float) -> NDArray[np.float64] | None:
    """Return a way to a place, frame of the window, no longer than what is left; or None.

    Where something stands on the place, anything near it will do.
    """
    side_m = own.explored.evidence.shape[0] * own.cell_m
    x_m, y_m = (min(max(v, BORDER_M), side_m - BORDER_M) for v in (to.x_m, to.y_m))
    beyond = (x_m, y_m) != (to.x_m, to.y_m)
    for room_m in (ROOM_M,) if beyond else (0.5 * near_m, BESIDE_M):
        way = _way(own, x_m, y_m, room_m)
        if way is not None and _length_m(way) <= left_m:
            return way
    return None


def _way(own: OwnMap, x_m: float, y_m: float, room_m: float) -> NDArray[np.float64] | None:
    """Return the cheapest way to anywhere so near a place, through what was never seen as well."""
    costs = own.explored.costs(UNSEEN)
    middle = (np.arange(costs.shape[0]) + 0.5) * own.cell_m
    away_m = np.hypot(middle[np.newaxis, :] - x_m, middle[:, np.newaxis] - y_m)
    goals = np.where(away_m <= room_m, 0, -1).astype(np.int32)
    distance, parent = np.empty(costs.shape, np.int32), np.empty(costs.shape, np.int32)
    goal = way_kernels.spread(costs, goals, own.cell(), SQUEEZE, distance, parent)
    if goal < 0:
        return None
    way: NDArray[np.float64] = way_kernels.straightened(
        costs, way_kernels.way_to(parent, goal, own.cell_m), own.cell_m
    )
    return way


def _length_m(way: NDArray[np.float64]) -> float:
    return float(np.hypot(*np.diff(way, axis=0).T).sum())


def _elsewhere(own: OwnMap, centre: Pose, true: Pose) -> Errand:
    """Return an errand in the frame of the window as one in the grid's frame."""
    errand = own.errand
    here = own.within(centre)
    turn = true.theta_rad - here.theta_rad
    cos, sin = math.cos(turn), math.sin(turn)
    off = errand.way - [here.x_m, here.y_m]
    way = off @ np.array([[cos, sin], [-sin, cos]]) + [true.x_m, true.y_m]
    return Errand(way, errand.face_rad + turn, errand.at, errand.status)
