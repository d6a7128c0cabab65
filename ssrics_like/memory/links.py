"""How landmarks lie from one another: what going between them has told.

Each pair that was gone between has an estimate of its own. Nothing makes them agree with one
another or with one map: what lies where, seen from a landmark, follows from the pairs on the way.
"""

from __future__ import annotations

import heapq
import itertools
import math
from collections.abc import Mapping
from typing import NamedTuple

from ssrics_like.poses import Pose

LEAST_M, LEAST_RAD = 0.02, 0.005
"""However often a way was gone, it is not known better (standard deviations)."""
HORIZON = 500
"""So many landmarks are expected somewhere, those first whose places are most certain."""
KEPT = 64
"""Landmarks from which was looked since something was learned: it is asked again at every step."""


class Link(NamedTuple):
    """Where a landmark lies, seen from another.

    Attributes
    ----------
    pose : Pose
        Of the one in the frame of the other.
    variance_m2, variance_rad2 : float
        Of each coordinate, and of the direction.
    """

    pose: Pose
    variance_m2: float
    variance_rad2: float

    @property
    def reversed(self) -> Link:
        """The same, seen from the other end."""
        back = Pose(0.0, 0.0, 0.0).seen_from(self.pose)
        return Link(back, self.variance_m2, self.variance_rad2)

    def and_then(self, onward: Link) -> Link:
        """Return where one gets by another link; an error in direction grows with its length."""
        return Link(
            self.pose.onward(onward.pose),
            self.variance_m2_after(onward),
            self.variance_rad2 + onward.variance_rad2,
        )

    def variance_m2_after(self, onward: Link) -> float:
        """Return the variance of where one gets by another link."""
        length2 = onward.pose.x_m**2 + onward.pose.y_m**2
        return self.variance_m2 + onward.variance_m2 + self.variance_rad2 * length2

    def averaged_with(self, other: Link) -> Link:
        """Return the mean of two estimates, each weighted by its certainty (Kalman 1960)."""
        gain = self.variance_m2 / (self.variance_m2 + other.variance_m2)
        turn_gain = self.variance_rad2 / (self.variance_rad2 + other.variance_rad2)
        turn = math.remainder(other.pose.theta_rad - self.pose.theta_rad, math.tau)
        return Link(
            Pose(
                self.pose.x_m + gain * (other.pose.x_m - self.pose.x_m),
                self.pose.y_m + gain * (other.pose.y_m - self.pose.y_m),
                math.remainder(self.pose.theta_rad + turn_gain * turn, math.tau),
            ),
            gain * other.variance_m2,
            turn_gain * other.variance_rad2,
        )

    @property
    def bounded(self) -> Link:
        """The same, no more certain than anything can be."""
        return Link(
            self.pose, max(self.variance_m2, LEAST_M**2), max(self.variance_rad2, LEAST_RAD**2)
        )


HERE = Link(Pose(0.0, 0.0, 0.0), 0.0, 0.0)


class Links:
    """All links, found by either end."""

    def __init__(self) -> None:
        self._from: dict[str, dict[str, Link]] = {}
        self._seen: dict[tuple[str, int], Mapping[str, Link]] = {}

    def between(self, one: str, other: str) -> Link | None:
        """Return where `other` lies, seen from `one`; None if that was never measured."""
        return self._from.get(one, {}).get(other)

    def relate(self, one: str, other: str, link: Link) -> None:
        """Take in a measurement of where `other` lies, seen from `one`.

        Raises
        ------
        ValueError
            If they are the same, or a variance is not above 0.
        """
        if one == other:
            raise ValueError(f"'{one}' cannot lie away from itself")
        if not (link.variance_m2 > 0.0 and link.variance_rad2 > 0.0):
            raise ValueError(f"from '{one}' to '{other}': a variance is not above 0")
        known = self.between(one, other)
        self._seen.clear()
        joined = (link if known is None else known.averaged_with(link)).bounded
        self._from.setdefault(one, {})[other] = joined
        self._from.setdefault(other, {})[one] = joined.reversed

    def seen_from(self, landmark: str, most: int = HORIZON) -> Mapping[str, Link]:
        """Return where landmarks lie, seen from one, each by the way of least variance (Dijkstra).

        Parameters
        ----------
        landmark : str
            It lies at its own origin, for certain.
        most : int
            So many landmarks at most, the most certain ones.
        """
        if (known := self._seen.get((landmark, most))) is not None:
            return known
        found: dict[str, Link] = {}
        order = itertools.count()  # of equal variances the first come counts
        waiting = [(0.0, next(order), landmark, HERE, HERE)]
        least = {landmark: 0.0}
        while waiting and len(found) < most:
            _, _, name, before, onward = heapq.heappop(waiting)
            if name in found:
                continue
            found[name] = link = before.and_then(onward)
            for neighbour, further in self._from.get(name, {}).items():
                variance_m2 = link.variance_m2_after(further)
                if neighbour not in found and variance_m2 < least.get(neighbour, math.inf):
                    least[neighbour] = variance_m2
                    heapq.heappush(waiting, (variance_m2, next(order), neighbour, link, further))
        if len(self._seen) >= KEPT:
            self._seen.clear()
        self._seen[landmark, most] = found
        return found
