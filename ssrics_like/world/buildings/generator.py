"""Buildings made up at random, furnished, with their truth: experiments need many buildings."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated, Literal

import numpy as np
from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, field_validator, model_validator

from ssrics_like.world.buildings.hallways import Sizes, lay_out
from ssrics_like.world.buildings.interior import fit_out
from ssrics_like.world.buildings.layout import (
    FEWEST,
    INNER,
    SHAPES,
    Box,
    Layout,
    Shape,
    cells,
)
from ssrics_like.world.buildings.plan import CELL_M, Passage, Plan, Rectangle, Space, draw, pair
from ssrics_like.world.buildings.rooms import SUITE_MIN, Gate, Habits, Rooms, cut, shared_out
from ssrics_like.world.buildings.turning import Turning
from ssrics_like.world.locations import Location
from ssrics_like.world.reachable import standing

DOORWAY_MIN_M = 0.85
"""A robot of 0.3 m radius passes it without scraping along."""
PROMISED_M = 0.3
"""A disc of this radius gets into every room."""
TRIES = 100

Share = Annotated[float, Field(ge=0.0, le=1.0)]
Range = Annotated[tuple[float, float], Field(strict=False), BeforeValidator(pair)]


class BuildingSettings(BaseModel):
    """What generated buildings are like.

    Attributes
    ----------
    rooms : int
        How many rooms.
    hallways : {"any", "straight", "L", "T", "X", "U", "ring"}
        How the hallways run. An L has a corner, a T and an X a junction, a U two corners and a
        ring four.
    scale : tuple of float
        Least and greatest factor on the size of rooms.
    doorway_m, hallway_m : tuple of float
        Narrowest and widest.
    openings : float
        Share of rooms that are open to the hallway, without a door's frame.
    suites : float
        Share of rooms that are reached through another room.
    connecting : float
        Share of walls between neighbours that have a doorway.
    clutter : float
        How much furniture there is, 0 (none) to 1.
    leaves : float
        Share of doorways whose door is there and stands open.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True, allow_inf_nan=False)

    rooms: Annotated[int, Field(ge=2, le=100)] = 9
    hallways: Literal["any", "straight", "L", "T", "X", "U", "ring"] = "any"
    scale: Range = (0.85, 1.25)
    doorway_m: Range = (DOORWAY_MIN_M, 1.1)
    hallway_m: Range = (1.6, 2.4)
    openings: Share = 0.15
    suites: Share = 0.15
    connecting: Share = 0.1
    clutter: Share = 0.5
    leaves: Share = 0.4

    @field_validator("scale")
    @classmethod
    def _scale(cls, value: tuple[float, float]) -> tuple[float, float]:
        return _within(value, 0.7, 3.0)

    @field_validator("doorway_m")
    @classmethod
    def _doorway(cls, value: tuple[float, float]) -> tuple[float, float]:
        return _within(value, DOORWAY_MIN_M, 1.8)

    @field_validator("hallway_m")
    @classmethod
    def _hallway(cls, value: tuple[float, float]) -> tuple[float, float]:
        return _within(value, 1.2, 6.0)

    @model_validator(mode="after")
    def _hallways_have_rooms(self) -> BuildingSettings:
        if self.hallways != "any" and self.rooms < FEWEST[self.hallways]:
            raise ValueError(
                f"rooms: {self.rooms}: expected at least {FEWEST[self.hallways]} "
                f"where hallways run as {self.hallways}"
            )
        return self


def _within(value: tuple[float, float], low: float, high: float) -> tuple[float, float]:
    if not low <= value[0] <= value[1] <= high:
        raise ValueError(f"{list(value)}: expected [from, to], rising, within {low:g} and {high:g}")
    return value


def generate(rng: np.random.Generator, settings: BuildingSettings | None = None) -> Plan:
    """Make a building up.

    A disc of radius 0.3 m gets from any hallway into every room.

    Parameters
    ----------
    rng : numpy.random.Generator
        Where chance comes from.
    settings : BuildingSettings, optional
        What it is to be like.

    Returns
    -------
    Plan
        Its locations are the truth: doorways D01, D02 ..., openings O01 ..., junctions J01 ...,
        corners C01 ..., each kind counted from the top left.
    """
    settings = settings or BuildingSettings()
    for _ in range(TRIES):
        plan = _attempt(rng, settings)
        if plan is not None and _is_whole(plan):
            return plan
    raise AssertionError(f"no building came of {TRIES} attempts with {settings}")


