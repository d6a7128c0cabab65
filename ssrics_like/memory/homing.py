"""Homing by view: where, near where it is believed to be, a remembered place looks as remembered.

An animal that has come near a place by path integration finds it by moving until what it sees
agrees with the snapshot that it remembers (Cartwright & Collett 1983).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.memory.surroundings import STRANGE, UNKNOWN_M, agreement
from ssrics_like.poses import Pose

if TYPE_CHECKING:
    from numpy.typing import NDArray

REACH_M, STEP_M = 2.4, 0.3
"""So far around the place it is looked for, and how closely."""
ASTRAY_M = 1.0
"""How far path integration is astray (standard deviation) where a robot comes to a landmark that it
has not marked on the way."""
ALIKE = 0.7
"""Share of directions that must agree."""
CLEARLY = 2.0
"""By so much it must look more alike there than where it is believed to be."""
FEWEST = 15
"""Fewer directions that are known, both now and then, say too little of where it is."""


def where_alike(
    remembered: NDArray[np.float32], look: Callable[[Pose], NDArray[np.float32]], place: Pose
) -> Pose | None:
    """Find where a place looks most as it is remembered.

    What counts is by how many directions more agree than between different places, less how far
    from where it is believed to be.

    Parameters
    ----------
    remembered : ndarray, shape (3 directions,)
        Its surroundings.
    look : callable
        Tells what surrounds a place, in its own frame.
    place : Pose
        Where the place is believed to be.

    Returns
    -------
    Pose or None
        Where it is, of the same direction; None if no place near looks like it, or none
        clearly more so than where it is believed to be.
    """
    steps = np.arange(-round(REACH_M / STEP_M), round(REACH_M / STEP_M) + 1) * STEP_M
    along_m, aside_m = (side.ravel() for side in np.meshgrid(steps, steps))
    places = [
        place.onward(Pose(x_m, y_m, 0.0))
        for x_m, y_m in zip(along_m.tolist(), aside_m.tolist(), strict=True)
    ]
    seen = np.array([look(each) for each in places])
    agreeing = agreement(remembered, seen)
    directions = len(remembered) // 3
    unknown = slice(directions, 2 * directions)
    known = (seen[:, unknown] < UNKNOWN_M) & (remembered[unknown] < UNKNOWN_M)
    several = known.sum(axis=1)
    off_m2 = along_m**2 + aside_m**2
    score = several * (agreeing - STRANGE) - 0.5 * off_m2 / ASTRAY_M**2
    score[np.isnan(score)] = 0.0  # too few directions to compare
    here = int(np.argmin(off_m2))
    best = int(np.argmax(np.where(several >= FEWEST, score, -np.inf)))
    found = several[best] >= FEWEST and agreeing[best] >= ALIKE
    return places[best] if found and score[best] >= score[here] + CLEARLY else None
