"""What a generated building is laid out with: hallways, and blocks between them for rooms.

Everything here is counted in cells of 5 cm, so that walls meet exactly.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal, NamedTuple, get_args

from ssrics_like.world.locations import Kind

Side = Literal["bottom", "top", "left", "right"]
Shape = Literal["straight", "L", "T", "X", "U", "ring"]
SHAPES: tuple[Shape, ...] = get_args(Shape)
FEWEST = {"straight": 2, "L": 4, "T": 5, "X": 6, "U": 6, "ring": 7}
"""Shape of the hallways -> the fewest rooms that a building with it has."""

CELLS_A_M = 20
OUTER, INNER = 4, 3  # thickness of walls: 0.2 m and 0.15 m


def cells(length_m: float) -> int:
    """Return a length in whole cells."""
    return round(length_m * CELLS_A_M)


class Box(NamedTuple):
    """A rectangle of cells: from (x0, y0) to before (x1, y1)."""

    x0: int
    y0: int
    x1: int
    y1: int


class Front(NamedTuple):
    """A side of a block along which a hallway runs, from `low` to before `high`."""

    side: Side
    low: int
    high: int

    @property
    def length(self) -> int:
        """Its length in cells."""
        return self.high - self.low


class Block(NamedTuple):
    """What rooms are cut out of."""

    box: Box
    fronts: tuple[Front, ...]

    @property
    def front(self) -> Front:
        """The longest front: rooms stand side by side along it."""
        return max(self.fronts, key=lambda front: front.length)

    @property
    def depth(self) -> int:
        """How far the block reaches away from its longest front."""
        box = self.box
        upright = self.front.side in ("bottom", "top")
        return box.y1 - box.y0 if upright else box.x1 - box.x0


@dataclass
class Layout:
    """Hallways and blocks.

    Attributes
    ----------
    width, height : int
        Size of the building, outer walls included.
    halls : list of Box
        Hallways; where they meet they overlap.
    blocks : list of Block
        Between the hallways, walls not included.
    places : list of (kind, x, y)
        Middles of junctions and corners.
    """

    width: int
    height: int
    halls: list[Box] = field(default_factory=list)
    blocks: list[Block] = field(default_factory=list)
    places: list[tuple[Kind, float, float]] = field(default_factory=list)

    @property
    def frontage(self) -> int:
        """Length of all blocks' longest fronts."""
        return sum(block.front.length for block in self.blocks)
