"""``ssrics map``: floor plans drawn, made up, looked at."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from ssrics_like.cli.options import NeededOut, Out, Pair, Whole

if TYPE_CHECKING:
    from ssrics_like.world.building import Building


def draw(plan: Path, *, out: Out = None, cell: float = 0.05) -> None:
    """Draw a map from a floor plan: the YAML file and the picture that a robot's map is.

    For example:

        ssrics map draw office.plan.yaml
        ssrics map draw office.plan.yaml -o maps/office.yaml

    Parameters
    ----------
    plan
        A floor plan in YAML.
    out
        The map's YAML file; the picture stands beside it. OFFICE.yaml beside OFFICE.plan.yaml if
        left out.
    cell
        Side of a cell, metres.
    """
    from ssrics_like.maps import load_plan, save_building
    from ssrics_like.world.buildings.plan import build

    _check_cell(cell)
    building = build(load_plan(plan), cell)
    where = _map_of(plan, out)
    print(_said(save_building(building, where.parent, where.stem), building))


def generate(
    *,
    out: NeededOut,
    seed: Whole = 2006,
    count: Whole = 1,
    name: str = "map",
    rooms: Whole = 9,
    hallways: str = "any",
    scale: Pair = (0.85, 1.25),
    doorway: Pair = (0.85, 1.1),
    hallway: Pair = (1.6, 2.4),
    openings: float = 0.15,
    suites: float = 0.15,
    connecting: float = 0.1,
    clutter: float = 0.5,
    leaves: float = 0.4,
) -> None:
    """Make furnished buildings up: maps with their doorways, openings, junctions and corners.

    The plan that a map was drawn from is written too, to be changed and drawn again.

    For example:

        ssrics map generate -o maps/ --seed 7
        ssrics map generate -o maps/ --count 20 --rooms 14 --hallways ring

    Parameters
    ----------
    out
        Folder for the maps.
    seed
        Same seed, same building. With --count, the first of seeds that follow each other.
    count
        How many buildings; their names carry their seeds.
    name
        What the files are called.
    rooms
        How many rooms each has.
    hallways
        How they run: straight, L, T, X, U, ring or any.
    scale
        Least and greatest factor on the size of rooms.
    doorway
        Narrowest and widest doorway, metres.
    hallway
        Narrowest and widest hallway, metres.
    openings
        Share of rooms that are open to the hallway, 0 to 1.
    suites
        Share of rooms that are reached through another room.
    connecting
        Share of walls between neighbours that have a doorway.
    clutter
        How much furniture there is, 0 to 1.
    leaves
        Share of doorways whose door stands open.
    """
    import dataclasses

    import numpy as np
    from pydantic import ValidationError

    from ssrics_like import settings
    from ssrics_like.errors import MapError
    from ssrics_like.maps import save_building, save_plan
    from ssrics_like.world.buildings import generator
    from ssrics_like.world.buildings.plan import build

    if count < 1 or seed < 0:
        raise MapError("count: expected 1 or more" if count < 1 else "seed: expected 0 or more")
    if not name or Path(name).name != name:
        raise MapError(f"name: '{name}': expected a file's name without a folder")
    wanted = {
        "rooms": rooms, "hallways": hallways, "scale": scale, "doorway_m": doorway,
        "hallway_m": hallway, "openings": openings, "suites": suites, "connecting": connecting,
        "clutter": clutter, "leaves": leaves,
    }  # fmt: skip
    try:
        chosen = generator.BuildingSettings.model_validate(wanted)
    except ValidationError as e:
        lines = settings.explain(generator.BuildingSettings, e, wanted)
        raise MapError("\n".join(text for _, text in lines)) from None
    for k in range(count):
        plan = generator.generate(np.random.default_rng(seed + k), chosen)
        plan = dataclasses.replace(plan, title=f"{plan.title}, seed {seed + k}")
        building = build(plan)
        stem = f"{name}-{seed + k}" if count > 1 else name
        path = save_building(building, out, stem)
        save_plan(plan, out / f"{stem}.plan.yaml")
        print(_said(path, building))


def show(file: Path, *, out: NeededOut, locations: Path | None = None) -> None:
    """Draw a picture of a map or plan, with its labelled places, to look at.

    For example:

        ssrics map show office.yaml -o office-picture.png
        ssrics map show office.yaml -o doors.svg --locations doors.csv

    Parameters
    ----------
    file
        A map's YAML file, or a floor plan.
    out
        The picture; its ending says which kind: .png, .svg or .pdf.
    locations
        Labelled places to show instead of the map's own, as CSV.
    """
    import dataclasses

    from ssrics_like.errors import MapError
    from ssrics_like.maps import is_plan, load_building, load_locations, load_plan
    from ssrics_like.report.building_figure import PICTURES, save_picture
    from ssrics_like.world.buildings.plan import build

    if out.suffix.lower() not in PICTURES:
        raise MapError(f"{out}: expected a picture's name ending in {', '.join(PICTURES)}")
    building = build(load_plan(file)) if is_plan(file) else load_building(file)
    if out.exists() and out.resolve() in _own_files(file):
        raise MapError(f"{out}: belongs to the map itself; choose another name")
    if locations is not None:
        building = dataclasses.replace(building, locations=load_locations(locations))
    save_picture(building, out)
    print(_said(out, building))


def _map_of(plan: Path, out: Path | None) -> Path:
    """Return the name of the map that is drawn from a plan."""
    from ssrics_like.errors import MapError

    name = plan.name.removesuffix(".yaml").removesuffix(".plan") + ".yaml"
    where = plan.parent / name if out is None else out
    if where.is_dir():
        where = where / name
    if where.suffix != ".yaml":
        raise MapError(f"{where}: expected a name ending in .yaml")
    if where.resolve() == plan.resolve():
        raise MapError(f"{plan}: the map would take the plan's place; name it with -o")
    return where


def _check_cell(cell: float) -> None:
    from ssrics_like.errors import MapError

    if not 0.001 <= cell <= 10:  # noqa: PLR2004 - a millimetre to ten metres
        raise MapError(f"cell: {cell:g}: expected metres, 0.001 to 10")


def _own_files(file: Path) -> set[Path]:
    """Return a map's files, which a picture of it must not take the place of."""
    from ssrics_like import settings

    image = settings.read_document(file).data.get("image")
    own = [file, file.parent / image] if isinstance(image, str) else [file]
    return {path.resolve() for path in own}


def _said(path: Path, building: Building) -> str:
    width_m, height_m = building.grid.size_m
    places = len(building.locations)
    return (
        f"{path}: '{building.title}', {width_m:g} x {height_m:g} m, "
        f"{places} location{'' if places == 1 else 's'}"
    )
