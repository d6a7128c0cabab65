"""A drive made into another one: what logs differ in that a simulated drive does not.

Logs begin at any heading, so that cells of the local map lie at any angle to the walls. Many keep
only some of the scans: every second, or those where the robot moved or turned enough. And poses
that were corrected by scan matching are off by a little each.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ssrics_like.training.drives import TrainingDrive

EVERY = (1, 1, 2, 4)
KEY_FRAMES = 0.4
"""Share of drives of which only key frames are kept."""
KEY_M, KEY_RAD = (0.05, 0.25), (0.1, 0.4)
PLACE_ERROR_M = (0.0, 0.005, 0.01, 0.02)
HEADING_ERROR_RAD = (0.0, 0.003, 0.008)
SPARSE_M = 0.05
"""Errors of place would lengthen the path a lot if scans were nearer to each other than this."""


def augmented(drive: TrainingDrive, rng: np.random.Generator) -> TrainingDrive:
    """Return a drive as another log might have it.

    Parameters
    ----------
    drive : TrainingDrive
        The drive; it is left as it is.
    rng : numpy.random.Generator
        Where chance comes from.
    """
    kept = _kept(drive, rng)
    poses = _turned(drive.poses[kept], float(rng.uniform(-math.pi, math.pi)))
    place_error_m, heading_error_rad = rng.choice(PLACE_ERROR_M), rng.choice(HEADING_ERROR_RAD)
    steps_m = np.hypot(*np.diff(poses[:, :2], axis=0).T)
    if len(steps_m) and np.median(steps_m) > SPARSE_M:
        poses[:, :2] += rng.normal(0.0, place_error_m, (len(poses), 2))
    poses[:, 2] += rng.normal(0.0, heading_error_rad, len(poses))
    return replace(
        drive, poses=poses, ranges_m=drive.ranges_m[kept], true_xy_m=drive.true_xy_m[kept]
    )


def _kept(drive: TrainingDrive, rng: np.random.Generator) -> NDArray[np.intp]:
    """Choose the scans that are kept."""
    if rng.random() < KEY_FRAMES:
        return key_frames(drive, float(rng.uniform(*KEY_M)), float(rng.uniform(*KEY_RAD)))
    return np.arange(0, len(drive.poses), int(rng.choice(EVERY)))


def key_frames(drive: TrainingDrive, step_m: float, turn_rad: float) -> NDArray[np.intp]:
    """Return the first scan, and each that lies so far from, or is turned so much to, the last.

    Parameters
    ----------
    drive : TrainingDrive
        The drive.
    step_m : float
        Metres of path.
    turn_rad : float
        Radians, either way.
    """
    travelled_m, headings_rad = drive.travelled_m, drive.poses[:, 2]
    kept = [0]
    for scan in range(1, len(headings_rad)):
        turned_rad = abs(math.remainder(headings_rad[scan] - headings_rad[kept[-1]], math.tau))
        if travelled_m[scan] - travelled_m[kept[-1]] >= step_m or turned_rad > turn_rad:
            kept.append(scan)
    return np.array(kept, np.intp)


def _turned(poses: NDArray[np.float64], by_rad: float) -> NDArray[np.float64]:
    """Return poses in a frame that is turned about the origin."""
    cos, sin = math.cos(by_rad), math.sin(by_rad)
    x, y, heading = poses.T
    return np.column_stack([cos * x - sin * y, sin * x + cos * y, heading + by_rad])
