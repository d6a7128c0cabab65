"""What a training drive is like, drawn at random: building, clutter, robot, people.

Ranges are wide on purpose. A cue that has seen only one laser, tidy rooms or one width of doorway
knows these, and not doorways.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from ssrics_like.scenarios.modules import load_robot
from ssrics_like.world.buildings.generator import DOORWAY_MIN_M, BuildingSettings
from ssrics_like.world.buildings.layout import FEWEST, Shape

if TYPE_CHECKING:
    import numpy as np

    from ssrics_like.world.robot import RobotProfile

ROBOTS = ("pioneer-dx", "pioneer-dx", "pioneer-dx-360", "pioneer-dx-urg")
"""Half of the drives are with 180 beams over 180 degrees, as most real logs are."""
NOISE_M = (0.01, 0.02, 0.03, 0.05)
DROPOUT = (0.0, 0.0, 0.01, 0.03)
MIXED = (0.0, 0.05, 0.1, 0.2)
RATE_HZ = (2.5, 5.0, 10.0)
RADIUS_M = (0.2, 0.23, 0.27)
ROOMS = (6, 13)
WIDEST_DOORWAY_M = (1.0, 1.2, 1.5, 1.8)
HALLWAY_FROM_M, HALLWAY_TO_M = (1.2, 1.8), (1.8, 3.0)
CLUTTER, LEAVES, OPENINGS, CONNECTING = (0.2, 1.0), (0.0, 0.8), (0.0, 0.3), (0.0, 0.4)
SCALE = (0.8, 1.4)
FRAMES, FALSE_GAPS, PIECES = 3, 7, 24
"""At most so many frames across hallways, false gaps, pieces of furniture of furnish."""
ROUGH = 0.6
"""Share of buildings with rough walls."""
CLEAR_DOORWAYS = 0.3
"""Share of buildings whose furniture keeps 0.9 m away from doorways, not only from the start."""
PEOPLE = (0, 0, 1, 2)
HALLWAYS: tuple[Shape, ...] = ("T", "T", "X", "X", "L", "U", "ring", "straight")
"""To learn structure: as many buildings with junctions as with corners or neither."""


@dataclass(frozen=True)
class Conditions:
    """What a training drive is like.

    Attributes
    ----------
    robot : RobotProfile
        Body, drive and laser.
    building : BuildingSettings
        What the generator is asked for.
    frames, false_gaps, pieces : int
        How many frames across hallways, false gaps and pieces of furniture are to be put.
    rough : bool
        Whether walls are rough.
    clear_doorways : bool
        Whether furniture keeps away from the generator's doorways.
    people : int
        How many walk about.
    """

    robot: RobotProfile
    building: BuildingSettings
    frames: int
    false_gaps: int
    pieces: int
    rough: bool
    clear_doorways: bool
    people: int


def drawn_conditions(rng: np.random.Generator) -> Conditions:
    """Draw what a drive is like.

    Parameters
    ----------
    rng : numpy.random.Generator
        Where chance comes from.
    """
    return Conditions(
        robot=_robot(rng),
        building=_building(rng),
        frames=int(rng.integers(FRAMES + 1)),
        false_gaps=int(rng.integers(FALSE_GAPS + 1)),
        pieces=int(rng.integers(PIECES + 1)),
        rough=bool(rng.random() < ROUGH),
        clear_doorways=bool(rng.random() < CLEAR_DOORWAYS),
        people=int(rng.choice(PEOPLE)),
    )


def structure_conditions(rng: np.random.Generator, *, clutter: bool) -> Conditions:
    """Draw what a drive is like that is to show junctions and corners.

    Parameters
    ----------
    rng : numpy.random.Generator
        Where chance comes from.
    clutter : bool
        Whether the building is one to be cluttered, or one as the generator makes them by default,
        where nobody walks about.
    """
    conditions = drawn_conditions(rng)
    shape = HALLWAYS[int(rng.integers(len(HALLWAYS)))]
    if not clutter:
        return replace(conditions, building=BuildingSettings(hallways=shape), people=0)
    rooms = max(conditions.building.rooms, FEWEST[shape])
    return replace(
        conditions,
        building=conditions.building.model_copy(update={"hallways": shape, "rooms": rooms}),
    )


def _robot(rng: np.random.Generator) -> RobotProfile:
    robot = load_robot(ROBOTS[int(rng.integers(len(ROBOTS)))])
    laser = robot.laser.model_copy(
        update={
            "noise_m": float(rng.choice(NOISE_M)),
            "dropout": float(rng.choice(DROPOUT)),
            "mixed": float(rng.choice(MIXED)),
            "rate_hz": float(rng.choice(RATE_HZ)),
        }
    )
    return robot.model_copy(update={"laser": laser, "radius_m": float(rng.choice(RADIUS_M))})


def _building(rng: np.random.Generator) -> BuildingSettings:
    return BuildingSettings(
        rooms=int(rng.integers(ROOMS[0], ROOMS[1] + 1)),
        clutter=float(rng.uniform(*CLUTTER)),
        doorway_m=(DOORWAY_MIN_M, float(rng.choice(WIDEST_DOORWAY_M))),
        hallway_m=(float(rng.uniform(*HALLWAY_FROM_M)), float(rng.uniform(*HALLWAY_TO_M))),
        leaves=float(rng.uniform(*LEAVES)),
        openings=float(rng.uniform(*OPENINGS)),
        connecting=float(rng.uniform(*CONNECTING)),
        scale=SCALE,
    )
