"""The compiled inner loop of boosted trees."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ssrics_like.compiling import compiled

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


@compiled
def raw_score(
    roots: NDArray[np.int32],
    feature: NDArray[np.int32],
    threshold: NDArray[np.float64],
    left: NDArray[np.int32],
    right: NDArray[np.int32],
    value: NDArray[np.float64],
    measures: NDArray[np.float64],
) -> float:
    """Return the sum of the leaves that measures, shape (features,), end in."""
    total = 0.0
    for tree in range(roots.shape[0]):
        node = roots[tree]
        while feature[node] >= 0:
            node = left[node] if measures[feature[node]] <= threshold[node] else right[node]
        total += value[node]
    return total
