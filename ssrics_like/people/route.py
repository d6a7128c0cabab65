"""The route that most runs took, cut in bins."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.spatial import cKDTree

from ssrics_like.comparison.matching import points
from ssrics_like.comparison.way import Way

STEPS = 4
"""So many steps of the way are looked at for each bin."""
MOST = 0.5
"""A bin that a lesser share of the runs came by is a detour, and no part of the route."""


@dataclass(frozen=True, eq=False)
class Route:
    """Where marks can lie on the way, without places counted twice.

    Attributes
    ----------
    ways : tuple of Way
        The ways of the runs, each with a pose at least.
    radius_m : float
        How near is by, metres.
    bin_m : float
        Length of a bin, metres.
    """

    ways: tuple[Way, ...]
    radius_m: float
    bin_m: float

    @cached_property
    def bins_m(self) -> NDArray[np.float64]:
        """Middles of the bins that at least half of the runs came by, shape (bins, 2), metres.

        In the order in which the first run came by.
        """
        return self._every_bin[self._shared]

    @cached_property
    def dropped(self) -> int:
        """How many bins are left out, since fewer than half of the runs came by."""
        return int((~self._shared).sum())

    def most_came_by(self, places: ArrayLike) -> NDArray[np.bool_]:
        """Tell which places, shape (n, 2), at least half of the runs came by within the radius.

        Every place, where there is no run.
        """
        near = self._away_m(places) <= self.radius_m
        most: NDArray[np.bool_] = near.sum(axis=0) >= MOST * len(near)
        return most

    def any_came_by(self, places: ArrayLike) -> NDArray[np.bool_]:
        """Tell which places, shape (n, 2), some run came by within the radius."""
        if not self.ways:
            return np.zeros(len(points(places)), bool)
        away_m, _ = self._tree.query(points(places))
        return np.asarray(away_m <= self.radius_m)

    @cached_property
    def _every_bin(self) -> NDArray[np.float64]:
        """The ways are followed in turn; a bin begins a bin's length from all that are there."""
        middles = np.empty((0, 2))
        for way in self.ways:
            metres = np.arange(0.0, way.length_m + 1e-9, self.bin_m / STEPS)
            for place in way.at(metres):
                off = middles - place
                if (np.einsum("ij,ij->i", off, off) >= self.bin_m**2).all():
                    middles = np.vstack([middles, place])
        return middles

    @cached_property
    def _shared(self) -> NDArray[np.bool_]:
        return self.most_came_by(self._every_bin)

    @cached_property
    def _trees(self) -> tuple[cKDTree, ...]:
        return tuple(cKDTree(way.xy_m) for way in self.ways)

    @cached_property
    def _tree(self) -> cKDTree:
        return cKDTree(np.concatenate([way.xy_m for way in self.ways]))

    def _away_m(self, places: ArrayLike) -> NDArray[np.float64]:
        """Return how far each way passes from each place, shape (ways, n), metres."""
        at = points(places)
        rows = [tree.query(at)[0] for tree in self._trees]
        return np.array(rows, np.float64).reshape(len(rows), len(at))


def route_of(ways: Sequence[Way], bin_m: float, radius_m: float) -> Route:
    """Return the route of several runs.

    A stretch that is driven a second time, by the same run or another, lies in the bins that are
    there already.

    Parameters
    ----------
    ways : sequence of Way
        The ways of all runs; those without a pose say nothing.
    bin_m : float
        Length of a bin, metres.
    radius_m : float
        How near is by, metres.
    """
    return Route(tuple(way for way in ways if len(way.xy_m)), radius_m, bin_m)
