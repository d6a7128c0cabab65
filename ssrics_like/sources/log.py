"""A log file as a stream of observations."""

from __future__ import annotations

import hashlib
import math
from collections import deque
from functools import cached_property
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING

from ssrics_like.errors import SourceError, choices, nearest
from ssrics_like.perception.observation import LaserScan, Observation
from ssrics_like.sources.lines import LineReader
from ssrics_like.sources.no_return import NoReturnRule
from ssrics_like.sources.reading import read_records
from ssrics_like.sources.recognise import FORMATS, FRAMES, READERS, recognise
from ssrics_like.sources.report import ReadReport
from ssrics_like.sources.timing import LOOK_AHEAD, Timekeeper, TimingSummary, usable

if TYPE_CHECKING:
    import os
    from collections.abc import Iterator

    from ssrics_like.sources.records import LaserRecord, RecordReader


def open_log(
    path: str | os.PathLike[str],
    *,
    format: str = "auto",  # noqa: A002 - the word users type; the builtin is not needed here
    strict: bool = False,
    fallback_rate_hz: float = 10.0,
    frame: str | None = None,
) -> LogSource:
    """Open a laser log, plain or gzipped.

    Parameters
    ----------
    path : path-like
        The log.
    format : str, optional
        A key of `FORMATS`, or ``auto`` to tell it from the content.
    strict : bool, optional
        Stop at the first malformed or cut-off line, instead of counting it.
    fallback_rate_hz : float, optional
        Scans per second where the log's times are missing or unusable.
    frame : str, optional
        ``odometry``, ``corrected`` or ``map`` instead of what the log suggests.

    Returns
    -------
    LogSource
        Iterate over it for observations.

    Raises
    ------
    SourceError
        The file is missing, a folder, empty, foreign or without a laser scan, or
        an argument is none of the choices.
    """
    asked = None if format == "auto" else format
    if asked is not None and asked not in FORMATS:
        known = [*FORMATS, "auto"]
        raise SourceError(
            f"unknown log format '{format}'{nearest(format, known)} (known: {choices(known)})"
        )
    if frame is not None and frame not in FRAMES:
        raise SourceError(
            f"unknown frame '{frame}'{nearest(frame, FRAMES)} (known: {choices(FRAMES)})"
        )
    if not (math.isfinite(fallback_rate_hz) and fallback_rate_hz > 0):
        raise SourceError(f"fallback rate {fallback_rate_hz} is not a positive number of hertz")
    file = _existing(Path(path))
    told = recognise(file, asked)
    return LogSource(
        file,
        format=asked or told.format,
        frame=frame or told.frame,
        strict=strict,
        fallback_rate_hz=fallback_rate_hz,
        looks_like=told.format,
    )


class LogSource:
    """Observations of one log, lazily; every iteration reads the file anew.

    Made by `open_log`. At most 500 scans are held in memory, so that times and
    no-return values can be judged before the first observation is handed out.

    Attributes
    ----------
    path : Path
        The file.
    format : str
        A key of `FORMATS`.
    frame : str
        Frame of the poses: ``odometry``, ``corrected`` or ``map``.
    report : ReadReport
        Counts of the latest iteration, live.
    """

    def __init__(
        self,
        path: Path,
        *,
        format: str,  # noqa: A002 - the word users type; the builtin is not needed here
        frame: str,
        strict: bool,
        fallback_rate_hz: float,
        looks_like: str = "",
    ) -> None:
        self.path = path
        self.format = format
        self.frame = frame
        self.report = ReadReport()
        self._strict = strict
        self._rate_hz = fallback_rate_hz
        self._looks_like = looks_like
        self._lines = LineReader(path)
        self._size = max(path.stat().st_size, 1)

    @cached_property
    def sha256(self) -> str:
        """Hex digest of the file's bytes as they lie on the disk."""
        with self.path.open("rb") as file:
            return hashlib.file_digest(file, "sha256").hexdigest()

    @property
    def progress(self) -> float:
        """Share of the file's bytes read so far in the latest iteration, 0 to 1."""
        return min(self._lines.consumed / self._size, 1.0)

    def __iter__(self) -> Iterator[Observation]:
        self.report = ReadReport()
        self._lines = LineReader(self.path)
        reader = READERS[self.format]()
        self.report.skipped = reader.skipped
        return self._observations(reader, self.report, self._lines)

    def _observations(
        self, reader: RecordReader, report: ReadReport, lines: LineReader
    ) -> Iterator[Observation]:
        records = read_records(reader, lines, report, self.path, strict=self._strict)
        ahead = deque(islice(records, LOOK_AHEAD))
        if not ahead:
            raise SourceError(self._no_scan(report))
        column, keeper = self._timekeeper(reader, list(ahead))
        names = reader.stamp_names
        report.timing = TimingSummary(keeper.usable, names[column] if names else "", self._rate_hz)
        no_return = NoReturnRule()
        for record in ahead:
            no_return.learn(record.ranges_m, record.stated_max_m)
        try:
            while ahead:
                record = ahead.popleft()
                yield self._observe(record, no_return, keeper, column, report)
                following = next(records, None)
                if following is not None:
                    no_return.learn(following.ranges_m, following.stated_max_m)
                    ahead.append(following)
        finally:
            report.notes = reader.notes() + no_return.notes()

    def _observe(
        self,
        record: LaserRecord,
        no_return: NoReturnRule,
        keeper: Timekeeper,
        column: int,
        report: ReadReport,
    ) -> Observation:
        index = report.scans
        report.scans += 1
        report.readings += record.ranges_m.size
        report.no_return += no_return.clean(record.ranges_m, index)
        time = keeper.time(record.stamps_s[column] if record.stamps_s else math.nan)
        report.timing.repaired, report.timing.resets = keeper.repaired, keeper.resets
        scan = LaserScan(record.ranges_m, record.angle_min_rad, record.angle_increment_rad)
        return Observation(index=index, t_s=time, pose=record.laser, scan=scan)

    def _timekeeper(self, reader: RecordReader, ahead: list[LaserRecord]) -> tuple[int, Timekeeper]:
        """Choose the first of the record's times that is usable."""
        for column in range(len(reader.stamp_names)):
            stamps = [record.stamps_s[column] for record in ahead]
            if usable(stamps):
                return column, Timekeeper(stamps, self._rate_hz)
        return 0, Timekeeper([], self._rate_hz)

    def _no_scan(self, report: ReadReport) -> str:
        parts = [f"{report.lines} lines"]
        if report.malformed:
            parts.append(f"{report.malformed} malformed, first {report.examples[0]}")
        parts += [f"{n} {kind} skipped" for kind, n in sorted(report.skipped.items())]
        like = ""
        if self._looks_like and self._looks_like != self.format:
            like = f"; its content looks like '{self._looks_like}'"
        return f"{self.path}: holds no '{self.format}' laser scan ({'; '.join(parts)}){like}"


def _existing(path: Path) -> Path:
    """Return the path of a readable file, or say what is wrong with it."""
    try:
        if path.is_dir():
            raise SourceError(f"{path}: is a folder, expected a log file")
        if path.is_file():
            return path
        if path.exists():
            raise SourceError(f"{path}: is not a regular file; a log is read more than once")
        beside = [other.name for other in path.parent.iterdir()] if path.parent.is_dir() else []
    except OSError as problem:
        raise SourceError(f"{path}: cannot be read: {problem.strerror or problem}") from problem
    raise SourceError(f"{path}: no such file{nearest(path.name, beside)}")
