"""The route of a robot as it is replayed: where its laser is at each moment."""

from __future__ import annotations

import csv
import hashlib
import math
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ssrics_like.errors import ResultsError
from ssrics_like.results.manifest import read_manifest
from ssrics_like.scenarios.feeds import DriveFeed
from ssrics_like.scenarios.place import Place
from ssrics_like.world.robot import OdometryProfile, RobotProfile

POSES_MIN = 2
LENGTH_MAX_S = 3600.0
"""An hour: nobody attends longer, and its frames are some 100 MB."""


@dataclass(frozen=True, eq=False)
class Replay:
    """Where a robot's laser was.

    Attributes
    ----------
    t_s : ndarray, shape (n,)
        Seconds from the beginning of the replay, rising from 0.
    poses : ndarray, shape (n, 3)
        x, y (metres) and heading (radians, unwrapped), map frame.
    robot : RobotProfile
        Whose laser is shown.
    """

    t_s: NDArray[np.float64]
    poses: NDArray[np.float64]
    robot: RobotProfile

    @property
    def length_s(self) -> float:
        """How long it takes, seconds."""
        return float(self.t_s[-1])

    def at(self, t_s: NDArray[np.float64] | float) -> NDArray[np.float64]:
        """Return poses at some times, shape (..., 3), linearly between those that are known."""
        columns = [np.interp(t_s, self.t_s, column) for column in self.poses.T]
        return np.stack(columns, axis=-1)

    @cached_property
    def sha256(self) -> str:
        """Digest of times and poses, rounded to micrometres and -seconds."""
        rounded = np.round(np.column_stack([self.t_s, self.poses]), 6) + 0.0
        return hashlib.sha256(rounded.tobytes()).hexdigest()


def faultless(robot: RobotProfile) -> RobotProfile:
    """Return a robot whose wheels and laser do not err, so that a route is the same each time."""
    laser = robot.laser.model_copy(update={"noise_m": 0.0, "dropout": 0.0, "mixed": 0.0})
    exact = OdometryProfile(
        scale=0.0, turn_scale=0.0, way_noise_m=0.0, turn_noise_rad=0.0, drift_rad=0.0
    )
    return robot.model_copy(update={"actuation": 0.0, "odometry": exact, "laser": laser})


def drive(place: Place) -> tuple[Replay, list[str]]:
    """Drive a route of waypoints.

    Parameters
    ----------
    place : Place
        Building, robot without faults, start and waypoints.

    Returns
    -------
    Replay
        Where the laser was at each scan.
    list of str
        What did not go as planned.
    """
    feed = DriveFeed(place, 0, 0)
    times: list[float] = []
    poses: list[tuple[float, ...]] = []
    for observation in feed:
        assert observation.true_pose is not None
        pose = observation.true_pose
        times.append(observation.t_s)
        poses.append((pose.x_m, pose.y_m, pose.theta_rad))
    return _replay(times, poses, place.robot), feed.warnings()


def replay_of_run(folder: Path, run: int, robot: RobotProfile) -> Replay:
    """Read where the robot was in a run of a results folder.

    Raises
    ------
    ResultsError
        The folder holds no results, no such run, or no positions in the frame of the map.
    """
    manifest = read_manifest(folder)
    file = folder / "path.csv"
    times: list[float] = []
    poses: list[tuple[float, ...]] = []
    found = set()
    try:
        with file.open(encoding="utf-8", newline="") as lines:
            rows = csv.DictReader(lines)
            for row in rows:
                number = int(row["run"])
                found.add(number)
                if number != run:
                    continue
                prefix = "true_" if row["true_x_m"] else ""
                if not prefix and manifest.get("frame") != "map":
                    raise ResultsError(
                        f"{folder}: run {run} has no positions in the frame of the map, only of "
                        f"{manifest.get('frame')}; expected a simulated run"
                    )
                times.append(float(row["t_s"]))
                poses.append(
                    tuple(float(row[f"{prefix}{key}"]) for key in ("x_m", "y_m", "theta_rad"))
                )
    except OSError as e:
        if isinstance(e, ResultsError):
            raise
        raise ResultsError(f"{file}: cannot be read ({e.strerror})") from None
    except KeyError as e:
        raise ResultsError(f"{file}: is damaged: it lacks the column {e}") from None
    except (TypeError, ValueError):
        raise ResultsError(
            f"{file}:{rows.line_num}: is damaged: expected a number in each column"
        ) from None
    except csv.Error:
        raise ResultsError(f"{file}: is damaged: it is no CSV") from None
    if not times:
        known = ", ".join(map(str, sorted(found))) or "none"
        raise ResultsError(f"{folder}: has no run {run}; the runs are {known}")
    return _replay(times, poses, robot)


def _replay(times: list[float], poses: list[tuple[float, ...]], robot: RobotProfile) -> Replay:
    t_s = np.array(times, np.float64)
    places = np.array(poses, np.float64).reshape(-1, 3)
    usable = np.isfinite(t_s) & np.isfinite(places).all(axis=1)
    if not usable.all() or (np.diff(t_s) <= 0).any():
        raise ResultsError("the route is damaged: times do not rise, or a pose is not finite")
    if len(t_s) < POSES_MIN or t_s[-1] - t_s[0] > LENGTH_MAX_S:
        raise ResultsError(
            f"the route takes {t_s[-1] - t_s[0]:g} s; expected more than 0 and at most "
            f"{LENGTH_MAX_S:g} s"
        )
    places[:, 2] = np.unwrap(places[:, 2], period=math.tau)
    return Replay(t_s - t_s[0], places, robot)
