"""What lies under a map: the floor plan in simulation, and the walls as the laser saw them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ssrics_like.report.plan import bounds_of, draw_plan
from ssrics_like.report.records import Results
from ssrics_like.report.walls import draw_walls

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ssrics_like.report.frames import Frame
    from ssrics_like.report.pictures import Outline
    from ssrics_like.results.records import Run

WALLS_CUT = 0.001  # share of the outline's cells that may lie beyond each edge of the map


def draw_background(axes: Axes, results: Results, frame: Frame, *, strength: float = 1.0) -> None:
    """Draw what lies under the map of the run that is shown."""
    if results.building is not None:
        draw_plan(axes, results.building.grid, frame, strength=strength)
    # In simulation these are furniture and doors that the plan does not show.
    draw_walls(axes, results.pictures.outline, frame, strength=strength)


def extent_of(results: Results, run: Run, outline: Outline) -> NDArray[np.float64]:
    """Return places, shape (n, 2), that bound a run's path, landmarks and walls.

    Parameters
    ----------
    results : Results
        The folder; its building bounds the map, where there is one.
    run : Run
        One of its runs.
    outline : Outline
        The walls as the run's laser saw them.
    """
    marks = [(mark.drawn_x_m, mark.drawn_y_m) for mark in run.landmarks]
    places = [run.path[:, 1:], np.array(marks, np.float64).reshape(-1, 2)]
    if results.building is not None:
        places.append(bounds_of(results.building.grid))
    elif len(outline.x):
        # Stray beams, through a door or window, may end outside.
        cells = np.column_stack([outline.x, outline.y]) * outline.cell_m
        places.append(np.quantile(cells, [WALLS_CUT, 1 - WALLS_CUT], axis=0))
    return np.concatenate(places)
