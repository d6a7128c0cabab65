"""Table 1 as a picture: how often each designated location was found, and by chance."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ssrics_like.comparison import FolderScores, PlaceScore
from ssrics_like.report import style
from ssrics_like.report.drawing import Drawing
from ssrics_like.report.labels import text_half_size
from ssrics_like.report.records import Results
from ssrics_like.report.words import interval_text, percent_text, place_text

if TYPE_CHECKING:
    from matplotlib.axes import Axes

ROWS_MAX = 80
ROW_PT, RIGHT_PT, TOP_PT, BOTTOM_PT = 21.0, 118.0, 26.0, 30.0
LEFTS_PT = (60.0, 180.0)
"""Least and most room for the names."""
NAME_MAX = 30
OURS = style.BLUE


def draw_locations(results: Results) -> Drawing | None:
    """Draw the share of runs that found each designated location; None where there is none."""
    if results.scores is None:
        return None
    every = [place for place in results.scores.scores.places if place.designated]
    places = every[:ROWS_MAX]
    if not places:
        return None
    published = results.scores.published
    height_pt = TOP_PT + BOTTOM_PT + ROW_PT * len(places)
    figure = style.new_figure(height_pt / style.POINTS)
    widest_pt = max(2 * text_half_size(_name(place), style.FONT_PT)[0] for place in places)
    left_pt = min(max(widest_pt + 10, LEFTS_PT[0]), LEFTS_PT[1])
    axes = style.place_axes(figure, left_pt, RIGHT_PT, BOTTOM_PT, TOP_PT)
    share_axis(axes, len(places))
    for row, place in enumerate(places):
        _draw_row(axes, row, place, published.get(place.location.id))
    axes.set_yticks(range(len(places)), [_name(place) for place in places], color=style.INK,
                    fontsize=style.FONT_PT)  # fmt: skip
    axes.set_xlabel("share of runs in which it was found, %")
    axes.legend(
        handles=_legend(results.scores, places), loc="lower left", bbox_to_anchor=(0, 1, 1, 0),
        borderaxespad=0.7, ncols=4, columnspacing=1.8, handlelength=1.6,
    )  # fmt: skip
    rest = f" The first {ROWS_MAX} of {len(every)}." if len(every) > ROWS_MAX else ""
    runs = places[0].runs
    said = (
        f" Diamonds: as published ({results.scores.published_in})."
        if any(place.location.id in published for place in places)
        else ""
    )
    return Drawing(
        "locations",
        figure,
        f"In what share of {runs} runs each of {len(places)} locations was found",
        f"How often each designated location was marked within {results.scores.scores.radius_m:g} "
        f"m, in {runs} {'runs' if runs > 1 else 'run'}: dots with the Wilson 95 % interval. Grey "
        "ticks: what as many marks would find if they were set at random along the same path; thin "
        "ones: at equal intervals of time."
        f"{said}{rest} After the report's table 1.",
    )


def share_axis(axes: Axes, rows: int) -> None:
    """Prepare axes whose rows run downwards and whose values are shares in per cent."""
    axes.set_xlim(-1, 101)
    axes.set_ylim(rows - 0.5, -0.5)
    axes.set_xticks(range(0, 101, 10))
    axes.grid(axis="x")
    axes.tick_params(axis="y", length=0)
    axes.spines["left"].set_visible(False)


def draw_interval(
    axes: Axes, row: float, share: float, interval: tuple[float, float], size: float = 7.0
) -> None:
    """Draw a share with its interval, per cent."""
    axes.plot([100 * v for v in interval], [row, row], color=OURS, linewidth=1.6, zorder=3)
    axes.plot(100 * share, row, zorder=5, **ours_look(size))


def draw_chance(axes: Axes, row: float, chance: float, half: float = 0.3) -> None:
    """Draw a tick at what chance would reach, per cent."""
    axes.plot([100 * chance] * 2, [row - half, row + half], zorder=4, **chance_look())


def draw_clock(axes: Axes, row: float, clock: float, half: float = 0.3) -> None:
    """Draw a thin tick at what a clock would reach, per cent."""
    axes.plot([100 * clock] * 2, [row - half, row + half], zorder=4, **clock_look())


def clock_look() -> dict[str, Any]:
    """Return how marks by a clock are drawn."""
    return {"color": style.INK, "linewidth": 0.9}


def ours_look(size: float) -> dict[str, Any]:
    """Return how our own share is drawn."""
    return {"marker": "o", "linestyle": "none", "markersize": size, "markerfacecolor": OURS,
            "markeredgecolor": "white", "markeredgewidth": 0.8}  # fmt: skip


def chance_look() -> dict[str, Any]:
    """Return how chance is drawn."""
    return {"color": style.MUTED, "linewidth": 2.2, "solid_capstyle": "butt"}


def clock_handle() -> dict[str, Any]:
    """Return a clock's tick for a legend."""
    return {"marker": "|", "linestyle": "none", "markersize": 9, "markeredgewidth": 0.9,
            "markeredgecolor": clock_look()["color"]}  # fmt: skip


def _published_look() -> dict[str, Any]:
    return {"marker": "D", "linestyle": "none", "markersize": 6.4, "markerfacecolor": "none",
            "markeredgecolor": style.ACCENT, "markeredgewidth": 1.3}  # fmt: skip


def _draw_row(axes: Axes, row: int, place: PlaceScore, published: float | None) -> None:
    draw_chance(axes, row, place.chance)
    draw_clock(axes, row, place.clock)
    draw_interval(axes, row, place.share, place.interval)
    if published is not None:
        axes.plot(100 * published, row, zorder=6, **_published_look())
    axes.annotate(
        f"{place.found} of {place.runs}", (1, row), (12, 0), va="center_baseline",
        xycoords=("axes fraction", "data"), textcoords="offset points", fontsize=style.SMALL_PT,
        color=style.MUTED, annotation_clip=False,
    )  # fmt: skip
    axes.annotate(
        f"{percent_text(place.share)} ({interval_text(place.interval)})", (1, row), (54, 0),
        va="center_baseline", xycoords=("axes fraction", "data"), textcoords="offset points",
        fontsize=style.SMALL_PT, annotation_clip=False,
    )  # fmt: skip


def _name(place: PlaceScore) -> str:
    """Return a location's id and label, shortened to what has room."""
    name = place_text(place.location.id, place.location.label)
    return name if len(name) <= NAME_MAX else name[: NAME_MAX - 1].rstrip() + "…"


def _legend(scores: FolderScores, places: list[PlaceScore]) -> list[Any]:
    from matplotlib.lines import Line2D

    ours: dict[str, Any] = {**ours_look(6.5), "linestyle": "-", "color": OURS, "linewidth": 1.6}
    tick: dict[str, Any] = {"marker": "|", "linestyle": "none", "markersize": 9,
                            "markeredgewidth": 2.2, "markeredgecolor": style.MUTED}  # fmt: skip
    handles = [
        Line2D([], [], label="found, with 95 % interval", **ours),
        Line2D([], [], label="by chance", **tick),
        Line2D([], [], label="by a clock", **clock_handle()),
    ]
    if any(place.location.id in scores.published for place in places):
        handles.append(Line2D([], [], label="published", **_published_look()))
    return handles
