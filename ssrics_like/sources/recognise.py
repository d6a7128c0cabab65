"""Which format a log has, told from its first lines and never from its name."""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ssrics_like.errors import SourceError
from ssrics_like.sources.carmen import CarmenReader, Vertex2Reader
from ssrics_like.sources.cmu import CmuReader
from ssrics_like.sources.lines import LineReader
from ssrics_like.sources.mm_rows import BEAMS, MIN_HEADER, MmRowsReader
from ssrics_like.sources.odometry_laser import OdometryLaserReader
from ssrics_like.sources.records import MalformedLineError, is_number, quote

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from ssrics_like.perception.observation import Pose
    from ssrics_like.sources.records import RecordReader

READERS: dict[str, type[RecordReader]] = {
    "carmen": CarmenReader,
    "cmu": CmuReader,
    "vertex2": Vertex2Reader,
    "odometry-laser": OdometryLaserReader,
    "mm-rows": MmRowsReader,
}
FORMATS: dict[str, str] = {
    "carmen": "CARMEN log: FLASER or ROBOTLASER1 records, metres",
    "cmu": "CMU log (Wean Hall): O and L records, centimetres",
    "vertex2": "pose graph: VERTEX2 poses, each before its ROBOTLASER1 or FLASER record",
    "odometry-laser": "DP-SLAM log: Odometry and Laser records, metres, no times",
    "mm-rows": "URG-04LX rows: header with wheel counts, then 682 readings in millimetres",
}
FRAMES = ("odometry", "corrected", "map")

LOOK_LINES = 5000
LOOK_SCANS = 50
LOOK_BYTES = 1 << 22
_MOVED_M = 0.05
_TURNED_RAD = 0.05


def _named(fields: list[bytes]) -> bool:
    return len(fields) > 1


def _counted(fields: list[bytes]) -> bool:
    return len(fields) > 1 and fields[1].isdigit()


def _numeric(fields: list[bytes]) -> bool:
    return len(fields) > 1 and all(map(is_number, fields[1:]))


# Keyword of a record: the format that it speaks for, whether it is a scan, and a
# test that a chance word at the beginning of a line of prose does not pass.
_MARKS: dict[bytes, tuple[str, bool, Callable[[list[bytes]], bool]]] = {
    b"FLASER": ("carmen", True, _counted),
    b"ROBOTLASER1": ("carmen", True, _counted),
    b"RLASER": ("carmen", False, _counted),
    b"ODOM": ("carmen", False, _named),
    b"PARAM": ("carmen", False, _named),
    b"NEFF": ("carmen", False, _numeric),
    b"VERTEX2": ("vertex2", False, _numeric),
    b"EDGE2": ("vertex2", False, _numeric),
    b"L": ("cmu", True, _numeric),
    b"O": ("cmu", False, _numeric),
    b"Laser": ("odometry-laser", True, _counted),
    b"Odometry": ("odometry-laser", False, _numeric),
}


@dataclass(frozen=True, slots=True)
class Recognised:
    """What the first lines say.

    Attributes
    ----------
    format : str
        A key of `FORMATS`, empty if nothing was recognised.
    frame : str
        ``odometry`` or ``corrected``.
    """

    format: str
    frame: str


def recognise(path: Path, asked: str | None) -> Recognised:
    """Look at the first 5000 lines, 50 scans or 4 MB, whichever ends first.

    A CARMEN log is in the corrected frame when it holds NEFF records, which only
    a particle filter writes, or when the laser's pose moves against the robot's
    odometry by more than 5 cm or .05 rad, which no mount does. A pose graph is
    corrected; the other formats hold odometry.

    Parameters
    ----------
    path : Path
        An existing file.
    asked : str or None
        A format that the caller insists on, or None to tell it from the content.

    Raises
    ------
    SourceError
        The file is empty, binary, text of another kind, or ends within the look
        and holds no laser scan.
    """
    lines = LineReader(path)
    marks: Counter[str] = Counter()
    kept: list[bytes] = []
    size = scans = 0
    ended = True
    for line in lines:
        if not kept and not line.strip():
            continue
        if b"\0" in line and not any(marks):  # later zeros are a disk's, and a malformed line
            raise SourceError(f"{path}: is a binary file, not a laser log{_begins(kept, line)}")
        kept.append(line)
        size += len(line)
        kind, laser = _classify(line)
        marks[kind] += 1
        scans += laser
        if scans >= LOOK_SCANS or len(kept) >= LOOK_LINES or size >= LOOK_BYTES:
            ended = False
            break
    if not kept:
        what = f": {lines.damage}" if lines.damage else ""
        raise SourceError(f"{path}: is empty{what}")
    told = _format(marks)
    if not (told or asked):
        raise SourceError(
            f"{path}: is not a laser log of a known format ({', '.join(FORMATS)})"
            f"{_begins(kept, b'')}"
        )
    if ended and not scans:
        known = sum(marks.values()) - marks[""]
        raise SourceError(
            f"{path}: holds no laser scan ({len(kept)} lines, {known} of them known records)"
        )
    chosen = asked or told
    return Recognised(told, _frame(chosen, kept))


def _classify(line: bytes) -> tuple[str, bool]:
    """Return the format that a line speaks for, if any, and whether it is a scan."""
    fields = line.split()
    if not fields:
        return "", False
    if fields[0] in _MARKS:
        name, laser, fits = _MARKS[fields[0]]
        return (name, laser) if fits(fields) else ("", False)
    row = len(fields) >= BEAMS + MIN_HEADER and all(map(is_number, fields))
    return ("mm-rows", True) if row else ("", False)


def _format(marks: Counter[str]) -> str:
    """Return the format with most evidence; one vertex makes a CARMEN log a graph."""
    if marks["vertex2"]:
        return "vertex2"
    known = [(number, name) for name, number in marks.items() if name]
    return max(known)[1] if known else ""


def _frame(chosen: str, kept: list[bytes]) -> str:
    if chosen == "vertex2":
        return "corrected"
    if chosen != "carmen":
        return "odometry"
    if any(line.startswith(b"NEFF") for line in kept):
        return "corrected"
    reader = CarmenReader()
    mounts = []
    for line in kept:
        try:
            record = reader.parse(line)
        except MalformedLineError:
            continue  # the pass over the log reports it
        if record is not None and record.base is not None:
            mounts.append(_mount(record.laser, record.base))
    if not mounts:
        return "odometry"
    x0, y0, theta0 = mounts[0]
    moved = any(
        math.hypot(x - x0, y - y0) > _MOVED_M
        or abs(math.remainder(theta - theta0, math.tau)) > _TURNED_RAD
        for x, y, theta in mounts
    )
    return "corrected" if moved else "odometry"


def _mount(laser: Pose, base: Pose) -> tuple[float, float, float]:
    """Return the laser's pose as the robot sees it: x ahead, y to the left, turn."""
    dx, dy = laser.x_m - base.x_m, laser.y_m - base.y_m
    cos, sin = math.cos(base.theta_rad), math.sin(base.theta_rad)
    return dx * cos + dy * sin, dy * cos - dx * sin, laser.theta_rad - base.theta_rad


def _begins(kept: list[bytes], line: bytes) -> str:
    return f"; it begins with {quote((kept or [line])[0])}"
