"""Readings made fit for correlation: no-return values capped, dropouts repaired.

A no-return value (81.83 m, 0, infinity, ...) is large and arbitrary, so it would
dominate a correlation: with 1 % of such beams a robot that stands still is
never bored. But a run of them may as well be a real opening that reaches
farther than the laser. The two are told apart by size.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ssrics_like.errors import SettingsError
from ssrics_like.perception.checks import require_ranges, scan_kernels

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray


class ConditionedScan(NamedTuple):
    """A scan fit for correlation.

    Attributes
    ----------
    ranges_m : ndarray, shape (beams,), float64
        Above 0 and at most the cap; NaN only where neither the beam nor any beam
        around it gave an answer.
    measured : ndarray, shape (beams,), bool
        True where the reading is the sensor's own, False where it was capped,
        repaired or is NaN.
    """

    ranges_m: NDArray[np.float64]
    measured: NDArray[np.bool_]


def condition(ranges_m: ArrayLike, range_cap_m: float, repair_window: int) -> ConditionedScan:
    """Cap no-return readings and repair isolated ones from their neighbours.

    1. A reading <= 0, >= the cap, or infinite is *no return*: it becomes the cap.
    2. Each no-return beam then takes the median of the `repair_window` beams
       around it. A run of at most (repair_window - 1) / 2 such beams, a dropout,
       so takes its neighbours' values, and a longer run, an opening, stays at
       the cap.
    3. A NaN beam (no answer at all) takes the median of the beams around it that
       have one; it stays NaN if there is none, or if repair is off.

    Near the ends of the scan the window is shifted inwards, so that the rule for
    runs is the same there. NaN neighbours are left out; of an even number of
    values the median is the lower middle one, so that a tie goes to the nearer.

    Parameters
    ----------
    ranges_m : array_like, shape (beams,)
        Readings in metres; not changed.
    range_cap_m : float
        Metres, above 0.
    repair_window : int
        Beams, odd and 3 or more; 0 turns repair off.

    Raises
    ------
    ScanError
        The scan is not one row of at least one beam.
    SettingsError
        The cap or the window is out of range.
    """
    if not 0.0 < range_cap_m < np.inf:
        raise SettingsError(f"range_cap_m is {range_cap_m!r}; expected metres above 0")
    if repair_window != 0 and not is_window(repair_window):
        raise SettingsError(
            f"repair_window is {repair_window!r}; expected 0 (off) or an odd number of beams >= 3"
        )
    ranges = require_ranges(ranges_m).copy()
    measured = np.empty(ranges.size, np.bool_)
    scan_kernels().condition_scan(ranges, measured, float(range_cap_m), repair_window)
    return ConditionedScan(ranges, measured)


def is_window(beams: int) -> bool:
    """Return whether `beams` is a window that has a middle and neighbours."""
    return beams >= 3 and beams % 2 == 1  # noqa: PLR2004
