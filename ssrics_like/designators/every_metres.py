"""A mark every so many metres: what any designator has to beat."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, ClassVar

from pydantic import Field

from ssrics_like.designators.path import Odometer
from ssrics_like.designators.protocol import DesignatorSettings, Grid, Mark

if TYPE_CHECKING:
    from ssrics_like.perception.observation import Observation

_ROUNDING = 1e-9


class EveryMetresSettings(DesignatorSettings):
    """Settings of `EveryMetres`.

    Attributes
    ----------
    every_m : float
        Metres of path between marks.
    """

    every_m: Annotated[float, Field(gt=0.0, le=10_000.0)] = 5.0


class EveryMetres:
    """Marks the first scan at or past each multiple of a length of path.

    It looks at every scan, and at the path alone. The strength is the multiple's number.

    Parameters
    ----------
    settings : EveryMetresSettings
        The length.

    References
    ----------
    A control of our own. Evenly spaced marks find more places than as many at random
    (docs/scoring.md), so a rule that only keeps time does as well as this.
    """

    Settings: ClassVar[type[DesignatorSettings]] = EveryMetresSettings
    GRID: ClassVar[Grid] = {"every_m": (0.5, 1.0, 1.5, 2.0, 3.0, 5.0, 8.0, 12.0)}
    hindsight: ClassVar[bool] = False
    source: ClassVar[str] = "a control of our own"

    def __init__(self, settings: EveryMetresSettings) -> None:
        self._every_m = settings.every_m
        self._odometer = Odometer()
        self._passed = 0

    def update(self, observation: Observation) -> list[Mark]:
        """Take the next observation; see `Designator`."""
        travelled_m = self._odometer.update(observation.pose)
        passed = int(travelled_m / self._every_m + _ROUNDING)
        if passed == self._passed:
            return []
        self._passed = passed
        return [Mark(observation.index, observation.index, float(passed))]

    def flush(self) -> list[Mark]:
        """Return nothing: no mark is kept back."""
        return []
