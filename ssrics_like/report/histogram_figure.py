"""The histograms of a novel and of a bored interval, as the report's figures 1 and 2."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ssrics_like.report import style
from ssrics_like.report.drawing import Drawing
from ssrics_like.report.pictures import Histogram
from ssrics_like.report.records import Results
from ssrics_like.report.words import fraction_text

if TYPE_CHECKING:
    from matplotlib.axes import Axes

HEIGHT_PT = 184.0
LEFT_PT, RIGHT_PT, TOP_PT, BOTTOM_PT, BETWEEN_PT = 42.0, 8.0, 38.0, 30.0, 56.0
BAR, LAST_BAR = "#b5c7d8", style.ACCENT


def draw_histograms(results: Results) -> Drawing | None:
    """Draw both histograms side by side; None where the run has neither."""
    novel, bored = results.pictures.novel, results.pictures.bored
    if novel is None and bored is None:
        return None
    figure = style.new_figure(HEIGHT_PT / style.POINTS)
    half = (style.WIDTH_IN * style.POINTS - LEFT_PT - RIGHT_PT - BETWEEN_PT) / 2
    threshold = float(results.scenario["perception"]["threshold"])
    for i, (name, histogram) in enumerate((("novel", novel), ("bored", bored))):
        left = LEFT_PT + i * (half + BETWEEN_PT)
        right = style.WIDTH_IN * style.POINTS - left - half
        axes = style.place_axes(figure, left, right, BOTTOM_PT, TOP_PT)
        if histogram is None:
            _nothing(axes, f"no {name} interval in this run")
        else:
            _bars(axes, histogram, name, threshold)
    return Drawing(
        "histograms",
        figure,
        "Histograms of the correlations within a novel and a bored interval",
        "How alike the scans of one interval are: every pair of scans by its correlation. Pairs in "
        "the last bar, at or above the gradient, are the boring ones; their share is the boredom "
        "quotient τ. The first bar also holds everything lower. After the report's figures 1 "
        "and 2.",
    )


def _bars(axes: Axes, histogram: Histogram, name: str, threshold: float) -> None:
    from matplotlib.ticker import MaxNLocator

    counts, edges = histogram.counts, histogram.edges
    bins = len(counts)
    pairs = sum(counts)
    colours = [BAR] * (bins - 1) + [LAST_BAR]
    axes.bar(range(bins), counts, width=0.86, color=colours)
    top = max(counts) or 1
    for i, count in enumerate(counts):
        if count == 0:
            continue
        axes.annotate(
            f"{count}", (i, count), (0, 2), textcoords="offset points", ha="center", va="bottom",
            fontsize=style.TINY_PT, color=LAST_BAR if i == bins - 1 else style.MUTED,
            fontweight="bold" if i == bins - 1 else "normal",
        )  # fmt: skip
    axes.set_xlim(-0.6, bins - 0.4)
    axes.set_ylim(0, top * 1.1)
    labels = [fraction_text(edge) for edge in edges]
    if edges[0] > -1:
        labels[0] = f"≤ {labels[0]}"
    axes.set_xticks([i - 0.5 for i in range(bins + 1)], labels)
    axes.set_xlabel("correlation of two scans")
    axes.set_ylabel("pairs of scans")
    axes.yaxis.set_major_locator(MaxNLocator(integer=True, steps=[1, 2, 5, 10]))
    axes.grid(axis="y")
    verdict = "above" if histogram.tau > threshold else "not above"
    axes.annotate(
        f"{name.capitalize()} interval, τ = {fraction_text(histogram.tau, 3)}", (0, 1), (0, 20),
        xycoords="axes fraction", textcoords="offset points", fontsize=style.FONT_PT + 1,
        fontweight="bold",
    )  # fmt: skip
    axes.annotate(
        f"{counts[-1]} of {pairs} pairs are boring, which is {verdict} the threshold "
        f"{fraction_text(threshold)}; ends at scan {histogram.scan}",
        (0, 1), (0, 8), xycoords="axes fraction", textcoords="offset points",
        fontsize=style.SMALL_PT + 0.5, color=style.MUTED,
    )  # fmt: skip


def _nothing(axes: Axes, text: str) -> None:
    """Say in empty axes why they are empty."""
    axes.set_axis_off()
    axes.text(
        0.5, 0.5, text, transform=axes.transAxes, ha="center", va="center", color=style.MUTED,
        fontstyle="italic",
    )  # fmt: skip
