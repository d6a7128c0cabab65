"""Activation noise."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

LEAST_PROBABILITY = 1e-4  # ACT-R 7, act-r-noise: p is kept within [0.0001, 0.9999]


def activation_noise(rng: np.random.Generator, scale: float, count: int) -> NDArray[np.float64]:
    """Draw logistic noise with mean 0 for `count` candidates.

    ``s ln((1 - p) / p)`` with p uniform, kept within [1e-4, 1 - 1e-4] as ACT-R does, so
    that no draw exceeds ``9.21 s``.

    Parameters
    ----------
    rng : numpy.random.Generator
        Where the randomness comes from; one number is drawn for each candidate.
    scale : float
        s; the variance is ``pi^2 s^2 / 3``, less 0.3 % for the clipping.
    count : int
        How many values to draw.

    Returns
    -------
    ndarray, shape (count,)

    References
    ----------
    Bothell, ACT-R 7.27+ Reference Manual, "Noise"; reference implementation act-r-noise.
    """
    probability = np.clip(rng.random(count), LEAST_PROBABILITY, 1 - LEAST_PROBABILITY)
    return np.asarray(scale * np.log((1 - probability) / probability))
