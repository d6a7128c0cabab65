"""What can be marked: each location on the route, and each bin of the rest of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.spatial import cKDTree
from scipy.spatial.distance import cdist

from ssrics_like.comparison.matching import NONE, points
from ssrics_like.people.markers import Marker
from ssrics_like.people.route import Route
from ssrics_like.world.locations import Location


@dataclass(frozen=True, eq=False)
class Units:
    """What can be marked.

    Two people who mean the same doorway seldom click on the same metre. Therefore the bins of the
    route within the radius of a location are joined to it: the location is one unit, and every
    bin that is left is another.

    Attributes
    ----------
    locations : tuple of Location
        All of them.
    route : Route
        The route. Without any way every location is a unit, and there are no bins.
    """

    locations: tuple[Location, ...]
    route: Route

    @cached_property
    def on_route(self) -> NDArray[np.bool_]:
        """Which locations most runs came by within the radius; only these are units."""
        return self.route.most_came_by(self._places)

    @cached_property
    def bins_m(self) -> NDArray[np.float64]:
        """Middles of the bins that belong to no location, shape (bins, 2), metres."""
        bins = self.route.bins_m
        away_m = cdist(bins, self._places)
        free: NDArray[np.float64] = bins[(away_m > self.route.radius_m).all(axis=1)]
        return free

    @cached_property
    def location_of(self) -> NDArray[np.int64]:
        """Index of the location that each of the first units is."""
        return np.flatnonzero(self.on_route)

    @cached_property
    def names(self) -> tuple[str, ...]:
        """What each unit is called: the id of its location, or ``bin N``."""
        ids = tuple(self.locations[i].id for i in self.location_of.tolist())
        return ids + tuple(f"bin {number}" for number in range(1, len(self.bins_m) + 1))

    def __len__(self) -> int:
        return len(self.location_of) + len(self.bins_m)

    def locations_of(self, marks: ArrayLike) -> NDArray[np.int64]:
        """Return the nearest location within the radius of each mark, shape (n,); else -1."""
        return _nearest(points(marks), self._places, self.route.radius_m)

    def of(self, marks: ArrayLike) -> NDArray[np.int64]:
        """Return the unit that each mark falls on.

        Parameters
        ----------
        marks : array_like, shape (n, 2)
            Metres.

        Returns
        -------
        ndarray of int64, shape (n,)
            The nearest location within the radius; else, if a run came by within the radius, the
            nearest bin within the radius or a bin's length, whichever is more; else -1: the mark
            lies off the route.
        """
        places = points(marks)
        at = self.locations_of(places)
        unit = np.full(len(self.locations) + 1, NONE, np.int64)  # the last stands for none
        unit[self.location_of] = np.arange(len(self.location_of))
        fell = unit[at]
        reach_m = max(self.route.radius_m, self.route.bin_m)
        bins = _nearest(places, self.bins_m, reach_m)
        free = (at == NONE) & (bins != NONE) & self.route.any_came_by(places)
        fell[free] = len(self.location_of) + bins[free]
        return fell

    def marked(self, markers: Sequence[Marker]) -> NDArray[np.bool_]:
        """Tell who marked which unit, shape (markers, units); once is as good as twice."""
        return _table([self.of(marker.xy_m) for marker in markers], len(self))

    def marked_locations(self, markers: Sequence[Marker]) -> NDArray[np.bool_]:
        """Tell who marked which location, on the route or not, shape (markers, locations)."""
        fell = [self.locations_of(marker.xy_m) for marker in markers]
        return _table(fell, len(self.locations))

    @cached_property
    def _places(self) -> NDArray[np.float64]:
        return points([(place.x_m, place.y_m) for place in self.locations])


def _table(fell: Sequence[NDArray[np.int64]], columns: int) -> NDArray[np.bool_]:
    table = np.zeros((len(fell), columns), bool)
    for row, at in zip(table, fell, strict=True):
        row[at[at != NONE]] = True
    return table


def _nearest(
    marks: NDArray[np.float64], places: NDArray[np.float64], radius_m: float
) -> NDArray[np.int64]:
    """Return the nearest place within the radius of each mark; -1 where there is none."""
    if len(places) == 0:
        return np.full(len(marks), NONE, np.int64)
    away_m, nearest = cKDTree(places).query(marks)
    return np.where(away_m <= radius_m, nearest, NONE).astype(np.int64)
