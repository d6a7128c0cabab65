"""The share of people, and of the runs of each model, that marked each location."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from ssrics_like.people.beside import Beside
from ssrics_like.people.markers import PEOPLE
from ssrics_like.people.names import short
from ssrics_like.report import style
from ssrics_like.report.drawing import Drawing
from ssrics_like.report.labels import legend_grid, text_half_size
from ssrics_like.report.locations_figure import share_axis
from ssrics_like.report.people_style import colours_of, mark_look, name_tips, said
from ssrics_like.report.words import place_text

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ssrics_like.people.shares import Share

ROWS_MAX = 60
BAR_PT, SPACE_PT, RIGHT_PT, TOP_PT, BOTTOM_PT = 9.0, 8.0, 50.0, 26.0, 30.0
LEGEND_ROW_PT = 12.5
LEFTS_PT = (60.0, 190.0)


def draw_people_locations(made: Beside) -> Drawing | None:
    """Draw bars with Wilson intervals, people above each model; None without locations."""
    places = made.units.locations[:ROWS_MAX]
    if not places:
        return None
    groups = (PEOPLE, *(model.name for model in made.models))
    names = [short(place_text(place.id, place.label)) for place in places]
    widest_pt = max(2 * text_half_size(name, style.FONT_PT)[0] for name in names)
    left_pt = min(max(widest_pt + 10, LEFTS_PT[0]), LEFTS_PT[1])
    handles = _legend(made)
    width_pt = style.WIDTH_IN * style.POINTS - left_pt - RIGHT_PT
    columns, rows = legend_grid([handle.get_label() for handle in handles], width_pt)
    top_pt = TOP_PT + LEGEND_ROW_PT * (rows - 1)
    row_pt = BAR_PT * len(groups) + SPACE_PT
    figure = style.new_figure((top_pt + BOTTOM_PT + row_pt * len(places)) / style.POINTS)
    axes = style.place_axes(figure, left_pt, RIGHT_PT, BOTTOM_PT, top_pt)
    share_axis(axes, len(places))
    bar = BAR_PT / row_pt
    for number, one in enumerate(made.shares[: len(places) * len(groups)]):
        row, turn = divmod(number, len(groups))
        _draw_bar(axes, made, one, row + (turn - (len(groups) - 1) / 2) * bar, bar)
    axes.set_yticks(range(len(places)), names, color=style.INK, fontsize=style.FONT_PT)
    tips = name_tips(axes, names, [place_text(place.id, place.label) for place in places])
    axes.set_xlabel("share that marked the location, %")
    axes.legend(
        handles=handles, loc="lower left", bbox_to_anchor=(0, 1, 1, 0), borderaxespad=0.7,
        ncols=columns, columnspacing=1.8, handlelength=1.4,
    )  # fmt: skip
    every = len(made.units.locations)
    rest = f" The first {ROWS_MAX} of {every} locations." if every > ROWS_MAX else ""
    return Drawing(
        "locations",
        figure,
        f"Share of people and of each model's runs that marked each of {len(places)} locations",
        f"Who has a mark within {made.settings.radius_m:g} m of each location: bars are shares, "
        "lines their Wilson 95 % intervals, numbers at the right how many of how many. People "
        f"stand above the models.{rest}",
        tips,
    )


def _draw_bar(axes: Axes, made: Beside, one: Share, at: float, bar: float) -> None:
    colour = colours_of(made)[one.group]
    if math.isnan(one.share):
        return
    axes.barh(at, 100 * one.share, height=0.82 * bar, color=style.mixed(colour, 0.45), zorder=2)
    low, high = one.interval
    axes.plot([100 * low, 100 * high], [at, at], color=colour, linewidth=1.2, zorder=3)
    axes.plot(100 * one.share, at, zorder=4, clip_on=False, **mark_look(made, one.group, 4.2))
    axes.annotate(
        f"{one.marked} of {one.markers}", (1, at), (10, 0), va="center_baseline",
        xycoords=("axes fraction", "data"), textcoords="offset points", fontsize=style.TINY_PT,
        color=style.MUTED, annotation_clip=False,
    )  # fmt: skip


def _legend(made: Beside) -> list[Any]:
    from matplotlib.lines import Line2D

    colours = colours_of(made)
    groups = [(PEOPLE, len(made.people)), *((m.name, len(m.runs)) for m in made.models)]
    return [
        Line2D(
            [], [], label=said(group, count),
            **{**mark_look(made, group), "linestyle": "-", "color": colours[group],
               "linewidth": 1.2},
        )
        for group, count in groups
    ]  # fmt: skip
