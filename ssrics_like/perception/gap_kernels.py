"""The compiled inner loops of gap features: what the surroundings of a place look like."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.compiling import compiled
from ssrics_like.perception.around_kernels import around
from ssrics_like.perception.frame_kernels import LIMIT_M, framed, narrowest
from ssrics_like.perception.local_map_kernels import CELL_M, FREE, OCCUPIED, march, state

if TYPE_CHECKING:
    from numpy.typing import NDArray

STEPS, STEP_M = 41, 0.1  # cross-sections, from 2 m behind the gap to 2 m ahead
HERE = STEPS // 2
STRETCHES = ((0, 10), (10, 16), (16, 19), (19, 22), (22, 25), (25, 31), (31, 41))
WIDER_M = 0.2  # a cross-section that is wider by this no longer belongs to the neck
STRIPS = 30  # cells along a jamb's wall, 1.5 m
BESIDE, FINE_M = (
    12,
    CELL_M / 2,
)  # to either side of its line; finer than cells, or a thin wall slips
BANDS_M = ((-2.0, -1.0), (-1.0, -0.3), (-0.3, 0.3), (0.3, 1.0), (1.0, 2.0))
NONE = 100


@compiled
def gap_features(
    evidence: NDArray[np.int8],
    seen_m: NDArray[np.float64],
    place: tuple[float, float, float],
    oldest_m: float,
    out: NDArray[np.float64],
) -> tuple[float, float, float]:
    """Describe the gap at a place.

    Parameters
    ----------
    evidence, seen_m : ndarray, shape (cells, cells)
        The local map.
    place : tuple of float
        x, y and direction of travel: metres, radians, frame of the map.
    oldest_m : float
        What was seen before counts as unknown.
    out : ndarray, shape (features,)
        Filled in the order of `ssrics_like.perception.gap.FEATURES`.

    Returns
    -------
    tuple of float
        x and y of the gap's middle, and the direction through it that the robot takes.
    """
    left, right, towards = narrowest(evidence, seen_m, place, oldest_m)
    lx, ly = math.cos(towards), math.sin(towards)
    middle = framed((place[0], place[1]), (lx, ly), 0.0, 0.5 * (left - right))
    width = left + right
    out[0] = width
    out[1] = abs(left - right)
    out[2] = abs(towards - place[2] - math.pi / 2)
    at = _cross_sections(evidence, seen_m, middle, (lx, ly), width, oldest_m, out, 3)
    at = _walls(evidence, seen_m, middle, (lx, ly), width, oldest_m, out, at)
    at = _floor(evidence, seen_m, middle, (lx, ly), oldest_m, out, at)
    around(evidence, seen_m, middle, (lx, ly), width, oldest_m, out, at)
    return middle[0], middle[1], towards - math.pi / 2


@compiled
def _cross_sections(
    evidence: NDArray[np.int8],
    seen_m: NDArray[np.float64],
    middle: tuple[float, float],
    left: tuple[float, float],
    width_m: float,
    oldest_m: float,
    out: NDArray[np.float64],
    at: int,
) -> int:
    """Measure how wide it is behind the gap, in it and ahead, and how deep the neck is."""
    lx, ly = left
    near, far = np.empty(STEPS), np.empty(STEPS)
    unknown = np.empty(STEPS)
    for step in range(STEPS):
        start = framed(middle, left, (step - HERE) * STEP_M, 0.0)
        one, dark = march(evidence, seen_m, start, (lx, ly), LIMIT_M, oldest_m)
        other, dim = march(evidence, seen_m, start, (-lx, -ly), LIMIT_M, oldest_m)
        near[step], far[step], unknown[step] = min(one, other), max(one, other), dark + dim
    for step in range(0, STEPS, 2):
        out[at], out[at + 1] = near[step], far[step]
        at += 2
    widths = near + far
    for first, last in STRETCHES:
        out[at] = widths[first:last].min()
        out[at + 1] = widths[first:last].max()
        out[at + 2] = widths[first:last].mean()
        out[at + 3] = unknown[first:last].mean()
        at += 4
    ahead_steps = 0
    while HERE + ahead_steps < STEPS and widths[HERE + ahead_steps] < width_m + WIDER_M:
        ahead_steps += 1
    behind_steps = 0
    while behind_steps < HERE and widths[HERE - 1 - behind_steps] < width_m + WIDER_M:
        behind_steps += 1
    out[at], out[at + 1] = ahead_steps, behind_steps
    return at + 2


@compiled
def _walls(
    evidence: NDArray[np.int8],
    seen_m: NDArray[np.float64],
    middle: tuple[float, float],
    left: tuple[float, float],
    width_m: float,
    oldest_m: float,
    out: NDArray[np.float64],
    at: int,
) -> int:
    """Measure whether walls continue beyond both jambs: a doorway has them, a table has not."""
    sides = np.zeros((2, 8))
    for side in range(2):
        sign = 1.0 if side == 0 else -1.0
        unbroken, seen = True, 0
        total = squares = 0.0
        for strip in range(STRIPS):
            aside = sign * (0.5 * width_m + CELL_M * (strip + 0.5))
            nearest, free = NONE, 0
            for offset in range(-BESIDE, BESIDE + 1):
                x, y = framed(middle, left, offset * FINE_M, aside)
                here = state(evidence, seen_m, x, y, oldest_m)
                if here == OCCUPIED and abs(offset) < abs(nearest):
                    nearest = offset
                elif here == FREE:
                    free += 1
            if nearest != NONE:
                sides[side, strip // 10] += 0.1
                sides[side, 3] += CELL_M if unbroken else 0.0
                total += nearest
                squares += nearest * nearest
                seen += 1
            elif free > BESIDE:
                unbroken = False
            elif free <= BESIDE // 3:  # hardly anything is known
                sides[side, 4] += CELL_M
        sides[side, 5] = sides[side, 6] = 1.0
        if seen > 2:  # noqa: PLR2004 - a line needs points
            mean = total / seen
            sides[side, 5] = math.sqrt(max(0.0, squares / seen - mean * mean)) * FINE_M
            sides[side, 6] = mean * FINE_M
        sides[side, 7] = sides[side, :3].sum()
    for measure in range(8):
        out[at] = min(sides[0, measure], sides[1, measure])
        out[at + 1] = max(sides[0, measure], sides[1, measure])
        at += 2
    return at


@compiled
def _floor(
    evidence: NDArray[np.int8],
    seen_m: NDArray[np.float64],
    middle: tuple[float, float],
    left: tuple[float, float],
    oldest_m: float,
    out: NDArray[np.float64],
    at: int,
) -> int:
    """Measure how much is occupied and free on the way and to its sides, in bands along it."""
    for first_m, last_m in BANDS_M:
        counts = np.zeros((2, 2))
        rows = round((last_m - first_m) / STEP_M)
        for row in range(rows):
            ahead = first_m + STEP_M * (row + 0.5)
            for column in range(-20, 21):
                x, y = framed(middle, left, ahead, STEP_M * column)
                here = state(evidence, seen_m, x, y, oldest_m)
                group = 0 if abs(column) <= 8 else 1  # noqa: PLR2004 - the robot's own lane
                if here == OCCUPIED:
                    counts[group, 0] += 1
                elif here == FREE:
                    counts[group, 1] += 1
        for group, columns in ((0, 17), (1, 24)):
            out[at] = counts[group, 0] / (rows * columns)
            out[at + 1] = counts[group, 1] / (rows * columns)
            at += 2
    return at
