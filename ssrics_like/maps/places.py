"""Tables of places: labelled locations, and what people chose as landmarks."""

from __future__ import annotations

from pathlib import Path

from ssrics_like.errors import nearest
from ssrics_like.maps.names import misspelt
from ssrics_like.maps.tables import Table
from ssrics_like.world.choices import Choice
from ssrics_like.world.locations import KINDS, Location


def load_locations(path: Path) -> tuple[Location, ...]:
    """Read labelled places from a CSV file.

    Columns ``id``, ``x_m`` and ``y_m``, and if you like ``label`` and ``kind``; others are
    passed over. A kind of somebody else's becomes ``other``; no kind means a doorway.

    Raises
    ------
    MapError
        With one line for each thing that is wrong.
    """
    return tuple(place for _, place in read_locations(path))


def read_locations(path: Path) -> list[tuple[str, Location]]:
    """Read labelled places as `load_locations` does, each with its ``file:line``."""
    table = Table(path, ("id", "x_m", "y_m"), ("label", "kind"))
    first: dict[str, int] = {}
    found = []
    for line, cells in table.rows:
        name = table.word(line, cells, "id")
        if name and name in first:
            table.problems.append(
                f"{path}:{line}: id '{name}' stands twice (first in line {first[name]})"
            )
        first.setdefault(name, line)
        kind = cells.get("kind", "") or "doorway"
        if kind not in KINDS:
            if misspelt(kind, KINDS):
                table.problems.append(
                    f"{path}:{line}: kind: unknown '{kind}'{nearest(kind, KINDS)}"
                )
            kind = "other"
        x_m, y_m = table.number(line, cells, "x_m"), table.number(line, cells, "y_m")
        place = Location(name, x_m, y_m, cells.get("label", ""), kind)
        found.append((f"{path}:{line}", place))
    table.finish()
    return found


def load_choices(path: Path) -> tuple[Choice, ...]:
    """Read people's landmarks from a CSV file.

    Columns ``participant``, ``landmark``, ``x_m`` and ``y_m``, and if you like ``label`` and
    ``t_s``, which may have empty cells; others are passed over.

    Raises
    ------
    MapError
        With one line for each thing that is wrong.
    """
    table = Table(path, ("participant", "landmark", "x_m", "y_m"), ("label", "t_s"))
    found = []
    for line, cells in table.rows:
        participant = table.word(line, cells, "participant")
        landmark = table.word(line, cells, "landmark")
        x_m, y_m = table.number(line, cells, "x_m"), table.number(line, cells, "y_m")
        t_s = table.number(line, cells, "t_s") if cells.get("t_s") else None
        found.append(Choice(participant, landmark, x_m, y_m, cells.get("label", ""), t_s))
    table.finish()
    return tuple(found)
