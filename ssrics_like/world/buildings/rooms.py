"""Rooms cut out of the blocks between hallways, and the doorways and openings that lead there."""

from __future__ import annotations

import itertools
from dataclasses import dataclass, field
from typing import Literal, NamedTuple

import numpy as np

from ssrics_like.world.buildings.layout import INNER, Block, Box, Front, Side, cells

ROOM_MIN, SUITE_MIN = cells(2.2), cells(2.4)
"""Least width of a room, and least depth of each of two rooms one behind the other."""
JAMB = 3  # 0.15 m of wall at least on both sides of a doorway
NICHE_SHARE, SECOND_SHARE, SHAFT_SHARE, PILLAR_M2 = 0.25, 0.25, 0.25, 45.0
INTO: dict[Side, tuple[int, int]] = {
    "bottom": (0, 1), "top": (0, -1), "left": (1, 0), "right": (-1, 0),
}  # fmt: skip
"""Side of a block at which a hallway runs -> the way from the hallway into the block."""


class Gate(NamedTuple):
    """A gap in a wall.

    Attributes
    ----------
    kind : {"doorway", "opening"}
        What it is.
    x, y : float
        Its middle, in the middle of the wall.
    into : tuple of int
        The way through it, into the room.
    width : int
        Cells.
    """

    kind: Literal["doorway", "opening"]
    x: float
    y: float
    into: tuple[int, int]
    width: int


@dataclass
class Rooms:
    """What blocks are made into; boxes and gates as `Layout` counts them."""

    rooms: list[Box] = field(default_factory=list)
    niches: list[Box] = field(default_factory=list)
    walls: list[Box] = field(default_factory=list)
    gates: list[Gate] = field(default_factory=list)


@dataclass(frozen=True)
class Habits:
    """How rooms are made: shares between 0 and 1, widths in metres."""

    doorway_m: tuple[float, float]
    openings: float
    connecting: float


