"""Labelled places on a map: a ring for each that was designated, with its number beside it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ssrics_like.comparison import FolderScores, PlaceScore
from ssrics_like.report import style
from ssrics_like.report.drawing import HALO
from ssrics_like.report.frames import Frame
from ssrics_like.report.labels import Room, text_half_size
from ssrics_like.report.words import percent_text, place_text

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LABEL_GAP_PT = 2.5
LABEL_MAX = 22
"""A longer label is left to the table."""
RINGS_MAX = 150
"""More designated places than this are drawn without numbers."""


@dataclass(frozen=True)
class PlaceStyle:
    """How large labelled places are drawn, points.

    Attributes
    ----------
    number_pt, label_pt : float
        Font of the number in its badge, and of the label beside it (0 for none).
    line_pt : float
        Width of rings and badges' rims.
    """

    number_pt: float = style.FONT_PT
    label_pt: float = style.SMALL_PT
    line_pt: float = 1.1


def draw_places(
    axes: Axes,
    scores: FolderScores,
    found: Sequence[bool],
    frame: Frame,
    room: Room,
    look: PlaceStyle,
) -> dict[str, str]:
    """Draw labelled places; return tips by gid.

    Parameters
    ----------
    axes : Axes
        A map's axes.
    scores : FolderScores
        The places.
    found : sequence of bool, one a place
        Whether the run that is shown found it; its badge is filled then.
    frame : Frame
        What the axes show.
    room : Room
        Where labels have room.
    look : PlaceStyle
        Sizes.
    """
    from matplotlib.colors import to_rgba
    from matplotlib.patches import Circle

    radius_m = scores.scores.radius_m
    tips = {}
    designated = [place for place in scores.scores.places if place.designated]
    for i, place in enumerate(scores.scores.places):
        at = place.location.x_m, place.location.y_m
        gid = f"place{i}"
        tips[gid] = _describe(place)
        if place.designated:
            axes.add_patch(
                Circle(at, radius_m, facecolor=to_rgba(style.ACCENT, 0.14), gid=gid,
                       edgecolor=style.ACCENT, linewidth=look.line_pt, zorder=1)
            )  # fmt: skip
        else:
            axes.plot(*at, gid=gid, zorder=1.5, **other_look(look))
            room.take(*frame.points(*at), 2, 2)
    if len(designated) <= RINGS_MAX:
        _draw_badges(axes, scores, found, frame, room, look)
    return tips


def _draw_badges(
    axes: Axes,
    scores: FolderScores,
    found: Sequence[bool],
    frame: Frame,
    room: Room,
    look: PlaceStyle,
) -> None:
    """Write the number of each designated place beside its ring, with its label if that fits."""
    ring_pt = scores.scores.radius_m * frame.points_per_m
    for place, was_found in zip(scores.scores.places, found, strict=True):
        if not place.designated:
            continue
        at_m = place.location.x_m, place.location.y_m
        at = frame.points(*at_m)
        number, label = place.location.id, place.location.label
        if number in label.split():
            label = ""  # it says no more than the number
        half = badge_half_size(number, look)
        spot = None
        if look.label_pt and 0 < len(label) <= LABEL_MAX:
            words = text_half_size(label, look.label_pt)[0]
            wide = half[0] + LABEL_GAP_PT / 2 + words
            spot = room.find(beside(*at, ring_pt, wide, half[1]), wide, half[1])
            if spot is not None:
                spot = spot[0] - LABEL_GAP_PT / 2 - words, spot[1]  # of the badge alone
                offset = spot[0] + half[0] + LABEL_GAP_PT - at[0], spot[1] - at[1]
                axes.annotate(
                    label, at_m, offset, textcoords="offset points", ha="left",
                    va="center_baseline", color=style.ACCENT, fontsize=look.label_pt, zorder=12,
                    gid=f"{HALO}-place-{number}",
                )  # fmt: skip
        if spot is None:
            spots = beside(*at, ring_pt, *half)
            spot = room.find(spots, *half) or spots[0]  # a number is never left out
        _badge(axes, at_m, (spot[0] - at[0], spot[1] - at[1]), number, look, filled=was_found)


def badge_half_size(number: str, look: PlaceStyle) -> tuple[float, float]:
    """Return half the width and height of a badge, points."""
    high = 0.72 * look.number_pt
    return max(text_half_size(number, look.number_pt)[0] + 0.25 * look.number_pt, high), high


def _badge(
    axes: Axes,
    at_m: tuple[float, float],
    offset_pt: tuple[float, float],
    number: str,
    look: PlaceStyle,
    *,
    filled: bool,
) -> None:
    from matplotlib.offsetbox import AnnotationBbox, DrawingArea
    from matplotlib.patches import FancyBboxPatch
    from matplotlib.text import Text

    half = badge_half_size(number, look)
    area = DrawingArea(2 * half[0], 2 * half[1])
    area.add_artist(
        FancyBboxPatch(
            (0, 0), 2 * half[0], 2 * half[1], boxstyle="round,pad=0,rounding_size=1.6",
            facecolor=style.ACCENT if filled else "white", edgecolor=style.ACCENT,
            linewidth=look.line_pt,
        )
    )  # fmt: skip
    area.add_artist(
        Text(
            half[0], half[1], number, ha="center", va="center_baseline", fontweight="bold",
            fontsize=look.number_pt, color="white" if filled else style.ACCENT,
        )
    )  # fmt: skip
    axes.add_artist(
        AnnotationBbox(
            area, at_m, offset_pt, xycoords="data", boxcoords="offset points", frameon=False,
            pad=0.0, annotation_clip=False, zorder=11,
        )
    )  # fmt: skip


def beside(
    x: float, y: float, ring: float, half_width: float, half_height: float
) -> list[tuple[float, float]]:
    """Return centres of boxes outside a ring, near ones first, the right upper one first."""
    spots = []
    for gap in (2.0, 8.0, 16.0, 28.0):
        dx, dy, slant = ring + gap + half_width, ring + gap + half_height, 0.7 * ring + gap
        spots += [
            (x + slant + half_width, y + slant + half_height),
            (x - slant - half_width, y + slant + half_height),
            (x + slant + half_width, y - slant - half_height),
            (x - slant - half_width, y - slant - half_height),
            (x + dx, y), (x, y + dy), (x - dx, y), (x, y - dy),
        ]  # fmt: skip
    return spots


def other_look(look: PlaceStyle) -> dict[str, Any]:
    """Return how a labelled place is drawn that was not designated."""
    return {
        "marker": "D", "linestyle": "none", "markersize": 3.2, "markerfacecolor": "none",
        "markeredgecolor": style.MUTED, "markeredgewidth": 0.6 * look.line_pt,
    }  # fmt: skip


def places_legend(scores: FolderScores, found: Sequence[bool], look: PlaceStyle) -> list[Any]:
    """Return a handle for each kind of labelled place that there is."""
    from matplotlib.lines import Line2D

    places = scores.scores.places
    hits = sum(was and p.designated for p, was in zip(places, found, strict=True))
    designated = sum(place.designated for place in places)
    badge = {"marker": "s", "linestyle": "none", "markersize": 6, "markeredgewidth": look.line_pt,
             "markeredgecolor": style.ACCENT}  # fmt: skip
    rows: list[tuple[int, str, dict[str, Any]]] = [
        (hits, "location found", {**badge, "markerfacecolor": style.ACCENT}),
        (designated - hits, "location missed", {**badge, "markerfacecolor": "white"}),
        (len(places) - designated, "other labelled place", other_look(look)),
    ]
    return [Line2D([], [], label=f"{text} ({n})", **kind) for n, text, kind in rows if n]


def _describe(place: PlaceScore) -> str:
    """Return a place's particulars in one line."""
    location = place.location
    name = place_text(location.id, location.label)
    runs = f"{place.runs} runs" if place.runs > 1 else "1 run"
    return (
        f"{name} ({location.kind}); found in {place.found} of {runs}, by chance in "
        f"{percent_text(place.chance)}"
    )
