"""Landmarks on a map: dots in their sector's colour, named where there is room."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ssrics_like.report import style
from ssrics_like.report.drawing import HALO
from ssrics_like.report.frames import Frame
from ssrics_like.report.labels import Room, around, text_half_size
from ssrics_like.report.words import seen_text, time_text
from ssrics_like.results.records import Landmark

if TYPE_CHECKING:
    from matplotlib.axes import Axes

SIZE_PT, CROWD_SIZE_PT, BULK_SIZE_PT = 6.4, 5.0, 3.4
CROWD = 60
"""More landmarks than this are drawn smaller."""
TIPPED_MAX = 400
"""So many landmarks are drawn one by one, with a tip each; more are drawn in bulk."""
LABELS_MAX = 600


def draw_label(
    axes: Axes,
    at_m: tuple[float, float],
    at_pt: tuple[float, float],
    place_pt: tuple[float, float],
    text: str,
    *,
    weight: str = "normal",
) -> None:
    """Write a label in a place found for it, both points from the lower left corner."""
    axes.annotate(
        text, at_m, (place_pt[0] - at_pt[0], place_pt[1] - at_pt[1]), textcoords="offset points",
        ha="center", va="center_baseline", fontsize=style.SMALL_PT, fontweight=weight, zorder=12,
        gid=f"{HALO}-{text}",
    )  # fmt: skip


def draw_landmarks(
    axes: Axes, landmarks: tuple[Landmark, ...], frame: Frame, room: Room
) -> dict[str, str]:
    """Draw landmarks with their names where there is room; return tips by gid."""
    size = _size(landmarks)
    if len(landmarks) > TIPPED_MAX:
        for sector in sorted({mark.sector for mark in landmarks}):
            places = [(m.drawn_x_m, m.drawn_y_m) for m in landmarks if m.sector == sector]
            axes.plot(*zip(*places, strict=True), zorder=8, **filled(sector, size))
    tips = {}
    for i, mark in enumerate(() if len(landmarks) > TIPPED_MAX else landmarks):
        gid = f"lm{i}"
        axes.plot(mark.drawn_x_m, mark.drawn_y_m, gid=gid, zorder=8, **filled(mark.sector, size))
        tips[gid] = describe(mark)
    take_landmarks(landmarks, frame, room)
    order = sorted(range(len(landmarks)), key=lambda i: (-landmarks[i].visits, i))
    for i in order[:LABELS_MAX]:
        mark = landmarks[i]
        at = frame.points(mark.drawn_x_m, mark.drawn_y_m)
        half = text_half_size(mark.name, style.SMALL_PT)
        place = room.find(around(*at, size / 2 + 0.5, *half), *half)
        if place is not None:
            draw_label(axes, (mark.drawn_x_m, mark.drawn_y_m), at, place, mark.name)
    return tips


def take_landmarks(landmarks: tuple[Landmark, ...], frame: Frame, room: Room) -> None:
    """Note that landmarks' dots are taken, so that no label covers them."""
    half = _size(landmarks) / 2
    for mark in landmarks:
        room.take(*frame.points(mark.drawn_x_m, mark.drawn_y_m), half, half)


def _size(landmarks: tuple[Landmark, ...]) -> float:
    """Return the size of each dot, points; the more there are, the smaller."""
    if len(landmarks) > TIPPED_MAX:
        return BULK_SIZE_PT
    return SIZE_PT if len(landmarks) <= CROWD else CROWD_SIZE_PT


def filled(sector: str, size: float) -> dict[str, Any]:
    """Return how a landmark is drawn."""
    return {
        "marker": "o", "linestyle": "none", "markersize": size, "markeredgecolor": "white",
        "markeredgewidth": 0.7, "markerfacecolor": style.sector_colour(sector),
    }  # fmt: skip


def describe(mark: Landmark) -> str:
    """Return a landmark's particulars in one line."""
    seen = seen_text(mark.sector, mark.structure)
    salience = "" if mark.salience is None else f"salience {mark.salience:.2f}; "
    return (
        f"{mark.name}: {seen}; declared at {time_text(mark.t_s)}; {salience}visits: {mark.visits}"
    )
