"""Hits, misses and false marks on the map: a run compared with labels, a panel a folder."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from ssrics_like.comparison.compared import Compared
from ssrics_like.comparison.compared_files import labels_name
from ssrics_like.comparison.driven import marks_of
from ssrics_like.comparison.matching import NONE
from ssrics_like.comparison.outcome import FALSE, HIT, OTHER, REPEAT, Outcome
from ssrics_like.comparison.scores import PlaceScore, Scores
from ssrics_like.comparison.truth import Truth
from ssrics_like.report import style
from ssrics_like.report.background import WALLS_CUT
from ssrics_like.report.drawing import HALO, Drawing, as_svg
from ssrics_like.report.frames import Frame, frame_around, show_frame
from ssrics_like.report.labels import Room, legend_grid, text_half_size
from ssrics_like.report.map_figure import LEGEND_ROW_PT, draw_ends, draw_path
from ssrics_like.report.pictures import Outline
from ssrics_like.report.place_markers import RINGS_MAX, beside
from ssrics_like.report.plan import bounds_of, draw_plan
from ssrics_like.report.reading import read_pictures
from ssrics_like.report.walls import draw_walls

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LEFT_PT, RIGHT_PT, BOTTOM_PT, TOP_PT = 26.0, 6.0, 28.0, 34.0
HEIGHTS_PT = (150.0, 560.0)
SHOWN_M = 1.0
"""The radius that is drawn, if it is among those compared; else the middle one is."""
SAME_M = 0.2
"""A log whose own poses lie this near to those of its labels has its walls drawn, too."""
FOUND, MISSED = style.GREEN, "#882255"
DASHES = (0.0, (3.0, 2.0))
LOOKS: dict[str, tuple[str, dict[str, Any]]] = {
    HIT: ("hit", {"marker": "o", "markersize": 6.0, "markerfacecolor": FOUND,
                  "markeredgecolor": "white", "markeredgewidth": 0.8}),
    REPEAT: ("repeated mark", {"marker": "o", "markersize": 4.4, "markerfacecolor": "white",
                               "markeredgecolor": style.MUTED, "markeredgewidth": 1.0}),
    OTHER: ("mark at another label", {"marker": "o", "markersize": 5.4,
                                      "markerfacecolor": style.BLUE, "markeredgecolor": "white",
                                      "markeredgewidth": 0.8}),
    FALSE: ("false mark", {"marker": "X", "markersize": 7.0, "markerfacecolor": style.VERMILION,
                           "markeredgecolor": "white", "markeredgewidth": 0.8}),
}  # fmt: skip
"""Fate of a mark -> what the legend says, and how it is drawn."""
LABEL_LOOK: dict[str, Any] = {
    "marker": "D", "markersize": 4.0, "markerfacecolor": "white", "markeredgecolor": style.BLUE,
    "markeredgewidth": 0.9,
}  # fmt: skip


@dataclass(frozen=True, eq=False)
class _Panel:
    """What one panel shows: the first run of a folder, at one radius."""

    number: int
    made: Compared
    scores: Scores
    outline: Outline | None
    frame: Frame
    handles: list[Any]
    columns: int
    rows: int

    @property
    def top_pt(self) -> float:
        return TOP_PT + LEGEND_ROW_PT * (self.rows - 1)

    @property
    def height_pt(self) -> float:
        return self.top_pt + self.frame.height_pt + BOTTOM_PT

    @property
    def outcome(self) -> Outcome:
        return self.scores.outcomes[0]


def comparison_svg(made: Sequence[Compared]) -> str:
    """Draw comparisons as SVG text.

    Parameters
    ----------
    made : sequence of Compared
        The comparisons; at least one. Of each the first run is drawn, at a radius of 1 m if that
        was asked for.

    Raises
    ------
    ResultsError
        A file with the walls that a run has seen is missing or damaged.
    """
    with style.context():
        return as_svg(draw_comparison(made))


def draw_comparison(made: Sequence[Compared]) -> Drawing:
    """Draw comparisons below each other; to be saved within `style.context`."""
    panels = [_panel(number, one) for number, one in enumerate(made)]
    height_pt = sum(panel.height_pt for panel in panels)
    figure = style.new_figure(height_pt / style.POINTS)
    tips: dict[str, str] = {}
    above_pt = 0.0
    for panel in panels:
        bottom_pt = height_pt - above_pt - panel.height_pt + BOTTOM_PT
        axes = style.place_axes(figure, LEFT_PT, RIGHT_PT, bottom_pt, above_pt + panel.top_pt)
        tips |= _draw(axes, panel)
        above_pt += panel.height_pt
    return Drawing(
        "comparison",
        figure,
        "Maps of the labelled places and the marks that were compared with them",
        "",
        tips,
    )


def _panel(number: int, made: Compared) -> _Panel:
    radii = [scores.radius_m for scores in made.scores]
    shown = radii.index(SHOWN_M) if SHOWN_M in radii else len(radii) // 2
    scores = made.scores[shown]
    width_pt = style.WIDTH_IN * style.POINTS - LEFT_PT - RIGHT_PT
    outline = _outline(made)
    places = np.array([(p.location.x_m, p.location.y_m) for p in scores.places])
    extent = [made.drives[0].way.xy_m, places - scores.radius_m, places + scores.radius_m]
    if not isinstance(made.truth, Truth):
        extent.append(bounds_of(made.truth.grid))
    elif outline is not None and len(outline.x):
        cells = np.column_stack([outline.x, outline.y]) * outline.cell_m
        extent.append(np.quantile(cells, [WALLS_CUT, 1 - WALLS_CUT], axis=0))
    frame = frame_around(np.concatenate(extent), width_pt, HEIGHTS_PT)
    handles = _legend(scores)
    columns, rows = legend_grid([handle.get_label() for handle in handles], width_pt)
    return _Panel(number, made, scores, outline, frame, handles, columns, rows)


def _outline(made: Compared) -> Outline | None:
    """Return the walls that the run has seen, where they are in the frame of the labels."""
    run = made.records.runs[0]
    if len(run.path) == 0 or len(made.drives[0].way.xy_m) == 0:
        return None
    away_m, _ = cKDTree(made.drives[0].way.xy_m).query(run.path[:, 1:])
    if away_m.max() > SAME_M:
        return None
    return read_pictures(made.records.folder, run).outline


def _draw(axes: Axes, panel: _Panel) -> dict[str, str]:
    made, frame = panel.made, panel.frame
    if not isinstance(made.truth, Truth):
        draw_plan(axes, made.truth.grid, frame)
    if panel.outline is not None:
        draw_walls(axes, panel.outline, frame)
    show_frame(axes, frame, low=True)
    if isinstance(made.truth, Truth):
        for line in made.lines_m[np.isfinite(made.lines_m).all(axis=(1, 2))]:
            axes.plot(*line.T, color=style.INK, linewidth=1.6, solid_capstyle="butt", zorder=1.8)
    path = _timed(made)
    landings = () if isinstance(made.truth, Truth) else made.records.runs[0].landings
    draw_path(axes, path, frame, width=0.9, landings=landings)
    room = Room(frame.width_pt, frame.height_pt)
    room.take(60, 10, 60, 14)  # the scale bar
    marks = made.drives[0].marks.xy_m
    for x, y in zip(*frame.points(marks[:, 0], marks[:, 1]), strict=True):
        room.take(float(x), float(y), 3.0, 3.0)
    draw_ends(axes, path, frame, room)
    tips = _draw_marks(axes, panel) | _draw_labels(axes, panel, room)
    for text in axes.texts:  # each panel has a start, an end and a scale bar
        text.set_gid(f"{text.get_gid()}-{panel.number}")
    axes.set_title(_title(panel), pad=8.0 + LEGEND_ROW_PT * panel.rows)
    axes.set_xlabel(_below(panel), loc="right", fontsize=style.SMALL_PT)
    axes.legend(
        handles=panel.handles, loc="lower left", bbox_to_anchor=(0, 1, 1, 0), borderaxespad=0.7,
        ncols=panel.columns, columnspacing=1.4, handlelength=1.2,
    )  # fmt: skip
    return tips


def _title(panel: _Panel) -> str:
    made, tally = panel.made, panel.scores.runs[0]
    return (
        f"{made.records.folder.name}, run {made.numbers[0]}, against {labels_name(made)}: within "
        f"{panel.scores.radius_m:g} m, {tally.found} of {tally.designated} places and "
        f"{tally.passed} of {tally.passages} passages found"
    )


def _below(panel: _Panel) -> str:
    said = "metres, frame of the labels"
    if len(panel.outcome.passed):
        said = f"1/2: one of two passages through the place was found · {said}"
    return said


def _timed(made: Compared) -> NDArray[np.float64]:
    """Return the path with a time before each pose, such that a step of 5 m was not driven."""
    if not isinstance(made.truth, Truth):
        return made.records.runs[0].path
    xy_m = made.truth.way.xy_m
    return np.column_stack([0.25 * np.arange(len(xy_m)), xy_m])


def _draw_marks(axes: Axes, panel: _Panel) -> dict[str, str]:
    tips = {}
    marks = panel.made.drives[0].marks
    names = [mark.landmark for mark in marks_of(panel.made.records.runs[0])]
    for i, fate in enumerate(panel.outcome.fates()):
        said, look = LOOKS[fate]
        gid = f"m{panel.number}-{i}"
        axes.plot(*marks.xy_m[i], gid=gid, linestyle="none", zorder=9 + (fate == HIT), **look)
        delay_m = marks.decided_m[i] - marks.along_m[i]
        late = f"; decided {delay_m:.1f} m later" if np.isfinite(delay_m) else ""
        tips[gid] = f"{names[i]}: {said}{late}"
    return tips


def _draw_labels(axes: Axes, panel: _Panel, room: Room) -> dict[str, str]:
    """Draw every labelled place; beside a designated one its id and the passages found."""
    from matplotlib.colors import to_rgba
    from matplotlib.patches import Circle

    tips = {}
    ring_pt = panel.scores.radius_m * panel.frame.points_per_m
    designated = sum(place.designated for place in panel.scores.places)
    for j, place in enumerate(panel.scores.places):
        at_m = place.location.x_m, place.location.y_m
        gid = f"p{panel.number}-{j}"
        tips[gid] = f"{place.location.id} ({place.location.kind})"
        if not place.designated:
            axes.plot(*at_m, gid=gid, linestyle="none", zorder=4, **LABEL_LOOK)
            continue
        found = bool(panel.outcome.found[j])
        colour = FOUND if found else MISSED
        axes.add_patch(
            Circle(at_m, panel.scores.radius_m, gid=gid, facecolor=to_rgba(colour, 0.13),
                   edgecolor=colour, linewidth=1.2, linestyle="-" if found else DASHES,
                   zorder=1.5)
        )  # fmt: skip
        if designated > RINGS_MAX:
            continue
        text = _name(place, panel, j)
        at, half = panel.frame.points(*at_m), text_half_size(text, style.SMALL_PT)
        spots = beside(*at, ring_pt, *half)
        spot = room.find(spots, *half) or spots[0]
        axes.annotate(
            text, at_m, (spot[0] - at[0], spot[1] - at[1]), textcoords="offset points",
            ha="center", va="center_baseline", fontsize=style.SMALL_PT, fontweight="bold",
            color=colour, zorder=12, gid=f"{HALO}-{gid}",
        )  # fmt: skip
    return tips


def _name(place: PlaceScore, panel: _Panel, number: int) -> str:
    """Return a place's id, with how many of the passages through it were found."""
    passages = panel.outcome.passages
    if passages is None or not (through := passages.place == number).any():
        return place.location.id
    passed = int((panel.outcome.passage_mark[through] != NONE).sum())
    return f"{place.location.id} {passed}/{int(through.sum())}"


def _legend(scores: Scores) -> list[Any]:
    """Return a handle for each kind of thing that is there, with how many there are."""
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    outcome = scores.outcomes[0]
    fates = Counter(outcome.fates())
    found = int(outcome.found[outcome.designated].sum())
    missed = int(outcome.designated.sum()) - found
    handles: list[Any] = [
        Line2D([], [], linestyle="none", label=f"{said} ({fates[fate]})", **look)
        for fate, (said, look) in LOOKS.items()
        if fates[fate]
    ]
    looks: tuple[tuple[int, str, str, Any], ...] = (
        (found, "found", FOUND, "-"), (missed, "missed", MISSED, DASHES),
    )  # fmt: skip
    for count, said, colour, line in looks:
        if count:
            handles.append(
                Patch(facecolor=style.mixed(colour, 0.13), edgecolor=colour, linestyle=line,
                      linewidth=1.2, label=f"place {said} ({count})")
            )  # fmt: skip
    others = int((~outcome.designated).sum())
    if others:
        handles.append(
            Line2D([], [], linestyle="none", label=f"other label ({others})", **LABEL_LOOK)
        )
    return handles
