"""The scans of a run, which a results folder does not hold: cast anew, or read from the log."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ssrics_like.errors import ResultsError
from ssrics_like.perception.observation import Pose
from ssrics_like.sources import open_log
from ssrics_like.viewer.manifest import Said
from ssrics_like.viewer.quantising import ranges_in_steps
from ssrics_like.world import ray_kernels
from ssrics_like.world.grid import GridMap
from ssrics_like.world.laser import leaps
from ssrics_like.world.robot import LaserProfile

BEAMS_MAX, BEAMS_MIN = 180, 60
READINGS_MAX = 2_000_000
"""Of all scans of a page together; two bytes each."""
TIME_OFF_S = 1e-5
"""How far a time in path.csv, which is rounded, may lie from that of its scan."""


@dataclass(frozen=True, eq=False)
class Scans:
    """The scans that a page shows.

    Attributes
    ----------
    poses : ndarray of int64, shape (scans,)
        Which pose of the path each was taken at.
    ranges : ndarray of uint16, shape (scans, beams)
        Centimetres; 65535 for no return.
    first_rad, step_rad : float
        Bearing of the first beam, and step to the next.
    """

    poses: NDArray[np.int64]
    ranges: NDArray[np.uint16]
    first_rad: float
    step_rad: float


def strides(scans: int, beams: int) -> tuple[int, int]:
    """Return how many scans and beams go for one that is kept, so that a page stays small.

    Beams are thinned first, to 60 at least; then whole scans are left out.
    """
    by_beam = -(-beams // BEAMS_MAX)
    kept = -(-beams // by_beam)
    while scans * kept > READINGS_MAX and -(-beams // (by_beam + 1)) >= BEAMS_MIN:
        by_beam += 1
        kept = -(-beams // by_beam)
    return max(1, -(-scans * kept // READINGS_MAX)), by_beam


def cast_anew(grid: GridMap, laser: LaserProfile, poses: NDArray[np.float64]) -> Scans:
    """Cast the scans that a map gives, without noise.

    Parameters
    ----------
    grid : GridMap
        The map.
    laser : LaserProfile
        The laser; its noise, dropout and mixed readings are left out.
    poses : ndarray, shape (n, 3)
        Of the laser, in the frame of the map: x, y (metres), heading (radians).
    """
    by_scan, by_beam = strides(len(poses), laser.beams)
    chosen = np.arange(0, len(poses), by_scan)
    directions = np.ascontiguousarray(laser.directions[::by_beam])
    leap = leaps(grid.solid)
    ranges = np.empty((len(chosen), len(directions)))
    for row, index in enumerate(chosen):
        at = grid.pose_in_grid(Pose(*poses[index].tolist()))
        ray_kernels.cast_scan(
            leap,
            grid.cell_m,
            (at.x_m, at.y_m, at.theta_rad),
            directions,
            laser.range_max_m,
            ranges[row],
        )
    bearings = laser.bearings_rad
    step_rad = float(bearings[1] - bearings[0]) * by_beam
    return Scans(chosen, ranges_in_steps(ranges), float(bearings[0]), step_rad)


def read_from_log(log: Path, said: Said, times_s: NDArray[np.float64]) -> Scans:
    """Read the scans of the log that a results folder was made from.

    Parameters
    ----------
    log : Path
        The log.
    said : Said
        What the folder's manifest says: which log it was, and how it was read.
    times_s : ndarray, shape (n,)
        Times of the path on the log's own clock; a scan is shown for each, thinned.

    Raises
    ------
    ResultsError
        It is another log, or its scans have other times than the path.
    SourceError
        It cannot be read.
    """
    source = open_log(
        log,
        format=said.format,
        strict=bool(said.reading.get("strict", False)),
        fallback_rate_hz=float(said.reading.get("fallback_rate_hz", 10.0)),
        frame=said.reading.get("frame"),
    )
    if source.sha256 != said.sha256:
        raise ResultsError(
            f"--log: {log}: is not the log that the results were made from: its sha256 begins "
            f"with {source.sha256[:12]}, that of {said.file} with {said.sha256[:12]}"
        )
    by_scan, by_beam = 1, 1
    rows: list[NDArray[np.uint16]] = []
    chosen: list[int] = []
    first_rad = step_rad = 0.0
    index = 0
    for observation in source:
        if index == len(times_s):
            break
        if observation.t_s < times_s[index] - TIME_OFF_S:
            continue  # thinned out of the path
        if observation.t_s > times_s[index] + TIME_OFF_S:
            break
        scan = observation.scan
        if not rows:
            by_scan, by_beam = strides(len(times_s), len(scan.ranges_m))
            first_rad = scan.angle_min_rad
            step_rad = scan.angle_increment_rad * by_beam
        if index % by_scan == 0:
            rows.append(ranges_in_steps(scan.ranges_m[::by_beam]))
            chosen.append(index)
        index += 1
    if index < len(times_s):
        raise ResultsError(
            f"{log}: holds no scan at {times_s[index]:.6f} s, where path.csv has a pose; "
            "another version of ssrics read it otherwise"
        )
    beams = len(rows[0]) if rows else 0
    return Scans(
        np.array(chosen, np.int64),
        np.array(rows, np.uint16).reshape(len(rows), beams),
        first_rad,
        step_rad,
    )
