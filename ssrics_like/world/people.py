"""People who walk about: discs that go from one random place to another."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from scipy import ndimage

from ssrics_like.errors import MapError
from ssrics_like.world import way_kernels
from ssrics_like.world.occupancy import BLOCKED, OPEN, TIGHT

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ssrics_like.perception.observation import Pose

BERTH_M = 0.2  # they keep off walls where there is room
POLITE_M = 0.3  # they stop this far from the robot
ENTRY_M = 1.0  # so far from the robot they start, if there is room
TRIES = 50
PATIENCE_S = 3.0  # and turn elsewhere when it does not go away


class People:
    """A number of walkers.

    Parameters
    ----------
    count : int
        How many.
    speed_m_s, radius_m : float
        Of each.
    rng : numpy.random.Generator
        Where they start and want to go.

    Attributes
    ----------
    discs : ndarray, shape (count, 3)
        x, y, radius, metres, grid frame.
    """

    def __init__(
        self, count: int, speed_m_s: float, radius_m: float, rng: np.random.Generator
    ) -> None:
        self.discs = np.zeros((count, 3))
        self.discs[:, 2] = radius_m
        self._speed_m_s = speed_m_s
        self._rng = rng
        self._ways: list[NDArray[np.float64]] = [np.empty((0, 2))] * count
        self._waited_s = np.zeros(count)
        self._entered = False

    def enter(self, clearance: NDArray[np.float32], cell_m: float, robot: Pose) -> None:
        """Learn the building, at first or after it has changed.

        Parameters
        ----------
        clearance : ndarray, shape (rows, columns)
            Distance from each cell to the nearest solid one, metres.
        cell_m : float
            Side of a cell, metres.
        robot : Pose
            Where the robot is: people start where it can get to, and not on it.
        """
        self._cell_m = cell_m
        radius_m = self.discs[0, 2] if len(self.discs) else 0.0
        self._costs = np.where(clearance > radius_m + BERTH_M, OPEN, TIGHT).astype(np.uint8)
        self._costs[clearance <= radius_m] = BLOCKED
        self._costs[clearance <= 0.0] = 0
        self._distance = np.empty(clearance.shape, np.int32)
        self._parent = np.empty(clearance.shape, np.int32)
        # A closed door parts the building: everybody stays in the part that he is in.
        self._parts, count = ndimage.label(clearance > radius_m, structure=np.ones((3, 3)))
        order = np.argsort(self._parts, axis=None, kind="stable")
        ends = np.searchsorted(self._parts.ravel()[order], np.arange(count + 2))
        self._places = [order[ends[i] : ends[i + 1]] for i in range(count + 1)]
        self._ways = [np.empty((0, 2))] * len(self.discs)
        if not self._entered:
            self._entered = True
            part = self._part_near(robot)
            for disc in self.discs:
                for _ in range(TRIES):
                    disc[:2] = self._place(part)
                    if math.hypot(disc[0] - robot.x_m, disc[1] - robot.y_m) > ENTRY_M:
                        break

    def walk(self, seconds: float, robot: Pose, robot_radius_m: float) -> None:
        """Let everybody walk for a moment."""
        for i, disc in enumerate(self.discs):
            way = self._ways[i]
            left = self._speed_m_s * seconds
            x, y = disc[0], disc[1]
            while left > 0.0 and len(way):
                step = math.hypot(way[0, 0] - x, way[0, 1] - y)
                share = min(left / step, 1.0) if step > 0.0 else 1.0
                x, y = x + share * (way[0, 0] - x), y + share * (way[0, 1] - y)
                left -= step
                if share == 1.0:
                    way = way[1:]
            gap = math.hypot(x - robot.x_m, y - robot.y_m) - disc[2] - robot_radius_m
            nearer = gap < math.hypot(disc[0] - robot.x_m, disc[1] - robot.y_m) - disc[2] - (
                robot_radius_m
            )
            if gap < POLITE_M and nearer:
                self._waited_s[i] += seconds
            else:
                disc[:2] = x, y
                self._ways[i] = way
                self._waited_s[i] = 0.0
            if not len(self._ways[i]) or self._waited_s[i] > PATIENCE_S:
                self._waited_s[i] = 0.0
                self._ways[i] = self._new_way(disc)

    def _part_near(self, robot: Pose) -> int:
        """Return the part of the building that the robot is in, or the one nearest to it."""
        row, column = np.nonzero(self._parts)
        if not len(row):
            raise MapError(f"people of radius {self.discs[0, 2]:g} m fit nowhere on the map")
        far = np.hypot(
            (column + 0.5) * self._cell_m - robot.x_m, (row + 0.5) * self._cell_m - robot.y_m
        )
        nearest = int(np.argmin(far))
        return int(self._parts[row[nearest], column[nearest]])

    def _place(self, part: int) -> tuple[float, float]:
        """Return a random place in a part of the building."""
        cell = int(self._places[part][self._rng.integers(len(self._places[part]))])
        row, column = divmod(cell, self._parts.shape[1])
        return (column + 0.5) * self._cell_m, (row + 0.5) * self._cell_m

    def _new_way(self, disc: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return a way to a random place, empty for somebody who is hemmed in."""
        start = int(disc[1] / self._cell_m), int(disc[0] / self._cell_m)
        part = int(self._parts[start])
        if not part:
            return np.empty((0, 2))
        x, y = self._place(part)
        goals = np.full(self._costs.shape, -1, np.int32)
        goals[int(y / self._cell_m), int(x / self._cell_m)] = 0
        goal = way_kernels.spread(self._costs, goals, start, TIGHT, self._distance, self._parent)
        if goal < 0:
            return np.empty((0, 2))
        way: NDArray[np.float64] = way_kernels.way_to(self._parent, goal, self._cell_m)
        return way
