"""How sure the cue has to be: the threshold, chosen on buildings that it was not trained in."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ssrics_like.comparison.tally import Tally, pooled
from ssrics_like.perception.doorways import AHEAD_M, APART_M, WEIGHTS
from ssrics_like.perception.walk import STEP_M
from ssrics_like.training.passages import tally

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ssrics_like.perception.trees import BoostedTrees
    from ssrics_like.training.examples import Example

FOUND = 7 / 8
"""Share of the passages that should be found."""
STEPS = 100
"""Thresholds are tried in hundredths."""


class Chosen(NamedTuple):
    """A threshold and what it does on the buildings that it was chosen on."""

    threshold: float
    tally: Tally


def choose_threshold(trees: BoostedTrees, held_out: Sequence[Example]) -> Chosen:
    """Choose the highest threshold at which at least seven of eight passages are found.

    If there is none, the lowest is taken, 0.01.

    Parameters
    ----------
    trees : BoostedTrees
        What was learned.
    held_out : sequence of Example
        Drives in other buildings than those of the training.
    """
    scored = [(example, scores(trees, example)) for example in held_out]
    for hundredths in range(STEPS - 1, 0, -1):
        threshold = hundredths / STEPS
        found = pooled(tally(example, peaks(score, threshold)) for example, score in scored)
        if found.pass_recall >= FOUND:
            break
    return Chosen(threshold, found)


def scores(trees: BoostedTrees, example: Example) -> NDArray[np.float64]:
    """Return the certainty of each place, as `DoorwayWatch` has it, shape (places,).

    Places at both ends lack neighbours and are given none: NaN.
    """
    p = np.array([trees.probability(measures) for measures in example.measures])
    certainty = np.full(len(p), np.nan)
    half = len(WEIGHTS) // 2
    if len(p) >= len(WEIGHTS):
        certainty[half:-half] = np.convolve(p, WEIGHTS, "valid") / sum(WEIGHTS)
    return certainty


def peaks(score: NDArray[np.float64], threshold: float) -> NDArray[np.intp]:
    """Return the places that `ssrics_like.perception.doorways.DoorwayWatch` would find.

    For a whole drive at once, and without asking the trees again for each threshold.

    Parameters
    ----------
    score : ndarray, shape (places,)
        As `scores` returns it, of places 0.1 m apart; NaN is below everything.
    threshold : float
        Least score.

    Returns
    -------
    ndarray, shape (n,)
        Indices of places, rising.
    """
    ahead, apart = round(AHEAD_M / STEP_M), round(APART_M / STEP_M)
    count = len(score)
    padded = np.pad(np.nan_to_num(score, nan=-np.inf), ahead, constant_values=-np.inf)
    highest = score >= threshold
    for step in range(1, ahead + 1):
        before, after = (padded[ahead + shift :][:count] for shift in (-step, step))
        highest &= (score > before) & (score >= after)
    found: list[int] = []
    for place in np.flatnonzero(highest).tolist():
        if not found or place - found[-1] >= apart:
            found.append(place)
    return np.array(found, np.intp)
