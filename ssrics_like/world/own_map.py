"""What a robot that finds its way by itself keeps of its surroundings, in its own frame."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ssrics_like.perception.observation import Pose
from ssrics_like.world.navigation import Errand, new_map

if TYPE_CHECKING:
    from ssrics_like.perception.observation import LaserScan
    from ssrics_like.world.robot import RobotProfile

SIDE_M = 30.0
"""Of the window that is kept; what is farther away is forgotten."""
MARGIN_M = 8.0
"""The window moves when the robot is nearer than this to its edge."""


class OwnMap:
    """A window of an occupancy grid that goes along with the robot.

    Poses come from path integration, which drifts, so that old walls would stand beside new ones
    in a map of everything; in a window little has drifted.

    Parameters
    ----------
    robot : RobotProfile
        The robot.
    cell_m : float
        Side of a cell, metres.
    start : Pose
        Of its centre, own frame.

    Attributes
    ----------
    explored, cell_m, errand, moved_away
        As of `navigation.Navigator`, in the frame of the window.
    origin_m : tuple of float
        x and y of the window's corner, own frame.
    """

    def __init__(self, robot: RobotProfile, cell_m: float, start: Pose) -> None:
        cells = round(SIDE_M / cell_m)
        self.explored = new_map(robot, (cells, cells), cell_m)
        self.cell_m = cell_m
        self.errand = Errand()
        self.moved_away = False
        self._robot = robot
        self._centre = start
        self._corner = tuple(round(v / cell_m) - cells // 2 for v in (start.x_m, start.y_m))

    @property
    def origin_m(self) -> tuple[float, float]:
        """See the class."""
        return self._corner[0] * self.cell_m, self._corner[1] * self.cell_m

    def within(self, pose: Pose) -> Pose:
        """Return a pose of the own frame in that of the window."""
        x_m, y_m = self.origin_m
        return Pose(pose.x_m - x_m, pose.y_m - y_m, pose.theta_rad)

    def cell(self) -> tuple[int, int]:
        """Return the row and column that the robot's centre is in."""
        centre = self.within(self._centre)
        return int(centre.y_m / self.cell_m), int(centre.x_m / self.cell_m)

    def take(self, centre: Pose, laser: Pose, scan: LaserScan) -> bool:
        """Take a scan; tell whether the window has moved.

        Parameters
        ----------
        centre, laser : Pose
            Of the robot's centre and of its laser, own frame.
        scan : LaserScan
            What it senses there.
        """
        self._centre = centre
        moved = self._follow()
        self.explored.take(scan, self.within(laser), self._robot.laser.directions)
        return moved

    def _follow(self) -> bool:
        """Move the window, if the robot has come near its edge."""
        cells = self.explored.evidence.shape[0]
        margin = MARGIN_M / self.cell_m
        row, column = self.cell()
        if all(margin <= at <= cells - margin for at in (row, column)):
            return False
        rows, columns = row - cells // 2, column - cells // 2
        self.explored.shift(rows, columns)
        self._corner = self._corner[0] + columns, self._corner[1] + rows
        return True
