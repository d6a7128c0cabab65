"""CSV tables with named columns: every problem of a file at once, each with its line."""

from __future__ import annotations

import csv
import io
import math
import re
import unicodedata
from collections.abc import Sequence
from pathlib import Path

from ssrics_like.errors import MapError, nearest
from ssrics_like.maps.names import misspelt

NUMBER = re.compile(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?")


class Table:
    """A CSV file whose first line names its columns.

    Parameters
    ----------
    path : Path
        The file.
    required : sequence of str
        Columns that must be there.
    optional : sequence of str
        Columns that may be. Others are passed over, unless they look misspelt.

    Attributes
    ----------
    rows : list of (int, dict)
        Line number and named cells of each row that is not blank.
    problems : list of str
        What is wrong, one line each; to be added to, and raised by `finish`.

    Raises
    ------
    MapError
        The file cannot be read, or has no usable header.
    """

    def __init__(self, path: Path, required: Sequence[str], optional: Sequence[str]) -> None:
        self.path = path
        self.rows: list[tuple[int, dict[str, str]]] = []
        self.problems: list[str] = []
        reader = csv.reader(io.StringIO(_text(path), newline=""))
        try:
            header = [name.strip() for name in next(reader, [])]
            self._check_header(header, required, optional)
            line = reader.line_num + 1
            for cells in reader:
                if any(cell.strip() for cell in cells):
                    self._take(line, header, cells)
                line = reader.line_num + 1
        except csv.Error as e:
            raise MapError(f"{path}:{reader.line_num}: not valid CSV: {e}") from None
        if not self.rows and not self.problems:
            raise MapError(f"{path}: the table has a header but no rows")

    def _check_header(
        self, header: list[str], required: Sequence[str], optional: Sequence[str]
    ) -> None:
        where = f"{self.path}:1"
        if not any(header):
            raise MapError(
                f"{self.path}: the file is empty, expected columns {', '.join(required)}"
            )
        known = [*required, *optional]
        problems = [
            f"{where}: column '{name}' is missing{nearest(name, set(header) - set(known))}"
            for name in required
            if name not in header
        ]
        if problems and len(header) == 1:
            raise MapError(
                f"{where}: '{header[0][:60]}': expected columns {', '.join(required)}, "
                "separated by commas"
            )
        missing_optional = [name for name in optional if name not in header]
        problems += [
            f"{where}: unknown column '{name}'{nearest(name, missing_optional)}"
            for name in header
            if name not in known and misspelt(name, missing_optional)
        ]
        problems += [
            f"{where}: column '{name}' stands twice"
            for name in dict.fromkeys(header)
            if name in known and header.count(name) > 1
        ]
        if problems:
            raise MapError("\n".join(problems))

    def _take(self, line: int, header: list[str], cells: list[str]) -> None:
        if len(cells) != len(header):
            self.problems.append(
                f"{self.path}:{line}: has {len(cells)} cells, expected {len(header)} as in line 1"
            )
            return
        self.rows.append((line, dict(zip(header, (cell.strip() for cell in cells), strict=True))))

    def number(self, line: int, cells: dict[str, str], column: str) -> float:
        """Return a cell as a number; NaN, and a problem noted, where it is none."""
        text = cells[column]
        # Stricter than Python: no `1_0`, no digits of other scripts.
        value = float(text) if NUMBER.fullmatch(text) else math.nan
        if not math.isfinite(value):
            shown = repr(text) if text else "nothing"
            self.problems.append(
                f"{self.path}:{line}: {column}: {shown} where a number was expected"
            )
            return math.nan
        return value

    def word(self, line: int, cells: dict[str, str], column: str) -> str:
        """Return a cell that must be a line of text; a problem is noted where it is none."""
        text = cells[column]
        if not text:
            self.problems.append(f"{self.path}:{line}: {column}: is empty")
        if any(unicodedata.category(letter) == "Cc" for letter in text):
            self.problems.append(
                f"{self.path}:{line}: {column}: {text!r:.60} has control characters"
            )
        return text

    def finish(self) -> None:
        """Raise what was found to be wrong.

        Raises
        ------
        MapError
            With one line for each problem, in order of their lines.
        """
        if self.problems:
            before = len(str(self.path)) + 1
            raise MapError(
                "\n".join(sorted(self.problems, key=lambda p: int(p[before:].split(":")[0])))
            )


def _text(path: Path) -> str:
    try:
        return path.read_bytes().decode("utf-8-sig")
    except FileNotFoundError:
        raise MapError(f"{path}: no such file") from None
    except IsADirectoryError:
        raise MapError(f"{path}: is a folder, expected a CSV file") from None
    except UnicodeDecodeError:
        raise MapError(f"{path}: cannot be read as text (it is not UTF-8)") from None
    except (OSError, ValueError) as e:  # ValueError: a name with a zero byte in it
        why = getattr(e, "strerror", None) or e
        raise MapError(f"{path}: cannot be read ({why})") from None
