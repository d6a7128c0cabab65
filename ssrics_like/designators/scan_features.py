"""Geometric features of a single scan, for learning what kind of place it was taken at."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.designators.readings import RANGE_MIN_M, ReadingSettings, read

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ssrics_like.perception.observation import LaserScan

    Array = NDArray[np.float64]

BEAM_RAD = math.radians(1.0)  # features are of beams so far apart, whatever the laser's are
CAPS_M = (1.0, 2.0, 4.0)  # beside the scan's own cap
GAPS_M = (0.25, 0.5, 1.0, 2.0)  # steps between neighbouring beams from which they are a gap
HARMONICS = 6  # Fourier coefficients of the outline on either side of 0

_ORDERS = (*range(2, HARMONICS + 1), *range(-HARMONICS, 0))
_ALL = ReadingSettings()
_TINY = 1e-9

FEATURES = (
    *("step_mean", "step_std"),
    *(f"step_{what}_to_{cap:g}m" for cap in CAPS_M for what in ("mean", "std")),
    *("range_mean", "range_std", "range_over_most_mean", "range_over_most_std"),
    *(f"gaps_{gap:g}m" for gap in GAPS_M),
    *("gaps_relative_mean", "gaps_relative_std"),
    *("minima_distance", "minima_angle"),
    *("area", "perimeter", "area_over_perimeter", "form_factor", "compactness"),
    *("outline_mean", "outline_std"),
    *("axis_major", "axis_minor", "axis_ratio", "elongation", "skewness", "kurtosis"),
    *(f"fourier_{n}" for n in _ORDERS),
)
"""Names of the features, in order."""


def scan_features(scan: LaserScan, settings: ReadingSettings = _ALL) -> Array | None:
    """Return geometric features of a scan.

    The scan is conditioned and read at beams 1 degree apart. Of the beams: steps between
    neighbours (also with the ranges cut at 1, 2 and 4 m), ranges (also as a share of the
    longest), the number of gaps, the relation of neighbouring ranges, distance and angle
    of the two nearest obstacles (the two lowest local minima). Of the outline, the polygon
    of the beams' ends: area, perimeter, their quotient and form factor (4 pi area /
    perimeter^2), compactness (area over that of the circle about the centroid that holds
    all), distance from the centroid, axes and shape from the second moments, moments of
    the distances, and the size of Fourier coefficients of x + iy over that of the first.

    Parameters
    ----------
    scan : LaserScan
        Any geometry.
    settings : ReadingSettings
        The cap and the repair of dropouts.

    Returns
    -------
    ndarray, shape (len(FEATURES),), or None
        Metres, radians or no unit; all finite. None if no beam has a value.

    Raises
    ------
    ScanError
        The scan has no beams.

    References
    ----------
    Martinez Mozos, Stachniss & Burgard (2005), "Supervised learning of places from range
    data using AdaBoost", ICRA. Their scans look all round; the outline of one that does
    not is closed through the laser. Left out: beams on extracted lines, and most of the
    200 Fourier descriptors and Hu's moments.
    """
    ranges, bearings, _ = read(scan, settings)
    if ranges.size == 0:
        return None
    count = min(max(round((bearings[-1] - bearings[0]) / BEAM_RAD), 0) + 1, 720)
    angles = np.linspace(bearings[0], bearings[-1], count)
    # The nearest beam, not a value between two, which would put walls into openings.
    middles = 0.5 * (bearings[1:] + bearings[:-1])
    r = np.maximum(ranges[np.searchsorted(middles, angles)], RANGE_MIN_M)
    return np.array([*_of_beams(r, angles), *_of_outline(r, angles)])


def _of_beams(r: Array, angles: Array) -> list[float]:
    steps = np.abs(np.diff(r)) if r.size > 1 else np.zeros(1)
    values = [steps.mean(), steps.std()]
    for cap_m in CAPS_M:
        cut = np.abs(np.diff(np.minimum(r, cap_m))) if r.size > 1 else np.zeros(1)
        values += [cut.mean(), cut.std()]
    share = r / r.max()
    values += [r.mean(), r.std(), share.mean(), share.std()]
    values += [np.count_nonzero(steps > gap_m) for gap_m in GAPS_M]
    relation = np.minimum(r[1:], r[:-1]) / np.maximum(r[1:], r[:-1]) if r.size > 1 else np.ones(1)
    values += [relation.mean(), relation.std()]
    padded = np.concatenate([[np.inf], r, [np.inf]])
    minima = np.flatnonzero((r < padded[:-2]) & (r <= padded[2:]))
    if minima.size < 2:  # noqa: PLR2004 - a pair
        return [*map(float, values), 0.0, 0.0]
    i, j = minima[np.argsort(r[minima], kind="stable")[:2]]
    apart = abs(angles[i] - angles[j])
    square = r[i] ** 2 + r[j] ** 2 - 2.0 * r[i] * r[j] * math.cos(apart)
    return [*map(float, values), math.sqrt(max(square, 0.0)), float(apart)]


def _of_outline(r: Array, angles: Array) -> list[float]:
    z = r * np.exp(1j * angles)
    whole_circle = angles[-1] - angles[0] > math.tau - 2.0 * BEAM_RAD
    outline = z if whole_circle else np.append(z, 0.0)
    ahead = np.roll(outline, -1)
    cross = (outline.conj() * ahead).imag
    area = 0.5 * abs(float(cross.sum()))
    perimeter = float(np.abs(ahead - outline).sum()) + _TINY
    centre = z.mean()
    from_centre = np.abs(z - centre)
    around = math.pi * float(from_centre.max()) ** 2 + _TINY
    values = [area, perimeter, area / perimeter, 4 * math.pi * area / perimeter**2, area / around]
    mean, std = float(from_centre.mean()), float(from_centre.std())
    values += [mean, std]
    x, y = z.real - centre.real, z.imag - centre.imag
    xx, yy, xy = (x * x).mean(), (y * y).mean(), (x * y).mean()
    middle, off = 0.5 * (xx + yy), math.hypot(0.5 * (xx - yy), xy)
    major, minor = math.sqrt(middle + off), math.sqrt(max(middle - off, 0.0))
    values += [major, minor, minor / (major + _TINY), off / (middle + _TINY)]
    standard = (from_centre - mean) / (std + _TINY)
    values += [float((standard**3).mean()), float((standard**4).mean())]
    # How long the coefficients are does not depend on heading nor on the first beam.
    size = np.abs(np.fft.fft(z, max(z.size, 2 * HARMONICS + 1)))
    scale = float(size[1]) + _TINY
    return values + [float(size[n]) / scale for n in _ORDERS]
