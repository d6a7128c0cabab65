"""Which readings of a log mean "nothing came back".

Lasers write no return as a number, and the same number can be a real reading of
another sensor. The rule here, for one log and in one pass:

* 0, negative and infinite values, and everything from 81.8 m on (81.83, 81.87,
  81.91: a SICK LMS counting centimetres in 13 bits) are no return in every log.
* The ceilings of other set-ups (`CEILINGS`) and the range that the record itself
  states as its longest are no return as long as *nothing in the log lies above
  them* and readings *pile up there*: at least ten, and four times as many as in
  the half metre below. A wall that happens to be 8.19 m away fails one of the
  two: other readings are longer, or its neighbours are as frequent. For the
  stated range the log's own word replaces the pile.

The log's first scans (the reader looks 500 ahead) are weighed before the first
is handed out; if a longer reading comes later the ceiling is given up from there.
NaN stays NaN: a beam without any answer.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

ALWAYS_FROM_M = 81.8
CEILINGS = (
    (8.18, 8.195),  # SICK, millimetres in 13 bits: 8.183, 8.187, 8.191
    (32.75, 32.77),  # SICK, millimetres in 15 bits: 32.759, 32.763, 32.767
    (49.995, 50.005),  # a common cap
    (51.0, 51.2),  # SICK, 5 cm steps in 10 bits, resampled: 51.05 to 51.16
)
_PILE = 10
_PILE_RATIO = 4
_BELOW_M = 0.5
_STATED_TOLERANCE_M = 0.005


@dataclass
class _Ceiling:
    """A range at which a sensor may be saturated, and the readings met so far."""

    low_m: float
    high_m: float
    stated: bool = False
    at: int = 0
    below: int = 0

    def in_use(self, largest_m: float) -> bool:
        if largest_m < self.low_m:
            return False
        return self.stated or (self.at >= _PILE and self.at >= _PILE_RATIO * self.below)


class NoReturnRule:
    """The no-return values of one log, learnt as its scans come.

    Attributes
    ----------
    given_up : list of (float, int)
        Ceilings in metres that were in use until a longer reading came, each
        with the 0-based index of the scan from which on they were not.
    """

    def __init__(self) -> None:
        self.given_up: list[tuple[float, int]] = []
        self._candidates = [_Ceiling(low, high) for low, high in CEILINGS]
        self._largest = 0.0
        self._stated = False
        self._used: _Ceiling | None = None

    def learn(self, ranges_m: NDArray[np.float64], stated_max_m: float = 0.0) -> None:
        """Weigh one scan's readings, shape (beams,), before it is cleaned."""
        self._add_stated(stated_max_m)
        if not self._candidates:
            return
        finite = ranges_m[np.isfinite(ranges_m)]
        if not finite.size:
            return
        self._largest = max(self._largest, float(finite.max()))
        self._candidates = [c for c in self._candidates if c.high_m >= self._largest]
        for ceiling in self._candidates:
            if self._largest >= ceiling.low_m - _BELOW_M:
                near = finite[finite >= ceiling.low_m - _BELOW_M]
                at = int(np.count_nonzero(near >= ceiling.low_m))
                ceiling.at += at
                ceiling.below += near.size - at

    def limit_m(self) -> float:
        """Return the range from which on readings are, at present, no return."""
        ceiling = self._ceiling()
        return ALWAYS_FROM_M if ceiling is None else ceiling.low_m

    def clean(self, ranges_m: NDArray[np.float64], index: int) -> int:
        """Replace no-return readings by +inf in place; return how many there were."""
        ceiling = self._ceiling()
        if ceiling is None and self._used is not None:
            self.given_up.append((self._used.low_m, index))
        self._used = ceiling
        limit = ALWAYS_FROM_M if ceiling is None else ceiling.low_m
        none = (ranges_m <= 0) | (ranges_m >= limit)
        ranges_m[none] = np.inf
        return int(np.count_nonzero(none))

    def notes(self) -> list[str]:
        """Say which ceilings were given up, and where."""
        return [
            f"Readings from {limit:.2f} m on were taken as no return up to scan {index}, "
            "where a longer reading showed that they are not."
            for limit, index in self.given_up
        ]

    def _ceiling(self) -> _Ceiling | None:
        return next((c for c in self._candidates if c.in_use(self._largest)), None)

    def _add_stated(self, stated_max_m: float) -> None:
        if self._stated or not 0 < stated_max_m < ALWAYS_FROM_M:
            return
        self._stated = True  # the first statement counts: one sensor has one longest range
        low, high = stated_max_m - _STATED_TOLERANCE_M, stated_max_m + _STATED_TOLERANCE_M
        if high >= self._largest:
            self._candidates.append(_Ceiling(low, high, stated=True))