def _attempt(rng: np.random.Generator, settings: BuildingSettings) -> Plan | None:
    """Make a building, or None if the rooms do not come out as many as they are to be."""
    fitting = [shape for shape in SHAPES if FEWEST[shape] <= settings.rooms]
    shape: Shape = fitting[int(rng.integers(len(fitting)))]
    if settings.hallways != "any":
        shape = settings.hallways
    scale = float(rng.uniform(*settings.scale))
    sizes = Sizes(rng, settings.hallway_m, (4.2 * scale, 6.8 * scale))
    suites = min(int(rng.binomial(settings.rooms, settings.suites)), settings.rooms // 2)
    room_m = float(rng.uniform(3.2, 4.8)) * scale
    for divided in (suites, 0):  # where rooms are not deep enough to be divided, none is
        layout = lay_out(shape, sizes, (settings.rooms - divided) * (cells(room_m) + INNER))
        made = _rooms(layout, settings, divided, rng)
        if len(made.rooms) == settings.rooms:
            break
    else:
        return None
    turning = Turning.drawn(layout.width, layout.height, rng)
    title = f"Generated: {settings.rooms} rooms, hallways {shape}"
    plan, ways = _plan(title, layout, made, turning)
    furniture = fit_out(plan, ways, settings.clutter, settings.leaves, rng)
    return replace(plan, furniture=furniture)


def _rooms(
    layout: Layout, settings: BuildingSettings, suites: int, rng: np.random.Generator
) -> Rooms:
    """Cut all blocks into rooms."""
    habits = Habits(settings.doorway_m, settings.openings, settings.connecting)
    blocks = layout.blocks
    deep = np.array([block.depth >= 2 * SUITE_MIN + INNER for block in blocks])
    columns = max(settings.rooms - suites, len(blocks))
    counts = shared_out(blocks, columns)
    can = int(np.sum(np.array(counts)[deep]))
    if settings.rooms - sum(counts) > can:
        counts = shared_out(blocks, settings.rooms - can)
    places = np.repeat(np.arange(len(blocks)), counts)
    places = places[deep[places]]
    wanted = min(max(settings.rooms - sum(counts), 0), len(places))
    chosen = rng.choice(places, wanted, replace=False) if wanted else np.array([], int)
    made = Rooms()
    for i, (block, count) in enumerate(zip(blocks, counts, strict=True)):
        part = cut(block, count, int(np.sum(chosen == i)), habits, rng)
        made.rooms += part.rooms
        made.niches += part.niches
        made.walls += part.walls
        made.gates += part.gates
    return made


def _plan(
    title: str, layout: Layout, made: Rooms, turning: Turning
) -> tuple[Plan, dict[Passage, tuple[int, int]]]:
    """Turn cells into metres, and name what is there."""
    width, height = turning.size()
    spaces = []
    kinds: tuple[tuple[Literal["hallway", "room"], list[Box]], ...] = (
        ("hallway", [*layout.halls, *made.niches]),
        ("room", made.rooms),
    )
    for use, boxes in kinds:
        for i, box in enumerate(boxes, 1):
            area = _rectangle(turning.box(box))
            spaces.append(Space(id=f"{use} {i}", kind=use, x_m=area.x_m, y_m=area.y_m))
    ways: dict[Passage, tuple[int, int]] = {}
    for kind, letter in (("doorway", "D"), ("opening", "O")):
        gates = [gate for gate in made.gates if gate.kind == kind]
        gates.sort(key=lambda gate: _reading(*turning.point(gate.x, gate.y)))
        for i, gate in enumerate(gates, 1):
            ways[_passage(f"{letter}{i:02d}", gate, turning)] = turning.way(gate.into)
    places = []
    for kind, letter in (("junction", "J"), ("corner", "C")):
        points = [turning.point(x, y) for found, x, y in layout.places if found == kind]
        for i, (x, y) in enumerate(sorted(points, key=lambda point: _reading(*point)), 1):
            places.append(Location(f"{letter}{i:02d}", _metres(x), _metres(y), kind=kind))
    plan = Plan(
        title, _metres(width), _metres(height), tuple(spaces), tuple(ways),
        tuple(_rectangle(turning.box(box)) for box in made.walls), (), tuple(places),
    )  # fmt: skip
    return plan, ways


def _reading(x: float, y: float) -> tuple[float, float]:
    """Sort from the top left to the bottom right, as one reads."""
    return -y, x


def _passage(name: str, gate: Gate, turning: Turning) -> Passage:
    x, y = turning.point(gate.x, gate.y)
    return Passage(
        id=name, kind=gate.kind, x_m=_metres(x), y_m=_metres(y),
        axis="x" if turning.way(gate.into)[0] else "y", width_m=_metres(gate.width),
        depth_m=_metres(INNER),
    )  # fmt: skip


def _rectangle(box: Box) -> Rectangle:
    return Rectangle(x_m=(_metres(box.x0), _metres(box.x1)), y_m=(_metres(box.y0), _metres(box.y1)))


def _metres(count: float) -> float:
    return round(count * CELL_M, 4)


def _is_whole(plan: Plan) -> bool:
    """Tell whether the promised disc gets into every space of a plan."""
    grid = draw(plan)
    there = standing(grid, *plan.spaces[0].middle, PROMISED_M)
    rows, columns = (np.arange(n) + 0.5 for n in grid.cells.shape)
    for space in plan.spaces:
        inside_y = (space.y_m[0] < rows * CELL_M) & (rows * CELL_M < space.y_m[1])
        inside_x = (space.x_m[0] < columns * CELL_M) & (columns * CELL_M < space.x_m[1])
        if space.kind == "room" and not there[np.ix_(inside_y, inside_x)].any():
            return False
    return True
