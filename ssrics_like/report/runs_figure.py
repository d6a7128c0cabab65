"""Several runs side by side: a small map of each."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.report import style
from ssrics_like.report.background import extent_of
from ssrics_like.report.drawing import HALO, Drawing
from ssrics_like.report.frames import Frame, frame_around
from ssrics_like.report.map_figure import draw_path
from ssrics_like.report.pictures import Outline
from ssrics_like.report.plan import draw_plans
from ssrics_like.report.reading import read_pictures
from ssrics_like.report.records import Results
from ssrics_like.report.walls import draw_walls
from ssrics_like.results.records import Landmark, Run

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MAPS_MAX = 16
COLUMNS_MAX = 4
GAP_PT, TITLE_PT = 10.0, 16.0
HEIGHTS_PT = (80.0, 220.0)
STRENGTH = 0.6


def draw_runs(results: Results) -> Drawing | None:
    """Draw a map for each of the first runs, at one scale; None for a single run."""
    runs = results.runs[:MAPS_MAX]
    if len(runs) == 1:
        return None
    rows = math.ceil(len(runs) / COLUMNS_MAX)
    columns = math.ceil(len(runs) / rows)
    width_pt = (style.WIDTH_IN * style.POINTS - 2 - (columns - 1) * GAP_PT) / columns
    outlines = [_outline(results, run) for run in runs]
    everywhere = [extent_of(results, r, seen) for r, seen in zip(runs, outlines, strict=True)]
    frame = frame_around(np.concatenate(everywhere), width_pt, HEIGHTS_PT)
    height_pt = rows * (frame.height_pt + TITLE_PT) + (rows - 1) * GAP_PT + 2
    figure = style.new_figure(height_pt / style.POINTS)
    corners = []
    for i in range(len(runs)):
        row, column = divmod(i, columns)
        left = 1 + column * (width_pt + GAP_PT)
        top = TITLE_PT + row * (frame.height_pt + TITLE_PT + GAP_PT)
        bottom = height_pt - top - frame.height_pt
        corners.append((left, bottom))
        right = style.WIDTH_IN * style.POINTS - left - width_pt
        axes = style.place_axes(figure, left, right, bottom, top)
        if results.building is None:
            draw_walls(axes, outlines[i], frame, strength=STRENGTH, side_px=500)
        else:
            axes.patch.set_visible(False)  # the plan lies below
        _small_map(axes, results, i, frame)
    if results.building is not None:
        draw_plans(figure, results.building.grid, frame, corners, strength=STRENGTH)
    noise = "" if runs[0].is_true else " Runs of a log differ only in the noise of the model."
    rest = f" The first {MAPS_MAX} of {len(results.runs)}." if len(results.runs) > MAPS_MAX else ""
    circles = (
        " Circles are the designated locations, thick where the run found one and thin and broken "
        "where it did not."
        if results.scores
        else ""
    )
    return Drawing(
        "runs",
        figure,
        f"Small maps of {len(runs)} runs with their landmarks",
        "Every run at the same scale, with its landmarks coloured by sector."
        f"{circles}{noise}{rest}",
    )


def _outline(results: Results, run: Run) -> Outline:
    """Read the walls that a run's laser saw; none are needed where there is a plan."""
    if results.building is not None:
        return Outline(1.0, np.empty(0, np.int64), np.empty(0, np.int64))
    return read_pictures(results.folder, run).outline


def _small_map(axes: Axes, results: Results, index: int, frame: Frame) -> None:
    run = results.runs[index]
    axes.set_xlim(frame.left, frame.right)
    axes.set_ylim(frame.bottom, frame.top)
    draw_path(axes, run.path, frame, width=0.7, parts=12, landings=run.landings)
    _dots(axes, run.landmarks)
    axes.set_xticks([])
    axes.set_yticks([])
    for spine in axes.spines.values():
        spine.set_visible(True)
        spine.set_color(style.RULE)
    axes.annotate(
        f"run {run.number}", (0, 1), (1, 4), xycoords="axes fraction",
        textcoords="offset points", fontsize=style.FONT_PT, fontweight="bold",
    )  # fmt: skip
    said = f"landmarks: {len(run.landmarks)}"
    if results.scores:
        tally = results.scores.scores.runs[index]
        said += f" · found: {tally.found} of {tally.designated}"
        _circles(axes, results, index, frame)
    axes.annotate(
        said, (1, 1), (-1, 4), xycoords="axes fraction", textcoords="offset points",
        fontsize=style.SMALL_PT, color=style.MUTED, ha="right",
    )  # fmt: skip


def _dots(axes: Axes, landmarks: tuple[Landmark, ...]) -> None:
    for sector in sorted({mark.sector for mark in landmarks}):
        places = [(m.drawn_x_m, m.drawn_y_m) for m in landmarks if m.sector == sector]
        axes.plot(
            *zip(*places, strict=True), "o", markersize=3.6, markeredgewidth=0.4,
            markeredgecolor="white", markerfacecolor=style.sector_colour(sector), zorder=8,
        )  # fmt: skip


def _circles(axes: Axes, results: Results, index: int, frame: Frame) -> None:
    """Draw the designated places with their numbers, which stand alike in every map."""
    from matplotlib.patches import Circle

    assert results.scores is not None
    scores = results.scores.scores
    aside_pt = 0.75 * scores.radius_m * frame.points_per_m + 1.5
    for place, found in zip(scores.places, scores.found[index].tolist(), strict=True):
        if not place.designated:
            continue
        at = place.location.x_m, place.location.y_m
        axes.add_patch(
            Circle(at, scores.radius_m, facecolor="none", edgecolor=style.ACCENT, zorder=5,
                   linewidth=1.3 if found else 0.7, linestyle="-" if found else (0, (2.5, 1.8)))
        )  # fmt: skip
        axes.annotate(
            place.location.id, at, (aside_pt, aside_pt), textcoords="offset points", ha="left",
            va="bottom", fontsize=style.TINY_PT, fontweight="bold", color=style.ACCENT, zorder=9,
            gid=f"{HALO}-{index}-{place.location.id}",
        )  # fmt: skip
