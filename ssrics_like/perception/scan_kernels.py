"""The compiled inner loops that look at one scan: conditioning, sector, view."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.compiling import HUGE_M, compiled

if TYPE_CHECKING:
    from numpy.typing import NDArray


@compiled
def _insert_sorted(a: NDArray[np.float64], n: int, value: float) -> None:
    """Insert `value` into the first `n` ascending elements of `a`, which has room for it."""
    while n > 0 and a[n - 1] > value:
        a[n] = a[n - 1]
        n -= 1
    a[n] = value


@compiled
def condition_scan(
    ranges: NDArray[np.float64], measured: NDArray[np.bool_], cap: float, window: int
) -> None:
    """Cap and repair `ranges` in place; see `conditioning.condition`."""
    n = ranges.shape[0]
    bad = 0
    for k in range(n):
        value = ranges[k]
        measured[k] = 0.0 < value < cap
        if not measured[k]:
            bad += 1
            if not np.isnan(value):
                ranges[k] = cap
    if window == 0 or bad == 0:
        return
    before = ranges.copy()
    width = min(window, n)
    nearby = np.empty(width)
    for k in range(n):
        if measured[k]:
            continue
        first = min(max(k - window // 2, 0), n - width)
        valid = 0
        for i in range(first, first + width):
            if not np.isnan(before[i]):
                _insert_sorted(nearby, valid, before[i])
                valid += 1
        if valid > 0:
            ranges[k] = nearby[(valid - 1) // 2]


@compiled
def _largest(
    ranges: NDArray[np.float64], first: int, last: int, half: int, nearby: NDArray[np.float64]
) -> float:
    """Largest running median over 2 half + 1 beams, centred on the beams first..last-1."""
    n = ranges.shape[0]
    best = -np.inf
    for k in range(first, last):
        low = max(k - half, 0)
        high = min(k + half + 1, n)
        valid = 0
        above = 0
        for i in range(low, high):
            valid += not np.isnan(ranges[i])
            above += ranges[i] > best
        # The lower median exceeds `best` only if more than half of the beams do.
        if np.isnan(ranges[k]) or above < valid - (valid - 1) // 2:
            continue
        filled = 0
        for i in range(low, high):
            if not np.isnan(ranges[i]):
                _insert_sorted(nearby, filled, ranges[i])
                filled += 1
        best = max(best, nearby[(filled - 1) // 2])
    return best


@compiled
def widest_sector(ranges: NDArray[np.float64], front: int, left: int, half: int) -> int:
    """Return 0 (front), 1 (left) or 2 (right); ties go to the earlier of these.

    `front` and `left` are the first beams of these sectors.
    """
    nearby = np.empty(2 * half + 1)
    best = _largest(ranges, front, left, half, nearby)
    winner = 0
    to_left = _largest(ranges, left, ranges.shape[0], half, nearby)
    if to_left > best:
        best = to_left
        winner = 1
    if _largest(ranges, 0, front, half, nearby) > best:
        winner = 2
    return winner


@compiled
def describe_view(ranges: NDArray[np.float64], view: NDArray[np.float32]) -> None:
    """Write the standardised medians of equal shares of the scan to `view`."""
    n = ranges.shape[0]
    bins = view.shape[0]
    medians = np.empty(bins)
    nearby = np.empty(n)
    valid_sum = 0.0
    valid_bins = 0
    for b in range(bins):
        low = b * n // bins
        high = max((b + 1) * n // bins, low + 1)
        filled = 0
        for i in range(low, high):
            if abs(ranges[i]) < HUGE_M:
                _insert_sorted(nearby, filled, ranges[i])
                filled += 1
        medians[b] = np.nan
        if filled > 0:
            medians[b] = 0.5 * (nearby[(filled - 1) // 2] + nearby[filled // 2])
            valid_sum += medians[b]
            valid_bins += 1
    view[:] = 0.0
    lowest = np.inf
    highest = -np.inf
    for b in range(bins):
        if np.isnan(medians[b]):
            medians[b] = valid_sum / max(valid_bins, 1)
        else:
            lowest = min(lowest, medians[b])
            highest = max(highest, medians[b])
    if highest > lowest:
        centre = lowest + np.mean(medians - lowest)
        length = math.sqrt(np.sum((medians - centre) ** 2))
        for b in range(bins):
            view[b] = (medians[b] - centre) / length
