"""Records of a run that stay small however long it is: a series, an outline."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ssrics_like.perception.observation import Observation

_OFFSET = 1 << 20  # cell numbers are packed as two 21-bit halves of one integer
_HALF = 21
_PENDING = 200_000
_CELLS_MAX = 300_000


@dataclass
class Series:
    """A quantity over time, kept as at most `bins_max` bins with their mean and extremes.

    When the bins are full, neighbours are joined and each bin takes twice as many samples.
    """

    bins_max: int = 4096
    _per_bin: int = 1
    _bins: list[list[float]] = field(default_factory=list)  # n, time of first, sum, least, largest

    def append(self, t_s: float, value: float) -> None:
        """Add one sample."""
        if self._bins and self._bins[-1][0] < self._per_bin:
            last = self._bins[-1]
            last[0] += 1
            last[2] += value
            last[3] = min(last[3], value)
            last[4] = max(last[4], value)
            return
        if len(self._bins) == self.bins_max:
            self._bins = [
                [a[0] + b[0], a[1], a[2] + b[2], min(a[3], b[3]), max(a[4], b[4])]
                for a, b in zip(self._bins[::2], self._bins[1::2], strict=True)
            ]
            self._per_bin *= 2
        self._bins.append([1.0, t_s, value, value, value])

    def as_data(self) -> dict[str, list[float]]:
        """Return columns t_s, mean, least, largest."""
        return {
            "t_s": [b[1] for b in self._bins],
            "mean": [b[2] / b[0] for b in self._bins],
            "least": [b[3] for b in self._bins],
            "largest": [b[4] for b in self._bins],
        }


class Outline:
    """The cells that laser beams ended in: a drawing of the building, no map for the robot.

    Parameters
    ----------
    range_max_m : float
        Longer readings are left out.
    cell_m : float
        Side of a cell; doubled when there are too many.
    """

    def __init__(self, range_max_m: float, cell_m: float = 0.1) -> None:
        self.range_max_m = range_max_m
        self.cell_m = cell_m
        self._cells: NDArray[np.int64] = np.empty(0, np.int64)
        self._counts: NDArray[np.int64] = np.empty(0, np.int64)
        self._pending: list[NDArray[np.int64]] = []
        self._pending_size = 0
        self._drawn_at: tuple[float, float, float] | None = None

    def add(self, observation: Observation) -> None:
        """Draw one scan, if the robot has moved since the last that was drawn."""
        pose = observation.true_pose or observation.pose
        here = (pose.x_m, pose.y_m, pose.theta_rad)
        if self._drawn_at is not None:
            x, y, theta = self._drawn_at
            turned = abs(math.remainder(here[2] - theta, math.tau))
            if math.hypot(here[0] - x, here[1] - y) < self.cell_m and turned < 0.1:  # noqa: PLR2004
                return
        self._drawn_at = here
        ranges = observation.scan.ranges_m
        usable = (ranges > 0) & (ranges < self.range_max_m)
        angle = pose.theta_rad + observation.scan.bearings_rad[usable]
        ix = np.floor((pose.x_m + ranges[usable] * np.cos(angle)) / self.cell_m).astype(np.int64)
        iy = np.floor((pose.y_m + ranges[usable] * np.sin(angle)) / self.cell_m).astype(np.int64)
        inside = (abs(ix) < _OFFSET) & (abs(iy) < _OFFSET)
        self._pending.append(((ix[inside] + _OFFSET) << _HALF) | (iy[inside] + _OFFSET))
        self._pending_size += int(inside.sum())
        if self._pending_size > _PENDING:
            self._merge()

    def _merge(self) -> None:
        keys = np.concatenate([self._cells, *self._pending])
        weights = np.concatenate([self._counts, np.ones(self._pending_size, np.int64)])
        self._cells, where = np.unique(keys, return_inverse=True)
        self._counts = np.bincount(where, weights, len(self._cells)).astype(np.int64)
        self._pending, self._pending_size = [], 0
        if len(self._cells) > _CELLS_MAX:
            self.cell_m *= 2
            ix, iy = self._unpack(self._cells)
            self._cells = ((ix // 2 + _OFFSET) << _HALF) | (iy // 2 + _OFFSET)
            self._cells, where = np.unique(self._cells, return_inverse=True)
            self._counts = np.bincount(where, self._counts, len(self._cells)).astype(np.int64)

    @staticmethod
    def _unpack(keys: NDArray[np.int64]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        return (keys >> _HALF) - _OFFSET, (keys & ((1 << _HALF) - 1)) - _OFFSET

    def as_data(self) -> dict[str, Any]:
        """Return the cell size and the numbers (x, y) of cells that more than one beam hit."""
        self._merge()
        ix, iy = self._unpack(self._cells[self._counts > 1])
        return {"cell_m": self.cell_m, "x": ix.tolist(), "y": iy.tolist()}
