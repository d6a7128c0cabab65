"""Writing results: plain numbers, whole files or none."""

from __future__ import annotations

import csv
import io
import json
import math
import re
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from ssrics_like.atomic import write_atomically

__all__ = ["csv_line", "csv_text", "json_text", "number", "plain", "write_atomically"]

DECIMALS = 6
_SPECIAL = re.compile('[,"\r\n]')


def number(value: float | None) -> str:
    """Write a number with at most six decimals; nothing for None and for what is not finite."""
    if value is None:
        return ""
    if isinstance(value, int):
        return str(value)
    if not math.isfinite(value):
        return ""
    text = f"{value:.{DECIMALS}f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


def plain(value: Any) -> Any:
    """Round every float in nested data to six decimals; what is not finite becomes None."""
    if isinstance(value, bool) or value is None:
        return value
    if isinstance(value, float):
        return round(value, DECIMALS) + 0.0 if math.isfinite(value) else None
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    return value


def json_text(data: Any, *, indent: int | None = 2) -> str:
    """Return data as JSON with a final newline."""
    separators = (",", ": ") if indent else (",", ":")
    return json.dumps(plain(data), indent=indent, separators=separators, allow_nan=False) + "\n"


def csv_line(values: Iterable[Any]) -> str:
    """Return one CSV row; numbers as by `number`."""
    plain_cells, cells = True, []
    for value in values:
        if value is None or isinstance(value, int | float):
            cells.append(number(value))
            continue
        cells.append(str(value))
        plain_cells = plain_cells and not _SPECIAL.search(cells[-1])
    if not plain_cells:
        buffer = io.StringIO()
        csv.writer(buffer, lineterminator="\n").writerow(cells)
        return buffer.getvalue()
    return ",".join(cells) + "\n"


def csv_text(header: Sequence[str], rows: Iterable[Iterable[Any]]) -> str:
    """Return a CSV file's text."""
    return csv_line(header) + "".join(csv_line(row) for row in rows)
