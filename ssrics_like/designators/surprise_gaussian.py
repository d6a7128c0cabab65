"""Bayesian surprise about few features of the scan."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated, ClassVar

import numpy as np
from pydantic import Field

from ssrics_like.designators.conjugate import NormalInverseGamma
from ssrics_like.designators.path import STEP_M
from ssrics_like.designators.peaks import Peaks, ScoredDesignator
from ssrics_like.designators.readings import SUMMARY, ReadingSettings, summary

if TYPE_CHECKING:
    from ssrics_like.designators.protocol import DesignatorSettings, Grid
    from ssrics_like.perception.observation import Observation


class SurpriseGaussianSettings(ReadingSettings):
    """Settings of `SurpriseGaussian`.

    Attributes
    ----------
    forget_m : float
        Metres of path after which evidence has faded to 1 / e.
    scale : float
        Spread that is expected of a feature before any scan, where 1 is that over a
        whole building.
    threshold_nats : float
        Least surprise, the mean over features.
    apart_m : float
        Least distance between two marks, metres of path.
    """

    forget_m: Annotated[float, Field(gt=0.0, le=10_000.0)] = 1.0
    scale: Annotated[float, Field(gt=0.0, le=1000.0)] = 1.0
    threshold_nats: Annotated[float, Field(ge=0.0, le=10_000.0)] = 0.06
    apart_m: Annotated[float, Field(gt=0.0, le=100.0)] = 2.0


class SurpriseGaussian(ScoredDesignator):
    """Marks where few features of the scan surprise most.

    Each feature of `readings.summary` is believed to be normal with unknown mean and
    variance (normal-inverse-gamma). Each 0.1 m of path the beliefs fade, then take in the
    scan; surprise, the strength, is the divergence of the beliefs after from those before,
    averaged over the features, in nats.

    Parameters
    ----------
    settings : SurpriseGaussianSettings
        The belief and the threshold.

    References
    ----------
    Itti & Baldi (2009), "Bayesian surprise attracts human attention", Vision Research 49,
    for the measure; Murphy (2007), "Conjugate Bayesian analysis of the Gaussian
    distribution", for the belief. Features and fading of evidence: ours.
    """

    Settings: ClassVar[type[DesignatorSettings]] = SurpriseGaussianSettings
    GRID: ClassVar[Grid] = {
        "forget_m": (0.5, 1.0, 2.0),
        "threshold_nats": (0.03, 0.06, 0.12, 0.24),
        "apart_m": (0.5, 1.0, 2.0, 3.0),
    }
    source: ClassVar[str] = "Itti & Baldi 2009; Murphy 2007"

    def __init__(self, settings: SurpriseGaussianSettings) -> None:
        super().__init__(Peaks(settings.threshold_nats, settings.apart_m))
        self._settings = settings
        self._last_m = 0.0
        one = np.ones(len(SUMMARY))
        self._prior = NormalInverseGamma(0.0 * one, one, one, settings.scale**2 * one)
        self._belief: NormalInverseGamma | None = None

    def score(self, observation: Observation) -> float:
        """Return the surprise of a scan, nats; NaN for the first and for one without an answer."""
        features = summary(observation.scan, self._settings)
        if features is None:
            return math.nan
        if self._belief is None:
            # As if this had been seen all along, lest every beginning be a surprise.
            seen = 1.0 / (1.0 - math.exp(-STEP_M / self._settings.forget_m))
            self._belief = NormalInverseGamma(
                features,
                self._prior.weight + seen,
                self._prior.shape + 0.5 * seen,
                self._prior.scale,
            )
            self._last_m = self.at_m
            return math.nan
        keep = math.exp((self._last_m - self.at_m) / self._settings.forget_m)
        before = self._belief.faded(keep, self._prior)
        self._belief, self._last_m = before.after(features), self.at_m
        return float(self._belief.kl(before).mean())
