"""A drive as the learner sees it: the measures of places along the way, and the truth of each."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.perception.conditioning import condition
from ssrics_like.perception.gap import FEATURES
from ssrics_like.perception.layout import LAYOUT
from ssrics_like.perception.observation import Pose
from ssrics_like.perception.profile import PerceptionProfile
from ssrics_like.perception.surroundings import Described, Surroundings
from ssrics_like.training.augmentation import augmented
from ssrics_like.training.buildings import training_building
from ssrics_like.training.conditions import drawn_conditions
from ssrics_like.training.drives import TrainingDrive, explored

if TYPE_CHECKING:
    from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class Example:
    """The places of a drive, every 0.1 m of path.

    Attributes
    ----------
    at_m : ndarray, shape (places,)
        Metres of path from the start, by odometry.
    xy_m : ndarray, shape (places, 2)
        Where each place really is, in the frame of the map.
    measures : ndarray, shape (places, features), float32
        In the order of `ssrics_like.perception.gap.FEATURES`, or of
        `ssrics_like.perception.layout.LAYOUT` where that is described. Single precision halves the
        memory of a training and is a hundred thousand times finer than a cell.
    doorways_m, others_m : ndarray, shape (n, 2), shape (m, 2)
        The building's doorways, and other labelled places, in the frame of the map.
    """

    at_m: NDArray[np.float64]
    xy_m: NDArray[np.float64]
    measures: NDArray[np.float32]
    doorways_m: NDArray[np.float64]
    others_m: NDArray[np.float64]


def example(seed: np.random.SeedSequence) -> Example:
    """Make an example; nothing but the seed decides about it.

    Parameters
    ----------
    seed : numpy.random.SeedSequence
        Of building, drive and augmentation.
    """
    rng = np.random.default_rng(seed)
    (of_drive,) = np.random.SeedSequence(seed.entropy, spawn_key=seed.spawn_key).spawn(1)
    conditions = drawn_conditions(rng)
    building = training_building(conditions, rng)
    return described(augmented(explored(building, conditions, of_drive), rng))


def described(drive: TrainingDrive, *, layout: bool = False) -> Example:
    """Describe the places along a drive, as the model itself does when it runs.

    Parameters
    ----------
    drive : TrainingDrive
        The drive.
    layout : bool
        Whether their layout is wanted, and not the gap at each.
    """
    profile = PerceptionProfile()
    surroundings: Surroundings[int] = Surroundings(wide=layout, layout=layout)
    found: list[Described[int]] = []
    for scan, (pose, ranges_m) in enumerate(zip(drive.poses, drive.ranges_m, strict=True)):
        conditioned = condition(ranges_m, profile.range_cap_m, profile.repair_window)
        found += surroundings.update(
            Pose(*pose.tolist()), drive.bearings_rad, conditioned.ranges_m, scan
        )
    at_m = np.array([one.place.at_m for one in found])
    xy_m = np.column_stack(
        [np.interp(at_m, drive.travelled_m, drive.true_xy_m[:, axis]) for axis in (0, 1)]
    )
    measures = np.array(
        [one.layout if layout else one.measures for one in found], np.float32
    ).reshape(-1, len(LAYOUT if layout else FEATURES))
    return Example(at_m, xy_m, measures, drive.doorways_m, drive.others_m)
