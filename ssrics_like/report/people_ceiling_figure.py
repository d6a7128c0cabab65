"""Where people, and the runs of each model, stand against others' consensus: the human ceiling."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ssrics_like.people.beside import Beside
from ssrics_like.people.ceiling import HELD
from ssrics_like.people.figures import Figure
from ssrics_like.people.markers import PEOPLE
from ssrics_like.people.resampling import known_mean
from ssrics_like.report import style
from ssrics_like.report.drawing import Drawing
from ssrics_like.report.labels import text_half_size
from ssrics_like.report.people_style import colours_of, mark_look, name_tips, said

if TYPE_CHECKING:
    from matplotlib.axes import Axes

ROW_PT, TOP_PT, BOTTOM_PT, RIGHT_PT, GAP_PT = 46.0, 20.0, 32.0, 14.0, 34.0
NAME_MAX = 26
DOT_PT, STEP_PT = 4.0, 3.4
LEVELS = 4
"""Dots that would cover one another are set so many steps above and below."""
MEAN_PT = 9.0
"""Half the height of the line that is a mean."""
TITLES = {"f": "F against others' consensus", "kappa": "κ against others' consensus"}
BELOW = {"f": "0 is nothing in common, 1 the same", "kappa": "0 is chance, 1 the same"}
LIMITS = {"f": (0.0, 1.0), "kappa": (-0.1, 1.0)}


def draw_people_ceiling(made: Beside) -> Drawing | None:
    """Draw a dot for each person and run, with means and intervals; None for a single person."""
    if len(made.people) < 2:  # noqa: PLR2004 - nobody has others
        return None
    groups = list(made.marked)
    counts = [len(table) for table in made.marked.values()]
    whole = [said(group, n, len(group)) for group, n in zip(groups, counts, strict=True)]
    names = [said(group, n, NAME_MAX) for group, n in zip(groups, counts, strict=True)]
    left_pt = 10.0 + max(2 * text_half_size(name, style.FONT_PT)[0] for name in names)
    page_pt = style.WIDTH_IN * style.POINTS
    width_pt = (page_pt - left_pt - RIGHT_PT - GAP_PT) / len(HELD)
    height_pt = TOP_PT + ROW_PT * len(groups) + BOTTOM_PT
    figure = style.new_figure(height_pt / style.POINTS)
    tips: dict[str, str] = {}
    for column, measure in enumerate(HELD):
        from_pt = left_pt + column * (width_pt + GAP_PT)
        axes = style.place_axes(
            figure, from_pt, page_pt - from_pt - width_pt, BOTTOM_PT, TOP_PT
        )  # fmt: skip
        values = [_values(made, group, measure) for group in groups]
        _draw_panel(axes, made, measure, values, width_pt)
        axes.set_yticks(range(len(groups)), [] if column else names, fontsize=style.FONT_PT,
                        color=style.INK)  # fmt: skip
        if column == 0:
            tips = name_tips(axes, names, whole)
    return Drawing(
        "ceiling",
        figure,
        "F and kappa of each person and of each run against the consensus of the others",
        "Each dot is a person, held against what at least half of all the others marked, or a run, "
        "held against the same, mean over all whom it could replace. Upright lines are means, bars "
        "their 95 % intervals where there are any; the dashed line is the mean of the people, the "
        "human ceiling. κ is 0 where agreement is as by chance.",
        tips,
    )


def swarm(values: NDArray[np.float64], dot: float) -> NDArray[np.int64]:
    """Return for each value how many steps off its row it is drawn, so that dots lie free.

    Parameters
    ----------
    values : ndarray, shape (n,)
        Along the row.
    dot : float
        Width of a dot, in the same unit.

    Returns
    -------
    ndarray of int64, shape (n,)
        0, 1, -1, 2, ... up to `LEVELS` either way; beyond that dots cover one another.
    """
    order = [0, *(sign * step for step in range(1, LEVELS + 1) for sign in (1, -1))]
    last = dict.fromkeys(order, -math.inf)
    steps = np.zeros(len(values), np.int64)
    for i in np.argsort(values, kind="stable").tolist():
        free = [level for level in order if values[i] - last[level] >= dot]
        steps[i] = free[0] if free else min(order, key=lambda level: last[level])
        last[int(steps[i])] = float(values[i])
    return steps


def _values(made: Beside, group: str, measure: str) -> NDArray[np.float64]:
    """Return the value of each person, or of each run as the mean over people."""
    if group == PEOPLE:
        return made.crowd.against_others.measure(measure)
    return known_mean(made.crowd.meet_others(made.marked[group]).measure(measure), axis=0)


def _draw_panel(
    axes: Axes, made: Beside, measure: str, values: Sequence[NDArray[np.float64]], width_pt: float
) -> None:
    known = np.concatenate(values)
    known = known[np.isfinite(known)]
    low, high = LIMITS[measure]
    low = min(low, math.floor(10 * known.min()) / 10) if len(known) else low
    room = 6.0 / width_pt * (high - low)
    axes.set_xlim(low - room, high + room)
    axes.set_ylim(len(values) - 0.5, -0.5)
    per_pt = (high - low + 2 * room) / width_pt
    ceiling = made.figures[PEOPLE][f"{measure}_others"].value
    if math.isfinite(ceiling):
        axes.axvline(ceiling, color=style.MUTED, linewidth=0.9, dashes=(4, 3), zorder=1)
    for row, (group, each) in enumerate(zip(made.marked, values, strict=True)):
        shown = each[np.isfinite(each)]
        up = row + swarm(shown, per_pt * DOT_PT) * STEP_PT / ROW_PT
        _draw_mean(axes, made.figures[group][f"{measure}_others"], row, colours_of(made)[group])
        axes.plot(shown, up, zorder=4, clip_on=False, **mark_look(made, group, DOT_PT))
    axes.set_title(TITLES[measure], pad=6.0)
    axes.grid(axis="x")
    axes.tick_params(axis="y", length=0)
    axes.spines["left"].set_visible(False)
    axes.set_xlabel(BELOW[measure])


def _draw_mean(axes: Axes, figure: Figure, row: int, colour: str) -> None:
    if math.isnan(figure.value):
        return
    look: dict[str, Any] = {"color": style.mixed(colour, 0.35), "solid_capstyle": "butt"}
    if math.isfinite(figure.interval[0]):
        axes.plot(figure.interval, [row, row], linewidth=2 * MEAN_PT, zorder=2, clip_on=False,
                  **look)  # fmt: skip
    half = 1.3 * MEAN_PT / ROW_PT
    axes.plot([figure.value] * 2, [row - half, row + half], color=colour, linewidth=1.8, zorder=3,
              solid_capstyle="butt")  # fmt: skip
