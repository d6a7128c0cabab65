"""Novelty over time, and when what was decided."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ssrics_like.report import style
from ssrics_like.report.drawing import Drawing
from ssrics_like.report.pictures import Novelty
from ssrics_like.report.records import Results
from ssrics_like.report.words import clock, fraction_text

BINS_MAX = 1000  # about as many as the figure has pixels
LEFT_PT, RIGHT_PT, TOP_PT, BOTTOM_PT = 78.0, 54.0, 8.0, 28.0
CURVE_PT, LANE_PT = 150.0, 13.0


def draw_novelty(results: Results) -> Drawing | None:
    """Draw novelty over time; None for a run shorter than one interval."""
    run = results.shown
    novelty = coarser(results.pictures.novelty, BINS_MAX)
    if len(novelty.t_s) == 0:
        return None
    perception = results.scenario["perception"]
    threshold = 1.0 - float(perception["threshold"])
    unit = clock(run.duration_s)
    kinds = sorted(run.decided, key=style.decision_order)
    lanes_pt = LANE_PT * len(kinds)
    gap = 8.0 if kinds else 0.0
    figure = style.new_figure((TOP_PT + CURVE_PT + gap + lanes_pt + BOTTOM_PT) / style.POINTS)
    axes = style.place_axes(figure, LEFT_PT, RIGHT_PT, BOTTOM_PT + lanes_pt + gap, TOP_PT)
    t = novelty.t_s / unit.seconds
    axes.fill_between(t, novelty.least, novelty.largest, color=style.BLUE, alpha=0.22, linewidth=0)
    axes.plot(t, novelty.mean, color=style.BLUE, linewidth=0.9)
    axes.axhline(threshold, color=style.ACCENT, linewidth=1.0, dashes=(5, 3))
    end = max(run.duration_s, float(novelty.t_s[-1])) / unit.seconds or 1.0
    axes.set_xlim(0.0, end)
    axes.set_ylim(-0.02, 1.02)
    axes.set_yticks([0, 0.25, 0.5, 0.75, 1], ["0", ".25", ".5", ".75", "1"])
    axes.set_ylabel("novelty, 1 − τ")
    axes.grid(axis="y")
    axes.annotate(
        f"novel ≥ {fraction_text(threshold)}", (1, threshold), (4, 0), va="center", ha="left",
        xycoords=("axes fraction", "data"), textcoords="offset points", color=style.ACCENT,
        fontsize=style.SMALL_PT, fontweight="bold",
    )  # fmt: skip
    below = axes
    if kinds:
        axes.tick_params(labelbottom=False, bottom=False)
        below = style.place_axes(figure, LEFT_PT, RIGHT_PT, BOTTOM_PT, TOP_PT + CURVE_PT + gap)
        below.set_xlim(axes.get_xlim())
        below.set_ylim(len(kinds) - 0.5, -0.5)
        for lane, kind in enumerate(kinds):
            moments = np.array([r.t_s for r in run.reflexes if r.decision == kind])
            shown = _distinct(moments / unit.seconds, end / BINS_MAX)
            colour = style.INK if kind in ("declared", "recognised") else style.MUTED
            below.vlines(shown, lane - 0.32, lane + 0.32, color=colour, linewidth=0.8)
        below.set_yticks(
            range(len(kinds)), [f"{kind} ({run.decided[kind]})" for kind in kinds],
            fontsize=style.SMALL_PT,
        )  # fmt: skip
        below.tick_params(axis="y", length=0)
        below.spines["left"].set_visible(False)
    below.set_xlabel(unit.label())
    along_the_way = perception.get("along") == "metres"
    interval = f"{perception['interval']} {'places along the way' if along_the_way else 'scans'}"
    return Drawing(
        "novelty",
        figure,
        f"Novelty over {run.duration_s:.0f} seconds with the threshold at {threshold:.2f}",
        f"Novelty (1 minus the boredom quotient τ) of each interval of {interval}: the line "
        "is the mean, the band reaches from the least to the largest where several intervals share "
        "a pixel. An interval is novel where it reaches the dashed line (τ at most "
        f"{fraction_text(1.0 - threshold)}). The line is drawn at an interval's last scan; each "
        "tick below is a reflex at its own moment, in the row of what was decided about it.",
    )


def coarser(novelty: Novelty, bins_max: int) -> Novelty:
    """Join neighbouring bins until there are at most `bins_max`."""
    count = len(novelty.t_s)
    per_bin = -(-count // bins_max) if count else 1
    if per_bin == 1:
        return novelty
    starts = np.arange(0, count, per_bin)
    sizes = np.diff(np.append(starts, count))
    return Novelty(
        novelty.t_s[starts],
        np.add.reduceat(novelty.mean, starts) / sizes,
        np.minimum.reduceat(novelty.least, starts),
        np.maximum.reduceat(novelty.largest, starts),
    )


def _distinct(values: NDArray[np.float64], step: float) -> NDArray[np.float64]:
    """Leave one of all values that share a pixel."""
    _, first = np.unique(np.floor(values / step), return_index=True)
    chosen: NDArray[np.float64] = values[first]
    return chosen
