"""Tables as CSV whose cells may hold whatever people write."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Sequence
from typing import Any

from ssrics_like.results.files import number


def csv_table(header: Sequence[str], rows: Iterable[Sequence[Any]]) -> str:
    """Return a table; numbers with at most six decimals, nothing for None."""
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(header)
    writer.writerows([_shown(cell) for cell in row] for row in rows)
    return stream.getvalue()


def _shown(cell: Any) -> str:
    return number(cell) if cell is None or isinstance(cell, int | float) else str(cell)
