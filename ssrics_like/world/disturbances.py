"""What may happen in a building while the robot drives: doors, slip, a kidnap, people."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ssrics_like.perception.observation import Pose


@dataclass(frozen=True, eq=False)
class DoorChange:
    """A door closes or opens.

    Attributes
    ----------
    at_s : float
        When, seconds since the start. It waits while somebody stands in the doorway.
    leaf : ndarray, shape (rows, columns), bool
        The cells that the closed door fills.
    closed : bool
        What it becomes.
    """

    at_s: float
    leaf: NDArray[np.bool_]
    closed: bool


@dataclass(frozen=True)
class Kidnap:
    """Somebody carries the robot elsewhere; its odometry does not notice.

    Attributes
    ----------
    at_s : float
        When, seconds since the start.
    to : Pose
        Where it is put down, grid frame.
    """

    at_s: float
    to: Pose


@dataclass(frozen=True)
class Crowd:
    """People who walk about.

    Attributes
    ----------
    count : int
        How many.
    speed_m_s, radius_m : float
        Of each.
    """

    count: int = 0
    speed_m_s: float = 1.1
    radius_m: float = 0.22


@dataclass(frozen=True)
class SlipSettings:
    """Places where the wheels spin.

    Attributes
    ----------
    per_m : float
        How many such stretches begin in a metre driven without slip, on average.
    length_m : float
        How long each is, as the wheels count it.
    share : float
        Share of the wheels' way that is lost there.
    """

    per_m: float = 0.0
    length_m: float = 0.5
    share: float = 0.5


class Slip:
    """Wheel slip in stretches that begin at random.

    Parameters
    ----------
    settings : SlipSettings
        How often and how much.
    rng : numpy.random.Generator
        Where stretches begin.
    """

    def __init__(self, settings: SlipSettings, rng: np.random.Generator) -> None:
        self._settings = settings
        self._rng = rng
        self._next_m = self._gap()
        self._way_m = 0.0

    def advance(self, way_m: float) -> float:
        """Count a way and return the share of the next that will be lost."""
        self._way_m += abs(way_m)
        if self._way_m >= self._next_m + self._settings.length_m:
            self._next_m = self._way_m + self._gap()
        return self._settings.share if self._way_m >= self._next_m else 0.0

    def _gap(self) -> float:
        if not self._settings.per_m:
            return math.inf
        return float(self._rng.exponential(1.0 / self._settings.per_m))


@dataclass(frozen=True, eq=False)
class Disturbances:
    """All of them; the default is an undisturbed building."""

    doors: tuple[DoorChange, ...] = ()
    kidnaps: tuple[Kidnap, ...] = ()
    crowd: Crowd = Crowd()
    slip: SlipSettings = SlipSettings()
