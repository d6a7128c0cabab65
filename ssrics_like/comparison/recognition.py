"""How well landmarks are known again: whether a passage brings the landmark of that place."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ssrics_like.comparison.proportions import share, wilson

if TYPE_CHECKING:
    from numpy.typing import NDArray

LABELLED_M = 1.0
"""A mark belongs to the nearest labelled place within this."""
SAME_M = 0.6
"""Two marks that lie nearer to each other are of one place, labelled or not."""


class Marked(NamedTuple):
    """A mark as the model made it.

    Attributes
    ----------
    x_m, y_m : float
        Where it really is, frame of the map.
    decision : str
        declared, recognised or unsure.
    landmark : str
        Which landmark; empty where unsure.
    """

    x_m: float
    y_m: float
    decision: str
    landmark: str


@dataclass
class RecognitionTally:
    """Counts over one or several drives.

    Attributes
    ----------
    marks : int
        All marks.
    again : int
        Those at a place of which there is a landmark already.
    right : int
        Of these, recognised as a landmark of that place.
    doubled : int
        Of these, declared as a new landmark.
    unsure : int
        Marks, wherever they are, of which the model does not say which landmark they are.
    recognised, wrong : int
        Marks recognised, and those recognised as a landmark of another place.
    declared : int
        New landmarks.
    landmarks, places : int
        Landmarks at labelled places, and these places.
    """

    marks: int = 0
    again: int = 0
    right: int = 0
    doubled: int = 0
    unsure: int = 0
    recognised: int = 0
    wrong: int = 0
    declared: int = 0
    landmarks: int = 0
    places: int = 0

    def __add__(self, other: RecognitionTally) -> RecognitionTally:
        return RecognitionTally(
            **{name: value + getattr(other, name) for name, value in vars(self).items()}
        )

    @property
    def recall(self) -> float:
        """Share of the marks at known places that were recognised rightly; NaN without any."""
        return share(self.right, self.again)

    @property
    def recall_interval(self) -> tuple[float, float]:
        """Its Wilson 95 % interval."""
        return wilson(self.right, self.again)

    @property
    def wrong_share(self) -> float:
        """Share of the recognitions that are of another place; NaN without any."""
        return share(self.wrong, self.recognised)

    @property
    def wrong_interval(self) -> tuple[float, float]:
        """Its Wilson 95 % interval."""
        return wilson(self.wrong, self.recognised)

    @property
    def new_share(self) -> float:
        """Share of the marks that are new landmarks; NaN without any."""
        return share(self.declared, self.marks)

    @property
    def landmarks_per_place(self) -> float:
        """Landmarks for each labelled place that has one; NaN without any."""
        return share(self.landmarks, self.places)


@dataclass
class Recogniser:
    """Follows a model's marks and counts which were recognised rightly.

    Parameters
    ----------
    places_m : ndarray, shape (places, 2)
        Labelled places, frame of the map.
    """

    places_m: NDArray[np.float64]
    _where: dict[str, tuple[float, float]] = field(default_factory=dict)

    def count(self, marks: Iterable[Marked]) -> RecognitionTally:
        """Count the marks of a drive, in their order; landmarks of earlier drives are known.

        Raises
        ------
        ValueError
            A mark recognises a landmark that was never declared.
        """
        tally = RecognitionTally()
        for mark in marks:
            here = (mark.x_m, mark.y_m)
            known = [name for name, there in self._where.items() if self._same(here, there)]
            tally.marks += 1
            tally.again += bool(known)
            if mark.decision == "recognised":
                if mark.landmark not in self._where:
                    raise ValueError(f"'{mark.landmark}' is recognised but was never declared")
                tally.recognised += 1
                right = self._same(here, self._where[mark.landmark])
                tally.right += right and bool(known)
                tally.wrong += not right
            elif mark.decision == "declared":
                tally.declared += 1
                tally.doubled += bool(known)
                self._where[mark.landmark] = here
            else:
                tally.unsure += 1
        labels = [self._label(there) for there in self._where.values()]
        tally.landmarks = sum(label >= 0 for label in labels)
        tally.places = len({label for label in labels if label >= 0})
        return tally

    def _label(self, at: Sequence[float]) -> int:
        """Return which labelled place a mark belongs to; -1 for none."""
        if not len(self.places_m):
            return -1
        distances_m = np.hypot(*(self.places_m - at).T)
        nearest = int(distances_m.argmin())
        return nearest if distances_m[nearest] < LABELLED_M else -1

    def _same(self, one: tuple[float, float], other: tuple[float, float]) -> bool:
        if np.hypot(one[0] - other[0], one[1] - other[1]) < SAME_M:
            return True
        label = self._label(one)
        return label >= 0 and label == self._label(other)
