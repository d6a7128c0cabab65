"""What the learner is told of each place: an opening, a junction, a corner, a hallway, or not."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.perception.structure import KINDS, SPOTS, Kind
from ssrics_like.training.labels import LEFT_OUT, NOT, nearest

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

    from ssrics_like.training.structure_examples import StructureExample
    from ssrics_like.world.buildings.plan import Plan, Space

IS = 1
WITHIN_M = {"opening": 0.35, "junction": 1.2, "corner": 1.2}
"""A place is at one if it is nearer than this to the middle. Robots cut corners: where hallways are
2 m wide, many come no nearer than 0.8 m to the middle of where they meet."""
ARGUABLE_M = {"opening": 0.9, "junction": 2.0, "corner": 2.0}
"""Up to here one may or may not say so."""
LIES: dict[Kind, str] = {
    "opening": "lies in an opening",
    "junction": "lies at a junction",
    "corner": "lies at a corner",
    "hallway": "lies in a hallway",
}


def spots(plan: Plan, kind: str) -> NDArray[np.float64]:
    """Return the middles of a building's openings, junctions or corners, shape (n, 2), metres."""
    if kind == "opening":
        found = [(one.x_m, one.y_m) for one in plan.passages if one.kind == kind]
    else:
        found = [(one.x_m, one.y_m) for one in plan.places if one.kind == kind]
    return np.array(found).reshape(-1, 2)


def structure_labels(one: StructureExample) -> NDArray[np.int8]:
    """Return IS, NOT or LEFT_OUT for each place and each of `KINDS`.

    Parameters
    ----------
    one : StructureExample
        The places and the plan.

    Returns
    -------
    ndarray, shape (places, kinds), int8
        What lies in neither a hallway nor a room, as within a wall's thickness, is left out of
        `hallway`.
    """
    xy_m = one.example.xy_m
    told = np.full((len(xy_m), len(KINDS)), NOT, np.int8)
    for column, kind in enumerate(SPOTS):
        away_m = nearest(xy_m, spots(one.plan, kind))
        told[away_m < ARGUABLE_M[kind], column] = LEFT_OUT
        told[away_m < WITHIN_M[kind], column] = IS
    room, hallway = (
        _within(xy_m, (space for space in one.plan.spaces if space.kind == kind))
        for kind in ("room", "hallway")
    )
    told[:, -1] = np.where(hallway, IS, np.where(room, NOT, LEFT_OUT))
    return told


def _within(xy_m: NDArray[np.float64], spaces: Iterable[Space]) -> NDArray[np.bool_]:
    """Tell which places, shape (n, 2), lie in any of some spaces."""
    inside = np.zeros(len(xy_m), bool)
    x, y = xy_m.T
    for space in spaces:
        inside |= (
            (x >= space.x_m[0]) & (x < space.x_m[1]) & (y >= space.y_m[0]) & (y < space.y_m[1])
        )
    return inside
