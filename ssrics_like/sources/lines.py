"""Lines of a plain or gzipped file, in memory that does not grow with the file.

The standard gzip reader raises at the end of a cut-off stream and may take the
last good lines with it; here everything that can be decompressed is handed on
and the damage is kept for the caller to report.
"""

from __future__ import annotations

import zlib
from typing import TYPE_CHECKING

from ssrics_like.errors import SourceError

if TYPE_CHECKING:
    from collections.abc import Iterator
    from io import BufferedReader
    from pathlib import Path

GZIP_MAGIC = b"\x1f\x8b"
_CHUNK = 1 << 14
_MAX_INFLATED = 1 << 18
_MAX_LINE = 1 << 20  # a scan of 100,000 beams; longer is no record
_ZLIB_GZIP = 31  # wbits: gzip header and trailer expected
_BOM = b"\xef\xbb\xbf"


class LineReader:
    """Iterate once over a file's lines, as bytes without the line feed.

    Parameters
    ----------
    path : Path
        A file; gzip is recognised by its first two bytes, not by its name.

    Attributes
    ----------
    consumed : int
        Bytes of the file read so far (compressed bytes for gzip).
    damage : str or None
        Why reading stopped before the end of the contents, if it did.
    final_newline : bool
        After iteration: whether the last line was ended by a line feed.

    Raises
    ------
    SourceError
        While iterating, when the file cannot be opened or read.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        self.consumed = 0
        self.damage: str | None = None
        self.final_newline = True

    def __iter__(self) -> Iterator[bytes]:
        try:
            with self._path.open("rb") as file:
                zipped = file.peek(2).startswith(GZIP_MAGIC)
                yield from self._split(self._inflated(file) if zipped else self._plain(file))
        except OSError as problem:
            why = problem.strerror or problem
            raise SourceError(f"{self._path}: cannot be read: {why}") from problem

    def _plain(self, file: BufferedReader) -> Iterator[bytes]:
        while block := file.read(_CHUNK):
            self.consumed += len(block)
            yield block

    def _inflated(self, file: BufferedReader) -> Iterator[bytes]:
        decoder = zlib.decompressobj(_ZLIB_GZIP)
        for raw in self._plain(file):
            block = raw
            while block:
                if decoder.eof:  # another member may follow; zeros are a tape's padding
                    block = block.lstrip(b"\0")
                    if not block:
                        break
                    decoder = zlib.decompressobj(_ZLIB_GZIP)
                before = decoder.copy()
                try:
                    yield decoder.decompress(block, _MAX_INFLATED)
                except zlib.error:
                    self.damage = "the gzip stream is damaged from here on"
                    yield from _salvage(before, block)
                    return
                block = decoder.unused_data if decoder.eof else decoder.unconsumed_tail
        yield decoder.flush()
        if not decoder.eof:
            self.damage = "the gzip stream is cut off"

    def _split(self, chunks: Iterator[bytes]) -> Iterator[bytes]:
        tail = b""
        first = True
        overlong = False
        for chunk in chunks:
            lines = (tail + chunk).split(b"\n")
            tail = lines.pop()
            if lines and overlong:
                del lines[0]
                overlong = False
            if lines and first:
                lines[0] = lines[0].removeprefix(_BOM)
                first = False
            yield from lines
            if overlong:
                tail = b""
            elif len(tail) > _MAX_LINE:
                yield tail  # once, so that it is counted as malformed; its rest is dropped
                tail, overlong = b"", True
        self.final_newline = not tail and not overlong
        if tail:
            yield tail.removeprefix(_BOM) if first else tail


def _salvage(decoder: zlib._Decompress, block: bytes) -> Iterator[bytes]:
    """Yield what a block holds before its damage: zlib drops it when it raises."""
    try:
        for at in range(len(block)):
            yield decoder.decompress(block[at : at + 1])
    except zlib.error:
        return
