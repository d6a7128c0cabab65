"""Bearings of the beams where a log states only how many there are.

A SICK LMS sweeps 180 degrees from right to left: 181 readings one degree apart
or 361 half a degree apart, both ends included. Drivers that store 180 or 360
drop the *last* reading, so the first beam stays at -90 degrees and the sweep
ends at +89 (or +89.5); it is not centred. The Intel log, which states its
angles, says so: 180 beams, start -1.570796, resolution 0.017453.
"""

from __future__ import annotations

import math
from functools import cache

RIGHT_RAD = -math.pi / 2
_DEGREES = {180: 1.0, 181: 1.0, 360: 0.5, 361: 0.5}


@cache
def fan(beams: int) -> tuple[float, float]:
    """Return bearing of the first beam and step between beams for a front laser.

    Parameters
    ----------
    beams : int
        Number of readings, at least 2.

    Returns
    -------
    angle_min_rad, angle_increment_rad : float
        Any number but 180, 181, 360 and 361 is spread over 180 degrees, both
        ends included.
    """
    degrees = _DEGREES.get(beams, 180.0 / (beams - 1))
    return RIGHT_RAD, math.radians(degrees)
