"""One drive through a building: time passes, the robot moves, observations come out."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.perception.observation import Observation, Pose
from ssrics_like.world import motion_kernels
from ssrics_like.world.disturbances import Disturbances, DoorChange, Slip
from ssrics_like.world.grid import GridMap
from ssrics_like.world.laser import Laser, leaps
from ssrics_like.world.navigation import Navigator
from ssrics_like.world.odometry import Odometry
from ssrics_like.world.people import People
from ssrics_like.world.reachable import clearance, reachable

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from numpy.typing import NDArray

    from ssrics_like.world.navigation import Leg
    from ssrics_like.world.robot import RobotProfile

TICK_S = 0.025  # wheels are steered at least so often
MAPPED_CELL_M = (0.04, 0.1)  # a plan with cells in this range is mapped in cells of its own size
DEFAULT_CELL_M = 0.05
STREAMS = ("laser", "odometry", "wheels", "people", "slip")
"""Sources of randomness, each with a generator of its own, so that they can be switched singly."""


class Simulation:
    """A robot on its journey through a building; iterate over its observations once.

    Parameters
    ----------
    grid : GridMap
        The building as it is at the start.
    robot : RobotProfile
        The robot.
    start : Pose
        Of its centre, grid frame.
    legs : sequence of Leg
        The journey.
    seed : numpy.random.SeedSequence
        Of all randomness.
    disturbances : Disturbances
        What happens on the way.
    time_limit_s : float
        The drive ends after this time at the latest.

    Attributes
    ----------
    ended : str
        Why the drive ended; empty before.
    coverage : float
        Share of the reachable free space that has been seen so far: of the cells that the robot's
        body could cover, from where it started, with the doors as they are at the start.
    t_s : float
        Time of the latest observation.
    way_m : float
        Length of the robot's true path, without what it was carried.
    bumps : int
        Scans at which the robot had run against something since the one before.
    """

    def __init__(
        self,
        grid: GridMap,
        robot: RobotProfile,
        start: Pose,
        legs: Sequence[Leg],
        seed: np.random.SeedSequence,
        disturbances: Disturbances | None = None,
        *,
        time_limit_s: float = 3600.0,
    ) -> None:
        self.grid = grid
        self.robot = robot
        self.ended = ""
        self.bumps = 0
        self.t_s = 0.0
        self.way_m = 0.0
        self.time_limit_s = time_limit_s
        self._happenings = disturbances or Disturbances()
        self._rngs = {
            name: np.random.default_rng(child)
            for name, child in zip(STREAMS, seed.spawn(len(STREAMS)), strict=True)
        }
        self._state = np.array([start.x_m, start.y_m, start.theta_rad, 0.0, 0.0])
        self._measured = np.zeros(2)
        # Edges are known to half a cell only; where the plan just lets it pass, the body does.
        self._body_m = max(robot.radius_m - 0.5 * grid.cell_m, 0.5 * robot.radius_m)
        self._laser = Laser(robot.laser, self._rngs["laser"])
        self._odometry = Odometry(robot.odometry, grid.pose_in_map(start), self._rngs["odometry"])
        self._slip = Slip(self._happenings.slip, self._rngs["slip"])
        self._lost_share = 0.0
        crowd = self._happenings.crowd
        self._people = People(crowd.count, crowd.speed_m_s, crowd.radius_m, self._rngs["people"])
        self._doors = sorted(self._happenings.doors, key=lambda door: door.at_s)
        self._kidnaps = sorted(self._happenings.kidnaps, key=lambda kidnap: kidnap.at_s)
        self._solid = grid.solid
        self._rebuild()
        self._open_doors(at_s=0.0)
        cell_m = mapped_cell_m(grid)
        self.navigator = Navigator(legs, robot, mapped_shape(grid, cell_m), cell_m)
        standing = reachable(_with_cells(grid, self._solid), start.x_m, start.y_m, robot.radius_m)
        self._reachable = np.argwhere(standing)

    @property
    def pose(self) -> Pose:
        """True pose of the robot's centre, grid frame."""
        return Pose(*self._state[:3].tolist())

    @property
    def coverage(self) -> float:
        """See the class."""
        if not len(self._reachable):
            return 0.0
        navigator = self.navigator
        places = (self._reachable + 0.5) * (self.grid.cell_m / navigator.cell_m)
        row, column = places.astype(np.int64).T
        return float(np.mean(navigator.explored.evidence[row, column] != 0))

    @property
    def outstanding(self) -> int:
        """Number of doors and kidnaps that are still to come."""
        return len(self._doors) + len(self._kidnaps)

    @property
    def progress(self) -> float:
        """Number of cells seen as a share of those to be seen: quick, and rough."""
        to_see = len(self._reachable) * (self.grid.cell_m / self.navigator.cell_m) ** 2
        return self.navigator.known_cells / max(to_see, 1.0)

    def __iter__(self) -> Iterator[Observation]:
        """Drive, and yield an observation for each scan."""
        period_s = 1.0 / self.robot.laser.rate_hz
        index = 0
        while True:
            self.t_s = index * period_s
            self._happen()
            pose = self.pose
            sensor = self._laser.pose_at(pose)
            scan = self._laser.scan(self._leap, self.grid.cell_m, sensor, self._people.discs)
            yield Observation(
                index=index,
                t_s=self.t_s,
                pose=self._laser.pose_at(self._odometry.pose),
                scan=scan,
                true_pose=self.grid.pose_in_map(sensor),
            )
            self.navigator.look(self.t_s, pose, sensor, scan)
            if self.navigator.finished:
                legs = self.navigator.legs
                self.ended = legs[-1].ending if legs else "end of an empty journey"
                return
            # A scan at the limit itself is still taken, however its time was rounded.
            if (index + 1) * period_s > self.time_limit_s + 1e-9:
                self.ended = f"time limit of {self.time_limit_s:g} s"
                return
            self._move(period_s)
            index += 1

    def _move(self, seconds: float) -> None:
        """Let the robot and the people move until the next scan."""
        robot, errand = self.robot, self.navigator.errand
        miss_v, miss_w = (1.0 + robot.actuation * self._rngs["wheels"].standard_normal(2)).tolist()
        before = self._state[:2].copy()
        errand.at, errand.status, bumps = motion_kernels.drive(
            self._state, self._measured, errand.way, errand.at, errand.face_rad,
            self.navigator.free_m, self.t_s < self.navigator.backing_until_s,
            seconds, math.ceil(seconds / TICK_S - 1e-9),
            (robot.speed_m_s, robot.turn_rad_s, robot.acceleration_m_s2,
             robot.turn_acceleration_rad_s2),
            (miss_v, miss_w, self._lost_share), self._body_m, self._clearance,
            self.grid.cell_m, self._people.discs,
        )  # fmt: skip
        way_m, turn_rad = self._measured.tolist()
        self.way_m += math.hypot(*(self._state[:2] - before).tolist())
        if bumps:
            self.bumps += 1
            if self.t_s >= self.navigator.backing_until_s:
                self.navigator.bump(self.t_s, self._contact())
        self._odometry.advance(way_m, turn_rad)
        self._lost_share = self._slip.advance(way_m)
        if len(self._people.discs):
            self._people.walk(seconds, self.pose, robot.radius_m)

    def _contact(self) -> tuple[float, float] | None:
        """Return the middle of the nearest solid cell, if the body touches it."""
        cell_m, reach = self.grid.cell_m, math.ceil(self.robot.radius_m / self.grid.cell_m) + 2
        row, column = self.grid.cell_of(*self._state[:2].tolist())
        top, left = max(row - reach, 0), max(column - reach, 0)
        found = np.argwhere(self._solid[top : row + reach + 1, left : column + reach + 1])
        if not len(found):
            return None
        places = (found[:, ::-1] + [left, top] + 0.5) * cell_m
        far = np.hypot(*(places - self._state[:2]).T)
        nearest = int(np.argmin(far))
        if far[nearest] > self.robot.radius_m + 2 * cell_m:
            return None
        return float(places[nearest, 0]), float(places[nearest, 1])

    def _happen(self) -> None:
        """Let doors close and open, and the robot be carried off, if it is time."""
        if self._doors and self._doors[0].at_s <= self.t_s:
            self._open_doors(self.t_s)
        while self._kidnaps and self._kidnaps[0].at_s <= self.t_s:
            to = self._kidnaps.pop(0).to
            self._state[:] = to.x_m, to.y_m, to.theta_rad, 0.0, 0.0
            self.navigator.forget_place()

    def _open_doors(self, at_s: float) -> None:
        waiting: list[DoorChange] = []
        changed = False
        for door in self._doors:
            # What a door has still to do comes in its order.
            later = any(np.array_equal(other.leaf, door.leaf) for other in waiting)
            if later or door.at_s > at_s or (door.closed and self._is_occupied(door.leaf)):
                waiting.append(door)
            else:
                changed = True
                self._solid = self._solid | door.leaf if door.closed else self._solid & ~door.leaf
        self._doors = waiting
        if changed:
            self._rebuild()

    def _is_occupied(self, leaf: NDArray[np.bool_]) -> bool:
        """Tell whether the robot or a person stands where a door would close."""
        row, column = np.nonzero(leaf)
        x, y = (column + 0.5) * self.grid.cell_m, (row + 0.5) * self.grid.cell_m
        bodies = [(*self._state[:2], self.robot.radius_m), *self._people.discs]
        margin = self.grid.cell_m
        return any(bool(np.any(np.hypot(x - bx, y - by) < r + margin)) for bx, by, r in bodies)

    def _rebuild(self) -> None:
        """Work out anew what depends on the walls."""
        self._leap = leaps(self._solid)
        self._clearance = clearance(_with_cells(self.grid, self._solid)).astype(np.float32)
        if len(self._people.discs):
            self._people.enter(self._clearance, self.grid.cell_m, self.pose)


