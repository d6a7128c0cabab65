"""A floor plan in vectors: rooms and hallways, the passages between them, what stands in them.

What is neither a space nor a passage is solid.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, Any, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, field_validator

from ssrics_like.errors import MapError
from ssrics_like.world.building import Building
from ssrics_like.world.buildings.pieces import Coordinate, Length, Piece, patch
from ssrics_like.world.grid import FREE, OCCUPIED, GridMap
from ssrics_like.world.locations import Location

CELL_M = 0.05
CELLS_MAX = 100_000_000
"""In a map. 5 cm cells of a square kilometre are four times as many."""


def pair(value: Any) -> Any:
    """Say plainly what is wrong with a pair of numbers; for pydantic, before it looks closer."""
    if isinstance(value, list | tuple) and len(value) != 2:  # noqa: PLR2004 - from and to
        raise ValueError(f"{list(value)}: expected two numbers")
    return value


Span = Annotated[tuple[Coordinate, Coordinate], Field(strict=False), BeforeValidator(pair)]


class _Strict(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid", strict=True, allow_inf_nan=False)


class Rectangle(_Strict):
    """A rectangle along the axes; of itself, a wall inside a space.

    Attributes
    ----------
    x_m, y_m : tuple of float
        From and to, metres.
    """

    x_m: Span
    y_m: Span

    @field_validator("x_m", "y_m")
    @classmethod
    def _rises(cls, span: tuple[float, float]) -> tuple[float, float]:
        if not span[0] < span[1]:
            raise ValueError(f"{list(span)}: expected [from, to] with from less than to")
        return span

    @property
    def area_m2(self) -> float:
        """Its area in square metres."""
        return (self.x_m[1] - self.x_m[0]) * (self.y_m[1] - self.y_m[0])

    @property
    def middle(self) -> tuple[float, float]:
        """Its middle."""
        return (self.x_m[0] + self.x_m[1]) / 2, (self.y_m[0] + self.y_m[1]) / 2


class Space(Rectangle):
    """Free floor; spaces that overlap or touch are one.

    Attributes
    ----------
    id : str
        Its name.
    kind : {"room", "hallway"}
        What it is for.
    """

    id: Annotated[str, Field(min_length=1)]
    kind: Literal["room", "hallway"] = "room"


class Passage(_Strict):
    """A gap cut through a wall.

    Attributes
    ----------
    id : str
        Its name as a labelled location; empty if it is none.
    label : str
        What people call it.
    kind : {"doorway", "opening"}
        A doorway is narrow and framed by walls, an opening is wide or has no frame.
    x_m, y_m : float
        Its middle.
    axis : {"x", "y"}
        The direction in which one walks through.
    width_m : float
        Its clear width.
    depth_m : float
        How much is cut along the axis: the wall's thickness, or more if there is floor behind.
    """

    id: str = ""
    label: str = ""
    kind: Literal["doorway", "opening"] = "doorway"
    x_m: Coordinate
    y_m: Coordinate
    axis: Literal["x", "y"]
    width_m: Length
    depth_m: Length = 0.4

    @property
    def cut(self) -> Rectangle:
        """What is cut out."""
        along, across = self.depth_m / 2, self.width_m / 2
        half_x, half_y = (along, across) if self.axis == "x" else (across, along)
        return Rectangle(
            x_m=(self.x_m - half_x, self.x_m + half_x), y_m=(self.y_m - half_y, self.y_m + half_y)
        )


@dataclass(frozen=True)
class Plan:
    """A floor plan.

    Attributes
    ----------
    title : str
        What it is the plan of.
    width_m, height_m : float
        Its size.
    spaces : tuple of Space
        Rooms and hallways.
    passages : tuple of Passage
        Doorways and openings.
    walls : tuple of Rectangle
        Solid parts of spaces; passages are cut through them too.
    furniture : tuple of Piece
        What stands about.
    places : tuple of Location
        Labelled places that are not passages: junctions, corners.
    """

    title: str
    width_m: float
    height_m: float
    spaces: tuple[Space, ...]
    passages: tuple[Passage, ...] = ()
    walls: tuple[Rectangle, ...] = ()
    furniture: tuple[Piece, ...] = ()
    places: tuple[Location, ...] = ()

    @property
    def locations(self) -> tuple[Location, ...]:
        """All labelled places: passages that have a name, then the others."""
        passages = (Location(p.id, p.x_m, p.y_m, p.label, p.kind) for p in self.passages if p.id)
        return (*passages, *self.places)


def draw(plan: Plan, cell_m: float = CELL_M) -> GridMap:
    """Draw a plan as a grid; its frame is both the map frame and the grid frame.

    Edges that lie on cell boundaries are exact; others move to the nearest boundary.

    Parameters
    ----------
    plan : Plan
        The plan.
    cell_m : float
        Side of a cell, metres.

    Raises
    ------
    MapError
        The grid would have more than 100 million cells.
    """
    rows, columns = (math.ceil(round(s / cell_m, 6)) for s in (plan.height_m, plan.width_m))
    if rows * columns > CELLS_MAX:
        raise MapError(
            f"a plan of {plan.width_m:g} x {plan.height_m:g} m has {rows * columns} cells of "
            f"{cell_m:g} m, expected at most {CELLS_MAX}"
        )
    cells = np.full((rows, columns), OCCUPIED, np.uint8)
    for space in plan.spaces:
        cells[window(space, cell_m)] = FREE
    for wall in plan.walls:
        cells[window(wall, cell_m)] = OCCUPIED
    for passage in plan.passages:
        cells[window(passage.cut, cell_m)] = FREE
    for piece in plan.furniture:
        put(piece, cells, cell_m)
    return GridMap(cells, cell_m)


def build(plan: Plan, cell_m: float = CELL_M) -> Building:
    """Draw a plan as a building; `draw` says how and what is refused."""
    return Building(plan.title, draw(plan, cell_m), plan.locations)


def put(piece: Piece, cells: NDArray[np.uint8], cell_m: float) -> None:
    """Make the cells solid that a piece takes up."""
    taken = patch(piece, (cells.shape[0], cells.shape[1]), cell_m)
    cells[taken.rows, taken.columns][taken.cells] = OCCUPIED


def window(area: Rectangle, cell_m: float) -> tuple[slice, slice]:
    """Return the rows and columns of a grid whose middles lie in a rectangle."""

    def cut(span: tuple[float, float]) -> slice:
        # Rounded first: 0.15 / 0.05 is a little less than 3.
        first, last = (max(0, math.floor(round(edge / cell_m, 6) + 0.5)) for edge in span)
        return slice(first, last)

    return cut(area.y_m), cut(area.x_m)
