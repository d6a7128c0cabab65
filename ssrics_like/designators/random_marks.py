"""Marks at random along the path: what chance alone reaches."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, ClassVar

import numpy as np
from pydantic import Field

from ssrics_like.designators.path import Odometer
from ssrics_like.designators.protocol import DesignatorSettings, Grid, Mark

if TYPE_CHECKING:
    from ssrics_like.perception.observation import Observation


class RandomMarksSettings(DesignatorSettings):
    """Settings of `RandomMarks`.

    Attributes
    ----------
    per_100_m : float
        Mean number of marks on 100 m of path.
    seed : int
        Of the places.
    """

    per_100_m: Annotated[float, Field(gt=0.0, le=100_000.0)] = 20.0
    seed: Annotated[int, Field(ge=0)] = 0


class RandomMarks:
    """Marks places of a Poisson process along the path.

    It looks at every scan, and at the path alone. Of several places between two scans one
    mark comes. The strength is 0.

    Parameters
    ----------
    settings : RandomMarksSettings
        Rate and seed.

    References
    ----------
    A control of our own. That gaps of a Poisson process are exponential: Kingman (1993),
    "Poisson Processes", chapter 4.
    """

    Settings: ClassVar[type[DesignatorSettings]] = RandomMarksSettings
    GRID: ClassVar[Grid] = {"per_100_m": (5.0, 10.0, 20.0, 40.0, 80.0, 160.0)}
    hindsight: ClassVar[bool] = False
    source: ClassVar[str] = "a control of our own"

    def __init__(self, settings: RandomMarksSettings) -> None:
        self._mean_gap_m = 100.0 / settings.per_100_m
        self._generator = np.random.default_rng(settings.seed)
        self._odometer = Odometer()
        self._next_m = self._gap_m()

    def update(self, observation: Observation) -> list[Mark]:
        """Take the next observation; see `Designator`."""
        travelled_m = self._odometer.update(observation.pose)
        if travelled_m < self._next_m:
            return []
        while self._next_m <= travelled_m:
            self._next_m += self._gap_m()
        return [Mark(observation.index, observation.index, 0.0)]

    def flush(self) -> list[Mark]:
        """Return nothing: no mark is kept back."""
        return []

    def _gap_m(self) -> float:
        return self._generator.exponential(self._mean_gap_m)