def mapped_cell_m(grid: GridMap) -> float:
    """Return the side of the cells in which a robot maps a building."""
    least, most = MAPPED_CELL_M
    return grid.cell_m if least <= grid.cell_m <= most else DEFAULT_CELL_M


def mapped_shape(grid: GridMap, cell_m: float) -> tuple[int, int]:
    """Return rows and columns of the robot's map of a building."""
    width_m, height_m = grid.size_m
    return math.ceil(height_m / cell_m - 1e-9), math.ceil(width_m / cell_m - 1e-9)


def mapped_solid(grid: GridMap, cell_m: float) -> NDArray[np.bool_]:
    """Return the floor plan in the cells of the robot's map: solid where any part of one is."""
    if cell_m == grid.cell_m:
        return grid.solid
    rows, columns = mapped_shape(grid, cell_m)
    solid = grid.solid
    for axis, size in ((0, rows), (1, columns)):
        # Cells first .. last of the plan lie, in part at least, in each cell of the map.
        edges = np.arange(size + 1) * (cell_m / grid.cell_m)
        first = np.minimum(np.floor(edges[:-1] + 1e-9), solid.shape[axis] - 1).astype(np.int64)
        last = np.minimum(np.ceil(edges[1:] - 1e-9), solid.shape[axis]).astype(np.int64)
        parts = [
            solid.take(range(i, max(j, i + 1)), axis=axis).any(axis=axis)
            for i, j in zip(first, last, strict=True)
        ]
        solid = np.stack(parts, axis=axis)
    return solid


def _with_cells(grid: GridMap, solid: NDArray[np.bool_]) -> GridMap:
    return GridMap(solid.astype(np.uint8), grid.cell_m, grid.origin)
