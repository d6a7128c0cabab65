"""Locations found from the marks of people, where nobody labelled any."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.cluster.hierarchy import fcluster, linkage
from scipy.spatial.distance import pdist

from ssrics_like.comparison.matching import points
from ssrics_like.world.locations import Location

PREFIX = "C"
LEAST = 2
"""A location that was found was marked by at least so many people, if there are so many."""


def clusters_of(marks: ArrayLike, radius_m: float) -> NDArray[np.int64]:
    """Group marks so that no two of a group lie farther apart than twice the radius.

    Parameters
    ----------
    marks : array_like, shape (n, 2)
        Metres.
    radius_m : float
        Metres, more than 0.

    Returns
    -------
    ndarray of int64, shape (n,)
        The group of each mark, from 0.

    References
    ----------
    Complete linkage (Sørensen 1948), of which the height of a join is the largest distance within
    the group; computed by scipy.
    """
    places = points(marks)
    if len(places) <= 1:
        return np.zeros(len(places), np.int64)
    tree = linkage(pdist(places), method="complete")
    return np.asarray(fcluster(tree, 2.0 * radius_m, criterion="distance"), np.int64) - 1


def found_locations(
    marks: ArrayLike, who: ArrayLike, radius_m: float, people: int
) -> tuple[Location, ...]:
    """Return a location at the middle of each group of marks that several people share.

    Parameters
    ----------
    marks : array_like, shape (n, 2)
        Marks of people, metres.
    who : array_like of int, shape (n,)
        The number of the participant who made each.
    radius_m : float
        Metres; no two marks of a group lie farther apart than twice that.
    people : int
        How many participants there are. A group must be of two of them, if there are two.

    Returns
    -------
    tuple of Location
        Named C1, C2, ... from the one that most people marked; of equal ones the westernmost
        first.
    """
    places, makers = points(marks), np.asarray(who, np.int64)
    groups = clusters_of(places, radius_m)
    found = []
    for group in range(int(groups.max()) + 1 if len(groups) else 0):
        mine = groups == group
        makers_here = len(np.unique(makers[mine]))
        if makers_here >= min(LEAST, people):
            x_m, y_m = places[mine].mean(axis=0).tolist()
            found.append((-makers_here, x_m, y_m))
    return tuple(
        Location(f"{PREFIX}{number}", x_m, y_m, "", "other")
        for number, (_, x_m, y_m) in enumerate(sorted(found), 1)
    )
