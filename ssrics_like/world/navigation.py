"""Where the robot goes next: one leg of its journey after the other.

A leg chooses errands, ways to drive and headings to take up; the navigator keeps
the robot's own map, watches over the errand and tells the leg how it went. It
knows the robot's true pose, as a robot with a good localiser would; the
model of the mind, which only watches, gets odometry.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Protocol

import numpy as np

from ssrics_like.world.motion_kernels import ARRIVED, ON_THE_WAY, free_ahead
from ssrics_like.world.occupancy import REACH_M, SILENT_RUN, OccupancyGrid

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from ssrics_like.perception.observation import LaserScan, Pose
    from ssrics_like.world.robot import RobotProfile

MAPPING_S = 0.3  # a scan is mapped this often at most; faster ones add little
STUCK_S = 6.0  # so long without getting anywhere is too long; a turn on the spot takes less
MOVED_M = 0.05
BACKING_S = 1.0
SELDOM = 1e-9  # how often a run of lost beams may be taken for nothing there, per beam
SIDE_M = 0.02  # berth beside the body that must be free to drive on
NOWHERE = np.empty((0, 2))


@dataclass
class Errand:
    """Something to drive to.

    Attributes
    ----------
    way : ndarray, shape (n, 2)
        Places to pass, metres, grid frame; empty to stay here.
    face_rad : float
        Heading to take up at its end; NaN for none.
    at : int
        Index of the next place.
    status : int
        ON_THE_WAY or ARRIVED.
    """

    way: NDArray[np.float64] = field(default_factory=lambda: NOWHERE)
    face_rad: float = math.nan
    at: int = 0
    status: int = ON_THE_WAY


class Leg(Protocol):
    """A part of the journey.

    Attributes
    ----------
    ending : str
        What its end is called.
    notes : list of str
        What did not go as planned, for the user.
    """

    ending: str
    notes: list[str]

    def begin(self, navigator: Navigator, t_s: float) -> None:
        """Prepare, when the leg's turn has come."""

    def next(self, navigator: Navigator, t_s: float, *, stuck: bool) -> Errand | None:
        """Look at how the errand goes; return it, or another one, or None at the leg's end.

        `stuck` tells that the robot has not got anywhere for a while.
        """


class Surveyor(Protocol):
    """What exploring needs: a map of the robot's own, and where on it the robot is.

    Attributes
    ----------
    explored, cell_m, errand, moved_away
        As of `Navigator`.
    """

    explored: OccupancyGrid
    cell_m: float
    errand: Errand
    moved_away: bool

    def cell(self) -> tuple[int, int]:
        """Return the row and column that the robot's centre is in."""


