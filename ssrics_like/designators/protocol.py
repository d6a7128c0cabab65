"""What a designator is: observations in, marks out."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import ClassVar, Protocol

from pydantic import BaseModel, ConfigDict

from ssrics_like.perception.observation import Observation


@dataclass(frozen=True, slots=True)
class Mark:
    """A place that was designated.

    Attributes
    ----------
    scan : int
        Index of the observation of the place.
    decided_scan : int
        Index of the observation at which that was decided; not before `scan`.
    strength : float
        How sure, in the designator's own units; more is surer.
    """

    scan: int
    decided_scan: int
    strength: float


class Designator(Protocol):
    """Marks places on one drive; the next drive takes a new one."""

    def update(self, observation: Observation) -> list[Mark]:
        """Take the next observation; return the marks that it decides, mostly none."""

    def flush(self) -> list[Mark]:
        """End the drive; return the marks that were kept back."""


class DesignatorSettings(BaseModel):
    """Base of every designator's settings: frozen, unknown keys rejected."""

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True, allow_inf_nan=False)


Grid = dict[str, tuple[object, ...]]
"""Name of a setting -> the values that tuning tries."""


class DesignatorKind(Protocol):
    """What the registry keeps: a class that makes designators from settings.

    Attributes
    ----------
    Settings : type
        Model of its settings.
    GRID : Grid
        What tuning tries, every value of a setting with every value of the others.
    hindsight : bool
        Whether it sees the whole drive before it decides. Such a one cannot run on a robot.
    source : str
        Short citation.
    """

    Settings: ClassVar[type[DesignatorSettings]]
    GRID: ClassVar[Grid]
    hindsight: ClassVar[bool]
    source: ClassVar[str]

    def __call__(self, settings: DesignatorSettings) -> Designator:
        """Return a designator for one drive."""


def designate(designator: Designator, observations: Iterable[Observation]) -> list[Mark]:
    """Return all marks of one drive, in order of their decision.

    Parameters
    ----------
    designator : Designator
        A new one.
    observations : iterable of Observation
        The drive, in order.
    """
    marks = [mark for observation in observations for mark in designator.update(observation)]
    return marks + designator.flush()
