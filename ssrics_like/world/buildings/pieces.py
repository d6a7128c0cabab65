"""Furniture as a laser at shin height sees it: boxes, round things, legs."""

from __future__ import annotations

import math
from typing import Annotated, Literal, NamedTuple, get_args

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict, Field

PieceKind = Literal["box", "round", "table", "chair", "desk"]
PIECE_KINDS: tuple[str, ...] = get_args(PieceKind)

LEG_M = 0.06
DRAWERS_M = 0.42
"""Width of the drawer unit that one side of a desk stands on."""
SQUARE_RAD = 1e-3

Length = Annotated[float, Field(gt=0.0, le=1000.0)]
Coordinate = Annotated[float, Field(ge=-1e6, le=1e6)]


class Piece(BaseModel):
    """A piece of furniture.

    Attributes
    ----------
    kind : {"box", "round", "table", "chair", "desk"}
        A box is solid (cupboard, shelf, sofa, crate, door leaf), and so is a round thing
        (pillar, bin, plant). A table and a chair stand on four legs, a desk on drawers on its
        left and two legs on its right.
    x_m, y_m : float
        Its middle.
    width_m, depth_m : float
        Its sides before it is turned: along x and along y. The diameter of a round thing is its
        width; its depth is of no account.
    turn_rad : float
        How far it is turned about its middle, counter-clockwise.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True, allow_inf_nan=False)

    kind: PieceKind
    x_m: Coordinate
    y_m: Coordinate
    width_m: Length
    depth_m: Length = 0.5
    turn_rad: Annotated[float, Field(ge=-100.0, le=100.0)] = 0.0


class _Part(NamedTuple):
    """A solid part in the frame of its piece: middle, and half its sides."""

    x_m: float
    y_m: float
    half_width_m: float
    half_depth_m: float


class Patch(NamedTuple):
    """Some cells of a grid: a window of it, and which of the window's cells are meant."""

    rows: slice
    columns: slice
    cells: NDArray[np.bool_]


def patch(piece: Piece, shape: tuple[int, int], cell_m: float, *, whole: bool = False) -> Patch:
    """Return the cells of a grid that a piece makes solid.

    A cell is solid if its middle is. What is thinner than a cell still makes a line without
    gaps, or a single cell.

    Parameters
    ----------
    piece : Piece
        The piece, in the grid frame.
    shape : tuple of int
        Rows and columns of the grid; what lies outside is left out.
    cell_m : float
        Side of a cell, metres.
    whole : bool
        Return the cells under the whole piece instead: what lies between its legs as well.
    """
    half = math.hypot(piece.width_m, piece.depth_m) / 2
    if piece.kind == "round":
        half = piece.width_m / 2
    rows = _window(piece.y_m, half, shape[0], cell_m)
    columns = _window(piece.x_m, half, shape[1], cell_m)
    y = (np.arange(rows.start, rows.stop)[:, None] + 0.5) * cell_m - piece.y_m
    x = (np.arange(columns.start, columns.stop)[None, :] + 0.5) * cell_m - piece.x_m
    if piece.kind == "round":
        reach = max(piece.width_m / 2, cell_m * math.sqrt(0.5))
        return Patch(rows, columns, np.asarray(np.hypot(x, y) <= reach))
    cos, sin = _direction(piece.turn_rad)
    along, across = cos * x + sin * y, cos * y - sin * x
    # So thick that the line which a thin part makes has no gaps, however it is turned.
    thinnest = cell_m * max(abs(cos), abs(sin)) / 2
    cells = np.zeros(along.shape, np.bool_)
    parts = _parts(piece)
    if whole:
        parts.append(_Part(0.0, 0.0, piece.width_m / 2, piece.depth_m / 2))
    for part in parts:
        width = max(part.half_width_m, thinnest) + 1e-9
        depth = max(part.half_depth_m, thinnest) + 1e-9
        cells |= (np.abs(along - part.x_m) <= width) & (np.abs(across - part.y_m) <= depth)
        middle_x = cos * part.x_m - sin * part.y_m
        middle_y = sin * part.x_m + cos * part.y_m
        cells |= (np.abs(x - middle_x) <= cell_m / 2) & (np.abs(y - middle_y) <= cell_m / 2)
    return Patch(rows, columns, cells)


def _direction(turn_rad: float) -> tuple[float, float]:
    """Return cosine and sine, exactly 0 and 1 for a square turn that is written as 1.5708."""
    quarters = round(turn_rad / (math.pi / 2))
    if abs(turn_rad - quarters * math.pi / 2) < SQUARE_RAD:
        return ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[quarters % 4]
    return math.cos(turn_rad), math.sin(turn_rad)


def _parts(piece: Piece) -> list[_Part]:
    half_width, half_depth = piece.width_m / 2, piece.depth_m / 2
    if piece.kind == "box":
        return [_Part(0.0, 0.0, half_width, half_depth)]
    leg = min(LEG_M / 2, half_width, half_depth)
    x, y = half_width - leg, half_depth - leg
    right = [_Part(x, y, leg, leg), _Part(x, -y, leg, leg)]
    if piece.kind == "desk":
        drawers = min(DRAWERS_M / 2, half_width)
        return [_Part(drawers - half_width, 0.0, drawers, half_depth), *right]
    return [*right, _Part(-x, y, leg, leg), _Part(-x, -y, leg, leg)]


def _window(middle_m: float, half_m: float, cells: int, cell_m: float) -> slice:
    """Return the cells of one axis that a piece may touch, with one to spare at both ends."""
    first = math.floor((middle_m - half_m) / cell_m) - 1
    last = math.ceil((middle_m + half_m) / cell_m) + 1
    first = min(max(first, 0), cells)
    return slice(first, max(min(last, cells), first))
