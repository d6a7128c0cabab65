"""What the tables of a results folder hold beside what the report reads of them."""

from __future__ import annotations

import csv
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ssrics_like.errors import ResultsError
from ssrics_like.results.records import Run
from ssrics_like.viewer.story import Confidence


def read_poses(folder: Path, run: Run) -> NDArray[np.float64]:
    """Read the path of a run with its headings.

    Returns
    -------
    ndarray, shape (poses, 4)
        t (seconds on the source's clock), x, y (metres), heading (radians) of the laser: true
        ones in simulation.

    Raises
    ------
    ResultsError
        path.csv is missing or damaged.
    """
    file = folder / "path.csv"
    prefix = "true_" if run.is_true else ""
    names = ("t_s", f"{prefix}x_m", f"{prefix}y_m", f"{prefix}theta_rad")
    poses = []
    for line, row in _rows_of(file, run.number):
        try:
            poses.append([float(row[name]) for name in names])
        except (KeyError, TypeError, ValueError) as e:
            raise ResultsError(f"{file}:{line}: is damaged: {e!r}") from None
    return np.array(poses, np.float64).reshape(-1, 4)


def read_confidences(folder: Path, run: Run) -> list[Confidence]:
    """Read how sure memory was at each decision that a production took, in order of deciding.

    Raises
    ------
    ResultsError
        decisions.csv is missing or damaged.
    """
    file = folder / "decisions.csv"
    found = []
    for line, row in _rows_of(file, run.number):
        try:
            if row["decision"] != "overwritten":
                text = row.get("confidence")
                found.append(Confidence(row["rule"], float(text) if text else None))
        except (KeyError, TypeError, ValueError) as e:
            raise ResultsError(f"{file}:{line}: is damaged: {e!r}") from None
    return found


def _rows_of(file: Path, run: int) -> Iterator[tuple[int, dict[str, str]]]:
    """Yield the rows of a run with their lines."""
    try:
        with file.open(encoding="utf-8", newline="") as lines:
            reader = csv.DictReader(lines)
            for row in reader:
                if row.get("run") == str(run):
                    yield reader.line_num, row
    except OSError as e:
        raise ResultsError(f"{file}: cannot be read ({e.strerror})") from None
