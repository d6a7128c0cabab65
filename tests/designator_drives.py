"""Drives made up observation by observation, and simulated ones: for tests of designators."""

import itertools
import math

import numpy as np
from buildings import Along, exact_laser, exact_robot, line, simulated

from ssrics_like.perception.observation import LaserScan, Observation, Pose

BEAMS = 90
ROOM = np.full(BEAMS, 3.0)


def observation(index, pose, ranges_m=ROOM, angle_min=None, step=None):
    ranges_m = np.asarray(ranges_m, float)
    step = math.pi / len(ranges_m) if step is None else step
    angle_min = -0.5 * step * (len(ranges_m) - 1) if angle_min is None else angle_min
    return Observation(index, 0.1 * index, Pose(*pose), LaserScan(ranges_m, angle_min, step))


def straight(metres, spacing_m=0.05, ranges=lambda _: ROOM):
    """Drive along the x axis; `ranges` gives a scan for the metres driven."""
    steps = round(metres / spacing_m)
    return [
        observation(k, (k * spacing_m, 0.0, 0.0), ranges(k * spacing_m)) for k in range(steps + 1)
    ]


def driven(grid, places, laser=None, seed=0):
    """Drive through a building along straight lines, with a robot and a laser without faults."""
    way = np.vstack([line(a, b) for a, b in itertools.pairwise(places)])
    heading = math.atan2(places[1][1] - places[0][1], places[1][0] - places[0][0])
    robot = exact_robot(laser or exact_laser())
    return list(simulated(grid, robot, (*places[0], heading), [Along(way)], seed))


def travelled(drive):
    """Return the metres travelled at each observation."""
    xy = np.array([(o.pose.x_m, o.pose.y_m) for o in drive])
    return np.concatenate([[0.0], np.hypot(*np.diff(xy, axis=0).T).cumsum()])


def spots(drive, marks):
    """Return the positions of the marks, shape (n, 2)."""
    return np.array([(drive[m.scan].pose.x_m, drive[m.scan].pose.y_m) for m in marks]).reshape(
        -1, 2
    )
