"""Scripted legs: a route of waypoints, and standing still."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.world import way_kernels
from ssrics_like.world.motion_kernels import ARRIVED
from ssrics_like.world.navigation import Errand, new_map
from ssrics_like.world.occupancy import SQUEEZE

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from ssrics_like.world.navigation import Navigator

PATIENCE_S = 10.0  # for a way to open, before a waypoint is given up
RETRY_S = 1.0
STUCK_MOST = 3  # on the way to a waypoint
CHECK_S = 0.5


class Route:
    """The leg ``waypoints``: one after the other, over the floor plan that the robot was given.

    Parameters
    ----------
    waypoints : sequence of tuple of float
        x, y and perhaps a heading, metres and radians, grid frame.
    names : sequence of str
        What to call them in notes.
    repeat : int
        How often the whole route is driven.
    solid : ndarray, shape (rows, columns), bool
        The floor plan, in the cells of the robot's map.
    """

    ending = "end of the route"

    def __init__(
        self,
        waypoints: Sequence[tuple[float, ...]],
        names: Sequence[str],
        repeat: int,
        solid: NDArray[np.bool_],
    ) -> None:
        self.notes: list[str] = []
        self._left = [
            (waypoint, name if repeat == 1 else f"{name} of lap {lap}")
            for lap in range(1, repeat + 1)
            for waypoint, name in zip(waypoints, names, strict=True)
        ]
        self._solid = solid
        self._waiting_s: float | None = None
        self._checked_s = -math.inf
        self._stuck = 0

    def begin(self, navigator: Navigator, t_s: float) -> None:
        """Give the robot the floor plan, once."""
        if navigator.planned is None:
            shape = navigator.explored.evidence.shape
            grid = new_map(navigator.robot, (shape[0], shape[1]), navigator.cell_m)
            grid.know(self._solid)
            navigator.planned = grid
        navigator.errand = Errand(status=ARRIVED)
        self._started = False
        self._checked_s = t_s

    def next(self, navigator: Navigator, t_s: float, *, stuck: bool) -> Errand | None:
        """Go on to the waypoint, or to the one after it."""
        errand = navigator.errand
        assert navigator.planned is not None
        if self._waiting_s is not None:
            if t_s - self._checked_s < RETRY_S:
                return errand
            return self._plan(navigator, t_s)
        if not self._started:
            self._started = True
            return self._plan(navigator, t_s)
        if errand.status == ARRIVED and len(errand.way):
            self._left.pop(0)
            self._stuck = 0
            return self._plan(navigator, t_s)
        if errand.status == ARRIVED:  # carried elsewhere
            return self._plan(navigator, t_s)
        if stuck:
            self._stuck += 1
            if self._stuck > STUCK_MOST:
                self._leave_out(f"the robot got stuck {self._stuck} times on its way")
                return self._plan(navigator, t_s)
            return self._wait(t_s)
        if t_s - self._checked_s >= CHECK_S:
            self._checked_s = t_s
            if not navigator.planned.is_open(errand.way, errand.at):
                return self._plan(navigator, t_s)
        return errand

    def _plan(self, navigator: Navigator, t_s: float) -> Errand | None:
        """Plan the way to the next waypoint; wait where there is none, give up in the end."""
        self._checked_s = t_s
        while self._left:
            waypoint, _ = self._left[0]
            way = _way(navigator, waypoint)
            if way is not None:
                self._waiting_s = None
                face_rad = waypoint[2] if len(waypoint) > 2 else math.nan  # noqa: PLR2004
                return Errand(way, face_rad)
            if self._waiting_s is None:
                self._waiting_s = t_s
            if t_s - self._waiting_s < PATIENCE_S:
                return Errand()
            self._leave_out(f"no way led there for {PATIENCE_S:g} s")
        return None

    def _leave_out(self, why: str) -> None:
        """Give the next waypoint up."""
        _, name = self._left.pop(0)
        self.notes.append(f"{name} was left out: {why}")
        self._waiting_s = None
        self._stuck = 0

    def _wait(self, t_s: float) -> Errand:
        """Stand still for a moment, then plan anew."""
        self._waiting_s = t_s
        self._checked_s = t_s
        return Errand()


class Wait:
    """The leg ``wait_s``: stand still.

    Parameters
    ----------
    seconds : float
        For how long.
    """

    ending = "end of the wait"

    def __init__(self, seconds: float) -> None:
        self.notes: list[str] = []
        self._seconds = seconds

    def begin(self, navigator: Navigator, t_s: float) -> None:  # noqa: ARG002 - as of every leg
        """Start the clock."""
        self._until_s = t_s + self._seconds

    def next(self, navigator: Navigator, t_s: float, *, stuck: bool) -> Errand | None:
        """Stand, until the time is up."""
        del stuck
        if t_s >= self._until_s - 1e-9:
            return None
        return navigator.errand if not len(navigator.errand.way) else Errand()


def _way(navigator: Navigator, waypoint: tuple[float, ...]) -> NDArray[np.float64] | None:
    """Return the cheapest way to a waypoint over the known floor plan, or None."""
    grid, cell_m = navigator.planned, navigator.cell_m
    assert grid is not None
    costs = grid.costs()
    goals = np.full(costs.shape, -1, np.int32)
    row, column = math.floor(waypoint[1] / cell_m), math.floor(waypoint[0] / cell_m)
    rows, columns = costs.shape
    if not (0 <= row < rows and 0 <= column < columns):
        return None
    goals[row, column] = 0
    distance, parent = np.empty(costs.shape, np.int32), np.empty(costs.shape, np.int32)
    goal = way_kernels.spread(costs, goals, navigator.cell(), SQUEEZE, distance, parent)
    if goal < 0:
        return None
    way: NDArray[np.float64] = way_kernels.straightened(
        costs, way_kernels.way_to(parent, goal, cell_m), cell_m
    )
    return way
