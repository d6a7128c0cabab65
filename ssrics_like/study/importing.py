"""Choices of landmarks from tables that other programs wrote, by saying which column is which."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

from ssrics_like.errors import StudyError, choices, nearest
from ssrics_like.maps.tables import Table
from ssrics_like.results.files import csv_text
from ssrics_like.study.export import CHOICES
from ssrics_like.study.plan_picture import is_on_picture, on_map
from ssrics_like.world.grid import GridMap

NEEDED = ("participant", "x_m", "y_m")


@dataclass(frozen=True)
class Units:
    """How the numbers of a table become metres and seconds.

    Attributes
    ----------
    scale_x, scale_y : float
        Metres for one unit of the table; negative where the axis runs the other way.
    offset_x_m, offset_y_m : float
        Added after that: where the table's zero lies in the frame of the map.
    scale_t : float
        Seconds for one unit of the table's times.
    """

    scale_x: float = 1.0
    scale_y: float = 1.0
    offset_x_m: float = 0.0
    offset_y_m: float = 0.0
    scale_t: float = 1.0


def read_mapping(texts: Iterable[str]) -> dict[str, str]:
    """Read ``participant=pid,x_m=mark_x``: our column -> the table's.

    Raises
    ------
    StudyError
        A part is no assignment, a column of ours is unknown or stands twice, or one is missing.
    """
    found: dict[str, str] = {}
    for part in (part.strip() for text in texts for part in text.split(",")):
        ours, equals, theirs = (word.strip() for word in part.partition("="))
        if not equals or not theirs:
            raise StudyError(f"--columns {part}: expected OURS=THEIRS, for example x_m=mark_x")
        if ours not in CHOICES:
            raise StudyError(
                f"--columns {part}: no column '{ours}'{nearest(ours, CHOICES)}; "
                f"choices have {choices(CHOICES)}"
            )
        if ours in found:
            raise StudyError(f"--columns {part}: {ours} stands twice")
        found[ours] = theirs
    missing = [name for name in NEEDED if name not in found]
    if missing:
        raise StudyError(f"--columns: {', '.join(missing)} missing; expected OURS=THEIRS for each")
    return found


def imported(
    path: Path, columns: Mapping[str, str], units: Units, pixels_of: GridMap | None = None
) -> str:
    """Return a table of choices made of another table.

    Rows without a place are passed over: such tables hold other trials as well. Without a column
    of landmarks, each participant's are numbered.

    Parameters
    ----------
    path : Path
        CSV with a header.
    columns : mapping
        Our column -> the table's.
    units : Units
        How its numbers become metres and seconds.
    pixels_of : GridMap or None
        A map of whose picture the places are pixels, right and down from the top left corner;
        then only the times have units.

    Raises
    ------
    MapError
        The table cannot be read, lacks a column, or a cell is no number.
    StudyError
        No row has a place, or one has none that can be.
    """
    table = Table(path, tuple(dict.fromkeys(columns.values())), ())
    made: dict[str, int] = {}
    rows = []
    for line, cells in table.rows:
        given = {ours: cells[theirs] for ours, theirs in columns.items()}
        if not given["x_m"] and not given["y_m"]:
            continue
        participant = table.word(line, cells, columns["participant"])
        landmark = table.word(line, cells, columns["landmark"]) if given.get("landmark") else ""
        x, y = (table.number(line, cells, columns[key]) for key in ("x_m", "y_m"))
        t = table.number(line, cells, columns["t_s"]) if given.get("t_s") else math.nan
        if math.isnan(x) or math.isnan(y):  # is noted
            continue
        if pixels_of is None:
            x_m, y_m = x * units.scale_x + units.offset_x_m, y * units.scale_y + units.offset_y_m
        else:
            right_m, down_m = x * pixels_of.cell_m, y * pixels_of.cell_m
            if not is_on_picture(pixels_of, right_m, down_m):
                raise StudyError(f"{path}:{line}: pixel {x:g}, {y:g} is not on the map's picture")
            x_m, y_m = on_map(pixels_of, right_m, down_m)
        if not (math.isfinite(x_m) and math.isfinite(y_m)):
            raise StudyError(f"{path}:{line}: the place is not finite; see --scale and --offset")
        made[participant] = made.get(participant, 0) + 1
        rows.append(
            (
                participant,
                landmark or f"L{made[participant]}",
                x_m,
                y_m,
                given.get("label", ""),
                t * units.scale_t if math.isfinite(t) else None,
            )
        )
    table.finish()
    if not rows:
        raise StudyError(f"{path}: no row has a place in {columns['x_m']} and {columns['y_m']}")
    return csv_text(CHOICES, rows)
