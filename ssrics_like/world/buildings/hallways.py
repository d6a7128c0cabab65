"""How the hallways of a generated building run: straight, as L, T, X or U, in a ring."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ssrics_like.world.buildings.layout import (
    INNER,
    OUTER,
    Block,
    Box,
    Front,
    Layout,
    Shape,
    Side,
    cells,
)

DEEP = 160  # 8 m: a core from there on holds two rows of rooms
DEEPEST = 180  # 9 m: nobody builds deeper rooms without light from two sides
WING = 64  # 3.2 m at least on both sides of a hallway that branches off


class Sizes:
    """Lengths of one building, drawn once and then scaled.

    Parameters
    ----------
    rng : numpy.random.Generator
        Where chance comes from.
    hallway_m : tuple of float
        Narrowest and widest hallway.
    depth_m : tuple of float
        Least and greatest depth of a row of rooms.
    """

    def __init__(
        self,
        rng: np.random.Generator,
        hallway_m: tuple[float, float],
        depth_m: tuple[float, float],
    ) -> None:
        self.hall = [cells(rng.uniform(*hallway_m)) for _ in range(4)]
        self.depth = [cells(rng.uniform(*depth_m)) for _ in range(4)]
        self.share = [float(rng.uniform(0.3, 0.7)) for _ in range(4)]
        self.coin = [bool(rng.random() < 0.5) for _ in range(4)]  # noqa: PLR2004 - a fair coin


def lay_out(shape: Shape, sizes: Sizes, frontage: int) -> Layout:
    """Lay hallways out so long that the blocks have about the frontage that rooms need.

    Parameters
    ----------
    shape : {"straight", "L", "T", "X", "U", "ring"}
        How the hallways run.
    sizes : Sizes
        Widths, depths and proportions.
    frontage : int
        Cells.
    """
    low, high = 20, frontage + 200
    while high - low > 1:
        middle = (low + high) // 2
        if _MAKERS[shape](sizes, middle).frontage < frontage:
            low = middle
        else:
            high = middle
    return _MAKERS[shape](sizes, high)


def _straight(s: Sizes, length: int) -> Layout:
    """One hallway, rooms on both sides; or on one side of it, and then shorter."""
    hall, below, above = s.hall[0], s.depth[0], s.depth[1]
    one_sided = s.coin[0] and s.coin[1]
    y0 = OUTER if one_sided else OUTER + below + INNER
    y1 = y0 + hall
    plan = Layout(2 * OUTER + length, y1 + INNER + above + OUTER)
    left, right = OUTER, OUTER + length
    plan.halls = [Box(left, y0, right, y1)]
    top = Box(left, y1 + INNER, right, y1 + INNER + above)
    plan.blocks = [Block(top, (Front("bottom", left, right),))]
    if not one_sided:
        bottom = Box(left, OUTER, right, OUTER + below)
        plan.blocks.append(Block(bottom, (Front("top", left, right),)))
    return plan


def _spine(s: Sizes, length: int, *, through: bool) -> Layout:
    """One hallway along the building and one across it: a T, or an X if it goes through."""
    along, across = s.hall[0], s.hall[1]
    length = max(length, across + 2 * (INNER + WING))
    below, above = s.depth[0], _between(s.depth[1], s.share[1] * length)
    if through:
        below = _between(below, s.share[2] * length)
    left, right = OUTER, OUTER + length
    spare = length - across - 2 * (INNER + WING)
    x0 = left + WING + INNER + round(s.share[0] * spare)
    x1 = x0 + across
    y0 = OUTER + below + INNER
    y1 = y0 + along
    top = y1 + INNER + above
    plan = Layout(2 * OUTER + length, top + OUTER)
    plan.halls = [Box(left, y0, right, y1), Box(x0, OUTER if through else y0, x1, top)]
    for low, high, side, inner in (
        (left, x0 - INNER, "right", Front("bottom", left, x0 - INNER)),
        (x1 + INNER, right, "left", Front("bottom", x1 + INNER, right)),
    ):
        box = Box(low, y1 + INNER, high, top)
        plan.blocks.append(Block(box, (inner, Front(_side(side), box.y0, top))))
        if through:
            box = Box(low, OUTER, high, OUTER + below)
            fronts = (Front("top", low, high), Front(_side(side), OUTER, box.y1))
            plan.blocks.append(Block(box, fronts))
    if not through:
        box = Box(left, OUTER, right, OUTER + below)
        plan.blocks.append(Block(box, (Front("top", left, right),)))
    plan.places = [("junction", (x0 + x1) / 2, (y0 + y1) / 2)]
    return plan


def _t(s: Sizes, length: int) -> Layout:
    return _spine(s, length, through=False)


def _x(s: Sizes, length: int) -> Layout:
    return _spine(s, length, through=True)


def _l(s: Sizes, length: int) -> Layout:
    """Two hallways that meet in a corner; rooms within the angle and on both outer sides."""
    along, across = s.hall[0], s.hall[1]
    below, beside = s.depth[0], s.depth[1]
    rise = _between(s.depth[2], length * s.share[0])
    left = OUTER
    x0 = left + max(length, s.depth[3]) + INNER
    x1 = x0 + across
    y0 = OUTER + below + INNER
    y1 = y0 + along
    top = y1 + INNER + rise
    plan = Layout(x1 + INNER + beside + OUTER, top + OUTER)
    plan.halls = [Box(left, y0, x1, y1), Box(x0, y0, x1, top)]
    plan.blocks = [
        Block(Box(left, OUTER, x1, OUTER + below), (Front("top", left, x1),)),
        Block(
            Box(x1 + INNER, OUTER, x1 + INNER + beside, top),
            (Front("left", y0, top),),
        ),
        Block(
            Box(left, y1 + INNER, x0 - INNER, top),
            (Front("bottom", left, x0 - INNER), Front("right", y1 + INNER, top)),
        ),
    ]
    plan.places = [("corner", (x0 + x1) / 2, (y0 + y1) / 2)]
    return plan


def _round(s: Sizes, length: int, *, closed: bool) -> Layout:
    """Hallways round a core: a ring, or a U that is open at the top."""
    below, above, west, east = s.depth
    has_west, has_east = s.coin[2], s.coin[3]
    x0 = OUTER + (west + INNER if has_west else 0)
    x1 = x0 + s.hall[1]
    long, short = max(length, s.depth[0]), 2 * _between(s.depth[0] // 2, s.share[0] * length / 2)
    across, up = (long, short) if closed else (short, long)
    x2 = x1 + INNER + across + INNER
    x3 = x2 + s.hall[2]
    y0 = OUTER + below + INNER
    y1 = y0 + s.hall[0]
    y2 = y1 + INNER + up + (INNER if closed else 0)
    y3 = y2 + (s.hall[3] if closed else 0)
    has_north = closed and s.coin[0]
    width = x3 + (INNER + east if has_east else 0) + OUTER
    height = y3 + (INNER + above if has_north else 0) + OUTER
    plan = Layout(width, height)
    plan.halls = [Box(x0, y0, x3, y1), Box(x0, y0, x1, y3), Box(x2, y0, x3, y3)]
    if closed:
        plan.halls.append(Box(x0, y2, x3, y3))
    inside = Box(x1 + INNER, y1 + INNER, x2 - INNER, y2 - (INNER if closed else 0))
    outside = Block(Box(OUTER, OUTER, width - OUTER, OUTER + below), (Front("top", x0, x3),))
    plan.blocks = [outside, *_core(inside, closed=closed)]
    if has_west:
        plan.blocks.append(Block(Box(OUTER, y0, OUTER + west, y3), (Front("right", y0, y3),)))
    if has_east:
        box = Box(x3 + INNER, y0, x3 + INNER + east, y3)
        plan.blocks.append(Block(box, (Front("left", y0, y3),)))
    if has_north:
        box = Box(OUTER, y3 + INNER, width - OUTER, y3 + INNER + above)
        plan.blocks.append(Block(box, (Front("bottom", x0, x3),)))
    middles_y = [(y0 + y1) / 2, (y2 + y3) / 2] if closed else [(y0 + y1) / 2]
    plan.places = [("corner", x, y) for y in middles_y for x in ((x0 + x1) / 2, (x2 + x3) / 2)]
    return plan


def _between(least: int, wanted: float) -> int:
    """Return a depth that grows with the building, but not to that of a barn."""
    return max(least, min(round(wanted), DEEPEST))


def _core(box: Box, *, closed: bool) -> list[Block]:
    """Return what the hallways of a ring or U go round: one block, or two back to back."""
    bottom, top = Front("bottom", box.x0, box.x1), Front("top", box.x0, box.x1)
    left, right = Front("left", box.y0, box.y1), Front("right", box.y0, box.y1)
    if closed and box.y1 - box.y0 >= DEEP:
        middle = (box.y0 + box.y1) // 2
        low, high = box._replace(y1=middle), box._replace(y0=middle + INNER)
        return [
            Block(low, (bottom, left._replace(high=middle), right._replace(high=middle))),
            Block(high, (top, left._replace(low=high.y0), right._replace(low=high.y0))),
        ]
    if not closed and box.x1 - box.x0 >= DEEP:
        middle = (box.x0 + box.x1) // 2
        low, high = box._replace(x1=middle), box._replace(x0=middle + INNER)
        return [
            Block(low, (bottom._replace(high=middle), left)),
            Block(high, (bottom._replace(low=high.x0), right)),
        ]
    return [Block(box, (bottom, left, right, top) if closed else (bottom, left, right))]


def _u(s: Sizes, length: int) -> Layout:
    return _round(s, length, closed=False)


def _ring(s: Sizes, length: int) -> Layout:
    return _round(s, length, closed=True)


def _side(name: str) -> Side:
    return "right" if name == "right" else "left"


_MAKERS: dict[Shape, Callable[[Sizes, int], Layout]] = {
    "straight": _straight,
    "L": _l,
    "T": _t,
    "X": _x,
    "U": _u,
    "ring": _ring,
}
