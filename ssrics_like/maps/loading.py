"""From a map's YAML file, its picture and its tables to a building."""

from __future__ import annotations

from pathlib import Path

from ssrics_like import settings
from ssrics_like.errors import MapError, SettingsError
from ssrics_like.maps.image import GreyImage, read_image
from ssrics_like.maps.map_file import MapFile
from ssrics_like.maps.names import misspelt
from ssrics_like.maps.places import load_choices, read_locations
from ssrics_like.world.building import Building
from ssrics_like.world.grid import FREE, GridMap
from ssrics_like.world.locations import Location


def load_building(path: Path) -> Building:
    """Read a map: a YAML file as ROS map_server has it, and the picture that it names.

    Parameters
    ----------
    path : Path
        The YAML file.

    Returns
    -------
    Building
        Its title is the file's name if the file gives none.

    Raises
    ------
    MapError
        With one line for each thing that is wrong, in the file, the picture or a table of
        places.
    """
    document = _document(path)
    if "spaces" in document.data and "image" not in document.data:
        raise MapError(f"{path}: is a floor plan, expected a map (ssrics map draw makes one of it)")
    problems: list[str] = []
    table = _lift_table(document)
    file = _checked(document, problems)
    image = _image(document, problems)
    places = _places(document, file, table, problems)
    grid = file.grid(image) if file and image else None
    if file and grid:
        problems += _off_the_map(grid, places)
        if not (grid.cells == FREE).any():
            problems.append(f"{document.where(('image',))}: image: no cell of the map is free")
    if problems or not file or not grid:
        raise MapError("\n".join(_in_order(document, problems)))
    return Building(file.title or path.stem, grid, tuple(place for _, place in places))


def humans_file(path: Path) -> Path | None:
    """Return the file of people's landmarks that a map names, or None.

    Raises
    ------
    MapError
        The map's YAML file is wrong.
    """
    document = _document(path)
    _lift_table(document)
    problems: list[str] = []
    file = _checked(document, problems)
    if file is None or problems:
        raise MapError("\n".join(_in_order(document, problems)))
    return None if file.humans is None else path.parent / file.humans


def is_plan(path: Path) -> bool:
    """Tell whether a YAML file is a floor plan rather than a map.

    Raises
    ------
    MapError
        It cannot be read.
    """
    return "spaces" in _document(path).data


def _document(path: Path) -> settings.Document:
    try:
        return settings.read_document(path)
    except SettingsError as e:
        raise MapError(str(e)) from None


def _lift_table(document: settings.Document) -> str | None:
    """Take out the path of a table of locations, which stands where a list may stand."""
    if isinstance(document.data.get("locations"), str):
        return str(document.data.pop("locations"))
    return None


def _checked(document: settings.Document, problems: list[str]) -> MapFile | None:
    """Check the keys, passing over those that other programs have for themselves."""
    known = MapFile.model_fields
    document.data = {
        key: value for key, value in document.data.items() if key in known or misspelt(key, known)
    }
    humans = document.data.get("humans")
    if isinstance(humans, str) and humans:
        try:
            load_choices(document.path.parent / humans)
        except MapError as e:
            where = document.where(("humans",))
            problems += [f"{where}: humans: {line}" for line in str(e).splitlines()]
    problems += _twice(document)
    try:
        return settings.validated(MapFile, document)
    except SettingsError as e:
        problems += str(e).splitlines()
        return None


def _twice(document: settings.Document) -> list[str]:
    """Find ids that stand twice, whatever else may be wrong."""
    entries = document.data.get("locations")
    problems = []
    first: dict[str, str] = {}
    for i, entry in enumerate(entries if isinstance(entries, list) else []):
        if not isinstance(entry, dict) or "id" not in entry:
            continue
        name, where = str(entry["id"]), document.where(("locations", i, "id"))
        if name in first:
            line = first[name].removeprefix(f"{document.path}:").partition(":")[0]
            problems.append(
                f"{where}: locations.{i}.id: '{name}' stands twice (first in line {line})"
            )
        first.setdefault(name, where)
    return problems


def _image(document: settings.Document, problems: list[str]) -> GreyImage | None:
    """Read the picture, even if something else is wrong, so that its problems show as well."""
    name = document.data.get("image")
    if not isinstance(name, str) or not name:
        return None
    try:
        return read_image(document.path.parent / name)
    except MapError as e:
        problems.append(f"{document.where(('image',))}: image: {e}")
        return None


def _places(
    document: settings.Document, file: MapFile | None, table: str | None, problems: list[str]
) -> list[tuple[str, Location]]:
    """Return each location with where it is written."""
    where = document.where(("locations",))
    if table is not None:
        try:
            return read_locations(document.path.parent / table)
        except MapError as e:
            problems += [f"{where}: locations: {line}" for line in str(e).splitlines()]
            return []
    return [
        (document.where(("locations", i, "id")), entry.location())
        for i, entry in enumerate(file.locations if file else ())
    ]


def _off_the_map(grid: GridMap, places: list[tuple[str, Location]]) -> list[str]:
    """Complain of locations that lie beyond the picture: they are of another map or frame."""
    problems = []
    for where, place in places:
        row, column = grid.cell_of(*grid.points_in_grid([[place.x_m, place.y_m]])[0])
        rows, columns = grid.cells.shape
        if not (0 <= row < rows and 0 <= column < columns):
            problems.append(
                f"{where}: location '{place.id}' at ({place.x_m:g}, {place.y_m:g}) lies off the map"
            )
    return problems


def _in_order(document: settings.Document, problems: list[str]) -> list[str]:
    """Sort problems by line and column; those of other files come last."""

    def place(problem: str) -> tuple[float, float]:
        before = f"{document.path}:"
        parts = problem.removeprefix(before).split(":") if problem.startswith(before) else []
        try:
            return float(parts[0]), float(parts[1])
        except (IndexError, ValueError):
            return (0.0, 0.0) if parts else (float("inf"), 0.0)

    return sorted(problems, key=place)
