"""Maps on paper: which part of the plane is shown, how large, and with what scale bar."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeVar

import numpy as np
from numpy.typing import NDArray

from ssrics_like.report.style import INK, RULE, SMALL_PT

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MARGIN = 0.07
"""Share of a map's span that is left free around it."""

Place = TypeVar("Place", float, NDArray[np.float64])


def round_length(wanted: float) -> float:
    """Return the largest of 1, 2, 5 times a power of ten that is at most `wanted`."""
    power = 10.0 ** math.floor(math.log10(wanted))
    return max(step * power for step in (1.0, 2.0, 5.0) if step * power <= wanted * (1 + 1e-9))


@dataclass(frozen=True)
class Frame:
    """Part of the plane that a map shows, and how large it is drawn.

    Attributes
    ----------
    left, right, bottom, top : float
        Limits, metres.
    points_per_m : float
        Scale, the same along both axes.
    """

    left: float
    right: float
    bottom: float
    top: float
    points_per_m: float

    @property
    def height_pt(self) -> float:
        """Height on the page, points."""
        return (self.top - self.bottom) * self.points_per_m

    @property
    def width_pt(self) -> float:
        """Width on the page, points."""
        return (self.right - self.left) * self.points_per_m

    def points(self, x_m: Place, y_m: Place) -> tuple[Place, Place]:
        """Return where a place lies, or many, in points from the lower left corner."""
        return (x_m - self.left) * self.points_per_m, (y_m - self.bottom) * self.points_per_m


def frame_around(
    places: NDArray[np.float64],
    width_pt: float,
    heights_pt: tuple[float, float],
    least_m: float = 4.0,
) -> Frame:
    """Fit places into a box of a width and a height within limits, scales being equal.

    Parameters
    ----------
    places : ndarray, shape (n, 2)
        x and y, metres; none give a box around the origin.
    width_pt : float
        Width of the box, points.
    heights_pt : tuple of float
        Least and largest height of the box, points.
    least_m : float
        Never show less than this.
    """
    if len(places) == 0:
        places = np.zeros((1, 2))
    low, high = places.min(axis=0), places.max(axis=0)
    middle_x, middle_y = (low + high) / 2
    span_x, span_y = np.maximum((high - low) * (1 + MARGIN), least_m)
    scale = min(width_pt / span_x, heights_pt[1] / span_y)
    height_pt = min(max(span_y * scale, heights_pt[0]), heights_pt[1])
    half_x, half_y = width_pt / scale / 2, height_pt / scale / 2
    return Frame(
        float(middle_x - half_x),
        float(middle_x + half_x),
        float(middle_y - half_y),
        float(middle_y + half_y),
        float(scale),
    )


def show_frame(axes: Axes, frame: Frame, *, low: bool = False) -> None:
    """Set the limits of a map's axes, box them in, and draw a scale bar.

    The bar carries its length above it, or, to be clear of the walls of a plan, lies `low` with
    its length behind it.
    """
    axes.set_xlim(frame.left, frame.right)
    axes.set_ylim(frame.bottom, frame.top)
    axes.set_aspect("equal")
    for spine in axes.spines.values():
        spine.set_visible(True)
        spine.set_color(RULE)
    axes.tick_params(length=2.5, labelsize=SMALL_PT)
    length_m = round_length((frame.right - frame.left) * 0.16)
    x = frame.left + 10 / frame.points_per_m
    y = frame.bottom + (6 if low else 9) / frame.points_per_m
    end = 2.5 / frame.points_per_m
    axes.plot(
        [x, x, x, x + length_m, x + length_m, x + length_m],
        [y + end, y - end, y, y, y - end, y + end],
        color=INK, linewidth=1.1, solid_capstyle="butt", zorder=20,
    )  # fmt: skip
    at, offset = ((x + length_m, y), (4, 0)) if low else ((x + length_m / 2, y), (0, 3))
    axes.annotate(
        f"{length_m:g} m", at, offset, textcoords="offset points", ha="left" if low else "center",
        va="center_baseline" if low else "bottom", fontsize=SMALL_PT, gid="halo-scale", zorder=20,
    )  # fmt: skip


def kept_apart(
    x_m: NDArray[np.float64], y_m: NDArray[np.float64], step_m: float
) -> NDArray[np.int64]:
    """Return indices of places of which no two share a square of side `step_m`.

    So a figure of ten thousand marks stays as small as one of hundreds.
    """
    cells = np.floor(np.column_stack([x_m, y_m]) / step_m).astype(np.int64)
    _, first = np.unique(cells, axis=0, return_index=True)
    return np.sort(first)
