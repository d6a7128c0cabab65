"""Lines to laser records: what is wrong is counted, or stops the reading when strict."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ssrics_like.errors import SourceError
from ssrics_like.sources.records import MalformedLineError

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from ssrics_like.sources.lines import LineReader
    from ssrics_like.sources.records import LaserRecord, RecordReader
    from ssrics_like.sources.report import ReadReport

_INCOMPLETE = "the file ends within the last line"


def read_records(
    reader: RecordReader, lines: LineReader, report: ReadReport, path: Path, *, strict: bool
) -> Iterator[LaserRecord]:
    """Yield the laser records of a log, keeping the books in `report`.

    A malformed line is left out and counted. The last line of a file is not
    malformed but cut off when it is a record that ends too early, when it has no
    line feed and gives no scan, or when the gzip stream ends or breaks there.

    Parameters
    ----------
    reader : RecordReader
        The format.
    lines : LineReader
        The file's lines.
    report : ReadReport
        Counts, written to.
    path : Path
        For messages: whole in errors, its name alone in the report.
    strict : bool
        Raise at the first line that is malformed or cut off.

    Raises
    ------
    SourceError
        With file and line, when strict; or when the file cannot be read.
    """
    books = _Books(report, path, strict)
    beams = 0
    line = b""
    record = None
    for line in lines:
        if line.strip():
            books.settle()
        report.lines += 1
        try:
            record = reader.parse(line)
            if record is not None:
                beams = beams or record.ranges_m.size
                if not reader.states_beams:
                    _same_beams(record.ranges_m.size, beams)
        except MalformedLineError as problem:
            record = None
            books.malformed(problem)
            continue
        if record is not None:
            yield record
    remark = not line.strip() or line.startswith(b"#")
    unread = not lines.final_newline and record is None and not remark
    books.close(lines.damage or (_INCOMPLETE if unread else ""))


class _Books:
    """Keep a malformed line open until it is known whether it is the last one."""

    def __init__(self, report: ReadReport, path: Path, strict: bool) -> None:
        self._report = report
        self._path = path
        self._strict = strict
        self._open: tuple[int, MalformedLineError] | None = None

    def malformed(self, problem: MalformedLineError) -> None:
        self._open = (self._report.lines, problem)

    def settle(self) -> None:
        """Call the open line malformed: another follows, so it was not cut off."""
        if self._open is None:
            return
        number, problem = self._open
        self._open = None
        if self._strict:
            raise SourceError(f"{self._path}:{number}: {problem}")
        self._report.malformed += 1
        self._report.example(f"{self._path.name}:{number}: {problem}")

    def close(self, cut: str) -> None:
        """End the books; `cut` says why the file ends too early, if it does."""
        if self._open is not None and not cut and self._open[1].short:
            cut = _INCOMPLETE
        if not cut:
            self.settle()
            return
        number, problem = self._open or (self._report.lines, None)
        reason = cut if problem is None else f"{cut} ({problem})"
        if self._strict:
            raise SourceError(f"{self._path}:{number}: {reason}")
        self._report.truncated_last_line = True
        self._report.truncation = f"{self._path.name}:{number}: {reason}"


def _same_beams(found: int, before: int) -> None:
    if found != before:
        short = found < before
        raise MalformedLineError(f"scan of {found} beams in a log of {before}", short=short)
