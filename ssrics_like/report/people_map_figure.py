"""The map with the marks of people and of each model, as points and as densities."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter

from ssrics_like.people.beside import Beside
from ssrics_like.people.folders import Folders
from ssrics_like.people.markers import PEOPLE, Marker
from ssrics_like.report import style
from ssrics_like.report.drawing import Drawing
from ssrics_like.report.frames import Frame, frame_around, show_frame
from ssrics_like.report.labels import Room, around, text_half_size
from ssrics_like.report.markers import draw_label
from ssrics_like.report.people_style import colours_of, mark_look, said
from ssrics_like.report.plan import bounds_of, draw_plan
from ssrics_like.report.reading import read_pictures
from ssrics_like.report.walls import draw_walls

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes

LEFT_PT, RIGHT_PT, BOTTOM_PT, TOP_PT, GAP_PT = 26.0, 6.0, 24.0, 24.0, 14.0
HEIGHTS_PT = (120.0, 520.0)
COLUMNS = 2
LEVELS = (0.2, 0.5, 1.0, 2.0)
"""Marks a marker that lie about a place; the lines and shades of a density."""
LINES = 0.62
"""Share of a model's colour in the lines of its density: marks stand out from them."""
SIZES_PT = (2.4, 4.6)
"""Of a mark of a run, and of a person; runs' lie over people's and leave their rims in sight."""
CELL_PT = 1.5
CELLS_MAX = 1_000_000
NAMED_MAX = 40


