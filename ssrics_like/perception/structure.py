"""What a place looks like, in one word.

Without a cue the width tells a corridor from a room. A structure cue has learned to tell openings,
junctions and corners from what is around them, and hallways from rooms.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np

from ssrics_like.perception.gap import FEATURES

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ssrics_like.perception.trees import BoostedTrees

Structure = Literal["unknown", "doorway", "opening", "junction", "corner", "corridor", "room"]
Kind = Literal["opening", "junction", "corner", "hallway"]

SPOTS: tuple[Literal["opening", "junction", "corner"], ...] = ("opening", "junction", "corner")
"""What lies at one spot and has a name; all else is a corridor or a room."""
KINDS: tuple[Kind, ...] = (*SPOTS, "hallway")
"""What a structure cue knows, each of its own: a hallway, as opposed to a room, tells corridors."""
CORRIDOR_M = 3.2
"""Without a cue: a corridor is nowhere wider than this from a metre behind to a metre ahead."""
BESIDE = 2
"""A place's certainty is the mean over it and so many neighbours on either side along the way."""

_WIDEST = [
    i
    for i, name in enumerate(FEATURES)
    if name.startswith("widest_m@") and not name.startswith(("widest_m@-2.0", "widest_m@+1.1"))
]


def corridor_or_room(measures: NDArray[np.float64]) -> Structure:
    """Tell by how wide it is around a place.

    Parameters
    ----------
    measures : ndarray, shape (features,)
        Of the place; see `ssrics_like.perception.gap.FEATURES`.
    """
    return "corridor" if measures[_WIDEST].max() <= CORRIDOR_M else "room"


@dataclass(frozen=True, eq=False)
class StructureCue:
    """What was learned of structure.

    Attributes
    ----------
    trees : mapping of str to BoostedTrees
        For each of `KINDS`: tell from the layout of a place how probably it is one.
    thresholds : mapping of str to float
        For each of `KINDS`: least certainty of what counts as one.
    """

    trees: Mapping[Kind, BoostedTrees]
    thresholds: Mapping[Kind, float]

    def probabilities(self, layout: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return how probably a place is of each of `KINDS`, shape (kinds,).

        Parameters
        ----------
        layout : ndarray, shape (measures,)
            Of the place; see `ssrics_like.perception.layout.LAYOUT`.
        """
        return np.array([self.trees[kind].probability(layout) for kind in KINDS])

    def word(self, certainties: NDArray[np.float64]) -> Structure:
        """Return what a place is called.

        Parameters
        ----------
        certainties : ndarray, shape (kinds,)
            Of each of `KINDS`, averaged over neighbouring places.

        Returns
        -------
        str
            Of openings, junctions and corners that are certain enough the most certain one; if
            none is, corridor or room.
        """
        sure = dict(zip(KINDS, certainties.tolist(), strict=True))
        spots = [kind for kind in SPOTS if sure[kind] >= self.thresholds[kind]]
        if spots:
            return max(spots, key=lambda kind: sure[kind])
        return "corridor" if sure["hallway"] >= self.thresholds["hallway"] else "room"


class _Told(NamedTuple):
    travelled_m: float
    probabilities: NDArray[np.float64]


class StructureWatch:
    """Remembers what the last places looked like, until a word for one of them is wanted.

    Parameters
    ----------
    cue : StructureCue
        What was learned.
    places : int
        How many places back a word may be wanted.
    """

    def __init__(self, cue: StructureCue, places: int) -> None:
        self._cue = cue
        self._told: deque[_Told] = deque(maxlen=places + BESIDE)

    def update(self, travelled_m: float, layout: NDArray[np.float64]) -> None:
        """Take the next place.

        Parameters
        ----------
        travelled_m : float
            By which the place will be asked for; must not fall.
        layout : ndarray, shape (measures,)
            As `StructureCue.probabilities` takes it.
        """
        self._told.append(_Told(travelled_m, self._cue.probabilities(layout)))

    def word_at(self, travelled_m: float) -> Structure:
        """Return the word for the place that is nearest to so many metres of path.

        Its neighbours ahead count as far as they have been seen.
        """
        told = list(self._told)
        nearest = min(range(len(told)), key=lambda i: abs(told[i].travelled_m - travelled_m))
        around = told[max(nearest - BESIDE, 0) : nearest + BESIDE + 1]
        return self._cue.word(np.mean([one.probabilities for one in around], axis=0))
