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
CAPTURING = 3  # rounds at first, in which a point belongs to a line that is twice as far
SCATTER_M = 0.03  # of points about their line: range noise, unevenness
ALIKE = 0.5  # cosine of the angle between two lines that are of the same wall
ENOUGH_M, ENOUGH_RAD = 2e-4, 1e-4  # a smaller correction ends the search
ABOUT_M, ABOUT, ASIDE = 0.15, 0.05, 2  # readings of the same thing: so far apart, so many beams


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
def remember(
    lines: NDArray[np.float64],
    seen_m: NDArray[np.float64],
    cells: NDArray[np.int64],
    cell_m: float,
    pose: tuple[float, float, float],
    new: NDArray[np.float64],
    at_m: float,
    within_m: float,
) -> None:
    """Add the lines of a scan to what was seen lately; what is there already stays as it is.

    Parameters
    ----------
    lines : ndarray, shape (n, n, most, 4)
        Of each square cell: a point and the normal that looks towards where it was seen from.
        The plane is rolled up, so that cells n apart share their place.
    seen_m : ndarray, shape (n, n, most)
        Length of the path when each was seen.
    cells : ndarray, shape (n, n, 3)
        Row and column of the cell that is kept there, and how many lines it has.
    cell_m : float
        Side of a cell.
    pose : tuple of float
        x, y and heading from where the scan was taken.
    new : ndarray, shape (beams, 4)
        Its lines; see `fit_lines`.
    at_m, within_m : float
        Length of the path by now; what was seen longer ago than the latter is forgotten.
    """
    n, most = lines.shape[0], lines.shape[2]
    apart_m2 = (cell_m / most) ** 2
    cos, sin = math.cos(pose[2]), math.sin(pose[2])
    for i in range(len(new)):
        if math.isnan(new[i, 0]):
            continue
        away_x = cos * new[i, 0] - sin * new[i, 1]
        away_y = sin * new[i, 0] + cos * new[i, 1]
        nx = cos * new[i, 2] - sin * new[i, 3]
        ny = sin * new[i, 2] + cos * new[i, 3]
        if nx * away_x + ny * away_y > 0.0:
            nx, ny = -nx, -ny
        x, y = pose[0] + away_x, pose[1] + away_y
        row, column = math.floor(y / cell_m), math.floor(x / cell_m)
        r, c = row % n, column % n
        if cells[r, c, 0] != row or cells[r, c, 1] != column:
            cells[r, c, 0], cells[r, c, 1], cells[r, c, 2] = row, column, 0
        kept = 0
        known = False
        for j in range(cells[r, c, 2]):
            if at_m - seen_m[r, c, j] > within_m:
                continue
            seen_m[r, c, kept] = seen_m[r, c, j]
            lines[r, c, kept] = lines[r, c, j]
            near = (lines[r, c, kept, 0] - x) ** 2 + (lines[r, c, kept, 1] - y) ** 2 < apart_m2
            along = lines[r, c, kept, 2] * nx + lines[r, c, kept, 3] * ny
            known = known or (near and along > ALIKE)
            kept += 1
        if not known and kept < most:
            lines[r, c, kept, 0], lines[r, c, kept, 1] = x, y
            lines[r, c, kept, 2], lines[r, c, kept, 3] = nx, ny
            seen_m[r, c, kept] = at_m
            kept += 1
        cells[r, c, 2] = kept


@compiled
def _nearest(
    lines: NDArray[np.float64],
    seen_m: NDArray[np.float64],
    cells: NDArray[np.int64],
    cell_m: float,
    at: tuple[float, float],
    look: tuple[float, float],
    capture_m: float,
    since_m: float,
) -> tuple[bool, float, float, float]:
    """Find the line nearest to a place that is looked at in a direction.

    Returns
    -------
    tuple
        Whether there is one within `capture_m`, its normal, and how far it is from the place along
        that.
    """
    n = len(lines)
    row, column = math.floor(at[1] / cell_m), math.floor(at[0] / cell_m)
    best, nx, ny, off = capture_m**2, 0.0, 0.0, 0.0
    found = False
    for cell_row in range(row - 1, row + 2):
        for cell_column in range(column - 1, column + 2):
            r, c = cell_row % n, cell_column % n
            if cells[r, c, 0] != cell_row or cells[r, c, 1] != cell_column:
                continue
            for j in range(cells[r, c, 2]):
                x, y = lines[r, c, j, 0] - at[0], lines[r, c, j, 1] - at[1]
                d = x * x + y * y
                if d >= best or seen_m[r, c, j] < since_m:
                    continue
                # A wall is seen from one side; from the other it is another one.
                if lines[r, c, j, 2] * look[0] + lines[r, c, j, 3] * look[1] >= 0.0:
                    continue
                best, found = d, True
                nx, ny = lines[r, c, j, 2], lines[r, c, j, 3]
                off = nx * x + ny * y
    return found, nx, ny, off


@compiled
def match(
    lines: NDArray[np.float64],
    seen_m: NDArray[np.float64],
    cells: NDArray[np.int64],
    cell_m: float,
    points: NDArray[np.float64],
    guess: tuple[float, float, float],
    sd: tuple[float, float],
    rounds: int,
    since_m: float,
) -> tuple[float, float, float, int]:
    """Find from where a scan was taken, by the lines that were seen lately.

    Gauss-Newton on the distances of the points from the nearest lines, each weighted by Cauchy's
    function, and on the distance from the guess.

    Parameters
    ----------
    lines, seen_m, cells, cell_m : as for `remember`
        A point belongs to a line within a cell's side.
    points : ndarray, shape (points, 2)
        What the scan met, metres, frame of its laser.
    guess : tuple of float
        x, y and heading that odometry gives, metres, radians.
    sd : tuple of float
        Standard deviations of the guess, metres and radians.
    rounds : int
        At most so many.
    since_m : float
        Lines seen before the path was so long do not count.

    Returns
    -------
    tuple
        x, y, heading, and how many of the points lie near a line.
    """
    x, y, heading = guess
    stiff_m, stiff_rad = 1.0 / sd[0] ** 2, 1.0 / sd[1] ** 2
    near = 0
    for round_ in range(rounds):
        capture_m = cell_m if round_ < CAPTURING else 0.5 * cell_m
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
            found, nx, ny, off = _nearest(
                lines, seen_m, cells, cell_m, (wx, wy), (px, py), capture_m, since_m
            )
            if not found:
                continue
            near += 1
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
