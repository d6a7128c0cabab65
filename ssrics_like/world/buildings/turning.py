"""Mirrored and turned buildings: one layout in eight ways."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ssrics_like.world.buildings.layout import Box


class Turning(NamedTuple):
    """A mirroring of a rectangle of cells.

    Attributes
    ----------
    width, height : int
        Of the rectangle before.
    flip_x, flip_y : bool
        Whether left and right, top and bottom are swapped.
    swap : bool
        Whether x and y are swapped afterwards.
    """

    width: int
    height: int
    flip_x: bool
    flip_y: bool
    swap: bool

    @classmethod
    def drawn(cls, width: int, height: int, rng: np.random.Generator) -> Turning:
        """Draw one of the eight ways."""
        flip_x, flip_y, swap = (bool(coin) for coin in rng.integers(2, size=3))
        return cls(width, height, flip_x, flip_y, swap)

    def size(self) -> tuple[int, int]:
        """Return width and height after it."""
        return (self.height, self.width) if self.swap else (self.width, self.height)

    def point(self, x: float, y: float) -> tuple[float, float]:
        """Return where a point comes to lie."""
        x = self.width - x if self.flip_x else x
        y = self.height - y if self.flip_y else y
        return (y, x) if self.swap else (x, y)

    def way(self, way: tuple[int, int]) -> tuple[int, int]:
        """Return which way a direction points afterwards."""
        x, y = (-way[0] if self.flip_x else way[0]), (-way[1] if self.flip_y else way[1])
        return (y, x) if self.swap else (x, y)

    def box(self, box: Box) -> Box:
        """Return where a box comes to lie."""
        (x0, y0), (x1, y1) = self.point(box.x0, box.y0), self.point(box.x1, box.y1)
        return Box(int(min(x0, x1)), int(min(y0, y1)), int(max(x0, x1)), int(max(y0, y1)))
