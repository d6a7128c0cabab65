"""What a structure cue says along a drive, and how often that is right.

Two counts are taken of the same words. By place: every 0.1 m of path, arguable places left out.
By passage: each time that the path comes near a spot, which is found if the word is said
meanwhile; and each stretch of the path on which a word is said, which is right if it comes near
a spot of the kind.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from scipy.spatial.distance import cdist

from ssrics_like.comparison.proportions import harmonic_mean, share
from ssrics_like.errors import SettingsError
from ssrics_like.perception.structure import BESIDE, KINDS, SPOTS, Kind, StructureCue
from ssrics_like.training.labels import LEFT_OUT
from ssrics_like.training.structure_labels import IS, LIES, spots, structure_labels

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ssrics_like.perception.trees import BoostedTrees
    from ssrics_like.training.structure_examples import StructureExample

WORDS = (*SPOTS, "corridor", "room")
STEPS = 100
"""Thresholds are tried in hundredths."""
NEAR_M = {"opening": 0.5, "junction": 1.0, "corner": 1.0}
"""The robot passes a spot when it comes this near to its middle."""
RIGHT_M = 0.5
"""A word is right up to so much farther away."""
TOGETHER_M = 1.0
"""Stretches of the path with no more between them are one."""


class Counts(NamedTuple):
    """How often something was told to be so, and how often it was said; they add up.

    Attributes
    ----------
    told, found : int
        What is so, and how much of that was said.
    said, right : int
        What was said, and how much of that is so.
    """

    told: int = 0
    found: int = 0
    said: int = 0
    right: int = 0

    @property
    def recall(self) -> float:
        """Share of what is so that was said; NaN if nothing is so."""
        return share(self.found, self.told)

    @property
    def precision(self) -> float:
        """Share of what was said that is so; NaN if nothing was said."""
        return share(self.right, self.said)

    @property
    def f(self) -> float:
        """Harmonic mean of recall and precision."""
        return harmonic_mean(self.recall, self.precision)


def added(counts: Iterable[Counts]) -> Counts:
    """Add counts up."""
    return Counts(*(sum(column) for column in zip(Counts(), *counts, strict=True)))


class Scored(NamedTuple):
    """A drive, and how certain its places are.

    Attributes
    ----------
    one : StructureExample
        The drive.
    certainties : ndarray, shape (places, kinds)
        Of each of `KINDS`, averaged as `StructureWatch` does.
    told : ndarray, shape (places, kinds), int8
        The truth; see `structure_labels`.
    """

    one: StructureExample
    certainties: NDArray[np.float64]
    told: NDArray[np.int8]


def scored(trees: Mapping[Kind, BoostedTrees], one: StructureExample) -> Scored:
    """Ask trees about all places of a drive.

    Parameters
    ----------
    trees : mapping of str to BoostedTrees
        For each of `KINDS`.
    one : StructureExample
        The drive.
    """
    places = one.example.measures
    p = np.array([[trees[kind].probability(place) for kind in KINDS] for place in places])
    return Scored(one, averaged(p.reshape(-1, len(KINDS))), structure_labels(one))


def averaged(p: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the mean over each place and its neighbours, as far as there are any.

    Parameters
    ----------
    p : ndarray, shape (places, kinds)
        Probabilities.
    """
    total = np.concatenate([np.zeros((1, p.shape[1])), p.cumsum(axis=0)])
    here = np.arange(len(p))
    first, end = np.maximum(here - BESIDE, 0), np.minimum(here + BESIDE + 1, len(p))
    means: NDArray[np.float64] = (total[end] - total[first]) / (end - first)[:, None]
    return means


def choose_thresholds(drives: Sequence[Scored]) -> dict[Kind, float]:
    """Choose for each of `KINDS` the hundredth with the greatest F by place, the lowest of equals.

    Parameters
    ----------
    drives : sequence of Scored
        In other buildings than those of the training.

    Raises
    ------
    SettingsError
        No place is of one of the kinds.
    """
    certainties = np.concatenate([one.certainties for one in drives])
    told = np.concatenate([one.told for one in drives])
    chosen: dict[Kind, float] = {}
    for column, kind in enumerate(KINDS):
        used = told[:, column] != LEFT_OUT
        is_so, sure = told[used, column] == IS, certainties[used, column]
        if not is_so.any():
            raise SettingsError(
                f"no threshold to choose: no place on the held-out drives {LIES[kind]}; "
                "expected more held-out buildings"
            )
        at_least = [sure >= hundredths / STEPS for hundredths in range(1, STEPS)]
        f = [2.0 * np.sum(said & is_so) / max(np.sum(said) + np.sum(is_so), 1) for said in at_least]
        chosen[kind] = (int(np.argmax(f)) + 1) / STEPS
    return chosen


