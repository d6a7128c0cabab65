"""A saved memory by itself: its landmarks where they fit best, and the ways between them."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ssrics_like.memory import Landmark, SavedMemory
from ssrics_like.memory.layout import Placed
from ssrics_like.report import style
from ssrics_like.report.drawing import Drawing, as_svg
from ssrics_like.report.frames import frame_around, show_frame
from ssrics_like.report.graph_figure import draw_distances, draw_ways, ways_of
from ssrics_like.report.labels import Room
from ssrics_like.report.map_figure import HEIGHTS_PT, MARGINS_PT
from ssrics_like.report.markers import draw_landmarks
from ssrics_like.results import records

BELOW = 0.12
"""Room below the lowest landmark, as a share of the whole."""


def memory_svg(memory: SavedMemory, layout: Mapping[str, Placed]) -> str:
    """Return a picture of a memory as SVG; equal memories give equal text."""
    with style.context():
        return as_svg(draw_memory(memory, layout))


def draw_memory(memory: SavedMemory, layout: Mapping[str, Placed]) -> Drawing:
    """Draw landmarks where a layout has them, and ways.

    Parts of the graph that no measured way joins need not fit together (see `relaxed_layout`).
    """
    topological = memory.topological()
    marks = tuple(
        _mark(node, topological.degree(node.id), layout[node.id]) for node in topological.nodes
    )
    left, right, bottom, _ = MARGINS_PT
    top = 6.0
    width_pt = style.WIDTH_IN * style.POINTS - left - right
    places = {mark.name: (mark.drawn_x_m, mark.drawn_y_m) for mark in marks}
    at = np.array(list(places.values()), np.float64).reshape(-1, 2)
    if len(at):  # the scale bar stands below the lowest landmark, not on it
        at = np.vstack(
            [at, at.min(axis=0) - (0.0, BELOW * max(float(np.ptp(at, axis=0).max()), 1.0))]
        )
    frame = frame_around(at, width_pt, HEIGHTS_PT)
    figure = style.new_figure((frame.height_pt + bottom + top) / style.POINTS)
    axes = style.place_axes(figure, left, right, bottom, top)
    show_frame(axes, frame)
    room = Room(frame.width_pt, frame.height_pt)
    room.take(60, 10, 60, 14)  # the scale bar
    ways = ways_of(topological.arcs)
    draw_ways(axes, ways, places)
    for way in ways:
        room.cross(np.array([frame.points(*places[end]) for end in way.ends]))
    tips = draw_landmarks(axes, marks, frame, room)
    draw_distances(axes, ways, places, frame, room)
    axes.set_xlabel(f"metres, {memory.frame} frame", loc="right", fontsize=style.SMALL_PT)
    return Drawing(
        "memory",
        figure,
        f"Topological memory of {len(marks)} landmarks and {len(ways)} ways between them",
        "Landmarks where they contradict the remembered ways least, joined where the robot went "
        "from one straight to the next; the numbers are remembered straight distances in metres.",
        tips,
    )


def _mark(landmark: Landmark, degree: int, placed: Placed) -> records.Landmark:
    """Return a landmark as figures take it."""
    labels = landmark.labels
    return records.Landmark(
        name=landmark.id,
        t_s=landmark.t_s,
        x_m=landmark.x_m,
        y_m=landmark.y_m,
        theta_rad=landmark.theta_rad,
        drawn_x_m=placed.pose.x_m,
        drawn_y_m=placed.pose.y_m,
        sector=str(labels.get("sector", "")),
        structure=str(labels.get("structure", "")),
        salience=None,  # would take the views of all, and how they compare
        relevance=degree,
        permanence=None,
        visits=landmark.visits,
    )
