"""One drive through a training building: what the laser saw, from where, and the truth."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.world.disturbances import Crowd, Disturbances
from ssrics_like.world.exploration import Exploration
from ssrics_like.world.simulation import Simulation

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ssrics_like.training.buildings import TrainingBuilding
    from ssrics_like.training.conditions import Conditions

LIMIT_S = 900.0
"""Long enough to see most of a building; what is left would look much the same."""


@dataclass(frozen=True, eq=False)
class TrainingDrive:
    """A drive and its truth.

    Attributes
    ----------
    poses : ndarray, shape (scans, 3)
        x, y and heading of the laser by odometry: metres, radians.
    ranges_m : ndarray, shape (scans, beams)
        Readings as the laser gave them.
    bearings_rad : ndarray, shape (beams,)
        Bearing of each beam.
    true_xy_m : ndarray, shape (scans, 2)
        Where the laser really was, in the frame of the map.
    doorways_m, others_m : ndarray, shape (n, 2), shape (m, 2)
        The building's doorways, and other labelled places, in the frame of the map.
    """

    poses: NDArray[np.float64]
    ranges_m: NDArray[np.float64]
    bearings_rad: NDArray[np.float64]
    true_xy_m: NDArray[np.float64]
    doorways_m: NDArray[np.float64]
    others_m: NDArray[np.float64]

    @property
    def travelled_m(self) -> NDArray[np.float64]:
        """Metres travelled up to each scan as odometry has it, shape (scans,)."""
        return travelled(self.poses)


def travelled(poses: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the length of a path up to each of its poses, shape (scans, 2 or more), metres."""
    return np.concatenate([[0.0], np.hypot(*np.diff(poses[:, :2], axis=0).T).cumsum()])


def explored(
    building: TrainingBuilding,
    conditions: Conditions,
    seed: np.random.SeedSequence,
    share: float = 1.0,
) -> TrainingDrive:
    """Let a robot explore a building.

    Parameters
    ----------
    building : TrainingBuilding
        The building.
    conditions : Conditions
        Robot and people.
    seed : numpy.random.SeedSequence
        Of laser, odometry, wheels and people.
    share : float
        Of the time that a drive takes at most.
    """
    simulation = Simulation(
        building.grid, conditions.robot, building.start, [Exploration()], seed,
        Disturbances(crowd=Crowd(conditions.people)), time_limit_s=share * LIMIT_S,
    )  # fmt: skip
    poses, ranges, places = [], [], []
    for observation in simulation:
        pose, truth = observation.pose, observation.true_pose
        assert truth is not None
        poses.append((pose.x_m, pose.y_m, pose.theta_rad))
        ranges.append(observation.scan.ranges_m)
        places.append((truth.x_m, truth.y_m))
    return TrainingDrive(
        np.array(poses), np.array(ranges), conditions.robot.laser.bearings_rad,
        np.array(places), building.doorways_m, building.others_m,
    )  # fmt: skip
