"""The agreement of every two markers, as a matrix."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ssrics_like.people.beside import Beside
from ssrics_like.people.names import short
from ssrics_like.people.resampling import known_mean
from ssrics_like.report import style
from ssrics_like.report.drawing import Drawing
from ssrics_like.report.labels import text_half_size
from ssrics_like.report.people_style import colours_of, name_tips
from ssrics_like.report.words import number_text

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.colors import Colormap
    from matplotlib.figure import Figure

SIDE_PT = 34.0
"""Largest side of a cell; the matrix is not wider than the page."""
WRITTEN_PT, NAMED_PT = 13.0, 6.5
"""Cells at least so large carry their value, and rows their marker's name."""
CELLS_MAX = 150
"""Of more markers the cells are a picture, without a line around each."""
TOP_PT, BOTTOM_PT, LEFT_PT, BAR_PT = 30.0, 12.0, 22.0, 84.0
NAME_MAX = 16
GLYPH_PT = 6.6
"""Width of a bold letter."""


def draw_people_agreement(made: Beside) -> Drawing | None:
    """Draw Cohen's kappa of every two markers; None for a single one."""
    order = agreement_order(made)
    count = len(order)
    if count < 2:  # noqa: PLR2004 - no pair
        return None
    whole = [made.markers[i].name for i in order]
    names = [short(name, NAME_MAX) for name in whole]
    width_pt = style.WIDTH_IN * style.POINTS - LEFT_PT - BAR_PT
    names_pt = max(2 * text_half_size(name, style.SMALL_PT)[0] for name in names)
    if (width_pt - names_pt) / count < NAMED_PT:
        names, names_pt = [], 0.0
    side_pt, left_pt = min((width_pt - names_pt) / count, SIDE_PT), LEFT_PT + names_pt
    size_pt = side_pt * count
    height_pt = max(size_pt + TOP_PT + BOTTOM_PT, 190.0)
    width_pt = left_pt + size_pt + BAR_PT
    figure = style.new_figure(height_pt / style.POINTS, width_pt / style.POINTS)
    axes = style.place_axes(figure, left_pt, BAR_PT, height_pt - TOP_PT - size_pt, TOP_PT)
    values = made.kappa[np.ix_(order, order)]
    _draw_cells(axes, values, side_pt)
    tips = {}
    if names:
        size = min(style.FONT_PT, side_pt - 0.8)
        axes.set_yticks(np.arange(count) + 0.5, names, fontsize=size)
        tips = name_tips(axes, names, whole)
    else:
        axes.set_yticks([])
    _draw_groups(axes, made, side_pt, before=not names)
    _draw_scale(figure, left_pt + size_pt, height_pt, width_pt)
    return Drawing(
        "agreement",
        figure,
        f"Matrix of Cohen's kappa of every two of {count} markers",
        "Cohen's κ of every two markers over all units: people first, in order of their mean κ "
        "with the other people, then the runs of each model, likewise with the people. White is "
        f"agreement as by chance, blue above, orange below it.{_undefined(values)}",
        tips,
    )


def agreement_order(made: Beside) -> list[int]:
    """Return the markers as they are drawn: within each group the most agreed with first."""
    count = len(made.people)
    score = known_mean(made.kappa[:, :count], axis=1)
    score = np.where(np.isfinite(score), score, -np.inf)
    order, first = [], 0
    for table in made.marked.values():
        mine = np.arange(first, first + len(table))
        order += mine[np.argsort(-score[mine], kind="stable")].tolist()
        first += len(table)
    return order


def colours_of_kappa() -> Colormap:
    """Return colours of kappa from -1, orange, over 0, white, to 1, blue."""
    from matplotlib.colors import LinearSegmentedColormap

    return LinearSegmentedColormap.from_list("kappa", [style.VERMILION, "white", "#00487a"])


def kappa_text(value: float) -> str:
    """Return kappa in as little room as there is: ``.90``, ``−.05``, ``1``."""
    return number_text(value, 2).replace("0.", ".").replace("1.00", "1")


