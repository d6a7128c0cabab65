"""Base-level activation of landmark chunks over time."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.report import style
from ssrics_like.report.drawing import HALO, Drawing
from ssrics_like.report.labels import spread
from ssrics_like.report.records import Results
from ssrics_like.report.words import clock, fraction_text

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from matplotlib.transforms import Transform

SHOWN_MAX = len(style.HIGHLIGHTS)
"""Landmarks drawn in colour; the others are pale."""
PALE_MAX = 200
LEFT_PT, RIGHT_PT, TOP_PT, BOTTOM_PT = 42.0, 74.0, 10.0, 30.0
HEIGHT_PT = 250.0
LABEL_GAP_PT = 9.5
LOWEST_BELOW_THRESHOLD = 1.0


def draw_activation(results: Results) -> Drawing | None:
    """Draw base levels over time; None where memory holds no landmark."""
    run, data = results.shown, results.pictures.activation
    visits = {mark.name: mark.visits for mark in run.landmarks}
    levels = {n: v for n, v in data.base_level.items() if np.isfinite(v).any()}
    if not levels:
        return None
    unit = clock(run.duration_s)
    t = data.t_s / unit.seconds
    ranked = sorted(levels, key=lambda name: -visits.get(name, 0))  # stable: oldest first
    coloured, others = ranked[:SHOWN_MAX], ranked[SHOWN_MAX : SHOWN_MAX + PALE_MAX]
    figure = style.new_figure(HEIGHT_PT / style.POINTS)
    axes = style.place_axes(figure, LEFT_PT, RIGHT_PT, BOTTOM_PT, TOP_PT)
    for name in reversed(others):
        axes.plot(t, levels[name], color=style.RULE, linewidth=0.6, zorder=1)
    threshold = float(results.scenario["memory"]["retrieval_threshold"])
    end = float(t[-1]) or 1.0
    axes.set_xlim(0.0, end)
    finite = np.concatenate([v[np.isfinite(v)] for v in levels.values()])
    low = min(float(finite.min()), threshold) - 0.4
    high = max(float(finite.max()), threshold) + 0.4
    axes.set_ylim(low, high)
    axes.axhline(threshold, color=style.ACCENT, linewidth=1.0, dashes=(5, 3), zorder=4)
    axes.annotate(
        f"retrieval threshold {fraction_text(threshold)}", (0, threshold), (4, 3), va="bottom",
        xycoords=("axes fraction", "data"), textcoords="offset points", color=style.ACCENT,
        fontsize=style.SMALL_PT, fontweight="bold", gid=f"{HALO}-threshold", zorder=6,
    )  # fmt: skip
    inner_pt = HEIGHT_PT - TOP_PT - BOTTOM_PT
    per_unit = inner_pt / (high - low)
    ends = [float(levels[n][np.isfinite(levels[n])][-1]) for n in coloured]
    wanted = [(level - low) * per_unit for level in ends]
    corner = _from_lower_right(axes, figure)
    placed = spread(wanted, LABEL_GAP_PT, 3.0, inner_pt - 3.0)
    for i, name in enumerate(coloured):
        colour = style.HIGHLIGHTS[i]
        axes.plot(t, levels[name], color=colour, linewidth=1.15, zorder=3)
        axes.annotate(
            f"{name} ({visits.get(name, 0)})", (1, ends[i]), (16, placed[i]),
            xycoords=("axes fraction", "data"), textcoords=corner, va="center_baseline",
            ha="left", color=colour, fontsize=style.SMALL_PT, fontweight="bold",
            arrowprops={"arrowstyle": "-", "color": colour, "linewidth": 0.6, "shrinkA": 1,
                        "shrinkB": 0, "relpos": (0, 0.5)},
        )  # fmt: skip
    axes.set_xlabel(unit.label())
    axes.set_ylabel("base-level activation")
    axes.grid(axis="y")
    rest = f"; the other {len(levels) - len(coloured)} are pale" if len(levels) > SHOWN_MAX else ""
    return Drawing(
        "activation",
        figure,
        f"Base-level activation of {len(levels)} landmark chunks over time",
        "How well each landmark is remembered: its base level jumps when it is declared or "
        f"recognised and decays from then on. The {len(coloured)} most visited are labelled; the "
        f"number of visits (returns from another landmark) is in brackets{rest}. Below the dashed "
        "line a landmark can only be recalled with help from noise or spreading activation. "
        "Sampled at "
        f"{len(t)} moments, so that the height of the jumps is not exact.",
    )


def _from_lower_right(axes: Axes, figure: Figure) -> Transform:
    """Return coordinates in points from the lower right corner of the axes."""
    from matplotlib.transforms import Affine2D, ScaledTranslation

    box = axes.get_position()
    width_in, height_in = figure.get_size_inches()
    corner = ScaledTranslation(box.x1 * width_in, box.y0 * height_in, figure.dpi_scale_trans)
    return Affine2D().scale(1 / style.POINTS) + figure.dpi_scale_trans + corner
