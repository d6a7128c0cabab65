"""The histogram of an interval's correlations, as in the report's figures 1 and 2."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.errors import SettingsError
from ssrics_like.perception.checks import require_fraction
from ssrics_like.perception.novelty import REPORT_GRADIENT

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

REPORT_BINS = 10  # report, section 2.2: "bins of 10 equally spaced intervals"


def correlation_histogram(
    correlations: ArrayLike, gradient: float = REPORT_GRADIENT, bins: int = REPORT_BINS
) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Count an interval's correlations in equal bins, the last of which is the bored one.

    The report says of its figure 1 that the last bar holds the pairs "at or
    higher than the gradient"; the figures' axis cannot be read. Our reading
    keeps both statements: bins as wide as 1 - gradient that end at 1, so that
    the last runs from the gradient to 1. Every lower correlation falls into the
    first bar.

    Parameters
    ----------
    correlations : array_like
        Pearson correlations, as `NoveltyDetector.correlations` gives them.
    gradient : float
        Lower edge of the last bin, 0 < gradient < 1.
    bins : int
        Number of bins, 2 or more.

    Returns
    -------
    counts : ndarray of int64, shape (bins,)
    edges : ndarray of float64, shape (bins + 1,)
        Rising; edges[-2] is the gradient and edges[-1] is 1.

    References
    ----------
    Report, section 2.2, figures 1 and 2.
    """
    gradient = require_fraction("gradient", gradient)
    if bins < 2:  # noqa: PLR2004  (one for the bored pairs, one for the others)
        raise SettingsError(f"bins is {bins!r}; expected 2 or more")
    edges = 1.0 - (1.0 - gradient) * np.arange(bins, -1, -1)
    edges[-2] = gradient
    counts, _ = np.histogram(np.clip(correlations, edges[0], 1.0), edges)
    return counts.astype(np.int64), edges.astype(np.float64)
