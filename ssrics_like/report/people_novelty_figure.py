"""What was novel to the robot on its way, and where on it people marked landmarks."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ssrics_like.errors import ResultsError
from ssrics_like.people.beside import Beside
from ssrics_like.people.folders import Folders
from ssrics_like.people.markers import PEOPLE, Marker
from ssrics_like.people.names import short
from ssrics_like.report import style
from ssrics_like.report.drawing import Drawing
from ssrics_like.report.novelty_figure import coarser
from ssrics_like.report.people_style import colours_of
from ssrics_like.report.reading import read_pictures
from ssrics_like.report.words import clock, fraction_text

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ssrics_like.report.pictures import Novelty
    from ssrics_like.results.records import Records, Run

BINS_MAX = 700
LEFT_PT, RIGHT_PT, TOP_PT, BOTTOM_PT, GAP_PT = 62.0, 60.0, 22.0, 28.0, 6.0
CURVE_PT, CROWD_PT, LANE_PT, BETWEEN_PT = 96.0, 40.0, 13.0, 20.0
SHOWN_MAX = 4
WINDOW_S = 5.0
"""People who mark within so many seconds of a moment are counted together."""


def draw_people_novelty(read: Folders, made: Beside) -> Drawing | None:
    """Draw the first run of each model; None where no results folder holds its novelty."""
    shown = []
    for number, records in enumerate(read.records[:SHOWN_MAX]):
        novelty = _novelty(records)
        if novelty is not None and len(novelty.t_s) and len(records.runs[0].path):
            shown.append((number, coarser(novelty, BINS_MAX)))
    if not shown:
        return None
    panel_pt = TOP_PT + CURVE_PT + GAP_PT + LANE_PT + GAP_PT + CROWD_PT + BOTTOM_PT
    height_pt = len(shown) * panel_pt + (len(shown) - 1) * BETWEEN_PT
    figure = style.new_figure(height_pt / style.POINTS)
    for place, (number, novelty) in enumerate(shown):
        top_pt = place * (panel_pt + BETWEEN_PT) + TOP_PT
        parts = []
        for part_pt in (CURVE_PT, LANE_PT, CROWD_PT):
            parts.append(
                style.place_axes(figure, LEFT_PT, RIGHT_PT, height_pt - top_pt - part_pt, top_pt)
            )
            top_pt += part_pt + GAP_PT
        _draw(parts, read.records[number], novelty, made, number)
    every = len(read.records)
    rest = f" The first {SHOWN_MAX} of {every} models." if every > SHOWN_MAX else ""
    timed = any(np.isfinite(person.t_s).any() for person in made.people)
    when = "when they pressed the key, if the run was there then; else " if timed else ""
    return Drawing(
        "novelty",
        figure,
        "Novelty along the route of each model's first run, with the moments of people's marks",
        "Novelty (1 minus the boredom quotient τ) over the first run of each model; an interval is "
        "novel at the dashed line or above. Ticks: what the run marked. Below: how many people "
        f"marked a landmark within {WINDOW_S / 2:g} s of each moment, {when}when the robot "
        f"first came by a mark of theirs, within {made.settings.radius_m:g} m of its way.{rest}",
    )


def moments_of(person: Marker, run: Run, radius_m: float) -> NDArray[np.float64]:
    """Return when on a run a person's marks are due, seconds since its start.

    A mark's own time is that of a run which the person saw replayed. Whether it was this run is
    told by where the robot was then.

    Parameters
    ----------
    person : Marker
        One of the people.
    run : Run
        A run with a path.
    radius_m : float
        How near the robot must have come to a mark, metres; others are passed over.

    Returns
    -------
    ndarray, shape (n,)
        The time of the mark if the robot was near it then, else when it first came by; rising.
    """
    then = [np.interp(person.t_s, run.path[:, 0], run.path[:, axis]) for axis in (1, 2)]
    seen = np.hypot(*(np.column_stack(then) - person.xy_m).T) <= radius_m
    placed = np.array([_came_by_s(run, place, radius_m) for place in person.xy_m], np.float64)
    moments = np.where(seen, person.t_s, placed)
    return np.sort(moments[np.isfinite(moments)])


def _came_by_s(run: Run, place: NDArray[np.float64], radius_m: float) -> float:
    """Return when the robot was nearest to a place, the first time that it came by; else NaN."""
    away_m = np.hypot(*(run.path[:, 1:] - place).T)
    near = np.flatnonzero(away_m <= radius_m)
    if len(near) == 0:
        return math.nan
    gone = np.flatnonzero(np.diff(near) > 1)
    first = near[: gone[0] + 1] if len(gone) else near
    return float(run.path[first[away_m[first].argmin()], 0])


def counted(people: Sequence[NDArray[np.float64]], at_s: NDArray[np.float64]) -> NDArray[np.int64]:
    """Return how many people have a moment within half the window of each time."""
    counts = np.zeros(len(at_s), np.int64)
    for moments in people:
        low = np.searchsorted(moments, at_s - WINDOW_S / 2, side="left")
        high = np.searchsorted(moments, at_s + WINDOW_S / 2, side="right")
        counts += high > low
    return counts


def _novelty(records: Records) -> Novelty | None:
    """Read the novelty of the first run; None where the folder does not hold it."""
    run = records.runs[0]
    if not (records.folder / "figures" / f"{run.name}.json").is_file():
        return None
    return read_pictures(records.folder, run).novelty


def _draw(parts: list[Axes], records: Records, novelty: Novelty, made: Beside, number: int) -> None:
    curve, lane, crowd = parts
    run, model = records.runs[0], made.models[number]
    colours, unit = colours_of(made), clock(run.duration_s)
    end_s = max(run.duration_s, float(novelty.t_s[-1])) or 1.0
    t = novelty.t_s / unit.seconds
    curve.fill_between(t, novelty.least, novelty.largest, color=style.PALE, alpha=0.6, linewidth=0)
    curve.plot(t, novelty.mean, color=style.INK, linewidth=0.8)
    curve.set_ylim(-0.02, 1.02)
    curve.set_yticks([0, 0.5, 1], ["0", ".5", "1"])
    curve.set_ylabel("novelty")
    curve.grid(axis="y")
    curve.set_title(short(f"{model.name}, {model.runs[0].name}", 60), color=colours[model.name])
    _draw_threshold(curve, records)
    lane.vlines(model.runs[0].t_s / unit.seconds, 0.1, 0.9, color=colours[model.name],
                linewidth=1.0)  # fmt: skip
    lane.set_ylim(0, 1)
    lane.set_yticks([0.5], ["run"])
    moments = [moments_of(person, run, made.settings.radius_m) for person in made.people]
    at_s = np.linspace(0.0, end_s, BINS_MAX)
    crowd.fill_between(at_s / unit.seconds, 0, counted(moments, at_s), color=colours[PEOPLE],
                       alpha=0.75, linewidth=0, step="mid")  # fmt: skip
    crowd.set_ylim(0, len(made.people) * 1.04)
    crowd.set_yticks([0, len(made.people)])
    crowd.set_ylabel(PEOPLE)
    crowd.grid(axis="y")
    crowd.set_xlabel(unit.label())
    for axes in parts:
        axes.set_xlim(0.0, end_s / unit.seconds)
    for axes in (curve, lane):
        axes.tick_params(labelbottom=False, bottom=False)
    lane.tick_params(axis="y", length=0)
    lane.spines["left"].set_visible(False)
    curve.yaxis.set_label_coords(-34 / 72 / _inches(curve), 0.5)
    crowd.yaxis.set_label_coords(-34 / 72 / _inches(crowd), 0.5)


def _inches(axes: Axes) -> float:
    """Return the width of axes, inches."""
    figure = axes.get_figure()
    assert figure is not None
    return float(axes.get_position().width * style.WIDTH_IN)


def _draw_threshold(axes: Axes, records: Records) -> None:
    try:
        threshold = 1.0 - float(records.scenario["perception"]["threshold"])
    except (KeyError, TypeError, ValueError) as e:
        raise ResultsError(
            f"{records.folder / 'manifest.json'}: is damaged: perception: {e!r}"
        ) from None
    axes.axhline(threshold, color=style.ACCENT, linewidth=0.9, dashes=(5, 3))
    axes.annotate(
        f"novel ≥ {fraction_text(threshold)}", (1, threshold), (4, 0), va="center", ha="left",
        xycoords=("axes fraction", "data"), textcoords="offset points", color=style.ACCENT,
        fontsize=style.SMALL_PT, fontweight="bold",
    )  # fmt: skip
