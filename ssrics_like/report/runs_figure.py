"""Several runs side by side: a small map of each."""

from __future__ import annotations

import math

import numpy as np

from ssrics_like.report import style
from ssrics_like.report.drawing import Drawing
from ssrics_like.report.frames import frame_around
from ssrics_like.report.map_figure import draw_path, extent_of
from ssrics_like.report.reading import read_pictures
from ssrics_like.report.records import Results
from ssrics_like.report.walls import draw_walls

MAPS_MAX = 12
COLUMNS_MAX = 4
GAP_PT, TITLE_PT = 10.0, 16.0
HEIGHTS_PT = (80.0, 220.0)


def draw_runs(results: Results) -> Drawing | None:
    """Draw a map for each of the first dozen runs, at one scale; None for a single run."""
    runs = results.runs[:MAPS_MAX]
    if len(runs) == 1:
        return None
    rows = math.ceil(len(runs) / COLUMNS_MAX)
    columns = math.ceil(len(runs) / rows)
    width_pt = (style.WIDTH_IN * style.POINTS - 2 - (columns - 1) * GAP_PT) / columns
    outlines = [read_pictures(results.folder, run).outline for run in runs]
    everywhere = [extent_of(run, outline) for run, outline in zip(runs, outlines, strict=True)]
    frame = frame_around(np.concatenate(everywhere), width_pt, HEIGHTS_PT)
    height_pt = rows * (frame.height_pt + TITLE_PT) + (rows - 1) * GAP_PT + 2
    figure = style.new_figure(height_pt / style.POINTS)
    for i, run in enumerate(runs):
        row, column = divmod(i, columns)
        left = 1 + column * (width_pt + GAP_PT)
        top = TITLE_PT + row * (frame.height_pt + TITLE_PT + GAP_PT)
        axes = style.place_axes(
            figure, left, style.WIDTH_IN * style.POINTS - left - width_pt,
            height_pt - top - frame.height_pt, top,
        )  # fmt: skip
        draw_walls(axes, outlines[i], frame, strength=0.6, side_px=500)
        axes.set_xlim(frame.left, frame.right)
        axes.set_ylim(frame.bottom, frame.top)
        draw_path(axes, run.path, frame, width=0.7, parts=12)
        for sector in sorted({mark.sector for mark in run.landmarks}):
            places = [(m.drawn_x_m, m.drawn_y_m) for m in run.landmarks if m.sector == sector]
            axes.plot(
                *zip(*places, strict=True), "o", markersize=3.6, markeredgewidth=0.4,
                markeredgecolor="white", markerfacecolor=style.sector_colour(sector), zorder=8,
            )  # fmt: skip
        axes.set_xticks([])
        axes.set_yticks([])
        for spine in axes.spines.values():
            spine.set_visible(True)
            spine.set_color(style.RULE)
        axes.annotate(
            f"run {run.number}", (0, 1), (1, 4), xycoords="axes fraction",
            textcoords="offset points", fontsize=style.FONT_PT, fontweight="bold",
        )  # fmt: skip
        axes.annotate(
            f"landmarks: {len(run.landmarks)}", (1, 1), (-1, 4), xycoords="axes fraction",
            textcoords="offset points", fontsize=style.SMALL_PT, color=style.MUTED, ha="right",
        )  # fmt: skip
    noise = "" if runs[0].is_true else " Runs of a log differ only in the noise of the model."
    rest = f" The first {MAPS_MAX} of {len(results.runs)}." if len(results.runs) > MAPS_MAX else ""
    return Drawing(
        "runs",
        figure,
        f"Small maps of {len(runs)} runs with their landmarks",
        f"Every run at the same scale, with its landmarks coloured by sector.{noise}{rest}",
    )
