"""Laser scans a second, against irsim-x and a caster in numpy, in one run.

    python benchmarks/bench_rays.py [--scans N] [--repeats N]

All cast the same 180 beams over 180 degrees from the same poses on the same maps of 500 x 500
cells of 5 cm: rooms with doorways and boxes at random, once as drawn and once with ragged walls
as in a map that a robot has made. The numpy caster steps all beams of many scans at once from
cell boundary to cell boundary. irsim-x (PyPI, MIT) reads the map as an image, makes rectangles
of it and meets them in C++, in single precision; it is measured where it can be imported, and
is no dependency of this project. The exit code is 1 if ranges differ.
"""

from __future__ import annotations

import argparse
import contextlib
import importlib.util
import itertools
import math
import os
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from scipy import ndimage

from ssrics_like.perception import Pose
from ssrics_like.world import ray_kernels
from ssrics_like.world.laser import Laser, leaps
from ssrics_like.world.robot import LaserProfile

CELLS, CELL_M = 500, 0.05
ROOMS = 3  # a side
RAGGED = 0.3  # share of the cells along walls that stick out
BEAMS, NOISE_M = 180, 0.02
BODY_M = 0.3
AT_ONCE = 50  # scans that the numpy caster takes together; with more it is no faster
GOAL = 40_000  # scans a second and core
SAME_M = {"numpy": 1e-9, "irsim-x": 1e-3}  # irsim-x computes in single precision
GRAZING = {"numpy": 0.0, "irsim-x": 1e-4}
"""Share of beams that may differ by more: those that graze a corner, and may hit or miss it."""

WORLD = """
world: {{width: {side}, height: {side}, obstacle_map: {image}}}
robot:
  kinematics: {{name: diff}}
  shape: {{name: circle, radius: 0.2}}
  state: [{start}, {start}, 0]
  sensors:
    - {{name: lidar2d, range_min: 0, range_max: 80, angle_range: {angle}, number: {beams},
       noise: {noise}, std: {std}}}
"""

Poses = NDArray[np.float64]
Ranges = NDArray[np.float64]
Solid = NDArray[np.bool_]


def draw_map(rng: np.random.Generator) -> Solid:
    """Make a building: a doorway in each wall between two rooms, some boxes in each room."""
    solid = np.zeros((CELLS, CELLS), bool)
    step = CELLS // ROOMS
    lines = [
        [0, *(step * np.arange(1, ROOMS) + rng.integers(-25, 26, ROOMS - 1)), CELLS - 3]
        for _ in range(2)
    ]
    for across, along, cells in ((*lines, solid), (*lines[::-1], solid.T)):
        for k, line in enumerate(across):
            cells[line : line + 3] = True
            if 0 < k < ROOMS:
                for low, high in itertools.pairwise(along):
                    door = rng.integers(low + 5, high - 25)
                    cells[line : line + 3, door : door + 20] = False
    for top, bottom in itertools.pairwise(lines[0]):
        for left, right in itertools.pairwise(lines[1]):
            for _ in range(rng.integers(2, 6)):
                height, width = rng.integers(6, 24, 2)
                row = rng.integers(top + 20, bottom - 40)
                column = rng.integers(left + 20, right - 40)
                solid[row : row + height, column : column + width] = True
    return solid


def ragged(solid: Solid, rng: np.random.Generator) -> Solid:
    """Let some of the free cells along walls be solid."""
    edge = ndimage.binary_dilation(solid) & ~solid
    return solid | (edge & (rng.random(solid.shape) < RAGGED))


def draw_poses(solid: Solid, rng: np.random.Generator, count: int) -> Poses:
    """Put a robot anywhere that it fits: x, y, heading, shape (count, 3)."""
    cells = np.argwhere(ndimage.distance_transform_edt(~solid) * CELL_M > BODY_M)
    chosen = cells[rng.integers(len(cells), size=count)]
    places = (chosen[:, ::-1] + rng.random((count, 2))) * CELL_M
    return np.column_stack([places, rng.uniform(-math.pi, math.pi, count)])


