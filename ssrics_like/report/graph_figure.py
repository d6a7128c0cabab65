"""The topological memory: landmarks and the ways that were gone between them."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.memory.landmark import Arc
from ssrics_like.report import style
from ssrics_like.report.background import draw_background, extent_of
from ssrics_like.report.drawing import HALO, Drawing
from ssrics_like.report.frames import Frame, frame_around, show_frame
from ssrics_like.report.labels import Room, text_half_size
from ssrics_like.report.map_figure import HEIGHTS_PT, MARGINS_PT, frame_text
from ssrics_like.report.markers import draw_landmarks
from ssrics_like.report.records import Results

if TYPE_CHECKING:
    from matplotlib.axes import Axes

DISTANCES_MAX = 24
THINNEST_PT, THICKEST_PT = 1.0, 5.0
SHORT_PT = 26.0
"""An arc shorter than this has no room for its distance."""


@dataclass(frozen=True)
class Way:
    """The arcs between two landmarks, both directions taken together.

    Attributes
    ----------
    ends : tuple of str
        The two landmarks.
    traversals : int
        How often it was gone.
    distance_m : float
        Mean straight distance as odometry had it.
    closed : bool
        Whether it was found shut and not gone since.
    """

    ends: tuple[str, str]
    traversals: int
    distance_m: float
    closed: bool = False


def ways_of(arcs: Iterable[Arc]) -> list[Way]:
    """Join arcs there and back, most gone first."""
    joined: dict[tuple[str, str], Way] = {}
    for arc in arcs:
        ends = (min(arc.from_id, arc.to_id), max(arc.from_id, arc.to_id))
        before = joined.get(ends, Way(ends, 0, 0.0))
        n = before.traversals + arc.traversals
        total_m = before.distance_m * before.traversals + arc.distance_m * arc.traversals
        joined[ends] = Way(ends, n, total_m / n, before.closed or arc.closed > 0)
    return sorted(joined.values(), key=lambda way: (-way.traversals, way.ends))


def draw_graph(results: Results) -> Drawing | None:
    """Draw the graph; None where no landmark was declared."""
    run = results.shown
    if not run.landmarks:
        return None
    left, right, bottom, _ = MARGINS_PT
    top = 6.0
    width_pt = style.WIDTH_IN * style.POINTS - left - right
    everything = extent_of(results, run, results.pictures.outline)
    frame = frame_around(everything, width_pt, HEIGHTS_PT)
    figure = style.new_figure((frame.height_pt + bottom + top) / style.POINTS)
    axes = style.place_axes(figure, left, right, bottom, top)
    draw_background(axes, results, frame, strength=0.45)
    show_frame(axes, frame, low=results.building is not None)
    room = Room(frame.width_pt, frame.height_pt)
    room.take(60, 10, 60, 14)  # the scale bar
    ways = ways_of(results.arcs)
    places = {mark.name: (mark.drawn_x_m, mark.drawn_y_m) for mark in run.landmarks}
    draw_ways(axes, ways, places)
    for way in ways:
        room.cross(np.array([frame.points(*places[end]) for end in way.ends]))
    tips = draw_landmarks(axes, run.landmarks, frame, room)
    draw_distances(axes, ways, places, frame, room)
    axes.set_xlabel(f"metres, {frame_text(results)}", loc="right", fontsize=style.SMALL_PT)
    most = ways[0].traversals if ways else 0
    thickness = (
        f"The thicker a line, the more often it was gone, either way (up to {most} times)"
        if most > 1
        else "Each way was gone once"
    )
    return Drawing(
        "graph",
        figure,
        f"Topological graph of {len(run.landmarks)} landmarks and {len(ways)} ways between them",
        "The topological memory: landmarks where they were declared, joined where the robot went "
        f"from one straight to the next. {thickness}; the numbers beside lines are remembered "
        "straight distances in metres, which need not agree with the map. They are written on the "
        f"ways gone most, as far as there is room.{_shut(ways)}",
        tips,
    )


def _shut(ways: list[Way]) -> str:
    """Say what a dashed line is, if there is one."""
    if not any(way.closed for way in ways):
        return ""
    return " A dashed orange line is a way that was found shut, and not gone since."


def draw_ways(axes: Axes, ways: list[Way], places: dict[str, tuple[float, float]]) -> None:
    """Draw ways as lines between places, the thicker the more often they were gone."""
    from matplotlib.collections import LineCollection

    if not ways:
        return
    most = max(ways[0].traversals - 1, 1)
    range_pt = THICKEST_PT - THINNEST_PT
    widths = [THINNEST_PT + range_pt * math.sqrt((way.traversals - 1) / most) for way in ways]
    lines = [[places[end] for end in way.ends] for way in ways]
    axes.add_collection(
        LineCollection(
            lines, linewidths=widths, alpha=0.6, capstyle="round", zorder=3,
            colors=["#d55e00" if way.closed else "#5d7a99" for way in ways],
            linestyles=[(0, (2.0, 2.0)) if way.closed else "solid" for way in ways],
        ),
        autolim=False,
    )  # fmt: skip


def draw_distances(
    axes: Axes,
    ways: list[Way],
    places: dict[str, tuple[float, float]],
    frame: Frame,
    room: Room,
) -> None:
    """Write distances at the middle of the ways gone most, where there is room."""
    written = 0
    for way in ways:
        (x0, y0), (x1, y1) = (places[end] for end in way.ends)
        if written == DISTANCES_MAX:
            return
        if math.hypot(x1 - x0, y1 - y0) * frame.points_per_m < SHORT_PT:
            continue
        middle = ((x0 + x1) / 2, (y0 + y1) / 2)
        text = f"{way.distance_m:.1f}"
        half = text_half_size(text, style.TINY_PT)
        if room.find([frame.points(*middle)], *half) is not None:
            axes.annotate(
                text, middle, ha="center", va="center", fontsize=style.TINY_PT,
                color=style.PATH_TO, zorder=10, gid=f"{HALO}-d{written}",
            )  # fmt: skip
            written += 1
