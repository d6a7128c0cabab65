"""Variants side by side: recall with its interval, chance and precision, a row each."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from ssrics_like.report import style
from ssrics_like.report.drawing import Drawing
from ssrics_like.report.locations_figure import (
    chance_look,
    clock_handle,
    draw_chance,
    draw_clock,
    draw_interval,
    ours_look,
    share_axis,
)
from ssrics_like.report.variants import Variant, Variants
from ssrics_like.report.variants_layout import grouped, labels_of, places_of, starts_of
from ssrics_like.report.words import figure_text

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.transforms import Transform

ROWS_MAX = 150
ROOMY = 24
"""So many rows are set wider apart than more are."""
ROOMY_PT, DENSE_PT = 17.0, 12.0
TOP_PT, BOTTOM_PT, RIGHT_PT = 42.0, 30.0, 82.0


def draw_variants(variants: Variants) -> Drawing | None:
    """Draw a row for each variant, grouped by factor; None where nothing was scored."""
    scored = [v for v in variants.done if not math.isnan(v.figures["recall"])]
    if not scored:
        return None
    rows = grouped(scored, variants.factors)[:ROWS_MAX]
    columns = labels_of(rows, variants.factors)
    places, lines = places_of(columns)
    row_pt = ROOMY_PT if len(rows) <= ROOMY else DENSE_PT
    height_pt = TOP_PT + BOTTOM_PT + row_pt * (places[-1] + 1)
    size = style.FONT_PT if len(rows) <= ROOMY else style.SMALL_PT
    starts, left_pt = starts_of(columns, variants.factors or ("variant",), size)
    figure = style.new_figure(height_pt / style.POINTS)
    axes = style.place_axes(figure, left_pt, RIGHT_PT, BOTTOM_PT, TOP_PT)
    share_axis(axes, 1)
    axes.set_ylim(places[-1] + 0.5, -0.5)
    axes.set_yticks([])
    for at, factor in lines:
        begin = (starts[factor] - left_pt) / (style.WIDTH_IN * style.POINTS - left_pt - RIGHT_PT)
        axes.plot([begin, 1], [at, at], color=style.RULE, linewidth=0.5 if factor else 0.9,
                  clip_on=False, transform=_share_then_row(axes), zorder=0)  # fmt: skip
    published = _published(rows)
    if not math.isnan(published):
        axes.axvline(100 * published, color=style.ACCENT, linewidth=1.0, dashes=(5, 3), zorder=1)
        axes.annotate(
            f"published {100 * published:.0f} %", (100 * published, 1), (0, 3), ha="center",
            xycoords=("data", "axes fraction"), textcoords="offset points", color=style.ACCENT,
            fontsize=style.SMALL_PT, fontweight="bold",
        )  # fmt: skip
    for row, texts, at in zip(rows, columns, places, strict=True):
        _draw_row(axes, row, at, size)
        _write_row(axes, texts, at, starts, left_pt, size, bold=row is variants.nearest)
    _headings(axes, variants.factors or ("variant",), starts, left_pt)
    axes.set_xlabel("per cent")
    axes.legend(
        handles=_legend(), loc="lower left", bbox_to_anchor=(0, 1, 1, 0), borderaxespad=2.0,
        ncols=3, columnspacing=1.8, handlelength=1.6,
    )  # fmt: skip
    return Drawing(
        "variants",
        figure,
        f"Recall, chance and precision of {len(rows)} variants",
        _caption(variants, rows, len(scored)),
    )


def _draw_row(axes: Axes, variant: Variant, at: float, size: float) -> None:
    figures = variant.figures
    dense = size < style.FONT_PT
    if not math.isnan(figures["chance"]):
        draw_chance(axes, at, figures["chance"], 0.34)
    if not math.isnan(figures["clock"]):
        draw_clock(axes, at, figures["clock"], 0.34)
    draw_interval(
        axes, at, figures["recall"], (figures["low"], figures["high"]), 5.2 if dense else 6.5
    )
    if not math.isnan(figures["precision"]):
        axes.plot(100 * figures["precision"], at, zorder=6, **_precision_look(dense=dense))
    axes.annotate(
        figure_text(figures["marks_per_100_m"], 1), (1, at), (RIGHT_PT - 6, 0), ha="right",
        va="center_baseline", xycoords=("axes fraction", "data"), textcoords="offset points",
        fontsize=size, annotation_clip=False,
    )  # fmt: skip


def _write_row(
    axes: Axes,
    texts: tuple[str, ...],
    at: float,
    starts: list[float],
    left_pt: float,
    size: float,
    *,
    bold: bool,
) -> None:
    for text, start in zip(texts, starts, strict=True):
        if text:
            axes.annotate(
                text, (0, at), (start - left_pt, 0), va="center_baseline", ha="left",
                xycoords=("axes fraction", "data"), textcoords="offset points", fontsize=size,
                annotation_clip=False,
            )  # fmt: skip
    if bold:
        axes.annotate(
            "▸", (0, at), (-9, 0), va="center_baseline", ha="left", fontsize=size + 1,
            xycoords=("axes fraction", "data"), textcoords="offset points", color=style.ACCENT,
            annotation_clip=False,
        )  # fmt: skip


def _headings(axes: Axes, factors: tuple[str, ...], starts: list[float], left_pt: float) -> None:
    heads = [
        (name, start - left_pt, 0, "left") for name, start in zip(factors, starts, strict=True)
    ]
    heads.append(("marks per 100 m", RIGHT_PT - 6, 1, "right"))
    for text, offset, side, align in heads:
        axes.annotate(
            text, (side, 1), (offset, 3), xycoords="axes fraction", textcoords="offset points",
            fontsize=style.SMALL_PT, color=style.MUTED, ha=align, annotation_clip=False,
        )  # fmt: skip


def _share_then_row(axes: Axes) -> Transform:
    """Return coordinates: a share of the axes' width, then a row."""
    from matplotlib.transforms import blended_transform_factory

    return blended_transform_factory(axes.transAxes, axes.transData)


