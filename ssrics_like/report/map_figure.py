"""The map: what lies under it, the path, what was decided where, and the labelled places."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ssrics_like.report import style
from ssrics_like.report.background import draw_background, extent_of
from ssrics_like.report.drawing import Drawing
from ssrics_like.report.frames import Frame, frame_around, kept_apart, show_frame
from ssrics_like.report.labels import Room, around, legend_grid, text_half_size
from ssrics_like.report.markers import (
    SIZE_PT,
    draw_label,
    draw_landmarks,
    filled,
    take_landmarks,
)
from ssrics_like.report.place_markers import PlaceStyle, draw_places, places_legend
from ssrics_like.report.records import Results
from ssrics_like.results.records import Reflex

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MARGINS_PT = (26.0, 6.0, 28.0, 24.0)  # left, right, bottom, top
HEIGHTS_PT = (230.0, 640.0)
LEGEND_ROW_PT = 12.5
PATH_PARTS = 48
CARRIED_M, CARRIED_M_S = 1.0, 20.0  # no robot indoors goes farther and faster than these
CARRIED: dict[str, Any] = {"color": style.MUTED, "linewidth": 0.9, "linestyle": (0, (1, 1.6))}
OTHERS = ("recognised", "unsure", "dismissed", "overwritten")
"""Decisions that make no new landmark."""


def draw_map(results: Results) -> Drawing:
    """Draw the map of the run that is shown."""
    run = results.shown
    left, right, bottom, top = MARGINS_PT
    width_pt = style.WIDTH_IN * style.POINTS - left - right
    handles = _legend(results)
    columns, rows = legend_grid([handle.get_label() for handle in handles], width_pt)
    top += LEGEND_ROW_PT * (rows - 1)
    places = extent_of(results, run, results.pictures.outline)
    frame = frame_around(places, width_pt, HEIGHTS_PT)
    figure = style.new_figure((frame.height_pt + bottom + top) / style.POINTS)
    axes = style.place_axes(figure, left, right, bottom, top)
    draw_background(axes, results, frame)
    show_frame(axes, frame, low=results.building is not None)
    draw_path(axes, run.path, frame, landings=run.landings)
    for landing in run.landings:
        axes.plot(*run.path[landing - 1 : landing + 1, 1:].T, zorder=2, **CARRIED)
    _draw_reflexes(axes, run.reflexes, frame)
    room = Room(frame.width_pt, frame.height_pt)
    room.take(60, 10, 60, 14)  # the scale bar
    if results.building:
        take_landmarks(run.landmarks, frame, room)
    draw_ends(axes, run.path, frame, room)
    tips: dict[str, str] = {}
    if results.scores:
        found = results.scores.scores.found[0].tolist()
        tips |= draw_places(axes, results.scores, found, frame, room, PlaceStyle())
    tips |= draw_landmarks(axes, run.landmarks, frame, room)
    axes.set_xlabel(f"metres, {frame_text(results)}", loc="right", fontsize=style.SMALL_PT)
    if handles:
        axes.legend(
            handles=handles, loc="lower left", bbox_to_anchor=(0, 1, 1, 0), borderaxespad=0.7,
            ncols=columns, columnspacing=1.4, handlelength=1.0,
        )  # fmt: skip
    over = "the floor plan" if results.building else "the walls seen by the laser"
    return Drawing(
        "map",
        figure,
        f"Map of the path with {len(run.landmarks)} landmarks over {over}",
        _caption(results, hint=bool(tips)),
        tips,
    )


def _caption(results: Results, *, hint: bool) -> str:
    """Say what is seen on the map."""
    run = results.shown
    ground = (
        "The floor plan of the building: walls dark, what nobody knows pale."
        if results.building
        else "Grey: where laser beams ended, drawn from the scans."
    )
    if results.building and len(results.pictures.outline.x):
        ground += " Grey: furniture and doors that it does not show."
    rings = (
        "; rings are reflexes at which one was recognised again"
        if run.decided["recognised"]
        else ""
    )
    text = (
        f"{ground} The line is the robot's path, darker "
        "with time. Filled dots are landmarks where they were declared, coloured by the sector in "
        f"which the largest reading lay{rings}; where it is crowded, some carry no name."
    )
    if len(run.landings):
        text += " Dotted: the robot was carried, and did not drive."
    if results.scores:
        radius_m = results.scores.scores.radius_m
        text += (
            f" Numbered circles, of {radius_m:g} m radius, are the locations that people "
            "designated; the number is filled where this run marked one inside the circle, and "
            "hollow where it did not. After the report's figures 3 and 4; figures/map-column.svg "
            "is the same for one column of a paper."
        )
    return text + (" Rest the pointer on a landmark for its particulars." if hint else "")


def frame_text(results: Results) -> str:
    """Say what the positions on a map are."""
    return "true positions" if results.shown.is_true else f"{results.manifest['frame']} frame"


def draw_path(
    axes: Axes,
    path: NDArray[np.float64],
    frame: Frame,
    width: float = 1.1,
    parts: int = PATH_PARTS,
    landings: NDArray[np.int64] | tuple[()] = (),
) -> None:
    """Draw the path as a line that darkens with time, broken where the robot was carried.

    `landings` are indices of poses where it was put down; a step that no robot drives is another.
    """
    from matplotlib.collections import LineCollection
    from matplotlib.colors import LinearSegmentedColormap

    jumps = np.union1d(_jumps(path), landings).astype(np.int64)
    keep = _thinned(path[:, 1:], 0.6 / frame.points_per_m, jumps)
    if len(keep) <= 1:
        return
    colours = LinearSegmentedColormap.from_list("time", [style.PATH_FROM, style.PATH_TO])
    points, landings = path[keep, 1:], np.flatnonzero(np.isin(keep, jumps))
    cuts = np.unique([*np.linspace(0, len(points) - 1, parts + 1).astype(np.int64), *landings])
    # Nothing is drawn where the robot was carried: a part ends at the point before.
    lines = [points[a : b + (b not in landings)] for a, b in itertools.pairwise(cuts)]
    shades = colours(np.linspace(0, 1, len(lines)))
    axes.add_collection(
        LineCollection(lines, colors=shades, linewidths=width, capstyle="round", zorder=2),
        autolim=False,
    )


def _jumps(path: NDArray[np.float64]) -> NDArray[np.int64]:
    """Return indices of poses that the robot cannot have driven to from the pose before."""
    steps_m = np.hypot(*np.diff(path[:, 1:], axis=0).T)
    return 1 + np.flatnonzero(steps_m > np.maximum(CARRIED_M_S * np.diff(path[:, 0]), CARRIED_M))


def _thinned(
    points: NDArray[np.float64], step_m: float, jumps: NDArray[np.int64]
) -> NDArray[np.int64]:
    """Return indices of points a step apart at least; the ends, and those at jumps, stay."""
    stay = {0, len(points) - 1, *jumps.tolist(), *(jumps - 1).tolist()} if len(points) else set()
    keep: list[int] = []
    for i, (x, y) in enumerate(points.tolist()):
        last = points[keep[-1]] if keep else None
        far = last is None or abs(x - last[0]) >= step_m or abs(y - last[1]) >= step_m
        if far or i in stay:
            keep.append(i)
    return np.array(keep, np.int64)


def draw_ends(axes: Axes, path: NDArray[np.float64], frame: Frame, room: Room) -> None:
    """Mark start and end of the path."""
    if len(path) == 0:
        return
    room.cross(np.column_stack(frame.points(path[:, 1], path[:, 2])))
    start, end = path[0, 1:], path[-1, 1:]
    together = np.hypot(*(end - start)) * frame.points_per_m < 10  # noqa: PLR2004 - points
    ends = [(start, "start, end", "s")] if together else [(start, "start", "s"), (end, "end", "D")]
    for (x, y), text, marker in ends:
        axes.plot(
            x, y, marker, markersize=5.2, markerfacecolor="white", markeredgecolor=style.INK,
            markeredgewidth=1.3, zorder=2.5,
        )  # fmt: skip
        px, py = frame.points(x, y)
        room.take(px, py, 3.5, 3.5)
        half = text_half_size(text, style.SMALL_PT)
        place = room.find(around(px, py, 5.0, *half), *half)
        if place is not None:
            draw_label(axes, (x, y), (px, py), place, text, weight="bold")


def _draw_reflexes(axes: Axes, reflexes: tuple[Reflex, ...], frame: Frame) -> None:
    """Draw what is no new landmark, thinned where marks would cover each other."""
    for zorder, decision in enumerate(reversed(OTHERS), 3):
        chosen = [r for r in reflexes if r.decision == decision]
        for sector in sorted({r.sector for r in chosen}):
            here = [r for r in chosen if r.sector == sector]
            x, y = np.array([r.x_m for r in here]), np.array([r.y_m for r in here])
            keep = kept_apart(x, y, 1.2 / frame.points_per_m)
            hollow = decision in ("recognised", "unsure")
            colour = style.sector_colour(sector) if hollow else style.MUTED
            axes.plot(x[keep], y[keep], zorder=zorder, **_look(decision, colour))


def _look(decision: str, colour: str) -> dict[str, Any]:
    """Return how a reflex is drawn that made no new landmark."""
    looks: dict[str, dict[str, Any]] = {
        "recognised": {"marker": "o", "markersize": 4.4, "markerfacecolor": "none"},
        "unsure": {"marker": "^", "markersize": 4.2, "markerfacecolor": "none"},
        "dismissed": {"marker": "o", "markersize": 2.8, "markeredgewidth": 0},
        "overwritten": {"marker": "x", "markersize": 3.8},
    }
    return {"linestyle": "none", "color": colour, "markeredgewidth": 0.9, **looks[decision]}


def _legend(results: Results) -> list[Any]:
    """Return a handle for each kind of thing that is on the map."""
    from matplotlib.lines import Line2D

    run = results.shown
    handles: list[Any] = []
    known = [s for s in style.SECTORS if any(m.sector == s for m in run.landmarks)]
    others = sorted({m.sector for m in run.landmarks} - set(style.SECTORS))
    for sector in known + others:
        count = sum(mark.sector == sector for mark in run.landmarks)
        handles.append(
            Line2D([], [], label=f"landmark, {sector} ({count})", **filled(sector, SIZE_PT))
        )
    for decision in OTHERS:
        count = run.decided[decision]
        if count:
            look = _look(decision, style.MUTED)
            handles.append(Line2D([], [], label=f"{decision} ({count})", **look))
    if len(run.landings):
        handles.append(Line2D([], [], label=f"carried elsewhere ({len(run.landings)})", **CARRIED))
    if results.scores:
        found = results.scores.scores.found[0].tolist()
        handles += places_legend(results.scores, found, PlaceStyle())
    return handles
