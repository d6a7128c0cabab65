"""How the marks of one set meet the marks of another, over the same units; many sets at once."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.stats import norm

Floats = NDArray[np.float64]
MEASURES = ("precision", "recall", "f", "kappa", "d_prime", "criterion")


@dataclass(frozen=True, eq=False)
class Hits:
    """Counts of units, from which every measure follows; all arrays have the same shape.

    Attributes
    ----------
    both : ndarray
        Units that were marked and wanted.
    marked : ndarray
        Units that were marked.
    wanted : ndarray
        Units that should be marked: those of a consensus, or of another marker.
    units : int
        All units.
    """

    both: Floats
    marked: Floats
    wanted: Floats
    units: int

    @property
    def precision(self) -> Floats:
        """Share of the marked units that are wanted; NaN where none is marked or wanted."""
        return np.where(self.wanted > 0, _over(self.both, self.marked), np.nan)

    @property
    def recall(self) -> Floats:
        """Share of the wanted units that are marked; NaN where none is wanted."""
        return _over(self.both, self.wanted)

    @property
    def f(self) -> Floats:
        """Harmonic mean of both; 0 where nothing is marked, NaN where nothing is wanted."""
        return np.where(
            self.wanted > 0, _over(2.0 * self.both, self.marked + self.wanted), np.nan
        )  # fmt: skip

    @property
    def agreement(self) -> Floats:
        """Share of the units about which both sets say the same."""
        differ = self.marked + self.wanted - 2.0 * self.both
        return 1.0 - _over(differ, np.full_like(differ, self.units))

    @property
    def kappa(self) -> Floats:
        """Cohen's kappa (1960); NaN where both sets hold every unit, or both none."""
        units = np.full_like(self.marked, self.units)
        p, q = _over(self.marked, units), _over(self.wanted, units)
        expected = p * q + (1.0 - p) * (1.0 - q)
        return _over(self.agreement - expected, 1.0 - expected)

    @property
    def d_prime(self) -> Floats:
        """Sensitivity d', hits against false alarms; NaN where all units or none are wanted."""
        hit, false = self._deviates
        return hit - false

    @property
    def criterion(self) -> Floats:
        """Criterion c: positive for whoever marks little. NaN as of `d_prime`."""
        hit, false = self._deviates
        return -(hit + false) / 2.0

    @property
    def _deviates(self) -> tuple[Floats, Floats]:
        """Normal deviates of the hit and false alarm rates.

        With the log-linear correction of Hautus (1995): .5 is added to each count and 1 to each
        number of trials, always, so that rates of 0 and 1 have a deviate.
        """
        others = self.units - self.wanted
        told = (self.wanted > 0) & (others > 0)
        hit = norm.ppf((self.both + 0.5) / (self.wanted + 1.0))
        false = norm.ppf((self.marked - self.both + 0.5) / (others + 1.0))
        return np.where(told, hit, np.nan), np.where(told, false, np.nan)

    def measure(self, name: str) -> Floats:
        """Return one of `MEASURES`."""
        value: Floats = getattr(self, name)
        return value


def hits(marked: ArrayLike, wanted: ArrayLike) -> Hits:
    """Count how each set of marks meets each set of wanted units.

    Parameters
    ----------
    marked : array_like of bool, shape (sets, units)
        Who marked which unit.
    wanted : array_like of bool, shape (truths, units)
        Which units should be marked, in as many ways.

    Returns
    -------
    Hits
        Arrays of shape (truths, sets).
    """
    a, b = np.asarray(marked, np.float64), np.asarray(wanted, np.float64)
    both = b @ a.T
    return Hits(
        both,
        np.broadcast_to(a.sum(axis=1), both.shape).copy(),
        np.broadcast_to(b.sum(axis=1)[:, np.newaxis], both.shape).copy(),
        a.shape[1],
    )


def paired_hits(marked: ArrayLike, wanted: ArrayLike) -> Hits:
    """Count how each set of marks meets the wanted units of the same row, shape (sets,)."""
    a, b = np.asarray(marked, bool), np.asarray(wanted, bool)
    both, marks, wants = (np.asarray(t.sum(axis=1), np.float64) for t in (a & b, a, b))
    return Hits(both, marks, wants, a.shape[1])


def _over(part: Floats, whole: Floats) -> Floats:
    """Return part / whole; NaN where there is nothing to have a share of."""
    tiny = np.abs(whole) < 1e-12  # noqa: PLR2004 - zero but for rounding
    share: Floats = np.divide(part, whole, out=np.full(np.shape(part), np.nan), where=~tiny)
    return share
