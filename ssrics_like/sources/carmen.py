"""CARMEN logs, and pose graphs that carry CARMEN laser records.

The front laser is read from FLASER (old) or ROBOTLASER1 (new) records; where a
log repeats its sweeps as both, the kind that comes first is kept, so that no
sweep counts twice. RLASER is the rear laser: skipped and counted.
"""

from __future__ import annotations

import re
from collections import Counter
from typing import TYPE_CHECKING

from ssrics_like.sources.angles import fan
from ssrics_like.sources.records import (
    MIN_BEAMS,
    LaserRecord,
    MalformedLineError,
    count,
    expect_fields,
    numbers,
    pose,
    quote,
    stamp,
)

if TYPE_CHECKING:
    from ssrics_like.perception.observation import Pose

FRONT_LASERS = (b"FLASER", b"ROBOTLASER1")
_SILENT = frozenset({b"ODOM", b"PARAM", b"NEFF", b"SYNC", b"EDGE2", b"TRUEPOS"})
_KEYWORD = re.compile(rb"[A-Z][A-Z0-9_]*")
_MAX_KINDS = 20  # kinds of skipped records that are named
_FLASER_EXTRA = 11  # keyword, n, two poses, two times, host
_HEAD = 9  # ROBOTLASER1: fields before the readings
_ROBOT_TAIL = 14  # ROBOTLASER1: two poses, five motion values, two times, host


class CarmenReader:
    """FLASER and ROBOTLASER1 records of a CARMEN log.

    A FLASER line is ``n r1..rn x y th odom_x odom_y odom_th ipc_time host
    logger_time``; a ROBOTLASER1 line states its angles, and its count of
    remissions is there or not: the number of fields tells.
    """

    stamp_names: tuple[str, ...] = ("ipc_time", "logger_time")

    states_beams = True

    def __init__(self) -> None:
        self.skipped: dict[str, int] = Counter()
        self._kind: bytes | None = None

    def parse(self, line: bytes) -> LaserRecord | None:
        """Return the line's front-laser record, if it is one."""
        head = line.split(None, 1)
        if not head or head[0].startswith(b"#") or head[0] in _SILENT:
            return None
        keyword = head[0]
        if keyword not in FRONT_LASERS:
            self._skip(keyword)
            return None
        if self._kind not in (None, keyword):
            self._skip(keyword)
            return None
        tokens = line.split()
        record = _flaser(tokens) if keyword == b"FLASER" else _robotlaser(tokens)
        self._kind = keyword
        return record

    def notes(self) -> list[str]:
        """Nothing: the records state the laser's pose themselves."""
        return []

    def _skip(self, keyword: bytes) -> None:
        if not _KEYWORD.fullmatch(keyword):
            raise MalformedLineError(f"{quote(keyword)} is not a kind of CARMEN record")
        name = keyword.decode("ascii")
        if name not in self.skipped and len(self.skipped) >= _MAX_KINDS:
            name = "other"
        self.skipped[name] = self.skipped.get(name, 0) + 1


class Vertex2Reader(CarmenReader):
    """Pose graph: a VERTEX2 line gives the corrected pose of the scan that follows.

    Where more than one vertex stands before a scan they cannot be told apart,
    and the laser pose in the scan's own record is used instead.
    """

    def __init__(self) -> None:
        super().__init__()
        self._vertices: list[Pose] = []
        self._own_pose = 0

    def parse(self, line: bytes) -> LaserRecord | None:
        """Return the line's front-laser record, at its vertex."""
        if line.startswith(b"VERTEX2"):
            tokens = line.split()
            expect_fields(len(tokens), 5, "VERTEX2")
            self._vertices = [*self._vertices[:1], pose(numbers(tokens[2:5]))]
            return None
        record = super().parse(line)
        if record is None:
            return None
        vertices, self._vertices = self._vertices, []
        if len(vertices) != 1:
            self._own_pose += 1
            return record
        return LaserRecord(
            record.ranges_m,
            record.angle_min_rad,
            record.angle_increment_rad,
            vertices[0],
            record.base,
            record.stamps_s,
            record.stated_max_m,
        )

    def notes(self) -> list[str]:
        """Say how many scans had no vertex of their own."""
        if not self._own_pose:
            return []
        note = (
            f"{self._own_pose} scans have no VERTEX2 line of their own; "
            "the laser pose in their own record was used."
        )
        return [note]


def _flaser(tokens: list[bytes]) -> LaserRecord:
    beams = _beams(tokens, 1, "FLASER")
    expect_fields(len(tokens), beams + _FLASER_EXTRA, f"FLASER of {beams} beams")
    values = numbers(tokens[2 : beams + 8])
    angle_min, increment = fan(beams)
    return LaserRecord(
        ranges_m=values[:beams],
        angle_min_rad=angle_min,
        angle_increment_rad=increment,
        laser=pose(values[beams : beams + 3]),
        base=pose(values[beams + 3 : beams + 6]),
        stamps_s=(stamp(tokens[-3]), stamp(tokens[-1])),
    )


def _robotlaser(tokens: list[bytes]) -> LaserRecord:
    beams = _beams(tokens, 8, "ROBOTLASER1")
    bare = _HEAD + beams + _ROBOT_TAIL
    tail_at = _HEAD + beams
    if len(tokens) != bare:
        if len(tokens) < bare:
            expect_fields(len(tokens), bare, f"ROBOTLASER1 of {beams} beams")
        remissions = count(tokens[tail_at], "remission count")
        expect_fields(
            len(tokens),
            bare + 1 + remissions,
            f"ROBOTLASER1 of {beams} beams and {remissions} remissions",
        )
        tail_at += 1 + remissions
    start, fov, resolution, max_range = numbers(tokens[2:6]).tolist()
    poses = numbers(tokens[tail_at : tail_at + 6])
    if not resolution > 0:
        resolution = fov / (beams - 1)
    if not (0 < resolution < 1 and abs(start) < 7):  # noqa: PLR2004 - a radian a step, a full turn
        raise MalformedLineError(f"start angle {start} and resolution {resolution} are no fan")
    return LaserRecord(
        ranges_m=numbers(tokens[_HEAD : _HEAD + beams]),
        angle_min_rad=start,
        angle_increment_rad=resolution,
        laser=pose(poses[:3]),
        base=pose(poses[3:]),
        stamps_s=(stamp(tokens[-3]), stamp(tokens[-1])),
        stated_max_m=max_range,
    )


def _beams(tokens: list[bytes], at: int, what: str) -> int:
    if len(tokens) <= at:
        raise MalformedLineError(f"{what} ends before its beam count", short=True)
    beams = count(tokens[at], "beam count")
    if beams < MIN_BEAMS:
        raise MalformedLineError(f"{what} has {beams} beams, expected at least {MIN_BEAMS}")
    return beams
