"""Bayesian surprise about the histogram of ranges."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated, ClassVar

import numpy as np
from pydantic import Field

from ssrics_like.designators.conjugate import dirichlet_kl
from ssrics_like.designators.path import STEP_M
from ssrics_like.designators.peaks import Peaks, ScoredDesignator
from ssrics_like.designators.readings import ReadingSettings, read

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ssrics_like.designators.protocol import DesignatorSettings, Grid
    from ssrics_like.perception.observation import LaserScan, Observation

PRIOR = 0.5  # Jeffreys' prior for each bin


class SurpriseHistogramSettings(ReadingSettings):
    """Settings of `SurpriseHistogram`.

    Attributes
    ----------
    bins : int
        Bins of range of equal width below the cap; there is one more for what reaches it.
    evidence : float
        What one scan counts for, in independent beams: neighbouring beams tell the same.
    forget_m : float
        Metres of path after which evidence has faded to 1 / e.
    threshold_nats : float
        Least surprise.
    apart_m : float
        Least distance between two marks, metres of path.
    """

    bins: Annotated[int, Field(ge=2, le=1000)] = 16
    evidence: Annotated[float, Field(gt=0.0, le=10_000.0)] = 20.0
    forget_m: Annotated[float, Field(gt=0.0, le=10_000.0)] = 2.0
    threshold_nats: Annotated[float, Field(ge=0.0, le=10_000.0)] = 0.7
    apart_m: Annotated[float, Field(gt=0.0, le=100.0)] = 2.0


class SurpriseHistogram(ScoredDesignator):
    """Marks where the histogram of ranges surprises most.

    The belief is a Dirichlet distribution over the shares of beams in bins of range. Each
    0.1 m of path it fades, then takes in the scan; surprise, the strength, is the
    divergence of the belief after from the belief before, in nats. A histogram does not
    change when the robot merely turns, as far as the field of view shows the same.

    Parameters
    ----------
    settings : SurpriseHistogramSettings
        The histogram and the threshold.

    References
    ----------
    Itti & Baldi (2009), "Bayesian surprise attracts human attention", Vision Research 49.
    Landmarks by surprise: Ranganathan & Dellaert (2009), "Bayesian surprise and landmark
    detection", ICRA, whose model of the senses is another. Fading of evidence: ours.
    """

    Settings: ClassVar[type[DesignatorSettings]] = SurpriseHistogramSettings
    GRID: ClassVar[Grid] = {
        "forget_m": (1.0, 2.0, 4.0),
        "threshold_nats": (0.35, 0.7, 1.2, 2.0),
        "apart_m": (0.5, 1.0, 2.0, 3.0),
    }
    source: ClassVar[str] = "Itti & Baldi 2009; Ranganathan & Dellaert 2009"

    def __init__(self, settings: SurpriseHistogramSettings) -> None:
        super().__init__(Peaks(settings.threshold_nats, settings.apart_m))
        self._settings = settings
        # The last edge is the cap, so that what reaches it has a bin of its own.
        self._edges = np.linspace(0.0, settings.range_cap_m, settings.bins + 1)[1:]
        self._last_m = 0.0
        self._belief: NDArray[np.float64] | None = None

    def score(self, observation: Observation) -> float:
        """Return the surprise of a scan, nats; NaN for the first and for one without an answer."""
        counts = self._counts(observation.scan)
        if counts is None:
            return math.nan
        if self._belief is None:
            # As if this had been seen all along, lest every beginning be a surprise.
            all_along = 1.0 - math.exp(-STEP_M / self._settings.forget_m)
            self._belief, self._last_m = PRIOR + counts / all_along, self.at_m
            return math.nan
        keep = math.exp((self._last_m - self.at_m) / self._settings.forget_m)
        before = PRIOR + keep * (self._belief - PRIOR)
        self._belief, self._last_m = before + counts, self.at_m
        return dirichlet_kl(self._belief, before)

    def _counts(self, scan: LaserScan) -> NDArray[np.float64] | None:
        ranges = read(scan, self._settings).ranges_m
        if ranges.size == 0:
            return None
        bins = np.searchsorted(self._edges, ranges, "right")
        counts = np.bincount(bins, minlength=self._settings.bins + 1).astype(np.float64)
        return counts * (self._settings.evidence / ranges.size)
