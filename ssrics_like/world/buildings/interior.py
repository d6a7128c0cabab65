"""What stands in a generated building: door leaves, furniture in rooms, things along hallways."""

from __future__ import annotations

import math

import numpy as np

from ssrics_like.world.buildings.groups import at_wall, groups, piece
from ssrics_like.world.buildings.pieces import Piece
from ssrics_like.world.buildings.placing import Placing
from ssrics_like.world.buildings.plan import Passage, Plan, Space, draw

BODY_M = 0.35
"""A disc of this radius still gets everywhere: a little more than the 0.3 m that is promised."""
TRIES = 4
LEAF_M = 0.05
LEAF_RAD = (1.2, 2.0)
"""How far a door stands open, from closed."""
HALLWAY_MIN_M = 1.7
"""A narrower hallway stays empty."""


def fit_out(
    plan: Plan,
    ways: dict[Passage, tuple[int, int]],
    clutter: float,
    leaves: float,
    rng: np.random.Generator,
) -> tuple[Piece, ...]:
    """Furnish a plan, so that a disc of radius 0.35 m still gets everywhere.

    Parameters
    ----------
    plan : Plan
        The plan without furniture; its first space is a hallway.
    ways : dict
        Passage -> the way through it into the room.
    clutter : float
        How full it is, 0 to 1.
    leaves : float
        Share of doorways whose door stands open.
    rng : numpy.random.Generator
        Where chance comes from.
    """
    clear = [plan.spaces[0].middle, *((place.x_m, place.y_m) for place in plan.locations)]
    placing = Placing(draw(plan), clear, BODY_M)
    stood: list[Piece] = []
    for passage in plan.passages:
        if passage.kind == "doorway" and rng.random() < leaves:
            leaf = _leaf(passage, ways[passage], rng)
            if placing.put(leaf, leaning=True):
                stood.append(leaf)
    for space in plan.spaces:
        if space.kind == "room":
            for group in groups(space, clutter, rng):
                stood += _stand(group, placing)
        else:
            stood += _along(space, clutter, placing, rng)
    return tuple(stood)


def _stand(group: list[Piece], placing: Placing) -> list[Piece]:
    """Put what fits of a group, if its first piece does."""
    first, *others = group
    if not placing.put(first):
        return []
    return [first, *(other for other in others if placing.put(other))]


def _along(
    hallway: Space, clutter: float, placing: Placing, rng: np.random.Generator
) -> list[Piece]:
    """Put benches, lockers and the like along a hallway."""
    spans = (hallway.x_m, hallway.y_m)
    width, length = sorted(high - low for low, high in spans)
    if width < HALLWAY_MIN_M:
        return []
    stood = []
    for _ in range(rng.poisson(clutter * length / 8.0)):
        long_m = round(float(rng.uniform(0.5, 1.8)) * 20) / 20
        deep_m = round(float(rng.uniform(0.3, 0.45)) * 20) / 20
        for _ in range(TRIES):
            thing, _ = at_wall(hallway, rng, "box", long_m, deep_m)
            if placing.put(thing):
                stood.append(thing)
                break
    return stood


def _leaf(passage: Passage, way: tuple[int, int], rng: np.random.Generator) -> Piece:
    """Return the leaf of a door, hinged at one jamb and swung into the room."""
    side = 1.0 if rng.random() < 0.5 else -1.0  # noqa: PLR2004 - a coin
    along = (side * abs(way[1]), side * abs(way[0]))  # from the middle to the hinge
    open_rad = float(rng.uniform(*LEAF_RAD))
    length = passage.width_m - LEAF_M
    half = passage.width_m / 2 + LEAF_M / 2
    wall = passage.depth_m / 2
    x_m = passage.x_m + along[0] * half + way[0] * wall
    y_m = passage.y_m + along[1] * half + way[1] * wall
    cos, sin = math.cos(open_rad), math.sin(open_rad)
    out = (-along[0] * cos + way[0] * sin, -along[1] * cos + way[1] * sin)
    x_m, y_m = x_m + out[0] * length / 2, y_m + out[1] * length / 2
    return piece("box", x_m, y_m, length, LEAF_M, math.atan2(out[1], out[0]))
