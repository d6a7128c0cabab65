"""The map of a building for one column of a paper: the report's figures 3 and 4."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ssrics_like.report import style
from ssrics_like.report.background import draw_background, extent_of
from ssrics_like.report.drawing import HALO, Drawing
from ssrics_like.report.frames import Frame, frame_around, kept_apart, round_length
from ssrics_like.report.labels import Room, legend_grid
from ssrics_like.report.map_figure import draw_path
from ssrics_like.report.place_markers import PlaceStyle, draw_places, places_legend
from ssrics_like.report.records import Results
from ssrics_like.results.records import MARKS, Run

if TYPE_CHECKING:
    from matplotlib.axes import Axes

WIDTH_IN = 3.5
"""One column of a two-column page (IEEE, ACM: 3.3 to 3.5 inches)."""
HEIGHTS_PT = (90.0, 340.0)
FONT_PT = 6.8
LOOK = PlaceStyle(number_pt=6.8, label_pt=0.0, line_pt=0.7)
BAR_PT, LEGEND_ROW_PT = 13.0, 9.5
DOT: dict[str, Any] = {
    "marker": "o",
    "linestyle": "none",
    "markersize": 3.4,
    "markerfacecolor": "black",
    "markeredgecolor": "white",
    "markeredgewidth": 0.5,
}


def draw_column_map(results: Results) -> Drawing | None:
    """Draw the map at the size at which it is printed; None without a building.

    As in the report, every place that was marked is a black dot. Text is set for print, so that
    the file is used as it is, without scaling.
    """
    if results.building is None:
        return None
    run = results.shown
    width_pt = WIDTH_IN * style.POINTS - 1
    handles = _legend(results)
    columns, rows = legend_grid([h.get_label() for h in handles], width_pt, FONT_PT, 14.0)
    places = extent_of(results, run, results.pictures.outline)
    frame = frame_around(places, width_pt, HEIGHTS_PT)
    below = BAR_PT + LEGEND_ROW_PT * rows
    figure = style.new_figure((frame.height_pt + below + 1) / style.POINTS, WIDTH_IN)
    box = figure.get_size_inches() * style.POINTS
    axes = figure.add_axes(
        (0.5 / box[0], below / box[1], frame.width_pt / box[0], frame.height_pt / box[1])
    )
    draw_background(axes, results, frame)
    axes.set_xlim(frame.left, frame.right)
    axes.set_ylim(frame.bottom, frame.top)
    axes.set_xticks([])
    axes.set_yticks([])
    for spine in axes.spines.values():
        spine.set_visible(False)
    draw_path(axes, run.path, frame, width=0.6, landings=run.landings)
    room = Room(frame.width_pt, frame.height_pt)
    _draw_ends(axes, run, frame, room)
    _draw_marks(axes, run, frame, room)
    if results.scores:
        found = results.scores.scores.found[0].tolist()
        draw_places(axes, results.scores, found, frame, room, LOOK)
    _scale_bar(axes, frame)
    figure.legend(
        handles=handles, loc="lower left", bbox_to_anchor=(0.5 / box[0], 1 / box[1]), ncols=columns,
        fontsize=FONT_PT, columnspacing=0.9, handlelength=0.9, handletextpad=0.25,
        labelspacing=0.25,
    )  # fmt: skip
    return Drawing(
        "map-column",
        figure,
        "Map of the path and the marks over the floor plan, for one column of a paper",
        "",
    )


def _draw_marks(axes: Axes, run: Run, frame: Frame, room: Room) -> None:
    """Draw a dot for every mark, one where they would cover each other."""
    places = np.array([(r.x_m, r.y_m) for r in run.reflexes if r.decision in MARKS]).reshape(-1, 2)
    keep = kept_apart(places[:, 0], places[:, 1], 0.8 / frame.points_per_m)
    axes.plot(*places[keep].T, zorder=8, **DOT)
    for x, y in places[keep].tolist():
        room.take(*frame.points(x, y), 1.7, 1.7)


def _draw_ends(axes: Axes, run: Run, frame: Frame, room: Room) -> None:
    """Mark where the robot began and where it ended; labels should not lie on its way."""
    if len(run.path) == 0:
        return
    room.cross(np.column_stack(frame.points(run.path[:, 1], run.path[:, 2])))
    for (x, y), marker in ((run.path[0, 1:], "s"), (run.path[-1, 1:], "D")):
        axes.plot(x, y, marker=marker, zorder=9, **_end_look())
        room.take(*frame.points(float(x), float(y)), 2.2, 2.2)


def _end_look() -> dict[str, Any]:
    return {"linestyle": "none", "markersize": 3.6, "markerfacecolor": "white",
            "markeredgecolor": style.INK, "markeredgewidth": 0.8}  # fmt: skip


def _legend(results: Results) -> list[Any]:
    from matplotlib.lines import Line2D

    run = results.shown
    marks = sum(run.decided[kind] for kind in MARKS)
    handles: list[Any] = [Line2D([], [], label=f"marked ({marks})", **DOT)]
    if results.scores:
        found = results.scores.scores.found[0].tolist()
        handles += places_legend(results.scores, found, LOOK)
        for handle in handles[1:]:
            handle.set_markersize(min(handle.get_markersize(), 4.2))
    for marker, text in (("s", "start"), ("D", "end")):
        handles.append(Line2D([], [], marker=marker, label=text, **_end_look()))
    return handles


def _scale_bar(axes: Axes, frame: Frame) -> None:
    """Draw a scale bar below the map, at its right end."""
    length_m = round_length((frame.right - frame.left) * 0.2)
    end = frame.right - 2 / frame.points_per_m
    y = frame.bottom - 6 / frame.points_per_m
    axes.plot(
        [end - length_m, end], [y, y], color=style.INK, linewidth=1.0, solid_capstyle="butt",
        clip_on=False,
    )  # fmt: skip
    axes.annotate(
        f"{length_m:g} m", (end - length_m, y), (-3, 0), textcoords="offset points", ha="right",
        va="center_baseline", fontsize=FONT_PT, annotation_clip=False, gid=f"{HALO}-scale",
    )  # fmt: skip