def _published(rows: list[Variant]) -> float:
    """Return the mean of the published shares; NaN without any."""
    shares = next((list(row.published.values()) for row in rows if row.published), [])
    return sum(shares) / len(shares) if shares else math.nan


def _precision_look(*, dense: bool) -> dict[str, Any]:
    return {"marker": "s", "linestyle": "none", "markersize": 4.2 if dense else 5.2,
            "markerfacecolor": "none", "markeredgecolor": style.INK,
            "markeredgewidth": 1.0}  # fmt: skip


def _legend() -> list[Any]:
    from matplotlib.lines import Line2D

    recall: dict[str, Any] = {**ours_look(6.0), "linestyle": "-", "linewidth": 1.6,
                              "color": style.BLUE}  # fmt: skip
    tick: dict[str, Any] = {"marker": "|", "linestyle": "none", "markersize": 9,
                            "markeredgewidth": 2.2,
                            "markeredgecolor": chance_look()["color"]}  # fmt: skip
    return [
        Line2D([], [], label="recall, with 95 % interval", **recall),
        Line2D([], [], label="recall by chance", **tick),
        Line2D([], [], label="by a clock", **clock_handle()),
        Line2D([], [], label="precision", **_precision_look(dense=False)),
    ]


def _caption(variants: Variants, rows: list[Variant], scored: int) -> str:
    """Say what is seen, and how to read it."""
    by = f", grouped by {', '.join(variants.factors)}" if variants.factors else ""
    text = (
        f"Every variant in a row{by}: the share of designated locations found, over all runs, with "
        "the Wilson 95 % interval; the broad tick is what as many marks at random along the path "
        "would find, the thin one what they would find at equal intervals of time. Recall right of "
        "its ticks by little is worth little, however high. Squares are the "
        "share of marked places at which something is labelled."
    )
    if variants.nearest is not None:
        text += (
            f" Broken line: mean of the published shares ({variants.published_in}); the arrow "
            "points at the variant whose shares come nearest to them."
        )
    return text + (f" The first {len(rows)} of {scored}." if scored > len(rows) else "")
