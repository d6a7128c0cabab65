"""Small floor plans, robots without faults, and a leg that drives a given way: for the tests."""

import math

import numpy as np

from ssrics_like.perception.observation import Pose
from ssrics_like.world.grid import AT_ORIGIN, FREE, OCCUPIED, UNKNOWN, GridMap
from ssrics_like.world.motion_kernels import ARRIVED
from ssrics_like.world.navigation import Errand
from ssrics_like.world.robot import LaserProfile, OdometryProfile, RobotProfile
from ssrics_like.world.simulation import Simulation

NO_DRIFT = OdometryProfile(
    scale=0.0, turn_scale=0.0, way_noise_m=0.0, turn_noise_rad=0.0, drift_rad=0.0
)
CELL_M = 0.05


def drawn(text, cell_m=1.0, origin=AT_ORIGIN):
    """Make a grid from a drawing: '.' free, '#' occupied, '?' unknown; its top line is on top."""
    values = {".": FREE, "#": OCCUPIED, "?": UNKNOWN}
    lines = text.split()[::-1]
    return GridMap(
        np.array([[values[c] for c in line] for line in lines], np.uint8), cell_m, origin
    )


def room(width_m, height_m, cell_m=CELL_M, walls=(), origin=AT_ORIGIN):
    """Make a room with a wall of two cells round it and boxes (x0, y0, x1, y1) of wall in it."""
    rows, columns = round(height_m / cell_m), round(width_m / cell_m)
    cells = np.full((rows, columns), OCCUPIED, np.uint8)
    cells[2:-2, 2:-2] = FREE
    for box in walls:
        x0, y0, x1, y1 = (round(edge / cell_m) for edge in box)
        cells[y0:y1, x0:x1] = OCCUPIED
    return GridMap(cells, cell_m, origin)


def two_rooms(door_m=0.9, origin=AT_ORIGIN):
    """Make two rooms, 6 x 3 m together, with a doorway in the middle of the wall between them."""
    low, high = 1.5 - door_m / 2, 1.5 + door_m / 2
    return room(6.0, 3.0, walls=[(2.9, 0.0, 3.1, low), (2.9, high, 3.1, 3.0)], origin=origin)


DOOR = (3.0, 1.5)  # the middle of the doorway of `two_rooms`


def offices():
    """Make a corridor with two offices on either side, 9 x 6 m, doorways of 0.9 m."""
    walls = [(4.4, 0.0, 4.5, 2.2), (4.4, 3.8, 4.5, 6.0)]
    for y0, y1 in ((2.1, 2.2), (3.8, 3.9)):
        walls += [(0.0, y0, 2.0, y1), (2.9, y0, 6.2, y1), (7.1, y0, 9.0, y1)]
    return room(9.0, 6.0, walls=walls)


def exact_laser(beams=180, degrees=180.0, **changes):
    """Make a laser without faults that looks over so many degrees, symmetrically."""
    step = degrees / beams
    return LaserProfile(
        **{
            "beams": beams, "first_bearing_deg": -(beams - 1) * step / 2, "step_deg": step,
            "noise_m": 0.0, **changes,
        }
    )  # fmt: skip


def exact_robot(laser=None, **changes):
    """Make a robot whose wheels, odometry and laser have no faults."""
    return RobotProfile(
        **{
            "actuation": 0.0, "odometry": NO_DRIFT,
            "laser": laser or exact_laser(), **changes,
        }
    )  # fmt: skip


class Along:
    """A leg that drives one way, whatever is there, takes up a heading, and ends."""

    ending = "end of the way"

    def __init__(self, places, face_rad=math.nan):
        self.notes = []
        self._errand = Errand(np.array(places, np.float64).reshape(-1, 2), face_rad)

    def begin(self, navigator, t_s):
        pass

    def next(self, navigator, t_s, *, stuck):
        return None if self._errand.status == ARRIVED else self._errand


def line(start, end, step_m=CELL_M):
    """Return places on a straight line, a cell apart as planned ways have them."""
    n = max(math.ceil(math.dist(start, end) / step_m), 1)
    return np.linspace(start, end, n + 1)[1:]


def simulated(grid, robot, start, legs, seed=0, disturbances=None, time_limit_s=600.0):
    """Make a simulation; `start` is x, y and perhaps a heading in the grid frame."""
    pose = Pose(*start, *[0.0] * (3 - len(start)))
    seeds = np.random.SeedSequence(seed)
    return Simulation(grid, robot, pose, legs, seeds, disturbances, time_limit_s=time_limit_s)


def distance_to_solid(grid, x_m, y_m):
    """Return how far a place is from the nearest solid cell or the grid's edge, exactly."""
    rows, columns = np.nonzero(grid.solid)
    aside = np.maximum(np.abs(x_m / grid.cell_m - columns - 0.5) - 0.5, 0.0)
    above = np.maximum(np.abs(y_m / grid.cell_m - rows - 0.5) - 0.5, 0.0)
    width_m, height_m = grid.size_m
    edge = min(x_m, y_m, width_m - x_m, height_m - y_m)
    if not len(rows):
        return edge
    return min(float(np.hypot(aside, above).min()) * grid.cell_m, edge)
