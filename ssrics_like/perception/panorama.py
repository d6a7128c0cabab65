"""Scans turned into one frame: turning on the spot then changes nothing but what is in view."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

BEAMS = 360
"""Directions of a panorama, a degree apart."""


def panorama(
    ranges_m: NDArray[np.float64], bearings_rad: NDArray[np.float64], heading_rad: float
) -> NDArray[np.float64]:
    """Arrange a scan by the direction of its beams in the frame of odometry.

    Parameters
    ----------
    ranges_m, bearings_rad : ndarray, shape (beams,)
        A conditioned scan.
    heading_rad : float
        Heading of the laser in that frame.

    Returns
    -------
    ndarray, shape (360,), float64
        The reading in each direction, of several the last; NaN where no beam looks.
    """
    around = np.full(BEAMS, np.nan)
    directions = np.round((bearings_rad + heading_rad) * (BEAMS / math.tau)).astype(np.int64)
    around[directions % BEAMS] = ranges_m
    return around
