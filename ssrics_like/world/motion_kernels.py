"""The compiled inner loop of driving: follow a path, obey the limits, hit nothing."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from ssrics_like.compiling import compiled

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

LOOK_AHEAD_M = (0.15, 0.4)  # slow and fast: steering for a nearer place would swing, for a
LOOK_AHEAD_S = 0.5  # farther one cut corners
PROGRESS_M = 1.0
ARRIVED_M = 0.12
FACED_RAD = 0.06
SLOW_RAD_S = 0.3  # turning no faster than this, the robot has faced what it was to face
PIVOT_RAD = 0.9  # farther off than this, the robot turns on the spot first
BRAKING = 0.7  # share of the deceleration that is counted on
CREEP_M_S = 0.05
BACKING_M_S = 0.2
SLOW_M_S = 0.3
SLOW_GAIN = 1.5  # per second: gentle enough for the turn to stop in time

ON_THE_WAY, ARRIVED = 0, 1


@compiled
def wrapped(angle: float) -> float:
    """Return an angle within -pi .. pi."""
    return math.atan2(math.sin(angle), math.cos(angle))


@compiled
def _steer(
    state: NDArray[np.float64],
    path: NDArray[np.float64],
    at: int,
    face_rad: float,
    free_m: float,
    limits: tuple[float, float, float, float],
) -> tuple[int, float, float, int]:
    """Return progress on the path, wanted speed and turn rate, and ON_THE_WAY or ARRIVED."""
    x, y, theta = state[0], state[1], state[2]
    speed, turn, brake, turn_brake = limits
    last = path.shape[0] - 1
    if at <= last:
        # The nearest place is looked for some way on: where a way curls, the next place may be
        # farther off than this one and the one after it nearer.
        here = math.hypot(path[at, 0] - x, path[at, 1] - y)
        along = 0.0
        nearest = at
        for i in range(at + 1, last + 1):
            along += math.hypot(path[i, 0] - path[i - 1, 0], path[i, 1] - path[i - 1, 1])
            if along > PROGRESS_M:
                break
            there = math.hypot(path[i, 0] - x, path[i, 1] - y)
            if there <= here:
                here, nearest = there, i
        at = nearest
        if at == last and here < ARRIVED_M:
            at += 1
    if at <= last:
        look_ahead = min(max(LOOK_AHEAD_S * state[3], LOOK_AHEAD_M[0]), LOOK_AHEAD_M[1])
        aim = at
        while aim < last and math.hypot(path[aim, 0] - x, path[aim, 1] - y) < look_ahead:
            aim += 1
        ox, oy = path[aim, 0] - x, path[aim, 1] - y
        distance = math.hypot(ox, oy)
        off = wrapped(math.atan2(oy, ox) - theta)
        if abs(off) > PIVOT_RAD:
            most = math.sqrt(2.0 * BRAKING * turn_brake * abs(off))
            return at, 0.0, math.copysign(min(turn, most), off), ON_THE_WAY
        bend = 2.0 * math.sin(off) / max(distance, LOOK_AHEAD_M[0])
        left = math.hypot(path[last, 0] - x, path[last, 1] - y)
        wanted = min(speed, math.sqrt(2.0 * BRAKING * brake * left))
        brake_for = math.sqrt(2.0 * BRAKING * brake * max(free_m, 0.0))
        wanted = min(wanted, max(brake_for, CREEP_M_S))
        if bend != 0.0:
            wanted = min(wanted, max(0.7 * turn / abs(bend), CREEP_M_S))
        wanted *= math.cos(off)
        # Slow, it turns towards the aim; fast, it follows the arc that leads there.
        bent = bend * state[3] + SLOW_GAIN * off * max(1.0 - state[3] / SLOW_M_S, 0.0)
        return at, wanted, min(max(bent, -turn), turn), ON_THE_WAY
    if not math.isnan(face_rad):
        off = wrapped(face_rad - theta)
        if abs(off) > FACED_RAD or abs(state[4]) > SLOW_RAD_S:
            most = math.sqrt(2.0 * BRAKING * turn_brake * abs(off))
            return at, 0.0, math.copysign(min(turn, most), off), ON_THE_WAY
    return at, 0.0, 0.0, ARRIVED


@compiled
def _room(
    clearance: NDArray[np.float32],
    cell_m: float,
    discs: NDArray[np.float64],
    x: float,
    y: float,
) -> float:
    """Return the distance from a place to the nearest solid cell or disc, metres."""
    # Between the centres of four cells; beyond the outermost centres there are only walls.
    column, row = math.floor(x / cell_m - 0.5), math.floor(y / cell_m - 0.5)
    if row < 0 or row + 1 >= clearance.shape[0] or column < 0 or column + 1 >= clearance.shape[1]:
        return -1.0
    right, up = x / cell_m - 0.5 - column, y / cell_m - 0.5 - row
    room = (1.0 - up) * (
        (1.0 - right) * clearance[row, column] + right * clearance[row, column + 1]
    ) + up * ((1.0 - right) * clearance[row + 1, column] + right * clearance[row + 1, column + 1])
    for i in range(discs.shape[0]):
        room = min(room, math.hypot(discs[i, 0] - x, discs[i, 1] - y) - discs[i, 2])
    return float(room)


@compiled
def drive(
    state: NDArray[np.float64],
    measured: NDArray[np.float64],
    path: NDArray[np.float64],
    at: int,
    face_rad: float,
    free_m: float,
    backing: bool,
    seconds: float,
    ticks: int,
    limits: tuple[float, float, float, float],
    factors: tuple[float, float, float],
    radius_m: float,
    clearance: NDArray[np.float32],
    cell_m: float,
    discs: NDArray[np.float64],
) -> tuple[int, int, int]:
    """Drive along a path for a while.

    Parameters
    ----------
    state : ndarray, shape (5,)
        x, y, heading, speed, turn rate; changed in place. Metres, radians, seconds, grid frame.
    measured : ndarray, shape (2,)
        Way and turn as the wheels count them; set.
    path : ndarray, shape (n, 2)
        Places to pass; may be empty.
    at : int
        Index of the path's next place; n once it is done.
    face_rad : float
        Heading to take up at its end; NaN for none.
    free_m : float
        How far the way ahead is free, by the last scan.
    backing : bool
        Back off straight instead.
    seconds, ticks
        For how long, and in how many steps.
    limits : tuple of float
        Speed, turn rate, and how fast these may change.
    factors : tuple of float
        What the wheels make of the commanded speed and turn rate, and the share of the wheels' way
        that is lost to slip.
    radius_m, clearance, cell_m, discs
        The body, and what it must not touch: per cell the distance to the nearest solid one; people
        as x, y, radius.

    Returns
    -------
    at : int
        New progress.
    status : int
        ON_THE_WAY or ARRIVED.
    bumps : int
        Steps in which the body ran against something.
    """
    bumps = 0
    dt = seconds / ticks
    status = ON_THE_WAY
    measured[:] = 0.0
    slip = factors[2]
    room = _room(clearance, cell_m, discs, state[0], state[1])
    for _ in range(ticks):
        if backing:
            wanted_v, wanted_w = -BACKING_M_S, 0.0
        else:
            at, wanted_v, wanted_w, status = _steer(state, path, at, face_rad, free_m, limits)
        dv, dw = limits[2] * dt, limits[3] * dt
        state[3] += min(max(wanted_v - state[3], -2.0 * dv), dv)  # brakes are stronger
        state[4] += min(max(wanted_w - state[4], -dw), dw)
        way = state[3] * factors[0] * dt
        turned = state[4] * factors[1] * dt
        measured[0] += way
        measured[1] += turned
        heading = state[2] + 0.5 * turned
        x = state[0] + way * (1.0 - slip) * math.cos(heading)
        y = state[1] + way * (1.0 - slip) * math.sin(heading)
        state[2] = wrapped(state[2] + turned)
        there = _room(clearance, cell_m, discs, x, y)
        if there >= radius_m or there > room:
            state[0], state[1] = x, y
            room = there
        elif way != 0.0:
            # Against something: the bumper stops the wheels.
            measured[0] -= way
            state[3] = 0.0
            bumps += 1
        free_m -= way
    return at, status, bumps


@compiled
def free_ahead(
    ranges_m: NDArray[np.float64],
    directions: NDArray[np.float64],
    laser_x_m: float,
    half_width_m: float,
) -> float:
    """Return how far the robot can drive straight on until its body touches a scan point."""
    nearest = math.inf
    for k in range(ranges_m.shape[0]):
        r = ranges_m[k]
        if not math.isfinite(r):
            continue
        ahead = r * directions[k, 0] + laser_x_m
        aside = abs(r * directions[k, 1])
        if ahead > 0.0 and aside < half_width_m:
            nearest = min(nearest, ahead - math.sqrt(half_width_m**2 - aside**2))
    return nearest
