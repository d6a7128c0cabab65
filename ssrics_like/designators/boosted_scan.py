"""Gradient boosting on geometric features of a single scan."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike
from pydantic import ConfigDict, Field

from ssrics_like.designators.optional import one_thread, optional
from ssrics_like.designators.peaks import Peaks, ScoredDesignator
from ssrics_like.designators.protocol import DesignatorSettings
from ssrics_like.designators.readings import ReadingSettings
from ssrics_like.designators.scan_features import scan_features
from ssrics_like.errors import SettingsError
from ssrics_like.perception.observation import LaserScan

if TYPE_CHECKING:
    from ssrics_like.designators.protocol import Grid
    from ssrics_like.perception.observation import Observation

TREES, LEAVES, RATE = 120, 15, 0.1


@dataclass(frozen=True, eq=False)
class ScanModel:
    """A trained classifier of single scans.

    Attributes
    ----------
    classifier : sklearn.ensemble.HistGradientBoostingClassifier
        Fitted to the features of `scan_features`.
    readings : ReadingSettings
        How scans were conditioned for training, and are.
    """

    classifier: Any
    readings: ReadingSettings

    def probability(self, scan: LaserScan) -> float:
        """Return the probability that a scan was taken at a place; NaN without any answer.

        Raises
        ------
        ScanError
            The scan has no beams.
        """
        features = scan_features(scan, self.readings)
        if features is None:
            return math.nan
        with one_thread():
            return float(self.classifier.predict_proba(features[None])[0, 1])


def train(
    scans: Sequence[LaserScan],
    labels: ArrayLike,
    seed: int,
    readings: ReadingSettings | None = None,
) -> ScanModel:
    """Train a classifier of single scans.

    The rarer class weighs as much as the other in all. A scan without any answer is left
    out.

    Parameters
    ----------
    scans : sequence of LaserScan
        Of any geometry; best of the laser that the model is for.
    labels : array_like of bool, shape (scans,)
        Whether each was taken at a place to be marked.
    seed : int
        Of the training. The same scans, labels and seed give the same model.
    readings : ReadingSettings, optional
        The cap and the repair of dropouts.

    Raises
    ------
    SettingsError
        There is not one label a scan, or all are alike.
    MissingPackageError
        scikit-learn is not installed.
    ScanError
        A scan has no beams.

    References
    ----------
    Friedman (2001), "Greedy function approximation: a gradient boosting machine", Annals of
    Statistics 29; by scikit-learn's histograms.
    """
    ensemble = optional("sklearn.ensemble", "scikit-learn", "boosted-scan")
    readings = readings or ReadingSettings()
    wanted = np.asarray(labels, bool)
    if wanted.shape != (len(scans),):
        raise SettingsError(
            f"labels have shape {wanted.shape}; expected one for each of {len(scans)}"
        )
    rows = [scan_features(scan, readings) for scan in scans]
    kept = np.array([row is not None for row in rows], bool)
    wanted = wanted[kept]
    if wanted.all() or not wanted.any():
        raise SettingsError("labels are all alike; expected scans at places and scans elsewhere")
    classifier = ensemble.HistGradientBoostingClassifier(
        learning_rate=RATE,
        max_iter=TREES,
        max_leaf_nodes=LEAVES,
        early_stopping=False,
        class_weight="balanced",
        random_state=seed,
    )
    with one_thread():
        classifier.fit(np.array([row for row in rows if row is not None]), wanted)
    return ScanModel(classifier, readings)


class BoostedScanSettings(DesignatorSettings):
    """Settings of `BoostedScan`.

    Attributes
    ----------
    model : ScanModel
        What `train` returned; it says how scans are read, too.
    threshold : float
        Least probability.
    apart_m : float
        Least distance between two marks, metres of path.
    """

    model_config = ConfigDict(arbitrary_types_allowed=True)

    model: ScanModel
    threshold: Annotated[float, Field(gt=0.0, le=1.0)] = 0.5
    apart_m: Annotated[float, Field(gt=0.0, le=100.0)] = 1.5


class BoostedScan(ScoredDesignator):
    """Marks where a trained classifier finds a scan most like those at the places wanted.

    It looks at every 0.1 m of path. The strength is the probability that the classifier
    gives; classes weigh the same in training, so that it is too high where places are rare.

    Parameters
    ----------
    settings : BoostedScanSettings
        The model and the threshold.

    References
    ----------
    Martinez Mozos, Stachniss & Burgard (2005), "Supervised learning of places from range
    data using AdaBoost", ICRA, for the features; see `scan_features` for what is left out.
    They boost decision stumps by AdaBoost; here it is trees by gradient boosting, Friedman
    (2001). Marking the peaks of the probability: ours.
    """

    Settings: ClassVar[type[DesignatorSettings]] = BoostedScanSettings
    GRID: ClassVar[Grid] = {
        "threshold": (0.5, 0.7, 0.9, 0.95, 0.98),
        "apart_m": (0.1, 0.25, 0.5, 1.0, 2.0),
    }
    source: ClassVar[str] = "Martinez Mozos, Stachniss & Burgard 2005; Friedman 2001"

    def __init__(self, settings: BoostedScanSettings) -> None:
        super().__init__(Peaks(settings.threshold, settings.apart_m))
        self._model = settings.model

    def score(self, observation: Observation) -> float:
        """Return the classifier's probability for a scan; NaN for one without an answer."""
        return self._model.probability(observation.scan)
