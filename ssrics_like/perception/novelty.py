"""The novelty algorithm of the report, for a whole log at once and scan by scan.

For the `interval` scans a_0 .. a_(beta-1), gamma is the number of pairs i < j
whose Pearson correlation exceeds the gradient T (strictly), and the boredom
quotient is tau = gamma / ((beta^2 - beta) / 2). An interval is novel unless tau
exceeds the threshold B.

Defined here, since the report leaves them open: a constant scan correlates 1
with an equal scan and 0 with any other; partly invalid scans are correlated
over the beams valid in both, and fewer than two such beams give 0.

References
----------
Report, section 2.1 (algorithm, equations 1 and 2) and 2.2 (values).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, cast

import numpy as np

from ssrics_like.errors import ScanError
from ssrics_like.perception.checks import (
    ADVANCES,
    kernels,
    require_choice,
    require_fraction,
    require_interval,
    require_ranges,
)

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

Advance = Literal["tumbling", "sliding"]

REPORT_GRADIENT = 0.99  # report, section 2.2 ("Gradient = 99")
REPORT_INTERVAL = 50  # report, section 2.2
REPORT_THRESHOLD = 0.75  # report, section 2.2

_CHUNK = 2048  # scans converted and counted at once, so that memory does not grow with the log
_PADDING = 32  # float32 values that two of the widest vector registers hold


def pairs(interval: int) -> int:
    """Return the number of pairs of an interval, (beta^2 - beta) / 2."""
    return interval * (interval - 1) // 2


def boredom_quotient(gamma: int, interval: int) -> float:
    """Return tau, the share of an interval's pairs that exceed the gradient.

    Parameters
    ----------
    gamma : int
        Pairs whose correlation exceeds the gradient.
    interval : int
        Scans in the interval.

    References
    ----------
    Report, equation 2.

    Examples
    --------
    >>> round(boredom_quotient(420, 50), 2)
    0.34
    """
    return gamma / pairs(interval)


def is_novel(tau: float, threshold: float) -> bool:
    """Return whether an interval is novel: unless tau exceeds the threshold, strictly.

    References
    ----------
    Report, section 2.1: "if tau > B then Not NOVEL else NOVEL".
    """
    return not tau > threshold


def novelty_profile(
    scans: ArrayLike,
    interval: int = REPORT_INTERVAL,
    gradient: float = REPORT_GRADIENT,
    advance: str = "sliding",
) -> NDArray[np.float64]:
    """Return the boredom quotient tau of every complete interval of a log.

    Parameters
    ----------
    scans : array_like, shape (n, beams)
        Readings in metres. A reading that is not finite is an invalid beam.
    interval : int
        Scans in an interval, beta >= 2.
    gradient : float
        Correlation that a pair must exceed to count as the same, 0 < T < 1.
    advance : {"sliding", "tumbling"}
        Sliding: an interval ends at each scan from the `interval`-th on.
        Tumbling: intervals follow one another without overlap.

    Returns
    -------
    ndarray, float64
        tau of each interval: n - interval + 1 of them (sliding) or n // interval
        (tumbling); empty when the log is shorter than one interval.

    Raises
    ------
    ScanError
        `scans` is not a table of numbers with at least one beam.
    SettingsError
        `interval`, `gradient` or `advance` is out of range.

    References
    ----------
    Report, section 2.1.

    See Also
    --------
    NoveltyDetector : the streaming twin, with equal answers.
    """
    interval = require_interval(interval)
    gradient = require_fraction("gradient", gradient)
    sliding = require_choice("advance", advance, ADVANCES) == "sliding"
    table = _require_table(scans)
    if len(table) < interval:
        return np.empty(0)
    if not sliding:
        table = table[: len(table) // interval * interval]
    forward, backward = _count(table, interval, gradient, sliding=sliding)
    if not sliding:
        gamma = forward.reshape(-1, interval).sum(axis=1)
        return np.asarray(gamma / pairs(interval), np.float64)
    gamma = np.empty(len(table) - interval + 1, np.int64)
    gamma[0] = backward[:interval].sum()
    # One step on, the pairs of the oldest scan leave and those of the newest enter.
    steps = backward[interval:] - forward[: len(table) - interval]
    gamma[1:] = gamma[0] + np.cumsum(steps)
    return np.asarray(gamma / pairs(interval), np.float64)


def _require_table(scans: ArrayLike) -> NDArray[np.generic]:
    try:
        table = np.asarray(scans)
    except ValueError as error:  # rows of different lengths
        raise ScanError(f"scans are not a table of numbers: {error}") from error
    if table.ndim != 2 or table.shape[1] == 0:  # noqa: PLR2004
        raise ScanError(f"scans have shape {table.shape}; expected (scans, beams), beams >= 1")
    if table.dtype.kind not in "fiub":
        raise ScanError(f"scans hold {table.dtype} values; expected ranges in metres")
    return table


def _count(
    table: NDArray[np.generic], interval: int, gradient: float, *, sliding: bool
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Count each scan's exceeding pairs with later and with earlier scans of its interval."""
    n = len(table)
    forward = np.zeros(n, np.int64)
    backward = np.zeros(n, np.int64)
    rows = _CHUNK if sliding else max(_CHUNK // interval, 1) * interval
    overlap = interval - 1 if sliding else 0
    count_pairs = kernels().count_pairs
    for first in range(0, n, rows):
        last = min(first + rows, n)
        part = np.require(table[first : last + overlap], np.float64, ["C", "W"])
        count_pairs(
            part,
            last - first,
            interval,
            len(part) if sliding else interval,
            gradient,
            forward[first : first + len(part)],
            backward[first : first + len(part)],
        )
    return forward, backward


class NoveltyDetector:
    """The boredom quotient of a stream of scans, in memory of one interval.

    Each scan costs its own `interval` - 1 correlations; the pairs of the scan
    that leaves are remembered, not recomputed.

    Parameters
    ----------
    interval, gradient, advance
        As for `novelty_profile`.

    Examples
    --------
    >>> detector = NoveltyDetector(interval=2)
    >>> [detector.update(scan) for scan in ([1, 2, 3], [1, 2, 3], [3, 2, 1])]
    [None, 1.0, 0.0]
    """

    def __init__(
        self,
        interval: int = REPORT_INTERVAL,
        gradient: float = REPORT_GRADIENT,
        advance: str = "sliding",
    ) -> None:
        self.interval = require_interval(interval)
        self.gradient = require_fraction("gradient", gradient)
        self.advance = cast("Advance", require_choice("advance", advance, ADVANCES))
        self._pairs = pairs(self.interval)
        self._push = kernels().push_scan
        self._books = np.zeros((2, self.interval), np.int64)
        self._state = np.zeros(3, np.int64)
        self._beams = 0
        self.reset()

    def reset(self) -> None:
        """Forget every scan; the next one may have another number of beams."""
        self._state[:] = 0
        self._beams = 0
        self._count = 0

    def update(self, ranges: ArrayLike) -> float | None:
        """Take one scan; return tau if it completes an interval, else None.

        Parameters
        ----------
        ranges : array_like, shape (beams,)
            Readings in metres. A reading that is not finite is an invalid beam.

        Raises
        ------
        ScanError
            The scan has no beams, or not as many as the interval's first; call
            `reset` to go on with scans of another size.
        """
        if self._beams == 0:
            self._begin(require_ranges(ranges).size)
        elif self._count == self.interval and self.advance == "tumbling":
            self._state[:] = 0
            self._count = 0
        self._scan[:] = require_ranges(ranges, self._beams)
        gamma = self._push(
            self._scan, self._ring, self._unit, self._books, self._state, self.gradient
        )
        if self._count < self.interval:
            self._count += 1
        return gamma / self._pairs if self._count == self.interval else None

    def correlations(self) -> NDArray[np.float64]:
        """Return the pair correlations of the scans in hand.

        After `update` has returned a tau these are the interval's
        (interval^2 - interval) / 2, and those above the gradient are exactly the
        ones that tau counts; before that, those of the scans taken so far.

        Returns
        -------
        ndarray, float64
            Pairs i < j with the oldest scan first, row by row of the upper triangle.
        """
        if self._count == 0:
            return np.empty(0)
        newest = int(self._state[1]) - 1
        slots = np.arange(newest - self._count + 1, newest + 1) % self.interval
        return scan_correlations(self._ring[slots])

    def _begin(self, beams: int) -> None:
        self._beams = beams
        self._scan = np.empty(beams)
        self._ring = np.empty((self.interval, beams))
        self._unit = np.zeros((self.interval, -(-beams // _PADDING) * _PADDING), np.float32)


def scan_correlations(scans: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the Pearson correlations of all pairs of scans, as the detector decides them.

    Parameters
    ----------
    scans : ndarray, shape (n, beams)
        Readings in metres.

    Returns
    -------
    ndarray, shape ((n * n - n) / 2,)
        Pairs i < j, row by row of the upper triangle.
    """
    table = np.require(scans, np.float64, ["C", "W"])
    return cast("NDArray[np.float64]", kernels().pair_correlations(table))
