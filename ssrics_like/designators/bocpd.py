"""Change points online: Bayesian online change point detection."""

from __future__ import annotations

import math
from collections import deque
from typing import TYPE_CHECKING, Annotated, ClassVar

import numpy as np
from pydantic import Field
from scipy.special import logsumexp

from ssrics_like.designators.conjugate import NormalInverseGamma
from ssrics_like.designators.path import STEP_M
from ssrics_like.designators.peaks import Peaks, ScoredDesignator
from ssrics_like.designators.readings import SUMMARY, ReadingSettings, summary

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ssrics_like.designators.protocol import DesignatorSettings, Grid
    from ssrics_like.perception.observation import Observation

WINDOW_M = 0.25  # a change so far off counts no more for a place, one half as far off half


class RunLengths:
    """The distribution of the number of data since the last change.

    After a change data come from normal distributions with new means and variances, drawn
    from the prior; a change comes with the same probability before each datum.

    Parameters
    ----------
    prior : NormalInverseGamma
        One belief for each feature: arrays of shape (features,), or (1,) where all agree.
    hazard : float
        Probability of a change before a datum.
    longest : int
        Run lengths from here on count as one, with what was learned over the more probable
        of those that meet there: memory stays constant.

    Attributes
    ----------
    log_probability : ndarray, shape (lengths,)
        Element r: that the newest r data belong together, r = 0 being a change right
        after the newest datum; at most `longest` + 1 of them.

    References
    ----------
    Adams & MacKay (2007), "Bayesian online changepoint detection", arXiv:0710.3742,
    algorithm 1. Libraries were looked at: the one that is kept (changepoint) keeps every
    run length, which never stops growing.
    """

    def __init__(self, prior: NormalInverseGamma, hazard: float, longest: int) -> None:
        self._prior = NormalInverseGamma(*(element[None] for element in prior))
        self._beliefs = self._prior
        self._log_change = math.log(hazard)
        self._log_stay = math.log1p(-hazard)
        self._longest = longest
        self.log_probability: NDArray[np.float64] = np.zeros(1)

    def update(self, x: NDArray[np.float64]) -> None:
        """Take in one datum, shape (features,)."""
        seen = self.log_probability + self._beliefs.log_predictive(x).sum(axis=1)
        log = np.concatenate(
            [[logsumexp(seen) + self._log_change], seen + self._log_stay],
        )
        grown = self._beliefs.after(x)
        beliefs = NormalInverseGamma(
            *(np.concatenate(pair) for pair in zip(self._prior, grown, strict=True))
        )
        if log.size > self._longest + 1:
            likelier = self._longest + int(log[-1] >= log[-2])
            log[-2] = np.logaddexp(log[-2], log[-1])
            log = log[:-1]
            kept = [*range(self._longest), likelier]
            beliefs = NormalInverseGamma(*(element[kept] for element in beliefs))
        self._beliefs = beliefs
        self.log_probability = log - logsumexp(log)


class BocpdSettings(ReadingSettings):
    """Settings of `Bocpd`.

    Attributes
    ----------
    change_m : float
        Mean distance between changes, metres of path.
    scale : float
        Spread that is expected of a feature between changes, where 1 is that over a
        whole building.
    lag_m : float
        How long after a change it is judged, metres of path.
    threshold : float
        Least probability that the change came there, or near: see `Bocpd`.
    apart_m : float
        Least distance between two marks, metres of path.
    longest_m : float
        Longest stretch without a change that is told apart, metres of path.
    """

    change_m: Annotated[float, Field(gt=0.2, le=10_000.0)] = 5.0
    scale: Annotated[float, Field(gt=0.0, le=1000.0)] = 0.3
    lag_m: Annotated[float, Field(gt=0.2, le=0.7)] = 0.5
    threshold: Annotated[float, Field(gt=0.0, le=1.0)] = 0.5
    apart_m: Annotated[float, Field(gt=0.0, le=100.0)] = 1.5
    longest_m: Annotated[float, Field(gt=1.0, le=1000.0)] = 12.0


class Bocpd(ScoredDesignator):
    """Marks where few features of the scan most probably changed for good.

    Each 0.1 m of path gives one datum, the features of `readings.summary`, taken as
    independent. The strength is the posterior probability, `lag_m` later, that the run
    that is still going on began at the place; beginnings beside it count with weights that
    fall to 0 at 0.25 m.

    Parameters
    ----------
    settings : BocpdSettings
        The model of changes and the threshold.

    References
    ----------
    Adams & MacKay (2007), "Bayesian online changepoint detection", arXiv:0710.3742.
    Judging a change after a lag, and the features: ours.
    """

    Settings: ClassVar[type[DesignatorSettings]] = BocpdSettings
    GRID: ClassVar[Grid] = {
        "scale": (0.07, 0.15, 0.4),
        "lag_m": (0.5, 0.7),
        "threshold": (0.01, 0.03, 0.1, 0.3),
        "apart_m": (1.0, 2.0, 4.0),
    }
    source: ClassVar[str] = "Adams & MacKay 2007"

    def __init__(self, settings: BocpdSettings) -> None:
        super().__init__(Peaks(settings.threshold, settings.apart_m, settings.lag_m))
        self._settings = settings
        one = np.ones(len(SUMMARY))
        # Anywhere within the building is as likely for the mean; a spread of `scale` within.
        weight = settings.scale**2
        # Weight and shape count data, the same for each feature, so that one column will do.
        prior = NormalInverseGamma(0.0 * one, weight * one[:1], one[:1], weight * one)
        self._runs = RunLengths(
            prior, STEP_M / settings.change_m, round(settings.longest_m / STEP_M)
        )
        self._data: deque[tuple[float, int]] = deque(maxlen=round(2.0 / STEP_M))

    def place_and_score(
        self, at_m: float, observation: Observation
    ) -> tuple[float, float, int] | None:
        """Return the chance of a change at the place a lag back; see `ScoredDesignator`."""
        features = summary(observation.scan, self._settings)
        if features is None:
            return None
        self._runs.update(features)
        self._data.append((at_m, observation.index))
        # A run of r data began with the r-th datum from the end.
        began_m = np.array([datum[0] for datum in reversed(self._data)])
        place = int(np.abs(began_m - (at_m - self._settings.lag_m)).argmin())
        lengths = self._runs.log_probability.size
        if place + 2 >= lengths:  # nothing before the first datum to change from
            return None
        weights = np.maximum(1.0 - np.abs(began_m - began_m[place]) / WINDOW_M, 0.0)
        changed = np.exp(self._runs.log_probability[1 : lengths - 1][: weights.size])
        place_m, scan = self._data[-1 - place]
        return place_m, float(changed @ weights[: changed.size]), scan
