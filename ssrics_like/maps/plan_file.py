"""Floor plans as YAML files: what a map is drawn from."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Annotated

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field

from ssrics_like import settings
from ssrics_like.atomic import write_atomically
from ssrics_like.errors import MapError, SettingsError
from ssrics_like.maps.map_file import LocationEntry
from ssrics_like.maps.yaml_text import yaml_text
from ssrics_like.settings import Document, Key
from ssrics_like.world.buildings.pieces import Length, Piece
from ssrics_like.world.buildings.plan import (
    CELL_M,
    Passage,
    Plan,
    Rectangle,
    Space,
    draw,
    pair,
    window,
)
from ssrics_like.world.grid import FREE

Size = Annotated[tuple[Length, Length], Field(strict=False), BeforeValidator(pair)]
LIST = Field(strict=False)  # YAML has lists, not tuples


class PlanFile(BaseModel):
    """A floor plan; what is neither a space nor a passage is solid.

    Attributes
    ----------
    title : str
        What it is the plan of.
    size_m : tuple of float
        Width and height.
    spaces, passages, walls, furniture, locations : tuple
        As `ssrics_like.world.buildings.plan.Plan` has them; its places are called locations here.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True, allow_inf_nan=False)

    title: str = ""
    size_m: Size
    spaces: Annotated[tuple[Space, ...], LIST, Field(min_length=1)]
    passages: Annotated[tuple[Passage, ...], LIST] = ()
    walls: Annotated[tuple[Rectangle, ...], LIST] = ()
    furniture: Annotated[tuple[Piece, ...], LIST] = ()
    locations: Annotated[tuple[LocationEntry, ...], LIST] = ()

    def plan(self, title: str) -> Plan:
        """Return it as the world's own kind of value; `title` stands in where the file has none."""
        width_m, height_m = self.size_m
        places = tuple(entry.location() for entry in self.locations)
        return Plan(
            self.title or title, width_m, height_m, self.spaces, self.passages, self.walls,
            self.furniture, places,
        )  # fmt: skip


def load_plan(path: Path) -> Plan:
    """Read a floor plan.

    Raises
    ------
    MapError
        With one line for each thing that is wrong: a key or value, an id that stands twice,
        what lies outside the plan, a passage that leads into a wall.
    """
    try:
        document = settings.read_document(path)
        if "image" in document.data and "spaces" not in document.data:
            raise MapError(f"{path}: is a map already drawn, expected a floor plan")
        file = settings.validated(PlanFile, document)
    except SettingsError as e:
        raise MapError(str(e)) from None
    plan = file.plan(path.name.split(".")[0])
    problems = [*_twice(file), *_outside(file)] or [*_blind(plan)]
    if problems:
        problems.sort(key=lambda problem: _place(document, problem[0]))
        raise MapError("\n".join(f"{document.where(key)}: {text}" for key, text in problems))
    return plan


def save_plan(plan: Plan, path: Path) -> None:
    """Write a floor plan as a file that `load_plan` reads.

    Raises
    ------
    MapError
        The file cannot be written.
    """
    data = {
        "title": plan.title,
        "size_m": [plan.width_m, plan.height_m],
        "spaces": [_plain(space, "id", "kind") for space in plan.spaces],
        "passages": [_plain(passage, "id") for passage in plan.passages],
        "walls": [_plain(wall) for wall in plan.walls],
        "furniture": [_plain(piece) for piece in plan.furniture],
        "locations": [
            {"id": p.id, "x_m": p.x_m, "y_m": p.y_m, "label": p.label, "kind": p.kind}
            for p in plan.places
        ],
    }
    # One line for each space, passage or piece.
    lines = []
    for key, value in data.items():
        if isinstance(value, list) and value and isinstance(value[0], dict):
            lines.append(f"{key}:\n")
            lines += [f"  - {yaml_text(item, flow=True)}" for item in value]
        elif value:
            lines.append(yaml_text({key: value}, flow=None if isinstance(value, list) else False))
    try:
        write_atomically(path, "".join(lines))
    except OSError as e:
        raise MapError(f"{path}: cannot be written ({e.strerror})") from None


def _plain(model: BaseModel, *first: str) -> dict[str, object]:
    """Return what differs from the defaults, with some keys in front."""
    data = model.model_dump(mode="json", exclude_defaults=True)
    return {key: data[key] for key in (*first, *data) if key in data}


def _twice(file: PlanFile) -> Iterator[tuple[Key, str]]:
    """Find ids that stand twice: among the spaces, and among the labelled places."""
    passages = [(("passages", i, "id"), p.id) for i, p in enumerate(file.passages) if p.id]
    places = [(("locations", i, "id"), p.id) for i, p in enumerate(file.locations)]
    spaces = [(("spaces", i, "id"), s.id) for i, s in enumerate(file.spaces)]
    for named in (spaces, passages + places):
        seen: set[str] = set()
        for key, name in named:
            if name in seen:
                yield key, f"{'.'.join(map(str, key))}: '{name}' stands twice"
            seen.add(name)


def _outside(file: PlanFile) -> Iterator[tuple[Key, str]]:
    """Find what does not lie within the plan."""
    width_m, height_m = file.size_m
    spans: list[tuple[Key, tuple[float, float], float]] = []
    for kind in ("spaces", "walls"):
        for i, area in enumerate(getattr(file, kind)):
            spans += [((kind, i, "x_m"), area.x_m, width_m), ((kind, i, "y_m"), area.y_m, height_m)]
    for kind in ("passages", "furniture", "locations"):
        for i, item in enumerate(getattr(file, kind)):
            spans += [((kind, i, "x_m"), (item.x_m, item.x_m), width_m)]
            spans += [((kind, i, "y_m"), (item.y_m, item.y_m), height_m)]
    for key, (low, high), limit in spans:
        if low < 0 or high > limit:
            shown = f"{low:g}" if low == high else f"[{low:g}, {high:g}]"
            yield key, f"{'.'.join(map(str, key))}: {shown}: expected within 0 and {limit:g}"


def _blind(plan: Plan) -> Iterator[tuple[Key, str]]:
    """Find passages with no floor at one end: they do not cut through the whole wall."""
    try:
        cells = draw(replace(plan, furniture=())).cells
    except MapError as e:
        yield ("size_m",), f"size_m: {e}"
        return
    half = CELL_M / 2
    for i, passage in enumerate(plan.passages):
        low, high = passage.cut.x_m if passage.axis == "x" else passage.cut.y_m
        for end in (low - half, high + half):
            x_m, y_m = (end, passage.y_m) if passage.axis == "x" else (passage.x_m, end)
            spot = Rectangle(x_m=(x_m - half, x_m + half), y_m=(y_m - half, y_m + half))
            if not (cells[window(spot, CELL_M)] == FREE).any():
                said = f"passages.{i}: leads into solid wall at {passage.axis} = {end:g}"
                yield ("passages", i), f"{said}; is it on the wall, and depth_m great enough?"


def _place(document: Document, key: Key) -> tuple[int, int]:
    mark = document.marks.get(key)
    return (mark.line, mark.column) if mark else (0, 0)
