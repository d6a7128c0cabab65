"""A building: its floor plan, and the places on it that somebody named."""

from __future__ import annotations

from dataclasses import dataclass

from ssrics_like.world.grid import GridMap
from ssrics_like.world.locations import Location


@dataclass(frozen=True, eq=False)
class Building:
    """A building to drive through.

    Attributes
    ----------
    title : str
        What it is.
    grid : GridMap
        Its floor plan.
    locations : tuple of Location
        Labelled places, in the frame of the map; may be empty.
    """

    title: str
    grid: GridMap
    locations: tuple[Location, ...] = ()
