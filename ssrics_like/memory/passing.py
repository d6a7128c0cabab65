"""Notices landmarks that the robot goes through and does not perceive: opportunities missed."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ssrics_like.poses import Pose

if TYPE_CHECKING:
    from ssrics_like.memory.hypotheses import Hypothesis
    from ssrics_like.memory.links import Links

THROUGH_M = 0.3
"""A robot so near to a landmark's place is in it."""
SURE_M = 0.25
"""Only places that are so well known count (standard deviation)."""
PAST_M = 3.0
"""Way after which a mark is overdue: perception looks back a metre, and deciding takes time."""
MARKED_M = 1.0
"""A mark so near to a landmark's place is one of it, whatever it is taken for."""


class _Passage(NamedTuple):
    """How the robot came by a landmark's place: how far ahead of it, first and last."""

    place: Pose
    from_m: float
    to_m: float
    at_m: float
    marked: bool = False

    @property
    def through(self) -> bool:
        """Whether it got to the other side unseeing; who turns back has missed nothing."""
        return not self.marked and self.from_m * self.to_m < 0.0


class Passing:
    """Follows the robot past the places where landmarks are expected.

    Parameters
    ----------
    links : Links
        Of the graph.
    """

    def __init__(self, links: Links) -> None:
        self._links = links
        self._known: Hypothesis | None = None
        self._places: list[tuple[str, Pose]] = []
        self._places_m = np.empty((0, 2))
        self._passages: dict[str, _Passage] = {}

    def go(self, here: Pose, travelled_m: float, known: Hypothesis | None) -> list[str]:
        """Note where the robot is.

        Parameters
        ----------
        here : Pose
            By path integration.
        travelled_m : float
            Length of the path.
        known : Hypothesis or None
            At which landmark it has been last; None while that is not proven.

        Returns
        -------
        list of str
            Landmarks that it went through a while ago, and did not mark; mostly none.
        """
        if known is None or known.landmark is None:
            self._known, self._passages = None, {}
            return []
        if known is not self._known:
            self._known = known
            self._expect(known, known.landmark)
        off_m = np.hypot(self._places_m[:, 0] - here.x_m, self._places_m[:, 1] - here.y_m)
        for index in np.flatnonzero(off_m < THROUGH_M).tolist():
            name, place = self._places[index]
            ahead_m = here.seen_from(place).x_m
            begun = self._passages.get(name, _Passage(place, ahead_m, ahead_m, travelled_m))
            self._passages[name] = begun._replace(to_m=ahead_m, at_m=travelled_m)
        over = [n for n, passage in self._passages.items() if travelled_m - passage.at_m > PAST_M]
        passages = {name: self._passages.pop(name) for name in over}
        return [name for name, passage in passages.items() if passage.through]

    def marked(self, place: Pose) -> None:
        """Note that a place was marked: whatever is expected there has not been missed."""
        for name, passage in self._passages.items():
            if passage.place.distance_m(place) < MARKED_M:
                self._passages[name] = passage._replace(marked=True)

    def _expect(self, known: Hypothesis, landmark: str) -> None:
        """Find where landmarks lie by what the robot knows now."""
        there = {
            name: known.fix.and_then(link) for name, link in self._links.seen_from(landmark).items()
        }
        sure = {name: link.pose for name, link in there.items() if link.variance_m2 < SURE_M**2}
        self._places = list(sure.items())
        self._passages = {  # what the robot does not believe any more, it has not missed
            name: passage
            for name, passage in self._passages.items()
            if name in sure and passage.place.distance_m(sure[name]) < THROUGH_M
        }
        self._places_m = np.array([(p.x_m, p.y_m) for p in sure.values()]).reshape(-1, 2)
