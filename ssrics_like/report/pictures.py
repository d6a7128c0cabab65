"""What a run leaves for drawing only: walls, novelty, histograms, activation."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class Outline:
    """Cells in which laser beams ended.

    Attributes
    ----------
    cell_m : float
        Side of a cell, metres.
    x, y : ndarray of int64, shape (cells,)
        Numbers of the cells; cell 0 begins at 0 m.
    """

    cell_m: float
    x: NDArray[np.int64]
    y: NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Novelty:
    """Novelty over time, in bins.

    Attributes
    ----------
    t_s : ndarray, shape (bins,)
        Seconds since the start of the run.
    mean, least, largest : ndarray, shape (bins,)
        Of 1 - tau within each bin.
    """

    t_s: NDArray[np.float64]
    mean: NDArray[np.float64]
    least: NDArray[np.float64]
    largest: NDArray[np.float64]


@dataclass(frozen=True)
class Histogram:
    """The correlations of one interval.

    Attributes
    ----------
    scan : int
        Index of the scan that completed the interval.
    tau : float
        Its boredom quotient.
    counts : tuple of int
        Pairs of scans in each bin.
    edges : tuple of float
        One more than `counts`; the last bin begins at the gradient.
    """

    scan: int
    tau: float
    counts: tuple[int, ...]
    edges: tuple[float, ...]


@dataclass(frozen=True, eq=False)
class Activation:
    """Base levels of landmark chunks over time.

    Attributes
    ----------
    t_s : ndarray, shape (moments,)
        Seconds since the start of the run.
    base_level : dict of str to ndarray, shape (moments,)
        NaN before the chunk was made.
    """

    t_s: NDArray[np.float64]
    base_level: dict[str, NDArray[np.float64]]


@dataclass(frozen=True, eq=False)
class Pictures:
    """What figures/run-NNN.json holds for drawing."""

    outline: Outline
    novelty: Novelty
    novel: Histogram | None
    bored: Histogram | None
    activation: Activation
