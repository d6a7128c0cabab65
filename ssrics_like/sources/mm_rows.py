"""One row a scan in millimetres: the Mines ParisTech rover with a URG-04LX.

A row is a header and 682 readings. Of the header are used column 0, the time in
microseconds, and columns 2 and 3, the counts of the left and right wheel
encoder (BreezySLAM reads the same ones; that it is this way round, and that the
beams run from right to left, is confirmed by the map that the poses draw).

The readings are the *last* 682 columns. In the published logs a double blank
parts them from 25 columns; BreezySLAM counts 24 and drops the last reading,
which turns its scans by a third of a degree.

References
----------
Hokuyo, SCIP 2.0 protocol, C-42-03320B: PP reply (steps 44 to 725 of 1024, front
at 384) and table 3 (distances below 20 are error codes; 0 is "possibly at 22 m").
BreezySLAM, ``examples/mines.py``: wheel radius 77 mm, half axle 165 mm, 2000 counts
a turn, laser 145 mm ahead of the axle, 70 beams at each end behind the rover's body.
"""

from __future__ import annotations

import math
from collections import Counter

import numpy as np

from ssrics_like.perception.observation import Pose
from ssrics_like.sources.records import LaserRecord, MalformedLineError, numbers, quote

BEAMS = 682
MIN_HEADER = 4
_STEP_RAD = 2 * math.pi / 1024
_FIRST_RAD = (44 - 384) * _STEP_RAD
_ERROR_CODES_BELOW = 20.0
_MARGIN = 70
_LASER_AHEAD_M = 0.145
_HALF_AXLE_M = 0.165
_M_PER_COUNT = 2 * math.pi * 0.077 / 2000
_MAX_COUNTS = 20_000  # 4.8 m between two scans: the counter was reset, not the wheel turned


class MmRowsReader:
    """Rows of millimetres with poses integrated from the wheel encoders.

    The pose starts at the origin, heading along x, when the log starts. Readings
    that are error codes, and the beams behind the rover's body, become NaN; 0
    stays for the caller, who takes it as no return.
    """

    stamp_names: tuple[str, ...] = ("microseconds",)

    states_beams = False

    def __init__(self) -> None:
        self.skipped: dict[str, int] = Counter()
        self._columns = 0
        self._counts: tuple[float, float] | None = None
        self._x = self._y = self._theta = 0.0
        self._resets = 0

    def parse(self, line: bytes) -> LaserRecord | None:
        """Return the row's laser record; None for a blank line or a comment."""
        tokens = line.split()
        if not tokens or tokens[0].startswith(b"#"):
            return None
        expected = self._columns or BEAMS + MIN_HEADER
        if len(tokens) < expected or (self._columns and len(tokens) > expected):
            short = len(tokens) < expected
            at_least = "" if self._columns else "at least "
            raise MalformedLineError(
                f"row of {len(tokens)} columns, expected {at_least}{expected}; "
                f"it begins with {quote(tokens[0])}",
                short=short,
            )
        values = numbers(tokens)
        left, right = float(values[2]), float(values[3])
        if not (math.isfinite(left) and math.isfinite(right)):
            raise MalformedLineError(f"the wheel counts {left}, {right} are not finite")
        self._columns = len(tokens)
        self._drive(left, right)
        ranges = values[-BEAMS:] / 1000.0
        ranges[(ranges > 0) & (ranges < _ERROR_CODES_BELOW / 1000.0)] = np.nan
        ranges[:_MARGIN] = np.nan
        ranges[-_MARGIN:] = np.nan
        laser = Pose(
            self._x + _LASER_AHEAD_M * math.cos(self._theta),
            self._y + _LASER_AHEAD_M * math.sin(self._theta),
            self._theta,
        )
        return LaserRecord(
            ranges,
            _FIRST_RAD,
            _STEP_RAD,
            laser,
            base=Pose(self._x, self._y, self._theta),
            stamps_s=(float(values[0]) / 1e6,),
        )

    def notes(self) -> list[str]:
        """Say where the poses come from."""
        poses = (
            "The log gives no pose: poses are integrated from the wheel encoders "
            "(2000 counts a turn, wheels of 77 mm radius, 330 mm apart) and drift."
        )
        notes = [poses]
        if self._resets:
            notes.append(
                f"The wheel counts jumped {self._resets} times; "
                "the robot is taken not to have moved there."
            )
        return notes

    def _drive(self, left: float, right: float) -> None:
        before, self._counts = self._counts, (left, right)
        if before is None:
            return
        if max(abs(left - before[0]), abs(right - before[1])) > _MAX_COUNTS:
            self._resets += 1
            return
        left_m = (left - before[0]) * _M_PER_COUNT
        right_m = (right - before[1]) * _M_PER_COUNT
        turn = (right_m - left_m) / (2 * _HALF_AXLE_M)
        forward = (left_m + right_m) / 2
        self._x += forward * math.cos(self._theta + turn / 2)
        self._y += forward * math.sin(self._theta + turn / 2)
        self._theta += turn
