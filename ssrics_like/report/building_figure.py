"""A building by itself: its floor plan to scale, with the places that people labelled."""

from __future__ import annotations

import io
import itertools
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from ssrics_like.errors import MapError
from ssrics_like.report import style
from ssrics_like.results.files import write_atomically
from ssrics_like.world.building import Building
from ssrics_like.world.grid import FREE, UNKNOWN, GridMap
from ssrics_like.world.locations import Location

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PICTURES: dict[str, dict[str, Any]] = {
    ".png": {"Software": None},
    ".svg": {"Date": None, "Creator": None},
    ".pdf": {"CreationDate": None, "Creator": None, "Producer": None},
}
"""Ending of a picture -> what is left out of it, so that equal pictures are equal files."""
DPI = 160
MARGINS_PT = (30.0, 8.0, 26.0, 44.0)  # left, right, bottom, top
HEIGHT_MAX_IN, WIDTH_MIN_IN = 12.0, 5.5
WALL_M = 0.5
"""Solid cells this near to a floor are drawn as its wall; what lies behind is drawn pale."""
FURNITURE_M = 2.5
"""Solid cells that stand free, no longer and no wider than this, are drawn as furniture."""

FLOOR, SOLID, BEHIND, NOBODY_LOOKED = "#ffffff", "#39434e", "#dfe4e9", "#eef1f4"
FURNITURE = "#a3793f"
KINDS = {
    "doorway": style.BLUE,
    "opening": style.GREEN,
    "junction": style.VERMILION,
    "corner": "#882255",
    "other": style.MUTED,
}
DOT_PT, BAR_UP_PT = 6.0, 9.0
FEW = 40
"""Up to so many places their ids are written larger."""
BARS_M = (1, 2, 5, 10, 20, 50, 100, 200, 500)


def draw_building(building: Building) -> Figure:
    """Draw a building's floor plan in the frame of the map, with its labelled places.

    Parameters
    ----------
    building : Building
        The building.

    Returns
    -------
    matplotlib.figure.Figure
        To be saved; it carries the project's style if made and saved within
        `ssrics_like.report.style.context`.
    """
    left, right, bottom, top = MARGINS_PT
    outline = _outline(building.grid)
    low, high = outline.min(axis=0), outline.max(axis=0)
    width_m, height_m = high - low
    widest = style.WIDTH_IN * style.POINTS - left - right
    points_per_m = min(widest / width_m, HEIGHT_MAX_IN * style.POINTS / height_m)
    spare = max(0.0, WIDTH_MIN_IN * style.POINTS - left - right - width_m * points_per_m)
    figure = style.new_figure((height_m * points_per_m + bottom + top) / style.POINTS)
    figure.set_figwidth((width_m * points_per_m + spare + left + right) / style.POINTS)
    axes = style.place_axes(figure, left + spare / 2, right + spare / 2, bottom, top)
    _draw_grid(axes, building.grid)
    axes.set_xlim(low[0], high[0])
    axes.set_ylim(low[1], high[1])
    figure.suptitle(
        building.title, x=left / style.POINTS / figure.get_figwidth(), y=1 - 12 / (
            figure.get_figheight() * style.POINTS), ha="left", va="center",
        fontsize=style.FONT_PT + 1, fontweight="bold",
    )  # fmt: skip
    axes.tick_params(length=2.5)
    for side in ("left", "bottom"):
        axes.spines[side].set_visible(False)
    _scale_bar(axes, width_m)
    _draw_places(axes, building, points_per_m)
    _legend(axes, building.locations)
    return figure


def save_picture(building: Building, path: Path) -> None:
    """Draw a building and save it, the same bytes each time.

    Parameters
    ----------
    building : Building
        The building.
    path : Path
        The picture; its ending is one of `PICTURES`.

    Raises
    ------
    MapError
        The file cannot be written.
    """
    with style.context():
        figure = draw_building(building)
        stream = io.BytesIO()
        kind = path.suffix.lower().removeprefix(".")
        figure.savefig(stream, format=kind, dpi=DPI, metadata=PICTURES[path.suffix.lower()])
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        write_atomically(path, stream.getvalue())
    except OSError as e:
        raise MapError(f"{path}: cannot be written ({e.strerror})") from None


def _outline(grid: GridMap) -> NDArray[np.float64]:
    """Return the corners of the grid in the frame of the map."""
    width_m, height_m = grid.size_m
    corners = [[0.0, 0.0], [width_m, 0.0], [width_m, height_m], [0.0, height_m]]
    return grid.points_in_map(corners)


def _draw_grid(axes: Axes, grid: GridMap) -> None:
    from matplotlib.colors import to_rgb
    from matplotlib.transforms import Affine2D

    free = grid.cells == FREE
    colours = np.empty((*free.shape, 3))
    colours[:] = to_rgb(BEHIND)
    colours[grid.cells == UNKNOWN] = to_rgb(NOBODY_LOOKED)
    near = ndimage.distance_transform_edt(~free) * grid.cell_m <= WALL_M
    colours[near & (grid.cells != UNKNOWN)] = to_rgb(SOLID)
    colours[_standing_free(grid)] = to_rgb(FURNITURE)
    colours[free] = to_rgb(FLOOR)
    width_m, height_m = grid.size_m
    turned = Affine2D().rotate(grid.origin.theta_rad).translate(grid.origin.x_m, grid.origin.y_m)
    axes.imshow(
        colours, extent=(0, width_m, 0, height_m), origin="lower", interpolation="none",
        transform=turned + axes.transData, zorder=0,
    )  # fmt: skip