def shared_out(blocks: list[Block], columns: int) -> list[int]:
    """Return how many rooms stand along each block's front, in proportion to its length."""
    fronts = np.array([block.front.length for block in blocks], np.float64)
    most = np.maximum(1, (fronts + INNER) // (ROOM_MIN + INNER))
    counts = np.ones(len(blocks))
    for _ in range(columns - len(blocks)):
        room = np.where(counts < most, fronts / (counts + 1), -1.0)
        if room.max() < 0:
            break
        counts[int(np.argmax(room))] += 1
    return [int(count) for count in counts]


def cut(block: Block, columns: int, suites: int, habits: Habits, rng: np.random.Generator) -> Rooms:
    """Cut a block into rooms side by side along its front.

    Parameters
    ----------
    block : Block
        The block.
    columns : int
        How many stand side by side.
    suites : int
        How many of them are divided into a front and a back room, as far as they are deep
        enough.
    habits : Habits
        How rooms are made.
    rng : numpy.random.Generator
        Where chance comes from.
    """
    made = Rooms()
    front = block.front
    depth = block.depth
    spans = _columns(front, columns, rng, made, block, depth)
    low, high = _ends(block)
    spans = [(min(low, a) if i == 0 else a, b) for i, (a, b) in enumerate(spans)]
    spans[-1] = (spans[-1][0], max(high, spans[-1][1]))
    deep = depth >= 2 * SUITE_MIN + INNER
    divided = set(rng.permutation(columns)[: suites if deep else 0].tolist())
    shallow: list[Box] = []
    for i, (a, b) in enumerate(spans):
        reach = Front(front.side, max(a, front.low), min(b, front.high))
        made.gates.append(_entrance(block, reach, habits, rng))
        if i in divided:
            split = int(rng.integers(SUITE_MIN, depth - SUITE_MIN - INNER + 1))
            back = _box(block, a, b, split + INNER, depth)
            shallow.append(_box(block, a, b, 0, split))
            made.rooms += [shallow[-1], back]
            inner = Block(back, (Front(front.side, a, b),))
            made.gates.append(_doorway(inner, inner.front, habits, rng))
        else:
            shallow.append(_box(block, a, b, 0, depth))
            made.rooms.append(shallow[-1])
            _second_entrance(block, shallow[-1], made, habits, rng)
    for one, other in itertools.pairwise(shallow):
        if rng.random() < habits.connecting:
            _connect(one, other, made, habits, rng)
    _shafts_and_pillars(made, rng)
    return made


def _ends(block: Block) -> tuple[int, int]:
    """Return from where to where the block reaches along its front."""
    box = block.box
    upright = block.front.side in ("bottom", "top")
    return (box.x0, box.x1) if upright else (box.y0, box.y1)


def _box(block: Block, low: int, high: int, near: int, far: int) -> Box:
    """Return a box from `low` to `high` along the front, `near` to `far` away from it."""
    box = block.box
    match block.front.side:
        case "bottom":
            return Box(low, box.y0 + near, high, box.y0 + far)
        case "top":
            return Box(low, box.y1 - far, high, box.y1 - near)
        case "left":
            return Box(box.x0 + near, low, box.x0 + far, high)
        case _:
            return Box(box.x1 - far, low, box.x1 - near, high)


def _columns(
    front: Front, columns: int, rng: np.random.Generator, made: Rooms, block: Block, depth: int
) -> list[tuple[int, int]]:
    """Share the front out among rooms of different widths, with a niche between two of them."""
    gaps = [INNER] * (columns - 1)
    niche = cells(rng.uniform(1.0, 1.8))
    spare = front.length - columns * (ROOM_MIN + INNER) - niche
    at = None
    if columns > 1 and spare > 0 and rng.random() < NICHE_SHARE:
        at = int(rng.integers(columns - 1))
        gaps[at] = niche + 2 * INNER
    free = front.length - sum(gaps) - columns * ROOM_MIN
    weights = rng.uniform(0.15, 1.0, columns)
    edges = np.floor(np.cumsum(weights) / weights.sum() * free).astype(int)
    extra = np.diff(edges, prepend=0)
    spans, low = [], front.low
    for i in range(columns):
        high = front.high if i == columns - 1 else low + ROOM_MIN + int(extra[i])
        spans.append((low, high))
        if i == at:
            far = min(cells(rng.uniform(0.5, 1.2)), depth)
            made.niches.append(_box(block, high + INNER, high + INNER + niche, -INNER, far))
        low = high + (gaps[i] if i < columns - 1 else 0)
    return spans


def _entrance(block: Block, reach: Front, habits: Habits, rng: np.random.Generator) -> Gate:
    """Make the way from the hallway into a room: a doorway, or an opening where there is space."""
    if rng.random() < habits.openings and reach.length > cells(2.2):
        widest = reach.length - 2 * JAMB
        width = min(cells(rng.uniform(1.5, 3.2)), widest)
        return _gate("opening", block, reach, width, rng)
    return _doorway(block, reach, habits, rng)


def _doorway(block: Block, reach: Front, habits: Habits, rng: np.random.Generator) -> Gate:
    return _gate("doorway", block, reach, cells(rng.uniform(*habits.doorway_m)), rng)


def _gate(
    kind: Literal["doorway", "opening"],
    block: Block,
    reach: Front,
    width: int,
    rng: np.random.Generator,
) -> Gate:
    """Put a gap somewhere into the wall in front of a room."""
    low = int(rng.integers(reach.low + JAMB, max(reach.high - JAMB - width, reach.low + JAMB) + 1))
    along = low + width / 2
    box, half = block.box, INNER / 2
    match reach.side:
        case "bottom":
            x, y = along, box.y0 - half
        case "top":
            x, y = along, box.y1 + half
        case "left":
            x, y = box.x0 - half, along
        case _:
            x, y = box.x1 + half, along
    return Gate(kind, x, y, INTO[reach.side], width)


def _second_entrance(
    block: Block, room: Box, made: Rooms, habits: Habits, rng: np.random.Generator
) -> None:
    """Give a room that also lies at another hallway a doorway there, now and then."""
    for front in block.fronts:
        upright = front.side in ("bottom", "top")
        edge = {"bottom": 1, "top": 3, "left": 0, "right": 2}[front.side]
        if front == block.front or room[edge] != block.box[edge]:
            continue
        low, high = (room.x0, room.x1) if upright else (room.y0, room.y1)
        reach = Front(front.side, max(low, front.low), min(high, front.high))
        if reach.length >= ROOM_MIN and rng.random() < SECOND_SHARE:
            made.gates.append(_doorway(block, reach, habits, rng))


def _connect(one: Box, other: Box, made: Rooms, habits: Habits, rng: np.random.Generator) -> None:
    """Make a doorway between two neighbours, unless there is a niche between them."""
    if one.x1 + INNER == other.x0:
        low, high = max(one.y0, other.y0), min(one.y1, other.y1)
        side: Side = "left"
    elif one.y1 + INNER == other.y0:
        low, high = max(one.x0, other.x0), min(one.x1, other.x1)
        side = "bottom"
    else:
        return
    reach = Front(side, low, high)
    if reach.length >= ROOM_MIN:
        made.gates.append(_doorway(Block(other, (reach,)), reach, habits, rng))


def _shafts_and_pillars(made: Rooms, rng: np.random.Generator) -> None:
    """Make some rooms L-shaped, and stand pillars in large ones, out of the way of all gates."""
    for room in made.rooms:
        width, height = room.x1 - room.x0, room.y1 - room.y0
        if min(width, height) >= cells(2.8) and rng.random() < SHAFT_SHARE:
            across, up = (cells(v) for v in rng.uniform(0.6, 1.5, 2))
            x = room.x0 if rng.random() < 0.5 else room.x1 - across  # noqa: PLR2004 - a coin
            y = room.y0 if rng.random() < 0.5 else room.y1 - up  # noqa: PLR2004
            _wall(Box(x, y, x + across, y + up), made)
        if width * height > PILLAR_M2 * cells(1.0) ** 2:
            side = cells(rng.uniform(0.3, 0.5))
            x, y = room.x0 + (width - side) // 2, room.y0 + (height - side) // 2
            _wall(Box(x, y, x + side, y + side), made)


def _wall(box: Box, made: Rooms) -> None:
    away = cells(1.0)
    for gate in made.gates:
        reach = gate.width / 2 + away
        near_x = box.x0 - reach < gate.x < box.x1 + reach
        near_y = box.y0 - reach < gate.y < box.y1 + reach
        if near_x and near_y:
            return
    made.walls.append(box)
