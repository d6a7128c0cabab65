"""Change points in hindsight: kernel change point detection over the whole drive."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, ClassVar

import numpy as np
from pydantic import Field

from ssrics_like.designators.optional import optional
from ssrics_like.designators.path import Steps
from ssrics_like.designators.protocol import Mark
from ssrics_like.designators.readings import ReadingSettings, summary

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ssrics_like.designators.protocol import DesignatorSettings, Grid
    from ssrics_like.perception.observation import Observation

COMPARED = 50  # data on each side of a change that give its strength


_CONSTANT = 1e-9  # a feature that varies less varies by rounding alone


class ChangePointsSettings(ReadingSettings):
    """Settings of `ChangePoints`.

    Attributes
    ----------
    step_m : float
        Metres of path between the scans that are looked at.
    penalty : float
        What a change costs; a step whose features are unlike those about it costs at most 1.
    width : float
        Difference between the features of two scans, in standard deviations over the
        drive, at which their likeness has fallen to 1 / e.
    apart_m : float
        Least distance between two marks, metres of path.
    """

    step_m: Annotated[float, Field(gt=0.0, le=100.0)] = 0.2
    penalty: Annotated[float, Field(gt=0.0, le=10_000.0)] = 2.0
    width: Annotated[float, Field(gt=0.0, le=1000.0)] = 1.0
    apart_m: Annotated[float, Field(gt=0.0, le=100.0)] = 1.0


class ChangePoints:
    """Marks where the features of scans change, as judged when the drive is over.

    The features of `readings.summary`, one datum each `step_m` of path, are cut so that
    data of one piece are alike by a Gaussian kernel. All data are kept until `flush`, and
    every mark is decided at the last scan. The strength is how unlike the pieces on both
    sides are: the squared distance of their means in the kernel's space, 0 to 2, over at
    most 50 data each.

    Parameters
    ----------
    settings : ChangePointsSettings
        The kernel and the penalty.

    References
    ----------
    Arlot, Celisse & Harchaoui (2019), "A kernel multiple change-point algorithm via model
    selection", JMLR 20; as in ruptures: Truong, Oudre & Vayatis (2020), "Selective review
    of offline change point detection methods", Signal Processing 167.
    """

    Settings: ClassVar[type[DesignatorSettings]] = ChangePointsSettings
    GRID: ClassVar[Grid] = {
        "penalty": (1.0, 2.0, 4.0, 8.0, 16.0),
        "width": (0.5, 1.0, 2.0),
        "apart_m": (2.0, 4.0, 8.0),
    }
    hindsight: ClassVar[bool] = True
    source: ClassVar[str] = "Arlot, Celisse & Harchaoui 2019; Truong, Oudre & Vayatis 2020"

    def __init__(self, settings: ChangePointsSettings) -> None:
        self._ruptures = optional("ruptures", "ruptures", "change-points")
        self._settings = settings
        self._steps = Steps(settings.step_m)
        self._scans: list[int] = []
        self._features: list[NDArray[np.float64]] = []
        self._newest = 0

    def update(self, observation: Observation) -> list[Mark]:
        """Take the next observation and return nothing: the drive must be over first.

        Raises
        ------
        ScanError
            The scan has no beams.
        """
        self._newest = observation.index
        if self._steps.update(observation.pose) is not None:
            features = summary(observation.scan, self._settings)
            if features is not None:
                self._scans.append(observation.index)
                self._features.append(features)
        return []

    def flush(self) -> list[Mark]:
        """Return all marks of the drive, in order."""
        shortest = max(round(self._settings.apart_m / self._settings.step_m), 1)
        if len(self._features) < 2 * shortest:
            return []
        data = np.array(self._features)
        spread = data.std(axis=0)
        data = (data - data.mean(axis=0)) / np.where(spread > _CONSTANT, spread, 1.0)
        data /= self._settings.width * np.sqrt(data.shape[1])
        search = self._ruptures.KernelCPD(kernel="rbf", params={"gamma": 1.0}, min_size=shortest)
        cuts = [0, *search.fit(data).predict(pen=self._settings.penalty)]
        marks = []
        for before, cut, after in zip(cuts[:-2], cuts[1:-1], cuts[2:], strict=True):
            one = data[max(before, cut - COMPARED) : cut]
            other = data[cut : min(after, cut + COMPARED)]
            marks.append(Mark(self._scans[cut], self._newest, _unlike(one, other)))
        return marks


def _unlike(one: NDArray[np.float64], other: NDArray[np.float64]) -> float:
    """Return the squared distance of two samples' means in the space of the kernel."""

    def alike(a: NDArray[np.float64], b: NDArray[np.float64]) -> float:
        squares = ((a[:, None] - b[None]) ** 2).sum(axis=2)
        return float(np.exp(-squares).mean())

    return alike(one, one) + alike(other, other) - 2.0 * alike(one, other)
