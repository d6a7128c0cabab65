"""F over noise, dropouts, scan rate and speed: a panel each, a line for each candidate."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from ssrics_like.bench.conditions import SWEEPS
from ssrics_like.bench.words import called
from ssrics_like.report import style
from ssrics_like.report.drawing import Drawing, as_svg
from ssrics_like.report.labels import spread

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ssrics_like.bench.candidates import Candidate
    from ssrics_like.bench.courses import Course
    from ssrics_like.bench.running import Bench

COLUMNS = 2
PANEL_PT = 250.0
LEFT_PT, LABELS_PT, BOTTOM_PT, TOP_PT = 34.0, 118.0, 32.0, 20.0
LABEL_STEP_PT = 8.6
LEAST_PT = 4.0
OURS_PT, BASELINE_PT = 2.4, 0.9
THEIR_COLOURS = (*style.HIGHLIGHTS, style.ORANGE, style.GREEN)
OUR_COLOURS = (style.BLUE, style.VERMILION)
CHANCE = "chance"


def curves_svg(bench: Bench) -> str | None:
    """Return the curves as SVG text; None where no course is a point of one."""
    names = dict.fromkeys(course.sweep for course in bench.courses if course.sweep)
    if not names:
        return None
    with style.context():
        columns = min(COLUMNS, len(names))
        rows = math.ceil(len(names) / columns)
        width = style.WIDTH_IN * style.POINTS
        figure = style.new_figure(rows * PANEL_PT / style.POINTS)
        panel = width / columns
        for i, name in enumerate(names):
            row, column = divmod(i, columns)
            left, top = column * panel + LEFT_PT, row * PANEL_PT + TOP_PT
            axes = style.place_axes(
                figure, left, width - (column + 1) * panel + LABELS_PT,
                (rows - row - 1) * PANEL_PT + BOTTOM_PT, top,
            )  # fmt: skip
            _draw(axes, bench, name, PANEL_PT - TOP_PT - BOTTOM_PT)
        label = "F of the designators over " + ", ".join(SWEEPS[name].title for name in names)
        return as_svg(Drawing("curves", figure, label, ""))


def _draw(axes: Axes, bench: Bench, name: str, height_pt: float) -> None:
    sweep = SWEEPS[name]
    points = [course for course in bench.courses if course.sweep == name]
    at = [course.value for course in points]
    if sweep.logarithmic:
        axes.set_xscale("log", base=2)
    axes.set_xlim(min(at), max(at) if max(at) > min(at) else min(at) + 1.0)
    axes.set_xticks(at, [f"{value:g}" for value in at], minor=False)
    axes.minorticks_off()
    axes.set_ylim(0.0, 1.0)
    axes.set_yticks([0.0, 0.2, 0.4, 0.6, 0.8, 1.0])
    axes.grid(visible=True, axis="y")
    axes.set_title(f"F over {sweep.title}")
    lines = _lines(bench, points)
    labels = []
    for text, values, colour, weight, dashed in lines:
        axes.plot(
            at, values, color=colour, linewidth=weight, linestyle=(0, (4, 3)) if dashed else "-",
            clip_on=False, zorder=5 if weight == OURS_PT else 3, solid_capstyle="round",
        )  # fmt: skip
        last = next((value for value in reversed(values) if not math.isnan(value)), math.nan)
        if not math.isnan(last):
            labels.append((text, last, colour, weight))
    placed = spread(
        [last * height_pt for _, last, _, _ in labels], LABEL_STEP_PT, LEAST_PT, height_pt
    )
    for (text, last, colour, weight), y_pt in zip(labels, placed, strict=True):
        axes.plot(
            [1.01, 1.05], [last, y_pt / height_pt], transform=axes.transAxes, color=colour,
            linewidth=0.6, clip_on=False,
        )  # fmt: skip
        axes.annotate(
            text, (1.06, y_pt / height_pt), xycoords="axes fraction", color=colour, ha="left",
            va="center_baseline", fontsize=style.SMALL_PT, annotation_clip=False,
            fontweight="bold" if weight == OURS_PT else "normal",
        )  # fmt: skip


Line = tuple[str, list[float], str, float, bool]
"""What it is called, its values, its colour, its width, and whether it is dashed."""


def _lines(bench: Bench, points: Sequence[Course]) -> list[Line]:
    """Return a line for each candidate, and one for chance: at the density of the first of ours."""
    ours = [candidate for candidate in bench.candidates if candidate.is_ours]
    others = [candidate for candidate in bench.candidates if not candidate.is_ours]
    lines: list[Line] = []
    for group, colours, weight in (
        (others, THEIR_COLOURS, BASELINE_PT),
        (ours, OUR_COLOURS, OURS_PT),
    ):
        for i, candidate in enumerate(group):
            values = _values(bench, points, candidate, "f")
            lines.append((called(candidate), values, colours[i % len(colours)], weight, False))
    first = (ours or others)[0]
    chance = _values(bench, points, first, "f_chance")
    lines.append((CHANCE, chance, style.INK, BASELINE_PT, True))
    return lines


def _values(
    bench: Bench, points: Sequence[Course], candidate: Candidate, figure: str
) -> list[float]:
    return [bench.figures[point.name, candidate.name].tally.figures()[figure] for point in points]
