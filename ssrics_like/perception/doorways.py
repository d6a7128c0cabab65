"""The doorway cue: how sure it is that the robot has just gone through a doorway."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from typing import TYPE_CHECKING, Generic, NamedTuple, TypeVar

from ssrics_like.perception.peaks import Peaks

if TYPE_CHECKING:
    from ssrics_like.perception.surroundings import Described
    from ssrics_like.perception.trees import BoostedTrees

T = TypeVar("T")

APART_M = 0.8
"""Two doorways are not nearer to each other along the way."""
AHEAD_M = 0.1
"""How far the certainty is awaited to rise further before its maximum counts."""
WEIGHTS = (1, 2, 1)
"""A place's certainty is the mean over it and its neighbours along the way, weighted so: one place
alone may look like a doorway by chance."""


@dataclass(frozen=True, eq=False)
class DoorwayCue:
    """What was learned of doorways.

    Attributes
    ----------
    trees : BoostedTrees
        Tell from the measures of a place how probably it lies in a doorway.
    threshold : float
        Least certainty of what counts as a doorway.
    """

    trees: BoostedTrees
    threshold: float


class SeenDoorway(NamedTuple, Generic[T]):
    """A doorway on the robot's way.

    Attributes
    ----------
    place : Described
        Where it is.
    certainty : float
        Probability, averaged as `WEIGHTS` has it.
    """

    place: Described[T]
    certainty: float


class DoorwayWatch(Generic[T]):
    """Watches the certainty of a doorway along the way for its peaks.

    Parameters
    ----------
    cue : DoorwayCue
        What was learned.
    """

    def __init__(self, cue: DoorwayCue) -> None:
        self._cue = cue
        self._peaks: Peaks[Described[T]] = Peaks(cue.threshold, APART_M, AHEAD_M)
        self._recent: deque[tuple[float, Described[T]]] = deque(maxlen=len(WEIGHTS))

    def update(self, described: Described[T]) -> list[SeenDoorway[T]]:
        """Take the next place; return the doorway that is now certain to be one, mostly none."""
        self._recent.append((self._cue.trees.probability(described.measures), described))
        if len(self._recent) < len(WEIGHTS):
            return []
        weighted = zip(WEIGHTS, self._recent, strict=True)
        certainty = sum(weight * p for weight, (p, _) in weighted) / sum(WEIGHTS)
        place = self._recent[len(WEIGHTS) // 2][1]
        return [
            SeenDoorway(seen, c)
            for c, seen in self._peaks.update(place.place.at_m, certainty, place)
        ]

    def flush(self) -> list[SeenDoorway[T]]:
        """Return a doorway that was still waited for, as at the end of a log."""
        return [SeenDoorway(seen, c) for c, seen in self._peaks.flush()]
