"""Table 1 of any experiment: who marked each location, people and the runs of each model."""

from __future__ import annotations

from dataclasses import dataclass

from ssrics_like.comparison.proportions import share, wilson
from ssrics_like.world.locations import Location


@dataclass(frozen=True, slots=True)
class Share:
    """How many of a group marked a location.

    Attributes
    ----------
    location : Location
        The place.
    group : str
        People, or a model.
    markers, marked : int
        How many there are of the group, and how many of them marked it.
    """

    location: Location
    group: str
    markers: int
    marked: int

    @property
    def share(self) -> float:
        """Share of the group that marked it; NaN without anybody."""
        return share(self.marked, self.markers)

    @property
    def interval(self) -> tuple[float, float]:
        """Wilson 95 % interval of the share."""
        return wilson(self.marked, self.markers)
