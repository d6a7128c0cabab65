"""A building to train in: made by the generator, cluttered, with all its doorways labelled."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.training.false_gaps import false_gaps
from ssrics_like.training.frames import door_frames
from ssrics_like.training.jambs import clutter_jambs
from ssrics_like.training.rough_walls import rough_walls
from ssrics_like.world.buildings.furniture import furnish
from ssrics_like.world.buildings.generator import generate
from ssrics_like.world.buildings.plan import build
from ssrics_like.world.reachable import roomiest

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ssrics_like.perception.observation import Pose
    from ssrics_like.training.conditions import Conditions
    from ssrics_like.world.buildings.plan import Plan
    from ssrics_like.world.grid import GridMap


@dataclass(frozen=True, eq=False)
class TrainingBuilding:
    """A building and its truth.

    Attributes
    ----------
    grid : GridMap
        The floor plan.
    start : Pose
        Where the robot starts, grid frame.
    doorways_m : ndarray, shape (n, 2)
        The middles of doorways, in the frame of the map.
    others_m : ndarray, shape (m, 2)
        Places of which it is arguable what they are: openings, junctions, corners.
    """

    grid: GridMap
    start: Pose
    doorways_m: NDArray[np.float64]
    others_m: NDArray[np.float64]


def training_building(conditions: Conditions, rng: np.random.Generator) -> TrainingBuilding:
    """Make a building up and clutter it.

    Parameters
    ----------
    conditions : Conditions
        What it is to be like.
    rng : numpy.random.Generator
        Where chance comes from.
    """
    return cluttered(plain_building(generate(rng, conditions.building)), conditions, rng)


def plain_building(plan: Plan) -> TrainingBuilding:
    """Build a plan as it is, with the furniture that the generator put there.

    Parameters
    ----------
    plan : Plan
        The plan.
    """
    building = build(plan)
    doorways, others = (
        np.array(
            [(p.x_m, p.y_m) for p in building.locations if (p.kind == "doorway") is wanted]
        ).reshape(-1, 2)
        for wanted in (True, False)
    )
    return TrainingBuilding(building.grid, roomiest(building.grid), doorways, others)


def cluttered(
    building: TrainingBuilding, conditions: Conditions, rng: np.random.Generator
) -> TrainingBuilding:
    """Clutter a building.

    Parameters
    ----------
    building : TrainingBuilding
        The building; it is left as it is.
    conditions : Conditions
        How much is put into it.
    rng : numpy.random.Generator
        Where chance comes from.
    """
    grid, start, radius_m = building.grid, building.start, conditions.robot.radius_m
    doorways = grid.points_in_grid(building.doorways_m)
    others = grid.points_in_grid(building.others_m)
    labelled = np.concatenate([doorways, others])
    grid, framed = door_frames(grid, labelled, conditions.frames, start, radius_m, rng)
    every = np.concatenate([doorways, framed])
    grid = clutter_jambs(grid, every, start, radius_m, rng)
    if conditions.rough:
        grid = rough_walls(grid, start, radius_m, rng)
    labelled = np.concatenate([labelled, framed])
    grid = false_gaps(grid, labelled, conditions.false_gaps, start, radius_m, rng)
    clear = np.array([[start.x_m, start.y_m]])
    if conditions.clear_doorways:
        clear = np.concatenate([clear, doorways])
    grid = furnish(grid, rng, conditions.pieces, clear, radius_m)
    return TrainingBuilding(grid, start, grid.points_in_map(every), grid.points_in_map(others))