def numpy_scans(solid: Solid, poses: Poses, bearings: NDArray[np.float64]) -> Ranges:
    """Step all beams of some scans through the grid at once; beams that have arrived drop out."""
    angles = (poses[:, 2:] + bearings).ravel()
    dx, dy = np.cos(angles), np.sin(angles)
    px, py = np.repeat(poses[:, :2] / CELL_M, len(bearings), axis=0).T
    column, row = np.floor(px).astype(np.intp), np.floor(py).astype(np.intp)
    across, up = np.where(dx > 0, 1, -1), np.where(dy > 0, 1, -1)
    with np.errstate(divide="ignore"):
        over_x, over_y = 1 / np.abs(dx), 1 / np.abs(dy)
    tx = np.where(dx > 0, column + 1 - px, px - column) * over_x
    ty = np.where(dy > 0, row + 1 - py, py - row) * over_y
    ranges = np.zeros(len(angles))
    beam = np.arange(len(angles))
    t = np.zeros(len(angles))
    while len(beam):
        met = solid[row, column]
        if met.any():
            ranges[beam[met]] = t[met]
            beam, row, column, across, up, tx, ty, over_x, over_y = (
                values[~met] for values in (beam, row, column, across, up, tx, ty, over_x, over_y)
            )
        sideways = tx <= ty
        t = np.where(sideways, tx, ty)
        column = column + across * sideways
        row = row + up * ~sideways
        tx = tx + over_x * sideways
        ty = ty + over_y * ~sideways
    return ranges.reshape(len(poses), -1) * CELL_M


class Ours:
    """The package's laser, and its kernel alone."""

    def __init__(self, solid: Solid) -> None:
        self.leap = leaps(solid)
        self.lasers = {
            noise_m: Laser(LaserProfile(beams=BEAMS, noise_m=noise_m), np.random.default_rng(1))
            for noise_m in (0.0, NOISE_M)
        }
        self.profile = self.lasers[0.0].profile

    def kernel(self, poses: Poses) -> Ranges:
        ranges = np.empty((len(poses), BEAMS))
        directions = self.profile.directions
        for pose, row in zip(poses.tolist(), ranges, strict=True):
            ray_kernels.cast_scan(self.leap, CELL_M, tuple(pose), directions, 80.0, row)
        return ranges

    def scans(self, poses: list[Pose], noise_m: float) -> Ranges:
        laser = self.lasers[noise_m]
        return np.array([laser.scan(self.leap, CELL_M, pose).ranges_m for pose in poses])


class IrSimX:
    """An environment of irsim-x with the map as its image."""

    def __init__(self, solid: Solid, folder: Path, *, noise: bool) -> None:
        with contextlib.redirect_stdout(sys.stderr):  # it says which windows it could not open
            import irsim  # noqa: PLC0415 - an optional peer

        image = folder / "map.png"
        Image.fromarray(np.where(solid[::-1], 0, 255).astype(np.uint8)).save(image)
        side = CELLS * CELL_M
        text = WORLD.format(
            side=side, image=image, start=side / 2, beams=BEAMS,
            angle=math.radians(BEAMS - 1), noise=noise, std=NOISE_M,
        )  # fmt: skip
        (folder / "world.yaml").write_text(text)
        self.env = irsim.make(
            str(folder / "world.yaml"), display=False, log_level="CRITICAL", seed=1
        )
        # What `env.step` moves and senses with has no public name.
        self.core, self.sense = self.env._cpp._w, self.env._cpp._fast_sensor_step  # noqa: SLF001
        self.lidar = self.env.robot.lidar
        self.angles = self.lidar.angle_list.astype(np.float32)

    def kernel(self, poses: Poses) -> Ranges:
        """Cast by the C++ kernel alone."""
        cast, angles = self.core.raycast_at, self.angles
        return np.array([cast(x, y, theta, angles, 80.0) for x, y, theta in poses.tolist()])

    def scans(self, poses: Poses) -> Ranges:
        """Sense as `env.step` does when the robot has moved."""
        ranges = np.empty((len(poses), BEAMS))
        state = self.env.robot._state  # noqa: SLF001 - set_state rebuilds more than is sensed with
        for pose, row in zip(poses[:, :, None], ranges, strict=True):
            state[:3] = pose
            self.sense()
            row[:] = self.lidar.range_data
        return ranges


EXACT, NOISY = "`Laser.scan`", f"`Laser.scan`, noise {100 * NOISE_M:g} cm"