class Navigator:
    """Leads a robot through the legs of its journey.

    Parameters
    ----------
    legs : sequence of Leg
        What it is to do.
    robot : RobotProfile
        The robot.
    shape : tuple of int
        Rows and columns of the robot's map.
    cell_m : float
        Side of its cells, metres.

    Attributes
    ----------
    explored : OccupancyGrid
        What it has seen.
    known_cells : int
        How many cells of it are not unknown.
    planned : OccupancyGrid or None
        The floor plan that it was given, corrected by what it has seen; None until a leg needs it.
    pose : Pose
        Of its centre, grid frame.
    scan : LaserScan
        The latest.
    robot : RobotProfile
        The robot.
    errand : Errand
        What it is doing.
    free_m : float
        How far it can drive straight on.
    backing_until_s : float
        When it has backed off far enough from what it ran against.
    moved_away : bool
        Whether the robot has been carried elsewhere since the last look.
    finished : bool
        Whether all legs are done.
    """

    def __init__(
        self, legs: Sequence[Leg], robot: RobotProfile, shape: tuple[int, int], cell_m: float
    ) -> None:
        self.legs = list(legs)
        self.robot = robot
        self.cell_m = cell_m
        self.explored = new_map(robot, shape, cell_m)
        self.planned: OccupancyGrid | None = None
        self.known_cells = 0
        self.errand = Errand()
        self.free_m = 0.0
        self.finished = not self.legs
        self.moved_away = False
        self.backing_until_s = -math.inf
        self._directions = robot.laser.directions
        self._laser_x_m = robot.laser.x_m
        self._leg = -1
        self._mapped_s = -math.inf
        self._moved_s = 0.0
        self._moved_from: Pose | None = None

    @property
    def notes(self) -> list[str]:
        """What did not go as planned on the legs so far."""
        return [note for leg in self.legs for note in leg.notes]

    def cell(self) -> tuple[int, int]:
        """Return the row and column that the robot's centre is in."""
        return int(self.pose.y_m / self.cell_m), int(self.pose.x_m / self.cell_m)

    def look(self, t_s: float, pose: Pose, laser: Pose, scan: LaserScan) -> None:
        """Take a scan and decide how to go on.

        Parameters
        ----------
        t_s : float
            Seconds since the start.
        pose, laser : Pose
            Of the robot's centre and of its laser, grid frame.
        scan : LaserScan
            What it senses there.
        """
        self.pose, self.scan = pose, scan
        arrived = self.errand.status == ARRIVED
        if arrived or t_s - self._mapped_s >= MAPPING_S - 1e-9:
            self._mapped_s = t_s
            self.known_cells += self.explored.take(scan, laser, self._directions)
            if self.planned is not None:
                self.planned.take(scan, laser, self._directions)
        self.free_m = free_ahead(
            scan.ranges_m, self._directions, self._laser_x_m, self.robot.radius_m + SIDE_M
        )
        errand = None
        if self._leg >= 0 and not self.finished:
            errand = self.legs[self._leg].next(self, t_s, stuck=self._is_stuck(t_s))
        while errand is None and not self.finished:
            self._leg += 1
            self.finished = self._leg == len(self.legs)
            if not self.finished:
                self.legs[self._leg].begin(self, t_s)
                errand = self.legs[self._leg].next(self, t_s, stuck=False)
        self.moved_away = False
        errand = errand or Errand(status=ARRIVED)
        self.errand = errand

    def bump(self, t_s: float, contact: tuple[float, float] | None) -> None:
        """Note what the bumper touched, which no scan has shown, and back off.

        Parameters
        ----------
        t_s : float
            Seconds since the start.
        contact : tuple of float or None
            x, y of a part of the building, grid frame; None for somebody who will walk on.
        """
        self.backing_until_s = t_s + BACKING_S
        for grid in (self.explored, self.planned):
            if grid is not None and contact is not None:
                grid.meet(*contact)

    def forget_place(self) -> None:
        """Note that the robot was carried elsewhere: whatever it was driving to is off."""
        self.errand = Errand(status=ARRIVED)
        self.moved_away = True
        self._mapped_s = -math.inf

    def _is_stuck(self, t_s: float) -> bool:
        before, now = self._moved_from, self.pose
        if before is None or math.hypot(now.x_m - before.x_m, now.y_m - before.y_m) > MOVED_M:
            self._moved_s, self._moved_from = t_s, now
        stuck = t_s - self._moved_s > STUCK_S
        if stuck or self.errand.status == ARRIVED:
            self._moved_s = t_s  # it was told, or stands because it should
        return stuck


def new_map(robot: RobotProfile, shape: tuple[int, int], cell_m: float) -> OccupancyGrid:
    """Return an empty map that fits a robot and its laser."""
    dropout = robot.laser.dropout
    chance = math.log(SELDOM) / math.log(dropout) if 0.0 < dropout < 1.0 else 0.0
    return OccupancyGrid(
        shape,
        cell_m,
        robot.radius_m,
        reach_m=min(REACH_M, robot.laser.range_max_m),
        # With many beams lost, only a long run of them means that there was nothing.
        silent_run=max(SILENT_RUN, math.ceil(chance)),
    )
