"""Base-level activation: how often and how long ago a chunk was used."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ssrics_like.memory.growing import GrowingArray

LEAST_AGE_S = 0.05  # ACT-R 7: no reference counts as younger than 50 ms
HALF_TICK_S = 0.0005  # ACT-R's clock counts whole ms: a reference this close is "now"


class ReferenceLog:
    """When each chunk of a table was used: one flat list, in the order of arrival.

    Attributes
    ----------
    times_s : GrowingArray of float64
        Time of each reference.
    rows : GrowingArray of int64
        Which chunk it belongs to.
    """

    def __init__(self) -> None:
        self.times_s = GrowingArray(np.float64)
        self.rows = GrowingArray(np.int64)
        self._chunks = 0
        self._latest_s = -np.inf

    def add_chunk(self, t_s: float) -> int:
        """Begin a chunk with its first reference; return its row."""
        row = self._chunks
        self._chunks += 1
        self.add_reference(row, t_s)
        return row

    def add_reference(self, row: int, t_s: float) -> None:
        """Note one more use of a chunk."""
        self.times_s.append(t_s)
        self.rows.append(row)
        self._latest_s = max(self._latest_s, t_s)

    def of(self, row: int) -> NDArray[np.float64]:
        """Return the times of one chunk's references, in the order of arrival."""
        mine: NDArray[np.bool_] = self.rows.used == row
        return self.times_s.used[mine]

    def by_chunk(self) -> list[NDArray[np.float64]]:
        """Return the times of every chunk's references, each in the order of arrival."""
        rows = self.rows.used
        order = np.argsort(rows, kind="stable")
        ends = np.cumsum(np.bincount(rows, minlength=self._chunks))
        return np.split(self.times_s.used[order], ends[:-1]) if self._chunks else []

    def base_levels(
        self,
        t_s: float,
        *,
        decay: float | None,
        optimized: bool | int,
        constant: float,
        wanted: NDArray[np.bool_] | None = None,
    ) -> NDArray[np.float64]:
        """Return the base level of every chunk at one moment, shape (chunks,).

        References after `t_s` do not count: a chunk that has none by then gets -inf,
        as does a chunk that is not `wanted`.
        """
        times, rows = self.times_s.used, self.rows.used
        keep = None if wanted is None else wanted[rows]
        if self._latest_s > t_s + HALF_TICK_S:
            past = times <= t_s + HALF_TICK_S
            keep = past if keep is None else keep & past
        if keep is not None:
            times, rows = times[keep], rows[keep]
        return base_levels(
            t_s - times,
            rows,
            self._chunks,
            decay=decay,
            optimized=optimized,
            constant=constant,
        )


def base_level(
    references_s: ArrayLike,
    t_s: float,
    *,
    decay: float | None = 0.5,
    optimized: bool | int = False,
    constant: float = 0.0,
) -> float:
    """Compute the base-level activation of one chunk.

    Parameters
    ----------
    references_s : array_like, shape (n,)
        When the chunk was used, seconds, in any order; the earliest is its creation.
    t_s : float
        The moment of interest, seconds.
    decay, optimized, constant
        As in :func:`base_levels`.

    Returns
    -------
    float

    References
    ----------
    Bothell, ACT-R 7.27+ Reference Manual, "Base-level activation".
    """
    ages = t_s - np.asarray(references_s, np.float64)
    rows = np.zeros(len(ages), np.int64)
    return float(base_levels(ages, rows, 1, decay=decay, optimized=optimized, constant=constant)[0])


