"""Boosted trees: a learned classifier as plain arrays.

Training is elsewhere; here a sum of small decision trees is turned into a probability, in the same
way whatever library grew them.

References
----------
Friedman (2001), "Greedy function approximation: a gradient boosting machine".
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.perception.tree_kernels import raw_score

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray


@dataclass(frozen=True, eq=False)
class BoostedTrees:
    """A sum of decision trees.

    All trees' nodes stand in one table. At a node whose `feature` is -1 a tree ends.

    Attributes
    ----------
    baseline : float
        Log odds before any tree.
    roots : ndarray, shape (trees,), int32
        Row of each tree's first node.
    feature : ndarray, shape (nodes,), int32
        Which measure a node asks for.
    threshold : ndarray, shape (nodes,), float64
        At most this goes to the left.
    left, right : ndarray, shape (nodes,), int32
        Row of the next node.
    value : ndarray, shape (nodes,), float64
        What a leaf adds to the log odds.
    """

    baseline: float
    roots: NDArray[np.int32]
    feature: NDArray[np.int32]
    threshold: NDArray[np.float64]
    left: NDArray[np.int32]
    right: NDArray[np.int32]
    value: NDArray[np.float64]

    def probability(self, measures: ArrayLike) -> float:
        """Return the probability that measures, shape (features,), belong to the class sought."""
        score = raw_score(
            self.roots, self.feature, self.threshold, self.left, self.right, self.value,
            np.asarray(measures, np.float64),
        )  # fmt: skip
        odds = self.baseline + score
        if odds < 0.0:  # so that nothing overflows
            return math.exp(odds) / (1.0 + math.exp(odds))
        return 1.0 / (1.0 + math.exp(-odds))
