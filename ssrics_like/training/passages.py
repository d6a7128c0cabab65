"""When a training drive led through a doorway, and which peaks of the cue find that."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.spatial.distance import cdist

from ssrics_like.comparison.drive import Drive, Marks, Passages
from ssrics_like.comparison.outcome import outcome_of
from ssrics_like.comparison.tally import Tally
from ssrics_like.comparison.way import Way

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ssrics_like.training.examples import Example

NEAR_M = 0.5
"""The robot passes a doorway when it comes this near to its middle."""
TOGETHER_M = 1.0
"""Stretches of the path near one doorway with no more between them are one passage."""
RADIUS_M = 1.0
"""A peak finds a passage at most this far away along the path."""


def passages(example: Example) -> Passages:
    """Find the passages of a drive through doorways: each time where it came nearest.

    A doorway that was cluttered has no clear line between two jambs that the path could be asked
    to cross, as `ssrics_like.comparison.passages` does on tidy maps; so nearness has to do.

    Parameters
    ----------
    example : Example
        The drive.
    """
    doorways: list[int] = []
    along: list[float] = []
    for doorway, distance in enumerate(cdist(example.doorways_m, example.xy_m)):
        near = np.flatnonzero(distance < NEAR_M)
        apart = np.flatnonzero(np.diff(example.at_m[near]) > TOGETHER_M) + 1
        for stretch in np.split(near, apart):
            if len(stretch):
                doorways.append(doorway)
                along.append(float(example.at_m[stretch[np.argmin(distance[stretch])]]))
    return Passages.of(doorways, along)


def tally(example: Example, peaks: NDArray[np.intp]) -> Tally:
    """Count which passages were found, and which peaks lie at a labelled place.

    Parameters
    ----------
    example : Example
        The drive.
    peaks : ndarray, shape (n,)
        Which of its places are said to be doorways, rising.
    """
    marks = Marks.of(example.xy_m[peaks], example.at_m[peaks])
    drive = Drive(Way(example.xy_m), marks, passages(example))
    places = np.concatenate([example.doorways_m, example.others_m])
    designated = np.arange(len(places)) < len(example.doorways_m)
    outcome = outcome_of(drive, places, designated, RADIUS_M)
    return Tally(
        runs=1, marks=len(peaks), merged=len(outcome.group_place), right=outcome.right,
        passages=len(outcome.passed), passed=int(outcome.passed.sum()),
    )  # fmt: skip
