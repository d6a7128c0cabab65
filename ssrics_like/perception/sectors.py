"""Which way the space is widest: the report's left / front / right of a scan."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Literal

import numpy as np

from ssrics_like.errors import ScanError
from ssrics_like.perception.checks import (
    SECTOR_RULES,
    require_choice,
    require_ranges,
    scan_kernels,
)

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

Sector = Literal["left", "front", "right"]
SectorRule = Literal["maximum", "robust"]

FRONT_HALF_RAD = math.radians(30.0)
"""Front is within this of straight ahead, inclusive (report, section 4: 61-120 of 180 degrees)."""

ROBUST_WIDTH_RAD = math.radians(5.0)
"""Angle over which the robust rule takes its running median, at least five beams."""

_SECTORS: tuple[Sector, Sector, Sector] = ("front", "left", "right")  # as `widest_sector` counts
_EDGE_RAD = 1e-9  # a beam printed as exactly 30 degrees is front, however it was rounded
_ROBUST_HALF_BEAMS = 2


class SectorClassifier:
    """Classifies the scans of one laser; its sectors' beams are found once.

    Parameters
    ----------
    bearings_rad : array_like, shape (beams,)
        Bearing of each beam, rising; 0 is straight ahead, positive is left.
    rule : {"robust", "maximum"}
        ``maximum`` is the report's: the sector of the single largest reading.
        ``robust`` compares the largest running median over about 5 degrees (five
        beams or more), so that one bad beam cannot decide.

    Raises
    ------
    ScanError
        The bearings do not rise.
    SettingsError
        The rule is unknown.
    """

    def __init__(self, bearings_rad: ArrayLike, rule: str = "robust") -> None:
        bearings = require_ranges(bearings_rad)
        # Written so that a NaN bearing is refused too.
        if bearings.size > 1 and not np.all(np.diff(bearings) > 0.0):
            raise ScanError("bearings do not rise; beams are expected from the right to the left")
        self.beams = bearings.size
        self._front = int(np.searchsorted(bearings, -FRONT_HALF_RAD - _EDGE_RAD, "left"))
        self._left = int(np.searchsorted(bearings, FRONT_HALF_RAD + _EDGE_RAD, "right"))
        self._half = 0
        if require_choice("sector_rule", rule, SECTOR_RULES) == "robust":
            step = (bearings[-1] - bearings[0]) / max(self.beams - 1, 1)
            wide = round(0.5 * ROBUST_WIDTH_RAD / step) if step > 0.0 else 0
            self._half = max(_ROBUST_HALF_BEAMS, wide)
        self._widest = scan_kernels().widest_sector

    def classify(self, ranges_m: NDArray[np.float64]) -> Sector:
        """Return the sector with the largest reading (or running median).

        Beams that are NaN are left out. A tie, frequent among beams at the range
        cap, goes to front, then left. A sector without a valid beam, also one
        outside the field of view, never wins; a scan without any valid beam is
        "front".

        Raises
        ------
        ScanError
            The scan has another number of beams than the bearings.
        """
        ranges = require_ranges(ranges_m)
        if ranges.size != self.beams:
            raise ScanError(f"a scan has {ranges.size} beams for {self.beams} bearings")
        return _SECTORS[self._widest(ranges, self._front, self._left, self._half)]


def classify(ranges_m: ArrayLike, bearings_rad: ArrayLike, rule: str = "robust") -> Sector:
    """Return "left", "front" or "right", the side on which a scan reaches farthest.

    For many scans of one laser, keep a `SectorClassifier`; its documentation says
    how ties and missing beams are decided.

    Parameters
    ----------
    ranges_m : array_like, shape (beams,)
        Conditioned readings in metres.
    bearings_rad : array_like, shape (beams,)
        Bearing of each beam, rising.
    rule : {"robust", "maximum"}
        See `SectorClassifier`.

    References
    ----------
    Report, section 4: "The largest reading was used as a classification of the area".
    """
    return SectorClassifier(bearings_rad, rule).classify(np.array(ranges_m, np.float64))
