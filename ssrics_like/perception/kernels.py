"""The compiled inner loops of the novelty algorithm.

They share one file because numba's cache of a function is renewed when its own
file changes, not when a file that it calls into does.

Two kinds of decision stand side by side. A pair of scans is first compared by
the float32 dot product of its standardised readings, whose distance from the
true correlation is bounded by `float32_margin`; only a pair whose product lies
within that bound of the gradient is decided again by `correlation` in float64.
So every path (streaming, sliding, tumbling) gives the answer of `correlation`,
bit for bit, at the speed of float32.

Float64 sums run in eight explicit lanes. Compilers may not reorder them, so
they give the same bits wherever they are inlined, and still use vector
instructions.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.compiling import HUGE_M, compiled, compiled_reordering

if TYPE_CHECKING:
    from numpy.typing import NDArray

BLOCK = 16
"""Scans in one matrix product; small, since a block of b is multiplied with b + interval - 1."""

_LANES = 8
_NEARLY_EQUAL = 1e-8  # squared deviation, relative to the squared mean
_TINY_SQUARES, _LARGE_SQUARES = 1e-100, 1e100


@compiled
def _sum(a: NDArray[np.float64], n: int) -> float:
    s0 = s1 = s2 = s3 = s4 = s5 = s6 = s7 = 0.0
    whole = n // _LANES * _LANES
    for k in range(0, whole, _LANES):
        s0 += a[k]
        s1 += a[k + 1]
        s2 += a[k + 2]
        s3 += a[k + 3]
        s4 += a[k + 4]
        s5 += a[k + 5]
        s6 += a[k + 6]
        s7 += a[k + 7]
    for k in range(whole, n):
        s0 += a[k]
    return ((s0 + s1) + (s2 + s3)) + ((s4 + s5) + (s6 + s7))


@compiled
def _dot(a: NDArray[np.float64], b: NDArray[np.float64], n: int) -> float:
    s0 = s1 = s2 = s3 = s4 = s5 = s6 = s7 = 0.0
    whole = n // _LANES * _LANES
    for k in range(0, whole, _LANES):
        s0 += a[k] * b[k]
        s1 += a[k + 1] * b[k + 1]
        s2 += a[k + 2] * b[k + 2]
        s3 += a[k + 3] * b[k + 3]
        s4 += a[k + 4] * b[k + 4]
        s5 += a[k + 5] * b[k + 5]
        s6 += a[k + 6] * b[k + 6]
        s7 += a[k + 7] * b[k + 7]
    for k in range(whole, n):
        s0 += a[k] * b[k]
    return ((s0 + s1) + (s2 + s3)) + ((s4 + s5) + (s6 + s7))


@compiled
def _centre(a: NDArray[np.float64], n: int) -> float:
    """Turn `a` into deviations from its mean, in place; return the sum of their squares."""
    mean = _sum(a, n) / n
    for k in range(n):
        a[k] -= mean
    squares = _dot(a, a, n)
    if squares < _NEARLY_EQUAL * n * mean * mean:
        # The mean of nearly equal readings is rounded by as much as they differ; the
        # mean of what is left corrects it.
        mean = _sum(a, n) / n
        for k in range(n):
            a[k] -= mean
        squares = _dot(a, a, n)
    if squares < _TINY_SQUARES or squares > _LARGE_SQUARES:
        # The product of two such sums would underflow or overflow; a correlation
        # does not depend on the scale.
        largest = 0.0
        for k in range(n):
            largest = max(largest, abs(a[k]))
        for k in range(n):
            a[k] /= largest
        squares = _dot(a, a, n)
    return squares


@compiled
def correlation(
    x: NDArray[np.float64],
    y: NDArray[np.float64],
    dx: NDArray[np.float64],
    dy: NDArray[np.float64],
) -> float:
    """Pearson correlation of two scans over the beams valid in both, the deciding routine.

    Fewer than two common beams: 0. A scan that is constant over the common
    beams: 1 if the other equals it there, else 0. `dx` and `dy` are work space.
    """
    n = 0
    for k in range(x.shape[0]):
        if abs(x[k]) < HUGE_M and abs(y[k]) < HUGE_M:
            dx[n] = x[k]
            dy[n] = y[k]
            n += 1
    if n < 2:  # noqa: PLR2004  (a correlation needs two points)
        return 0.0
    x_varies = y_varies = differ = False
    for k in range(n):
        x_varies |= dx[k] != dx[0]
        y_varies |= dy[k] != dy[0]
        differ |= dx[k] != dy[k]
    if not (x_varies and y_varies):
        return 0.0 if differ else 1.0
    xx = _centre(dx, n)
    yy = _centre(dy, n)
    r = _dot(dx, dy, n) / math.sqrt(xx * yy)
    return min(1.0, max(-1.0, r))


@compiled
def float32_margin(beams: int) -> float:
    """Bound on |float32 dot product - correlation| for standardised scans.

    gamma_k = k u / (1 - k u) with u = 2^-24 (Higham, Accuracy and Stability of
    Numerical Algorithms, section 3.1) holds for a dot product in any order, with
    k = beams for its sum, 2 for the rounding of its inputs, and 4 to spare for
    the float64 steps and for rounding the limits themselves to float32.
    """
    ku = (beams + 6) * 2.0**-24
    return ku / (1.0 - ku)


@compiled
def _standardise(
    scan: NDArray[np.float64], unit: NDArray[np.float32], work: NDArray[np.float64]
) -> bool:
    """Write the standardised scan to `unit`; return True if it needs pair by pair care.

    That is a constant or partly invalid scan; its `unit` is zero.
    """
    n = scan.shape[0]
    invalid = 0
    different = 0
    for k in range(n):
        work[k] = scan[k]
        invalid += not abs(scan[k]) < HUGE_M
        different += scan[k] != scan[0]
    if invalid > 0 or different == 0:
        unit[:n] = 0.0
        return True
    scale = 1.0 / math.sqrt(_centre(work, n))
    for k in range(n):
        unit[k] = work[k] * scale
    return False


@compiled
def count_pairs(
    scans: NDArray[np.float64],
    rows: int,
    interval: int,
    span: int,
    gradient: float,
    forward: NDArray[np.int64],
    backward: NDArray[np.int64],
) -> None:
    """Count, for each scan, its pairs within the interval that exceed the gradient.

    Parameters
    ----------
    scans : ndarray, shape (n, beams)
        Readings in metres.
    rows : int
        Pairs (i, j), i < j < i + interval, are counted for the first `rows` scans i.
    span : int
        Pairs across a multiple of `span` are left out: n for sliding intervals,
        the interval for tumbling ones.
    forward, backward : ndarray, shape (n,)
        forward[i] and backward[j] grow by one for each such pair.
    """
    n, beams = scans.shape
    unit = np.empty((n, beams), np.float32)
    special = np.zeros(n + 1, np.int64)  # running number of scans that need care
    dx = np.empty(beams)
    dy = np.empty(beams)
    for i in range(n):
        special[i + 1] = special[i] + _standardise(scans[i], unit[i], dx)
    margin = float32_margin(beams)
    lower = np.float32(gradient - margin)
    upper = np.float32(gradient + margin)
    space = np.empty(BLOCK * (BLOCK + interval - 1), np.float32)
    for first in range(0, rows, span):
        last = min(first + span, n)
        for top in range(first, min(last, rows), BLOCK):
            bottom = min(top + BLOCK, last, rows)
            right = min(bottom + interval - 1, last)
            product = space[: (bottom - top) * (right - top)].reshape(bottom - top, right - top)
            np.dot(unit[top:bottom], unit[top:right].T, product)
            for i in range(top, bottom):
                stop = min(i + interval, right)
                line = product[i - top]
                exceeding = 0
                near = 0
                for j in range(i + 1, stop):
                    above = line[j - top] > upper
                    exceeding += above
                    backward[j] += above
                    near += (line[j - top] >= lower) & (not above)
                if near > 0 or special[stop] > special[i]:
                    i_special = special[i + 1] > special[i]
                    for j in range(i + 1, stop):
                        care = i_special or special[j + 1] > special[j]
                        close = lower <= line[j - top] <= upper
                        if (care or close) and correlation(scans[i], scans[j], dx, dy) > gradient:
                            exceeding += 1
                            backward[j] += 1
                forward[i] += exceeding


@compiled_reordering
def _dot_float32(a: NDArray[np.float32], b: NDArray[np.float32]) -> np.float32:
    total = np.float32(0.0)
    for k in range(a.shape[0]):
        total += a[k] * b[k]
    return total


@compiled
def push_scan(
    scan: NDArray[np.float64],
    ring: NDArray[np.float64],
    unit: NDArray[np.float32],
    books: NDArray[np.int64],
    state: NDArray[np.int64],
    gradient: float,
) -> int:
    """Take a scan into the ring of the interval; return the exceeding pairs now in it.

    Parameters
    ----------
    ring, unit : ndarray, shape (interval, beams) and (interval, padded beams)
        The scans in hand, and the same standardised, padded with zeros.
    books : ndarray, shape (2, interval)
        For each slot: its exceeding pairs with later scans, and whether it needs care.
    state : ndarray, shape (3,)
        Scans in hand, slot of the next scan, exceeding pairs.
    """
    interval, beams = ring.shape
    count, slot, gamma = state[0], state[1], state[2]
    if count == interval:  # the slot still holds the oldest scan
        gamma -= books[0, slot]
        count -= 1
    for k in range(beams):
        ring[slot, k] = scan[k]
    dx = np.empty(beams)
    dy = np.empty(beams)
    care = _standardise(ring[slot], unit[slot], dx)
    books[0, slot] = 0
    books[1, slot] = care
    margin = float32_margin(beams)
    lower = np.float32(gradient - margin)
    upper = np.float32(gradient + margin)
    other = slot - count
    if other < 0:
        other += interval
    for _ in range(count):
        exceeds = False
        close = care or books[1, other] != 0
        if not close:
            product = _dot_float32(unit[other], unit[slot])
            exceeds = bool(product > upper)
            close = bool(lower <= product <= upper)
        if close:
            exceeds = correlation(ring[other], ring[slot], dx, dy) > gradient
        if exceeds:
            books[0, other] += 1
            gamma += 1
        other += 1
        if other == interval:
            other = 0
    state[0], state[1], state[2] = count + 1, (slot + 1) % interval, gamma
    return int(gamma)


@compiled
def pair_correlations(scans: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the correlations of all pairs i < j of `scans`, row by row of the upper triangle."""
    n, beams = scans.shape
    dx = np.empty(beams)
    dy = np.empty(beams)
    result = np.empty(n * (n - 1) // 2)
    at = 0
    for i in range(n):
        for j in range(i + 1, n):
            result[at] = correlation(scans[i], scans[j], dx, dy)
            at += 1
    return result
