"""When a robot went through a doorway: its path crosses the line between the two jambs."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ssrics_like.comparison.drive import Passages
from ssrics_like.comparison.way import CARRIED_M, Way
from ssrics_like.world import ray_kernels
from ssrics_like.world.grid import GridMap
from ssrics_like.world.laser import leaps
from ssrics_like.world.locations import Location

WIDEST_M = 3.0
"""A wider gap is no doorway, as in `ssrics_like.world.doors`."""
ANGLES = 180
TOGETHER_M = 1.0
"""Crossings of one line with less of the way between them are one coming and going."""


def thresholds(grid: GridMap, locations: Sequence[Location]) -> NDArray[np.float64]:
    """Return the line across the gap that each location lies in.

    It is the shortest straight line through the location that ends at walls on both sides, the
    one on which `ssrics_like.world.doors.door_leaf` hangs a door.

    Parameters
    ----------
    grid : GridMap
        The floor plan, doors open.
    locations : sequence of Location
        Places, in the frame of the map.

    Returns
    -------
    ndarray, shape (locations, 2, 2)
        Both ends of each line, x and y in the frame of the map; NaN for a location that lies in
        no gap of up to 3 m.
    """
    lines = np.full((len(locations), 2, 2), np.nan)
    if len(locations) == 0:
        return lines
    angles = np.pi * np.arange(ANGLES) / ANGLES
    directions = np.column_stack([np.cos(angles), np.sin(angles)])
    leap = leaps(grid.solid)
    for line, (x, y) in zip(
        lines, grid.points_in_grid([(p.x_m, p.y_m) for p in locations]).tolist(), strict=True
    ):
        if not grid.is_free(x, y):
            continue
        reach = np.empty((2, ANGLES))
        for side, sign in enumerate((1.0, -1.0)):
            ray_kernels.cast_scan(
                leap, grid.cell_m, (x, y, 0.0), sign * directions, WIDEST_M, reach[side]
            )
        widths = reach.sum(axis=0)
        width = float(widths.min())
        if not math.isfinite(width) or width > WIDEST_M:
            continue
        # Lines that are as short to a hundredth of a cell differ by rounding; the middle one
        # stands straight.
        equal = np.flatnonzero(widths <= width + 0.01 * grid.cell_m)
        best = int(equal[np.argmin(np.abs(equal - equal.mean()))])
        ends = [(x, y) + sign * reach[side, best] * directions[best]
                for side, sign in enumerate((1.0, -1.0))]  # fmt: skip
        line[:] = grid.points_in_map(ends)
    return lines


def passages_through(way: Way, lines: ArrayLike) -> Passages:
    """Find the passages of a way through lines.

    The robot has passed when it is on the other side: crossings of one line with less than 1 m
    of way between one and the next are taken together, and an even number of them, after which
    the robot is back where it came from, is no passage. A passage lies at the middle one of its
    crossings.

    Parameters
    ----------
    way : Way
        Where the robot was.
    lines : array_like, shape (places, 2, 2)
        Both ends of the line across each place, in the frame of the way; NaN for a place that
        has none.

    Returns
    -------
    Passages
        In order of the way; `place` is the index of the line.
    """
    lines = np.asarray(lines, np.float64).reshape(-1, 2, 2)
    found: list[tuple[float, int]] = []
    for place, line in enumerate(lines):
        if np.isfinite(line).all():
            found += [(along, place) for along in _passed(_crossings(way, line))]
    return Passages.of([place for _, place in found], [along for along, _ in found])


def _crossings(way: Way, line: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the metres driven up to each crossing of a line."""
    a, b = line
    (dx, dy), (x, y) = b - a, (way.xy_m - a).T
    aside = dx * y - dy * x  # twice the area of the triangle: its sign says on which side
    left = aside > 0
    before = np.flatnonzero(left[1:] != left[:-1])
    share = aside[before] / (aside[before] - aside[before + 1])
    steps = way.xy_m[before + 1] - way.xy_m[before]
    at = way.xy_m[before] + share[:, np.newaxis] * steps - a
    on_line = (at @ (b - a)) / ((b - a) @ (b - a))
    kept = (on_line >= 0) & (on_line <= 1) & (np.hypot(*steps.T) <= CARRIED_M)
    length = way.along_m[before + 1] - way.along_m[before]
    crossed: NDArray[np.float64] = (way.along_m[before] + share * length)[kept]
    return crossed


def _passed(crossings: NDArray[np.float64]) -> list[float]:
    """Return where the robot got to the other side for good, of its crossings of one line."""
    groups = np.split(crossings, np.flatnonzero(np.diff(crossings) >= TOGETHER_M) + 1)
    return [float(group[len(group) // 2]) for group in groups if len(group) % 2]
