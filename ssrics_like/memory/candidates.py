"""The outcome of a retrieval, with every term that led to it."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ssrics_like.memory.chunks import Chunk


class CandidateRow(NamedTuple):
    """The terms of one candidate's activation; `total` is their sum."""

    name: str
    base_level: float
    spreading: float
    partial_match: float
    noise: float
    total: float


@dataclass(frozen=True, eq=False)
class Candidates:
    """Every chunk that a request could have retrieved, column by column.

    Attributes
    ----------
    names : ndarray of str objects, shape (n,)
        In the order in which the chunks came to memory (type by type, where the request
        names no type).
    base_level, spreading, partial_match, noise, total : ndarray, shape (n,), float64
        Terms of the activation, and their sum.
    threshold : float
        Activation that a chunk must reach; -inf where activation is not computed.
    winner : int or None
        Index of the most active candidate, whether or not it reaches the threshold.
    """

    names: NDArray[np.object_]
    base_level: NDArray[np.float64]
    spreading: NDArray[np.float64]
    partial_match: NDArray[np.float64]
    noise: NDArray[np.float64]
    total: NDArray[np.float64]
    threshold: float
    winner: int | None

    def __len__(self) -> int:
        return len(self.names)

    def row(self, index: int) -> CandidateRow:
        """Return the terms of one candidate."""
        return CandidateRow(
            str(self.names[index]),
            float(self.base_level[index]),
            float(self.spreading[index]),
            float(self.partial_match[index]),
            float(self.noise[index]),
            float(self.total[index]),
        )

    def rows(self) -> Iterator[CandidateRow]:
        """Yield each candidate in turn."""
        return map(self.row, range(len(self)))

    @property
    def by_context(self) -> NDArray[np.float64]:
        """What spreading and matching say for each candidate, its base level and noise aside."""
        return self.spreading + self.partial_match

    @property
    def threshold_by_context(self) -> float:
        """The threshold for `by_context`: as far above a candidate of mean odds as before."""
        if not len(self):
            return self.threshold
        mean = float(np.logaddexp.reduce(self.base_level)) - math.log(len(self))
        return self.threshold - mean

    @property
    def best(self) -> CandidateRow | None:
        """The most active candidate, whether or not it reaches the threshold."""
        return None if self.winner is None else self.row(self.winner)


def most_active(names: NDArray[np.object_], total: NDArray[np.float64]) -> int | None:
    """Find the index of the greatest total; of equal ones, the first by name, ignoring case.

    ACT-R with :er nil sorts by string<, and its names have no case.
    """
    if len(total) == 0:
        return None
    tied = np.flatnonzero(total == total.max())
    return int(min(tied, key=lambda index: (str(names[index]).upper(), str(names[index]))))


@dataclass(frozen=True, eq=False)
class Retrieval:
    """What a request brought.

    Attributes
    ----------
    chunk : Chunk or None
        The chunk retrieved; None for a failure.
    latency_s : float
        Time until it is there, or until the failure is known: whole milliseconds.
    activation : float
        Of the retrieved chunk; NaN for a failure.
    candidates : Candidates
        Every term of every candidate.
    """

    chunk: Chunk | None
    latency_s: float
    activation: float
    candidates: Candidates

    @property
    def share(self) -> float:
        """The share of what was recalled, or of nothing, in the odds of all candidates.

        Activation is the logarithm of the odds that a chunk is needed (Anderson 1990), and the
        threshold that of the odds that none of them is: so each has the share exp(A_i) of the sum,
        noise aside.
        """
        found = self.candidates
        return self.share_of(found.total - found.noise, found.threshold)

    def share_of(self, activations: NDArray[np.float64], threshold: float) -> float:
        """Return the same, were these the activations and this the threshold."""
        if not math.isfinite(threshold):  # activation is not reckoned
            return 1.0
        odds = np.append(activations, threshold)
        share = np.exp(odds - np.logaddexp.reduce(odds))
        chosen = -1 if self.chunk is None else self.candidates.winner
        return float(share[-1 if chosen is None else chosen])