def draw_people_map(read: Folders, made: Beside) -> Drawing:
    """Draw a panel for each model: its marks over those of the people, on the map."""
    columns = min(COLUMNS, len(made.models))
    rows = -(-len(made.models) // columns)
    page_pt = style.WIDTH_IN * style.POINTS
    width_pt = page_pt / columns - LEFT_PT - RIGHT_PT
    frame = frame_around(_extent(read, made), width_pt, HEIGHTS_PT)
    panel_pt = frame.height_pt + TOP_PT + BOTTOM_PT
    height_pt = rows * panel_pt + (rows - 1) * GAP_PT
    figure = style.new_figure(height_pt / style.POINTS)
    tips: dict[str, str] = {}
    for number in range(len(made.models)):
        row, column = divmod(number, columns)
        left_pt = column * page_pt / columns + LEFT_PT
        top_pt = row * (panel_pt + GAP_PT) + TOP_PT
        axes = style.place_axes(
            figure, left_pt, page_pt - left_pt - width_pt,
            height_pt - top_pt - frame.height_pt, top_pt,
        )  # fmt: skip
        tips |= _draw_panel(axes, frame, read, made, number)
        for text in axes.texts:  # each panel has a scale bar, and the same locations
            text.set_gid(f"{text.get_gid()}-{number}")
    models = ", ".join(model.name for model in made.models)
    return Drawing(
        "map",
        figure,
        f"Map with the marks of {len(made.people)} people and of the runs of {models}",
        "Filled dots: marks of people; hollow shapes: marks of the model's runs, where the robot "
        "was when it perceived. Shades (people) and lines (model): their density, smoothed with a "
        f"normal kernel of {made.settings.radius_m / 2:g} m; at the outermost one in five markers "
        "has a mark about there, then one in two, one each, and two each. Circles of "
        f"{made.settings.radius_m:g} m radius are the locations, drawn solid where at least half "
        "of the people marked them.",
        tips,
    )


def density(
    markers: Sequence[Marker], frame: Frame, sd_m: float, cell_m: float
) -> NDArray[np.float64]:
    """Return how many marks a marker has about each place of a frame.

    Marks are smoothed with a normal kernel that is 1 in its middle, so that a place that every
    marker marked exactly once, all on the same spot, has the value 1.

    Parameters
    ----------
    markers : sequence of Marker
        At least one.
    frame : Frame
        What is shown.
    sd_m : float
        Standard deviation of the kernel, metres.
    cell_m : float
        Side of a cell, metres.

    Returns
    -------
    ndarray, shape (rows, columns)
        Row 0 is the lowest.
    """
    marks = np.concatenate([marker.xy_m for marker in markers])
    columns, rows = (
        max(1, int(np.ceil(span / cell_m)))
        for span in (frame.right - frame.left, frame.top - frame.bottom)
    )
    cells = np.floor((marks - [frame.left, frame.bottom]) / cell_m).astype(np.int64)
    inside = ((cells >= 0) & (cells < [columns, rows])).all(axis=1)
    counts = np.zeros((rows, columns))
    np.add.at(counts, (cells[inside, 1], cells[inside, 0]), 1.0 / len(markers))
    sd = sd_m / cell_m
    smooth: NDArray[np.float64] = gaussian_filter(counts, sd, mode="constant") * 2 * np.pi * sd**2
    return smooth


def _extent(read: Folders, made: Beside) -> NDArray[np.float64]:
    if read.building is not None:
        return bounds_of(read.building.grid)
    ways = [way.xy_m for model in made.models for way in model.ways]
    return np.concatenate([*ways, *(marker.xy_m for marker in made.markers)])


def _draw_panel(
    axes: Axes, frame: Frame, read: Folders, made: Beside, number: int
) -> dict[str, str]:
    model, radius_m = made.models[number], made.settings.radius_m
    colours = colours_of(made)
    if read.building is not None:
        draw_plan(axes, read.building.grid, frame, strength=0.75)
    else:
        records = read.records[number]
        draw_walls(axes, read_pictures(records.folder, records.runs[0]).outline, frame)
    show_frame(axes, frame, low=read.building is not None)
    area = (frame.right - frame.left) * (frame.top - frame.bottom)
    cell_m = max(CELL_PT / frame.points_per_m, (area / CELLS_MAX) ** 0.5)
    for group, markers in ((PEOPLE, made.people), (model.name, model.runs)):
        values = density(markers, frame, radius_m / 2, cell_m)
        _draw_density(axes, values, frame, cell_m, colours[group], filled=group == PEOPLE)
        for marker in markers:
            axes.plot(
                *marker.xy_m.T, zorder=6 + (group != PEOPLE),
                **mark_look(made, group, SIZES_PT[group == PEOPLE]),
            )  # fmt: skip
    tips = _draw_locations(axes, frame, made, number)
    axes.legend(
        handles=_legend(made, number), loc="lower left", bbox_to_anchor=(0, 1, 1, 0),
        borderaxespad=0.6, ncols=2, columnspacing=1.6,
    )  # fmt: skip
    return tips


def _draw_density(
    axes: Axes, values: NDArray[np.float64], frame: Frame, cell_m: float, colour: str, *,
    filled: bool,
) -> None:  # fmt: skip
    rows, columns = values.shape
    if min(rows, columns) < 2 or values.max() <= LEVELS[0]:  # noqa: PLR2004 - no area
        return
    x = frame.left + (np.arange(columns) + 0.5) * cell_m
    y = frame.bottom + (np.arange(rows) + 0.5) * cell_m
    levels = [level for level in LEVELS if level < values.max()]
    if filled:
        shades = [style.mixed(colour, 0.16 + 0.13 * i) for i in range(len(levels))]
        axes.contourf(x, y, values, levels=[*levels, np.inf], colors=shades, alpha=0.75, zorder=1.2)
    else:
        axes.contour(x, y, values, levels=levels, colors=style.mixed(colour, LINES), linewidths=0.8,
                     zorder=4)  # fmt: skip


def _draw_locations(axes: Axes, frame: Frame, made: Beside, number: int) -> dict[str, str]:
    from matplotlib.patches import Circle

    tips, room = {}, Room(frame.width_pt, frame.height_pt)
    room.take(60, 10, 60, 14)  # the scale bar
    radius_m = made.settings.radius_m
    agreed = dict(zip(made.units.names, made.crowd.consensus.tolist(), strict=True))
    counts: dict[str, list[str]] = {}
    for one in made.shares:
        counts.setdefault(one.location.id, []).append(f"{one.group} {one.marked} of {one.markers}")
    for i, place in enumerate(made.units.locations):
        gid = f"p{number}-{i}"
        axes.add_patch(
            Circle((place.x_m, place.y_m), radius_m, gid=gid, facecolor="none",
                   edgecolor=style.INK, linewidth=1.0 if agreed.get(place.id) else 0.8,
                   linestyle="-" if agreed.get(place.id) else (0, (2.5, 2.0)), zorder=5)
        )  # fmt: skip
        tips[gid] = f"{place.id}: {', '.join(counts[place.id])}"
        if len(made.units.locations) > NAMED_MAX:
            continue
        at = frame.points(place.x_m, place.y_m)
        half = text_half_size(place.id, style.SMALL_PT)
        spot = room.find(around(*at, radius_m * frame.points_per_m + 1.0, *half), *half)
        if spot is not None:
            draw_label(axes, (place.x_m, place.y_m), at, spot, place.id, weight="bold")
    return tips


def _legend(made: Beside, number: int) -> list[Any]:
    from matplotlib.lines import Line2D

    model = made.models[number]
    return [
        Line2D([], [], label=said(group, count), **mark_look(made, group, 5.5))
        for group, count in ((PEOPLE, len(made.people)), (model.name, len(model.runs)))
    ]