def _standing_free(grid: GridMap) -> NDArray[np.bool_]:
    """Return the solid cells that are neither walls nor joined to one."""
    parts, _ = ndimage.label(grid.cells != FREE, structure=np.ones((3, 3)))
    extents = ndimage.find_objects(parts)
    most = FURNITURE_M / grid.cell_m
    small = np.array(
        [False, *(max(side.stop - side.start for side in extent) <= most for extent in extents)]
    )
    for edge in (parts[0], parts[-1], parts[:, 0], parts[:, -1]):
        small[edge] = False
    chosen: NDArray[np.bool_] = small[parts]
    return chosen


def _scale_bar(axes: Axes, width_m: float) -> None:
    """Draw a bar of a round length, about an eighth of the plan, above its right end."""
    from matplotlib.transforms import ScaledTranslation

    length_m = max((bar for bar in BARS_M if bar <= width_m / 7), default=BARS_M[0])
    end = axes.get_xlim()[1]
    figure = axes.get_figure()
    assert figure is not None
    up = ScaledTranslation(0, BAR_UP_PT / style.POINTS, figure.dpi_scale_trans)
    axes.plot(
        [end - length_m, end], [1, 1], color=style.INK, linewidth=2.2, solid_capstyle="butt",
        clip_on=False, transform=axes.get_xaxis_transform() + up,
    )  # fmt: skip
    axes.annotate(
        f"{length_m} m", (end - length_m, 1), (-5, BAR_UP_PT),
        xycoords=axes.get_xaxis_transform(), textcoords="offset points", ha="right", va="center",
        fontsize=style.SMALL_PT, color=style.MUTED, annotation_clip=False,
    )  # fmt: skip


def _draw_places(axes: Axes, building: Building, points_per_m: float) -> None:
    """Draw a dot for each place, and its id beside it where it covers least."""
    from matplotlib.patheffects import withStroke

    places = building.locations
    font_pt = style.FONT_PT if len(places) <= FEW else style.SMALL_PT
    half_y = font_pt * 0.42
    taken = [(p.x_m * points_per_m, p.y_m * points_per_m, DOT_PT / 2, DOT_PT / 2) for p in places]
    for place in places:
        axes.plot(
            place.x_m, place.y_m, "o", markersize=DOT_PT, markerfacecolor=KINDS[place.kind],
            markeredgecolor="white", markeredgewidth=0.8, zorder=5, clip_on=False,
        )  # fmt: skip
        half_x = max(1, len(place.id)) * font_pt * 0.36
        x, y = place.x_m * points_per_m, place.y_m * points_per_m
        reach_x, reach_y = half_x + DOT_PT / 2 + 1.5, half_y + DOT_PT / 2 + 1.5
        beside = [(reach_x, 0.0), (-reach_x, 0.0), (0.0, reach_y), (0.0, -reach_y)]
        beside += [(0.8 * i * reach_x, 0.8 * j * reach_y) for i in (1, -1) for j in (1, -1)]
        boxes = [(x + dx, y + dy, half_x, half_y) for dx, dy in beside]
        best = min(boxes, key=lambda box: _covers(building.grid, box, taken, points_per_m))
        taken.append(best)
        axes.annotate(
            place.id, (place.x_m, place.y_m), (best[0] - x, best[1] - y),
            textcoords="offset points", ha="center", va="center_baseline", fontsize=font_pt,
            fontweight="bold", color=KINDS[place.kind], zorder=6, annotation_clip=False,
            path_effects=[withStroke(linewidth=2.4, foreground="white")],
        )  # fmt: skip


def _covers(
    grid: GridMap,
    box: tuple[float, float, float, float],
    taken: list[tuple[float, float, float, float]],
    points_per_m: float,
) -> float:
    """Return how much a label would cover: other marks weigh more than walls."""
    x, y, half_x, half_y = box
    over = sum(
        abs(x - x2) < half_x + half_x2 and abs(y - y2) < half_y + half_y2
        for x2, y2, half_x2, half_y2 in taken
    )
    spots = itertools.product(np.linspace(-1, 1, 7) * half_x, np.linspace(-1, 1, 5) * half_y)
    points = np.array([(x + dx, y + dy) for dx, dy in spots]) / points_per_m
    walls = sum(not grid.is_free(*point) for point in grid.points_in_grid(points))
    return 100 * over + walls


def _legend(axes: Axes, places: tuple[Location, ...]) -> None:
    from matplotlib.lines import Line2D

    counts = {kind: sum(place.kind == kind for place in places) for kind in KINDS}
    handles = [
        Line2D(
            [], [], marker="o", linestyle="none", markersize=DOT_PT, markerfacecolor=KINDS[kind],
            markeredgecolor="white", label=f"{kind} ({count})",
        )
        for kind, count in counts.items()
        if count
    ]  # fmt: skip
    if handles:
        axes.legend(
            handles=handles, loc="lower left", bbox_to_anchor=(0, 1), borderaxespad=0.7,
            ncols=len(handles), columnspacing=1.4,
        )  # fmt: skip