def base_levels(
    ages_s: NDArray[np.float64],
    rows: NDArray[np.int64],
    count: int,
    *,
    decay: float | None,
    optimized: bool | int,
    constant: float,
) -> NDArray[np.float64]:
    """Compute the base-level activations of chunks whose references stand in one flat list.

    With ages t_1 (newest) ... t_n (oldest) of a chunk's n references, and no age below
    50 ms, the base level is `constant` plus

    * exact: ``ln sum_j t_j^-d``
    * optimized: ``ln(n / (1 - d)) - d ln t_n``
    * hybrid k, where n > k (exact elsewhere):
      ``ln(sum_(j<=k) t_j^-d + (n - k) (t_n^(1-d) - t_k^(1-d)) / ((1-d) (t_n - t_k)))``

    Parameters
    ----------
    ages_s : ndarray, shape (references,)
        Age of each reference in seconds.
    rows : ndarray, shape (references,)
        The chunk that each reference belongs to.
    count : int
        Number of chunks.
    decay : float or None
        d; None leaves `constant` alone.
    optimized : bool or int
        False for the exact form, True for the optimized one, k > 0 for the hybrid.
    constant : float
        Added to every base level.

    Returns
    -------
    ndarray, shape (count,)
        -inf for a chunk without references.

    Raises
    ------
    ValueError
        For the optimized form with a decay of 1 or more.

    Notes
    -----
    In the hybrid's approximated part it is not the ages but their difference that is
    50 ms at least; so it is in the reference implementation (compute-references). From
    d = 1 on, where ACT-R stops with an arithmetic error, those ages have the floor too,
    and at d = 1 the limit ``(n - k) ln(t_n / t_k) / (t_n - t_k)`` is taken.

    References
    ----------
    Anderson & Lebiere (1998), The Atomic Components of Thought, equation 4.1 (exact).
    Petrov (2006), "Computationally efficient approximation of the base-level learning
    equation in ACT-R", ICCM (hybrid).
    """
    references = np.bincount(rows, minlength=count)
    with np.errstate(divide="ignore"):  # ln 0 = -inf is the answer for no references
        if decay is None:
            return np.where(references > 0, constant, -np.inf)
        if optimized is True:
            if decay >= 1:
                raise ValueError(f"optimized learning needs a decay below 1, got {decay:g}")
            age = np.full(count, LEAST_AGE_S)
            np.maximum.at(age, rows, ages_s)
            optimal = np.log(references / (1 - decay)) - decay * np.log(age)
            return np.asarray(constant + optimal)
        if optimized is False:
            strength = _sums(rows, np.maximum(ages_s, LEAST_AGE_S) ** -decay, count)
        else:
            strength = _hybrid_strength(ages_s, rows, references, decay, optimized)
        return constant + np.log(strength)


def _hybrid_strength(
    ages_s: NDArray[np.float64],
    rows: NDArray[np.int64],
    references: NDArray[np.int64],
    decay: float,
    kept: int,
) -> NDArray[np.float64]:
    order = np.lexsort((ages_s, rows))  # chunk by chunk, newest first
    ages, rows = ages_s[order], rows[order]
    end = np.cumsum(references)
    rank = np.arange(len(ages)) - (end - references)[rows]
    newest = rank < kept
    powers = np.maximum(ages[newest], LEAST_AGE_S) ** -decay
    strength = _sums(rows[newest], powers, len(references))
    long = np.flatnonzero(references > kept)
    oldest_age = ages[end[long] - 1]
    kept_age = ages[(end - references)[long] + kept - 1]
    least = 0.0 if decay < 1 else LEAST_AGE_S
    upper, lower = np.maximum(oldest_age, least), np.maximum(kept_age, least)
    if decay == 1:
        area = np.log(upper / lower)
    else:
        area = (upper ** (1 - decay) - lower ** (1 - decay)) / (1 - decay)
    span = np.maximum(oldest_age - kept_age, LEAST_AGE_S)
    strength[long] += (references[long] - kept) * area / span
    return strength


def _sums(rows: NDArray[np.int64], weights: NDArray[np.float64], count: int) -> NDArray[np.float64]:
    """Sum the weights of each row, in their order, so that equal histories tie exactly."""
    return np.asarray(np.bincount(rows, weights=weights, minlength=count), np.float64)
