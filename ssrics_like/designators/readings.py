"""What designators read from a scan, whatever the laser: beams that answered, few features."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, NamedTuple

import numpy as np
from pydantic import Field, field_validator

from ssrics_like.designators.protocol import DesignatorSettings
from ssrics_like.perception.conditioning import condition, is_window

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ssrics_like.perception.observation import LaserScan

RANGE_MIN_M = 0.1
"""Shorter readings count as this long, so that a logarithm of a range stays tame."""

SUMMARY = ("mean", "spread", "far", "roughness", "near_right", "near_front", "near_left")
"""Names of the features of `summary`, in order."""

_NEAR, _FAR = 0.1, 0.9  # quantiles
_USUAL_MEAN = np.array((-1.4, 0.65, -0.55, 2.1, -2.0, -1.8, -2.0))
_USUAL_SPREAD = np.array((0.4, 0.2, 0.45, 0.4, 0.6, 0.6, 0.6))
# Rounded, over drives through eight generated buildings with a cap of 8 m: they bring the
# features to one scale, and are fitted to nothing.


class ReadingSettings(DesignatorSettings):
    """Settings of all designators that read scans.

    Attributes
    ----------
    range_cap_m : float
        Metres. Readings from here on, and no-return values, are set to it.
    repair_window : int
        Beams of the median that repairs dropouts, odd; 0 turns repair off.
    """

    range_cap_m: Annotated[float, Field(gt=0.1, le=10_000.0)] = 8.0
    repair_window: Annotated[int, Field(ge=0, le=1001)] = 5

    @field_validator("repair_window")
    @classmethod
    def _window_is_odd(cls, beams: int) -> int:
        if beams != 0 and not is_window(beams):
            raise ValueError("expected 0 (off) or an odd number of beams, 3 or more")
        return beams


class Readings(NamedTuple):
    """The beams of a scan that have a value after conditioning.

    Attributes
    ----------
    ranges_m, bearings_rad : ndarray, shape (valid,), float64
        In order of rising bearing; both are empty if no beam gave an answer.
    measured : ndarray, shape (valid,), bool
        False where the reading was capped or repaired.
    """

    ranges_m: NDArray[np.float64]
    bearings_rad: NDArray[np.float64]
    measured: NDArray[np.bool_]


def read(scan: LaserScan, settings: ReadingSettings) -> Readings:
    """Condition a scan and leave out the beams that remain without a value.

    Raises
    ------
    ScanError
        The scan has no beams.
    """
    ranges, measured = condition(scan.ranges_m, settings.range_cap_m, settings.repair_window)
    valid = ~np.isnan(ranges)
    if valid.all():
        return Readings(ranges, scan.bearings_rad, measured)
    return Readings(ranges[valid], scan.bearings_rad[valid], measured[valid])


def summary(scan: LaserScan, settings: ReadingSettings) -> NDArray[np.float64] | None:
    """Return few features of a scan that hardly depend on the laser.

    With l = log(range / cap): the mean of l, its standard deviation, its upper decile, the
    logarithm of 1 plus the sum of its steps between neighbouring beams, and the lower
    decile of the right, the middle and the left third of the beams. Each is brought to
    about zero mean and unit spread over an office building.

    Returns
    -------
    ndarray, shape (len(SUMMARY),), or None
        No unit; None if no beam has a value.

    Raises
    ------
    ScanError
        The scan has no beams.
    """
    ranges = read(scan, settings).ranges_m
    beams = ranges.size
    if beams == 0:
        return None
    log = np.log(np.maximum(ranges, RANGE_MIN_M) / settings.range_cap_m)
    ordered = np.sort(log)
    features = [
        log.mean(),
        log.std(),
        ordered[round(_FAR * (beams - 1))],
        np.log1p(np.abs(np.diff(log)).sum()),
    ]
    for third in range(3):
        first = third * beams // 3
        part = np.sort(log[first : max((third + 1) * beams // 3, first + 1)])
        features.append(part[round(_NEAR * (part.size - 1))])
    scaled: NDArray[np.float64] = (np.array(features) - _USUAL_MEAN) / _USUAL_SPREAD
    return scaled