def _undefined(values: NDArray[np.float64]) -> str:
    """Say what hatching means, where there is some."""
    apart = ~np.eye(len(values), dtype=bool)
    if np.isfinite(values[apart]).all():
        return ""
    return " Hatched: not defined, since both marked nothing, or everything."


def _draw_cells(axes: Axes, values: NDArray[np.float64], side_pt: float) -> None:
    from matplotlib.patches import Rectangle

    count = len(values)
    axes.set_xlim(0, count)
    axes.set_ylim(count, 0)
    shown = np.ma.masked_invalid(values)
    look: dict[str, Any] = {"cmap": colours_of_kappa(), "vmin": -1, "vmax": 1}
    if count > CELLS_MAX:
        axes.imshow(shown, extent=(0, count, count, 0), aspect="auto", interpolation="none", **look)
    else:
        axes.pcolormesh(shown, edgecolors="white", linewidth=0.4, **look)
    for i, j in zip(*np.nonzero(~np.isfinite(values)), strict=True):
        same = i == j
        axes.add_patch(
            Rectangle((j, i), 1, 1, facecolor=style.UNKNOWN, edgecolor="white", linewidth=0.4,
                      hatch=None if same else "////")
        )  # fmt: skip
    if side_pt >= WRITTEN_PT:
        for (i, j), value in np.ndenumerate(values):
            if math.isfinite(value):
                axes.text(
                    j + 0.5, i + 0.5, kappa_text(value), ha="center", va="center_baseline",
                    fontsize=min(0.42 * side_pt, style.FONT_PT),
                    color="white" if abs(value) > 0.45 else style.INK,  # noqa: PLR2004
                )  # fmt: skip
    axes.set_xticks([])
    axes.tick_params(axis="y", length=0, pad=2, labelcolor=style.INK)
    for spine in axes.spines.values():
        spine.set_visible(False)


def _draw_groups(axes: Axes, made: Beside, side_pt: float, *, before: bool) -> None:
    """Draw each group's name above its columns, and before its rows if those carry no name."""
    first, groups = 0, colours_of(made)
    for number, (group, table) in enumerate(made.marked.items()):
        last = first + len(table)
        look: dict[str, Any] = {"color": groups[group], "linewidth": 3.0, "clip_on": False,
                                "solid_capstyle": "butt"}  # fmt: skip
        room = int((last - first) * side_pt / GLYPH_PT)
        # Above the names of rows there is room to the left of the first group.
        to_left = number == 0 and not before and len(group) > room
        name = short(group, NAME_MAX if to_left else max(2, room))
        said: dict[str, Any] = {
            "textcoords": "offset points", "fontsize": style.FONT_PT, "fontweight": "bold",
            "color": groups[group], "annotation_clip": False,
        }  # fmt: skip
        axes.plot([first + 0.1, last - 0.1], [-4 / side_pt] * 2, **look)
        axes.annotate(
            name, (last if to_left else first, 0), (-5 if to_left else 0.5, 9),
            ha="right" if to_left else "left", va="bottom", **said,
        )  # fmt: skip
        if before:
            axes.plot([-4 / side_pt] * 2, [first + 0.1, last - 0.1], **look)
            axes.annotate(name, (0, first), (-9, 0), ha="right", va="top", rotation=90, **said)
        if number:
            axes.axhline(first, color="white", linewidth=2.4)
            axes.axvline(first, color="white", linewidth=2.4)
        first = last


def _draw_scale(figure: Figure, right_pt: float, height_pt: float, width_pt: float) -> None:
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize

    left_pt = right_pt + 20.0
    axes = style.place_axes(
        figure, left_pt, width_pt - left_pt - 11.0, max(height_pt - TOP_PT - 150.0, 20.0), TOP_PT
    )
    bar = figure.colorbar(ScalarMappable(Normalize(-1, 1), colours_of_kappa()), cax=axes)
    bar.set_ticks([-1, -0.5, 0, 0.5, 1], labels=["−1", "−.5", "0", ".5", "1"])
    bar.set_label("Cohen's κ")
    bar.outline.set_visible(False)
    bar.ax.tick_params(length=0)
