"""Marks where the robot turns."""

from __future__ import annotations

import math
from collections import deque
from typing import TYPE_CHECKING, Annotated, ClassVar

from pydantic import Field

from ssrics_like.designators.peaks import Peaks, ScoredDesignator
from ssrics_like.designators.protocol import DesignatorSettings, Grid

if TYPE_CHECKING:
    from ssrics_like.designators.protocol import Mark
    from ssrics_like.perception.observation import Observation


class TurningSettings(DesignatorSettings):
    """Settings of `Turning`.

    Attributes
    ----------
    window_m : float
        Metres of path over which the turn is taken, the place in its middle.
    threshold_rad : float
        Least change of heading over the window, as weighted.
    apart_m : float
        Least distance between two marks, metres of path.
    """

    window_m: Annotated[float, Field(gt=0.0, le=1.2)] = 1.0
    threshold_rad: Annotated[float, Field(gt=0.0, le=10.0)] = 0.6
    apart_m: Annotated[float, Field(gt=0.0, le=100.0)] = 1.0


class Turning(ScoredDesignator):
    """Marks the places where the heading changes most over a window of path.

    It looks at every 0.1 m of path and reads no scan. The strength is the change of heading
    over the window, radians, with weights that fall from 1 at the place to 0 at the
    window's ends: a turn on the spot counts whole there, and less beside.

    Parameters
    ----------
    settings : TurningSettings
        The window and the threshold.

    References
    ----------
    Michon & Denis (2001), "When and why are visual landmarks used in giving directions?",
    COSIT 2001: landmarks are named where the route turns.
    """

    Settings: ClassVar[type[DesignatorSettings]] = TurningSettings
    GRID: ClassVar[Grid] = {
        "window_m": (0.6, 1.0, 1.2),
        "threshold_rad": (0.15, 0.3, 0.6, 1.0, 1.4),
        "apart_m": (0.5, 1.0, 2.0, 4.0),
    }
    source: ClassVar[str] = "Michon & Denis 2001"

    def __init__(self, settings: TurningSettings) -> None:
        self._half_m = 0.5 * settings.window_m
        super().__init__(Peaks(settings.threshold_rad, settings.apart_m, self._half_m))
        self._window: deque[tuple[float, float, int]] = deque()  # metres, turn up to there, scan
        self._last_rad = math.nan
        self._turned_rad = 0.0

    def update(self, observation: Observation) -> list[Mark]:
        """Take the next observation; see `Designator`."""
        theta_rad = observation.pose.theta_rad
        if math.isfinite(theta_rad):
            # Added up scan by scan, a full turn on the spot is not nothing.
            if not math.isnan(self._last_rad):
                self._turned_rad += math.remainder(theta_rad - self._last_rad, math.tau)
            self._last_rad = theta_rad
        return super().update(observation)

    def place_and_score(
        self, at_m: float, observation: Observation
    ) -> tuple[float, float, int] | None:
        """Return the turn about the place half a window back; see `ScoredDesignator`."""
        window, half_m = self._window, self._half_m
        window.append((at_m, self._turned_rad, observation.index))
        self._turned_rad = 0.0
        place_m, _, scan = min(window, key=lambda step: abs(step[0] - (at_m - half_m)))
        while window[0][0] <= place_m - half_m:
            window.popleft()
        turn_rad = sum(turn * max(1.0 - abs(m - place_m) / half_m, 0.0) for m, turn, _ in window)
        return place_m, abs(turn_rad), scan
