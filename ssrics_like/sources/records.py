"""What a format's reader hands over for one laser record, and how it says no."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

import numpy as np

from ssrics_like.perception.observation import Pose

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

MIN_BEAMS = 2  # one reading has no bearing step


class MalformedLineError(Exception):
    """A line cannot be understood; the message says why, without file and line.

    Parameters
    ----------
    reason : str
        One clear phrase.
    short : bool, optional
        True when the line is a record that merely ends too early, as the last
        line of a log does when the robot was switched off.
    """

    def __init__(self, reason: str, *, short: bool = False) -> None:
        super().__init__(reason)
        self.short = short


@dataclass(frozen=True, slots=True)
class LaserRecord:
    """One laser record as its line states it, in metres and radians.

    Attributes
    ----------
    ranges_m : ndarray, shape (beams,)
        Readings from right to left, no-return codes still in them.
    angle_min_rad, angle_increment_rad : float
        Bearing of the first beam and the step between beams.
    laser : Pose
        Pose of the laser.
    base : Pose or None
        Pose of the robot's centre, where the line has it.
    stamps_s : tuple of float
        The line's times, best first; NaN where one is not a number.
    stated_max_m : float
        Longest range that the line claims for the sensor, 0 where it claims none.
    """

    ranges_m: NDArray[np.float64]
    angle_min_rad: float
    angle_increment_rad: float
    laser: Pose
    base: Pose | None = None
    stamps_s: tuple[float, ...] = ()
    stated_max_m: float = 0.0


class RecordReader(Protocol):
    """A format: lines in, laser records out. It may remember earlier lines.

    Attributes
    ----------
    stamp_names : tuple of str
        Names of the times in a record.
    states_beams : bool
        Whether each record says how many beams it has, so that another number is no damage.
    skipped : dict
        Kind of line -> how many were passed over.
    """

    stamp_names: tuple[str, ...]
    states_beams: bool
    skipped: dict[str, int]

    def parse(self, line: bytes) -> LaserRecord | None:
        """Return the line's laser record, or None for a line that holds none.

        Raises
        ------
        MalformedLineError
            The line is not one of this format.
        """

    def notes(self) -> list[str]:
        """Return what a reader of the results should know about this format's poses."""


def numbers(tokens: Sequence[bytes]) -> NDArray[np.float64]:
    """Return the tokens as float64, shape (len(tokens),)."""
    try:
        return np.array(tokens, dtype=np.float64)
    except ValueError:
        wrong = next(token for token in tokens if not is_number(token))
        raise MalformedLineError(f"{quote(wrong)} is not a number") from None


def is_number(token: bytes) -> bool:
    """Whether a token can be read as a number."""
    try:
        float(token)
    except ValueError:
        return False
    return True


def count(token: bytes, what: str) -> int:
    """Return a token as a whole number of beams (or remissions)."""
    if not token.isdigit():
        raise MalformedLineError(f"{what} {quote(token)} is not a whole number")
    return int(token[:9])  # a longer count cannot match the line's fields anyway


def stamp(token: bytes) -> float:
    """Return a time, or NaN: a scan is never dropped for its time."""
    return float(token) if is_number(token) else math.nan


FARTHEST_M = 2e7
"""Half way round the Earth: coordinates of a map grid may be large, nonsense is larger."""


def pose(values: Sequence[float] | NDArray[np.float64], scale: float = 1.0) -> Pose:
    """Return x, y, theta as a pose; `scale` turns the log's unit into metres."""
    x, y, theta = float(values[0]) * scale, float(values[1]) * scale, float(values[2])
    if not (math.isfinite(x) and math.isfinite(y) and math.isfinite(theta)):
        raise MalformedLineError(f"the pose ({x}, {y}, {theta}) is not finite")
    if max(abs(x), abs(y)) > FARTHEST_M:
        raise MalformedLineError(f"the pose ({x:g}, {y:g}) lies more than {FARTHEST_M:g} m away")
    return Pose(x, y, theta)


def expect_fields(found: int, expected: int, what: str) -> None:
    """Complain unless a record has exactly the fields that its beam count asks for."""
    if found != expected:
        raise MalformedLineError(
            f"{what} has {found} fields, expected {expected}", short=found < expected
        )


def quote(token: bytes, limit: int = 24) -> str:
    """Return raw bytes as short printable text for a message."""
    text = token[:limit].decode("ascii", errors="backslashreplace")
    shown = "".join(c if c.isprintable() else "?" for c in text)
    return f"'{shown}{'...' if len(token) > limit else ''}'"
