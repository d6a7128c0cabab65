"""A drive to learn structure from: the layout of its places, and the plan that tells the truth."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ssrics_like.training.augmentation import augmented
from ssrics_like.training.buildings import cluttered, plain_building
from ssrics_like.training.conditions import structure_conditions
from ssrics_like.training.drives import explored
from ssrics_like.training.examples import described
from ssrics_like.world.buildings.generator import generate

if TYPE_CHECKING:
    from ssrics_like.training.examples import Example
    from ssrics_like.world.buildings.plan import Plan

SHARE = 0.5
"""Of the time of a drive that doorways are learned from. There are few junctions in a building, and
to have passed them often says less than another building's."""


class Asked(NamedTuple):
    """Which example is to be made; nothing else decides about it.

    Attributes
    ----------
    seed : numpy.random.SeedSequence
        Of building, drive and augmentation.
    clutter : bool
        Whether the building is to be cluttered.
    """

    seed: np.random.SeedSequence
    clutter: bool


class StructureExample(NamedTuple):
    """The places of a drive, and the plan of the building that it leads through.

    Attributes
    ----------
    example : Example
        The places and their layout.
    plan : Plan
        The plan, in the frame of the map.
    """

    example: Example
    plan: Plan


def structure_example(asked: Asked) -> StructureExample:
    """Make an example.

    Parameters
    ----------
    asked : Asked
        Which.
    """
    seed = asked.seed
    rng = np.random.default_rng(seed)
    (of_drive,) = np.random.SeedSequence(seed.entropy, spawn_key=seed.spawn_key).spawn(1)
    conditions = structure_conditions(rng, clutter=asked.clutter)
    plan = generate(rng, conditions.building)
    building = plain_building(plan)
    if asked.clutter:
        building = cluttered(building, conditions, rng)
    drive = augmented(explored(building, conditions, of_drive, SHARE), rng)
    return StructureExample(described(drive, layout=True), plan)
