"""Furniture as it stands in rooms: a desk with its chair, a table with chairs round it, shelves."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from ssrics_like.world.buildings.pieces import Piece, PieceKind
from ssrics_like.world.buildings.plan import Rectangle

Group = list[Piece]
"""Pieces that stand together; the others are left out where the first finds no place."""

WALLS = ((0.0, 1.0, 0.0), (0.0, -1.0, math.pi), (1.0, 0.0, -math.pi / 2), (-1.0, 0.0, math.pi / 2))
"""Way from a wall into the room, and how far furniture with its back there is turned."""


def _size(rng: np.random.Generator, low: float, high: float) -> float:
    """Draw a length, in steps of 5 cm so that furniture fills whole cells."""
    return round(float(rng.uniform(low, high)) * 20) / 20


def _rounded(value: float) -> float:
    return round(value, 3)


def piece(
    kind: PieceKind, x_m: float, y_m: float, width_m: float, depth_m: float, turn_rad: float = 0.0
) -> Piece:
    """Make a piece; a thousandth of a metre is fine enough."""
    return Piece(
        kind=kind, x_m=_rounded(x_m), y_m=_rounded(y_m), width_m=_rounded(width_m),
        depth_m=_rounded(depth_m), turn_rad=round(turn_rad, 4),
    )  # fmt: skip


def at_wall(
    room: Rectangle, rng: np.random.Generator, kind: PieceKind, width_m: float, depth_m: float
) -> tuple[Piece, tuple[float, float]]:
    """Stand a piece with its back at one of the walls; return it with the way into the room."""
    way_x, way_y, turn_rad = WALLS[int(rng.integers(len(WALLS)))]
    along = (width_m if way_y else depth_m) / 2, (depth_m if way_y else width_m) / 2
    x_m, y_m = (
        float(rng.uniform(span[0] + half, max(span[1] - half, span[0] + half)))
        for span, half in zip((room.x_m, room.y_m), along, strict=True)
    )
    x_m, y_m = round(x_m * 20) / 20, round(y_m * 20) / 20
    if way_y:
        y_m = room.y_m[0] + depth_m / 2 if way_y > 0 else room.y_m[1] - depth_m / 2
    else:
        x_m = room.x_m[0] + depth_m / 2 if way_x > 0 else room.x_m[1] - depth_m / 2
    return piece(kind, x_m, y_m, width_m, depth_m, turn_rad), (way_x, way_y)


def _inside(room: Rectangle, rng: np.random.Generator, margin_m: float) -> tuple[float, float]:
    x_m, y_m = (
        float(rng.uniform(low + margin_m, max(high - margin_m, low + margin_m)))
        for low, high in (room.x_m, room.y_m)
    )
    return round(x_m * 20) / 20, round(y_m * 20) / 20


def _chair(rng: np.random.Generator, x_m: float, y_m: float) -> Piece:
    x_m, y_m = x_m + rng.normal(0, 0.06), y_m + rng.normal(0, 0.06)
    return piece("chair", x_m, y_m, 0.45, 0.45, float(rng.normal(0, 0.25)))


def shelf(room: Rectangle, rng: np.random.Generator) -> Group:
    """Return a shelf or cupboard at a wall."""
    shelf, _ = at_wall(room, rng, "box", _size(rng, 0.8, 2.6), _size(rng, 0.3, 0.6))
    return [shelf]


def workplace(room: Rectangle, rng: np.random.Generator) -> Group:
    """Return a desk at a wall, and its chair."""
    depth_m = _size(rng, 0.7, 0.85)
    desk, (way_x, way_y) = at_wall(room, rng, "desk", _size(rng, 1.2, 1.8), depth_m)
    off = depth_m / 2 + 0.35
    return [desk, _chair(rng, desk.x_m + way_x * off, desk.y_m + way_y * off)]


def round_table(room: Rectangle, rng: np.random.Generator) -> Group:
    """Return a table somewhere, with a chair on each side."""
    side = _size(rng, 0.7, 1.0)
    x_m, y_m = _inside(room, rng, 1.2)
    off = side / 2 + 0.2
    seats = ((off, 0.0), (-off, 0.0), (0.0, off), (0.0, -off))
    return [
        piece("table", x_m, y_m, side, side, float(rng.uniform(0, 0.6))),
        *(_chair(rng, x_m + dx, y_m + dy) for dx, dy in seats),
    ]


def conference(room: Rectangle, rng: np.random.Generator) -> Group:
    """Return a long table along the room, with chairs on both sides."""
    width = room.x_m[1] - room.x_m[0]
    height = room.y_m[1] - room.y_m[0]
    upright = height > width
    longest = max(width, height)
    length, depth = _size(rng, 1.6, max(1.7, min(4.0, longest - 2.4))), _size(rng, 0.8, 1.3)
    x_m, y_m = (middle + float(rng.uniform(-0.3, 0.3)) for middle in room.middle)
    group = [piece("table", x_m, y_m, length, depth, math.pi / 2 if upright else 0.0)]
    seats = max(1, int(length / 0.75))
    for side in (-1, 1):
        for i in range(seats):
            along, off = (i + 0.5) * length / seats - length / 2, side * (depth / 2 + 0.15)
            dx, dy = (off, along) if upright else (along, off)
            group.append(_chair(rng, x_m + dx, y_m + dy))
    return group


def bench(room: Rectangle, rng: np.random.Generator) -> Group:
    """Return a laboratory bench somewhere, and stools."""
    length, depth = _size(rng, 1.6, 3.2), _size(rng, 0.7, 0.9)
    x_m, y_m = _inside(room, rng, 1.3)
    upright = bool(rng.random() < 0.5)  # noqa: PLR2004 - a coin
    group = [piece("box", x_m, y_m, length, depth, math.pi / 2 if upright else 0.0)]
    for side in (-1, 1):
        along, off = float(rng.uniform(-length / 3, length / 3)), side * (depth / 2 + 0.35)
        dx, dy = (off, along) if upright else (along, off)
        group.append(piece("round", x_m + dx, y_m + dy, 0.35, 0.35))
    return group


def sofa(room: Rectangle, rng: np.random.Generator) -> Group:
    """Return a sofa at a wall, and a low table in front of it."""
    depth_m = _size(rng, 0.8, 0.95)
    sofa, (way_x, way_y) = at_wall(room, rng, "box", _size(rng, 1.4, 2.4), depth_m)
    off = depth_m / 2 + 0.75
    x_m, y_m = sofa.x_m + way_x * off, sofa.y_m + way_y * off
    return [sofa, piece("table", x_m, y_m, 0.9, 0.55, sofa.turn_rad)]


def stray(room: Rectangle, rng: np.random.Generator) -> Group:
    """Return a crate, a bin or a plant somewhere."""
    x_m, y_m = _inside(room, rng, 0.3)
    if rng.random() < 0.5:  # noqa: PLR2004 - a coin
        return [piece("round", x_m, y_m, _size(rng, 0.3, 0.6), 0.5)]
    turn_rad = float(rng.uniform(0, math.pi))
    return [piece("box", x_m, y_m, _size(rng, 0.4, 0.8), _size(rng, 0.4, 0.7), turn_rad)]


Maker = Callable[[Rectangle, np.random.Generator], Group]

USES: tuple[tuple[float, tuple[Maker, ...], tuple[Maker, ...]], ...] = (
    (0.0, (shelf,), (shelf, stray)),  # store
    (8.0, (workplace,), (workplace, shelf, stray)),  # office
    (14.0, (conference,), (shelf, stray)),  # meeting room
    (14.0, (sofa, round_table), (round_table, stray, shelf)),  # lounge
    (20.0, (bench, bench), (bench, shelf, workplace)),  # laboratory
    (20.0, (workplace, workplace), (workplace, shelf, round_table)),  # open office
)
"""What a room may be: from how many square metres, what it has, and what it has more of."""


def groups(room: Rectangle, clutter: float, rng: np.random.Generator) -> list[Group]:
    """Return furniture for a room, to be tried in turn.

    Parameters
    ----------
    room : Rectangle
        The room.
    clutter : float
        How full it is, 0 to 1.
    rng : numpy.random.Generator
        Where chance comes from.
    """
    if clutter == 0:
        return []
    fitting = [use for use in USES if use[0] <= room.area_m2]
    _, first, more = fitting[int(rng.integers(len(fitting)))]
    number = rng.poisson(clutter * room.area_m2 / 5.0)
    makers = [*first, *(more[int(rng.integers(len(more)))] for _ in range(number))]
    return [maker(room, rng) for maker in makers]