def words(cue: StructureCue, drive: Scored) -> NDArray[np.str_]:
    """Return what each place of a drive is called, shape (places,)."""
    return np.array([cue.word(sure) for sure in drive.certainties], dtype="U8")


def by_place(said: NDArray[np.str_], told: NDArray[np.int8]) -> dict[str, Counts]:
    """Count for each of `WORDS` how many places are so, and are called so.

    Where a spot of any kind is arguable nothing counts; a place at two spots may be called either.

    Parameters
    ----------
    said : ndarray, shape (places,)
        What each place is called.
    told : ndarray, shape (places, kinds), int8
        The truth.
    """
    at_spot = (told[:, :-1] == IS).any(axis=1)
    clear = ~(told[:, :-1] == LEFT_OUT).any(axis=1) & (at_spot | (told[:, -1] != LEFT_OUT))
    truth: dict[str, NDArray[np.bool_]] = {
        kind: told[:, column] == IS for column, kind in enumerate(SPOTS)
    }
    truth["corridor"] = ~at_spot & (told[:, -1] == IS)
    truth["room"] = ~at_spot & (told[:, -1] != IS)
    counts: dict[str, Counts] = {}
    for word in WORDS:
        so, called = truth[word] & clear, (said == word) & clear
        both = int(np.sum(so & called))
        counts[word] = Counts(int(np.sum(so)), both, int(np.sum(called)), both)
    return counts


def by_passage(said: NDArray[np.str_], one: StructureExample) -> dict[str, Counts]:
    """Count for each of `SPOTS` how many passages there are, and stretches where it is said.

    Parameters
    ----------
    said : ndarray, shape (places,)
        What each place is called.
    one : StructureExample
        The drive.
    """
    counts: dict[str, Counts] = {}
    at_m = one.example.at_m
    for kind in SPOTS:
        away_m = cdist(spots(one.plan, kind), one.example.xy_m)
        passed = [stretch for away in away_m for stretch in stretches(away < NEAR_M[kind], at_m)]
        called = stretches(said == kind, at_m)
        nearest_m = away_m.min(axis=0, initial=np.inf)
        counts[kind] = Counts(
            told=len(passed),
            found=sum(bool((said[stretch] == kind).any()) for stretch in passed),
            said=len(called),
            right=sum(bool(nearest_m[s].min() < NEAR_M[kind] + RIGHT_M) for s in called),
        )
    return counts


def stretches(which: NDArray[np.bool_], at_m: NDArray[np.float64]) -> list[NDArray[np.intp]]:
    """Return the stretches of a path for which something holds, as the numbers of places.

    Parameters
    ----------
    which : ndarray, shape (places,), bool
        For which places it holds.
    at_m : ndarray, shape (places,)
        Where these are along the path, rising, metres.
    """
    places = np.flatnonzero(which)
    if len(places) == 0:
        return []
    return np.split(places, np.flatnonzero(np.diff(at_m[places]) > TOGETHER_M) + 1)


def figures(cue: StructureCue, drives: Iterable[Scored]) -> dict[str, dict[str, Counts]]:
    """Count what a cue says on several drives.

    Returns
    -------
    dict
        ``places``: for each of `WORDS`, see `by_place`; ``passages``: for each of `SPOTS`, see
        `by_passage`.
    """
    said = [(words(cue, one), one) for one in drives]
    places = [by_place(called, one.told) for called, one in said]
    passages = [by_passage(called, one.one) for called, one in said]
    return {
        "places": {word: added(one[word] for one in places) for word in WORDS},
        "passages": {kind: added(one[kind] for one in passages) for kind in SPOTS},
    }
