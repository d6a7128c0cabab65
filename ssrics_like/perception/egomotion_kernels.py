"""The compiled inner loops of egomotion: lines in a scan, and how a later scan fits them."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.compiling import compiled

if TYPE_CHECKING:
    from numpy.typing import NDArray

NEAR_M = 0.05  # a reading nearer than this is a fault
BESIDE = 4  # beams to either side that a line is fitted to
FEWEST = 4  # points of a line
STEP_M, STEP = 0.12, 0.05  # neighbours farther apart in range than this, and a share of it, part
STRAIGHT_M = 0.06  # points that scatter more about their line are no wall
SLENDER = 4.0  # along a wall they scatter so much more, in variance, than across it
CAPTURE_M, NEAREST_M = 0.4, 0.15  # a point belongs to a line so near: at first, then at last
CAPTURING = 3  # rounds at first
WINDOW = 40  # beams to either side among which the nearest line is sought
SCATTER_M = 0.03  # of points about their line: range noise, unevenness
ABOUT_M, ABOUT, ASIDE = 0.15, 0.05, 2  # readings of the same thing: so far apart, so many beams
ENOUGH_M, ENOUGH_RAD = 2e-4, 1e-4  # a smaller correction ends the search


@compiled
def fit_lines(
    bearings_rad: NDArray[np.float64], ranges_m: NDArray[np.float64], out: NDArray[np.float64]
) -> None:
    """Fit a short line to each beam's reading and its neighbours'.

    Parameters
    ----------
    bearings_rad, ranges_m : ndarray, shape (beams,)
        The scan; what is not finite met nothing.
    out : ndarray, shape (beams, 4)
        Filled with a point of the line and its normal, metres, frame of the laser; NaN where the
        readings do not lie on a line.
    """
    beams = len(bearings_rad)
    for i in range(beams):
        out[i, :] = np.nan
        here = ranges_m[i]
        if not NEAR_M < here < np.inf:
            continue
        count = 0
        x_sum = y_sum = xx = xy = yy = 0.0
        for way in (-1, 1):
            last = here
            for k in range(0 if way > 0 else 1, BESIDE + 1):  # the beam itself counts once
                j = i + way * k
                if not 0 <= j < beams:
                    break
                reading = ranges_m[j]
                if not NEAR_M < reading < np.inf or abs(reading - last) > STEP_M + STEP * here:
                    break
                last = reading
                x = reading * math.cos(bearings_rad[j])
                y = reading * math.sin(bearings_rad[j])
                count += 1
                x_sum += x
                y_sum += y
                xx += x * x
                xy += x * y
                yy += y * y
        if count < FEWEST:
            continue
        x_sum /= count
        y_sum /= count
        a, b, c = xx / count - x_sum**2, xy / count - x_sum * y_sum, yy / count - y_sum**2
        spread = math.sqrt(0.25 * (a - c) ** 2 + b * b)
        across = max(0.5 * (a + c) - spread, 0.0)
        along = 0.5 * (a + c) + spread
        if across > STRAIGHT_M**2 or along < SLENDER * across:
            continue
        normal = 0.5 * math.atan2(2.0 * b, a - c) + math.pi / 2
        out[i, 0], out[i, 1] = x_sum, y_sum
        out[i, 2], out[i, 3] = math.cos(normal), math.sin(normal)


@compiled
def match(
    lines: NDArray[np.float64],
    middle_rad: float,
    step_rad: float,
    points: NDArray[np.float64],
    guess: tuple[float, float, float],
    sd_m: float,
    sd_rad: float,
    rounds: int,
) -> tuple[float, float, float, int]:
    """Find from where a scan was taken, seen from where the lines were.

    Gauss-Newton on the distances of the points from the nearest lines, each weighted by Cauchy's
    function, and on the distance from the guess.

    Parameters
    ----------
    lines : ndarray, shape (beams, 4)
        See `fit_lines`.
    middle_rad, step_rad : float
        Bearing of the middle of the lines' beams, and the step between two.
    points : ndarray, shape (points, 2)
        What the scan met, metres, frame of its laser.
    guess : tuple of float
        x, y and heading that odometry gives, metres, radians, in the frame of the lines.
    sd_m, sd_rad : float
        Standard deviations of the guess.
    rounds : int
        At most so many.

    Returns
    -------
    tuple
        x, y, heading, and how many of the points lie near a line.
    """
    beams = len(lines)
    x, y, heading = guess
    stiff_m, stiff_rad = 1.0 / sd_m**2, 1.0 / sd_rad**2
    near = 0
    for round_ in range(rounds):
        capture_m = CAPTURE_M if round_ < CAPTURING else NEAREST_M
        cos, sin = math.cos(heading), math.sin(heading)
        h00 = h11 = stiff_m
        h22 = stiff_rad
        h01 = h02 = h12 = 0.0
        g0, g1 = stiff_m * (guess[0] - x), stiff_m * (guess[1] - y)
        g2 = stiff_rad * (guess[2] - heading)
        near = 0
        for i in range(len(points)):
            px = cos * points[i, 0] - sin * points[i, 1]
            py = sin * points[i, 0] + cos * points[i, 1]
            wx, wy = px + x, py + y
            turn = math.atan2(wy, wx) - middle_rad
            turn -= 2.0 * math.pi * round(turn / (2.0 * math.pi))
            beam = round(0.5 * (beams - 1) + turn / step_rad)
            window = int(min(2.0 + capture_m / (max(math.hypot(wx, wy), 0.2) * step_rad), WINDOW))
            best, line = capture_m**2, -1
            for j in range(max(beam - window, 0), min(beam + window + 1, beams)):
                d = (lines[j, 0] - wx) ** 2 + (lines[j, 1] - wy) ** 2
                if d < best:  # never for NaN
                    best, line = d, j
            if line < 0:
                continue
            near += 1
            nx, ny = lines[line, 2], lines[line, 3]
            off = nx * (lines[line, 0] - wx) + ny * (lines[line, 1] - wy)
            weight = 1.0 / (SCATTER_M**2 + off * off)
            lever = ny * px - nx * py
            h00 += weight * nx * nx
            h01 += weight * nx * ny
            h11 += weight * ny * ny
            h02 += weight * nx * lever
            h12 += weight * ny * lever
            h22 += weight * lever * lever
            g0 += weight * nx * off
            g1 += weight * ny * off
            g2 += weight * lever * off
        # Cramer's rule; the guess keeps the determinant above 0.
        c00, c01, c02 = h11 * h22 - h12 * h12, h02 * h12 - h01 * h22, h01 * h12 - h02 * h11
        determinant = h00 * c00 + h01 * c01 + h02 * c02
        c11, c12, c22 = h00 * h22 - h02 * h02, h01 * h02 - h00 * h12, h00 * h11 - h01 * h01
        dx = (c00 * g0 + c01 * g1 + c02 * g2) / determinant
        dy = (c01 * g0 + c11 * g1 + c12 * g2) / determinant
        turn = (c02 * g0 + c12 * g1 + c22 * g2) / determinant
        x, y, heading = x + dx, y + dy, heading + turn
        if round_ >= CAPTURING and max(abs(dx), abs(dy)) < ENOUGH_M and abs(turn) < ENOUGH_RAD:
            break
    return x, y, heading, near


@compiled
def agreeing(
    ranges_m: NDArray[np.float64],
    middle_rad: float,
    step_rad: float,
    points: NDArray[np.float64],
    pose: tuple[float, float, float],
) -> tuple[int, int]:
    """Count how many points of a scan lie about where an earlier scan met something.

    Parameters
    ----------
    ranges_m : ndarray, shape (beams,)
        The earlier scan; what is not finite met nothing.
    middle_rad, step_rad : float
        Bearing of the middle of its beams, and the step between two.
    points : ndarray, shape (points, 2)
        What the later scan met, metres, frame of its laser.
    pose : tuple of float
        x, y and heading from where it was taken, in the frame of the earlier one.

    Returns
    -------
    tuple of int
        How many points agree, and how many lie where the earlier scan met something.
    """
    beams = len(ranges_m)
    cos, sin = math.cos(pose[2]), math.sin(pose[2])
    agree = compared = 0
    for i in range(len(points)):
        x = cos * points[i, 0] - sin * points[i, 1] + pose[0]
        y = sin * points[i, 0] + cos * points[i, 1] + pose[1]
        turn = math.atan2(y, x) - middle_rad
        turn -= 2.0 * math.pi * round(turn / (2.0 * math.pi))
        beam = round(0.5 * (beams - 1) + turn / step_rad)
        if not 0 <= beam < beams:
            continue
        away = math.hypot(x, y)
        allowed = ABOUT_M + ABOUT * away
        heard = agreed = False
        for j in range(max(beam - ASIDE, 0), min(beam + ASIDE + 1, beams)):
            heard = heard or ranges_m[j] < np.inf
            agreed = agreed or abs(ranges_m[j] - away) < allowed
        compared += heard
        agree += agreed
    return agree, compared