class Trial:
    """One map: every caster with its median time for a scan, and whether the ranges agree."""

    def __init__(self, solid: Solid, poses: Poses, folder: Path | None) -> None:
        ours = Ours(solid)
        self.expected = expected = ours.kernel(poses)
        objects = [Pose(*pose) for pose in poses.tolist()]
        few, fewer = poses[: max(len(poses) // 10, 1)], poses[: max(len(poses) // 40, 1)]

        def by_numpy(poses: Poses) -> Ranges:
            parts = [poses[i : i + AT_ONCE] for i in range(0, len(poses), AT_ONCE)]
            return np.concatenate(
                [numpy_scans(solid, part, ours.profile.bearings_rad) for part in parts]
            )

        self.works: dict[str, tuple[int, Callable[[], Any]]] = {
            EXACT: (len(poses), lambda: ours.scans(objects, 0.0)),
            "the kernel `cast_scan` alone": (len(poses), lambda: ours.kernel(poses)),
            "numpy, all beams at once": (len(few), lambda: by_numpy(few)),
        }
        self.off_m = {"numpy": np.abs(by_numpy(few) - expected[: len(few)])}
        if folder is not None:
            other, loud = (IrSimX(solid, folder, noise=noise) for noise in (False, True))
            self.off_m["irsim-x"] = np.abs(other.scans(poses) - expected)
            self.works["irsim-x, its C++ kernel alone"] = len(few), lambda: other.kernel(few)
            self.works["irsim-x, sensing"] = len(few), lambda: other.scans(few)
        self.works[NOISY] = len(poses), lambda: ours.scans(objects, NOISE_M)
        if folder is not None:
            self.works["irsim-x, sensing with noise"] = len(fewer), lambda: loud.scans(fewer)
        self.seconds: dict[str, list[float]] = {name: [] for name in self.works}

    def time_all(self) -> None:
        """Time everything once, one after the other, so that a busy moment slows all alike."""
        for name, (count, work) in self.works.items():
            start = time.perf_counter()
            work()
            self.seconds[name].append((time.perf_counter() - start) / count)

    def a_second(self, name: str) -> float:
        return 1 / float(np.median(self.seconds[name]))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--scans", type=int, default=4000, help="poses on each map")
    parser.add_argument("--repeats", type=int, default=9)
    arguments = parser.parse_args()
    rng = np.random.default_rng(2006)
    drawn = draw_map(rng)
    maps = {"as drawn": drawn, "ragged": ragged(drawn, rng)}
    poses = draw_poses(maps["ragged"], rng, arguments.scans)
    peer = importlib.util.find_spec("irsim") is not None
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place) if peer else None
        trials = {name: Trial(solid, poses, folder) for name, solid in maps.items()}
        for _ in range(arguments.repeats):
            for trial in trials.values():
                trial.time_all()

    means = ", ".join(f"{t.expected.mean():.1f} m {name}" for name, t in trials.items())
    print(
        f"{BEAMS} beams from each of {len(poses)} poses, mean range {means}; one core; median of "
        f"{arguments.repeats} repeats, load {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores\n"
    )
    print("| scans a second; times as long as ours | " + " | ".join(trials) + " |")
    print("|---" * (len(trials) + 1) + "|")
    beside = EXACT
    for name in trials["as drawn"].works:
        beside = NOISY if name == NOISY else beside
        cells = [
            f"{t.a_second(name):,.0f}; {t.a_second(beside) / t.a_second(name):.2f}"
            for t in trials.values()
        ]
        print(f"| {name} | {' | '.join(cells)} |")
    print()
    if not peer:
        print("irsim-x is left out: it is not installed here (pip install irsim-x)")
    fine = True
    for map_name, trial in trials.items():
        for name, off_m in trial.off_m.items():
            grazing = float((off_m > SAME_M[name]).mean())
            same = grazing <= GRAZING[name]
            fine = fine and same
            print(
                f"{map_name}, ranges of {name}: {'same' if same else 'DIFFERENT'}, "
                f"within {SAME_M[name]:g} m but for {1e6 * grazing:.0f} beams in a million"
            )
    reached = min(t.a_second(name) for t in trials.values() for name in (EXACT, NOISY))
    print(f"goal: {GOAL:,} scans a second and core, with and without noise: {reached:,.0f}")
    return 0 if fine else 1


if __name__ == "__main__":
    sys.exit(main())
