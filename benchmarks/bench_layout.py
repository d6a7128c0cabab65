"""How far landmarks are from where they are drawn, and how long it takes to lay a thousand.

    python benchmarks/bench_layout.py [--maps PLAN ...] [--buildings N] [--seeds N]
                                      [--landmarks N] [--jobs N]

Generated buildings, and floor plans in the format of `ssrics bench designators --maps`, are
explored once with odometry 5 % off, corrected by matching scans or not. Positions are compared
with the true ones after the best rigid fit: of the robot, where a landmark was declared as the
wheels have it; of the landmark, where the most certain way from the first one puts it, and in the
relaxed layout.

The second table lays a made-up building, against least squares of scipy that begin at the same
place.
"""

from __future__ import annotations

import argparse
import math
import os
import sys
import time
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np
from scipy.optimize import least_squares
from scipy.sparse import coo_array

from ssrics_like.bench.conditions import NOMINAL
from ssrics_like.bench.drives import BenchDrive, OnPlan, Simulated, make_drive
from ssrics_like.cues import read_cue, read_structure_cue
from ssrics_like.library import find, find_cue
from ssrics_like.memory import Arc, Landmark, TopologicalMemory
from ssrics_like.memory.layout import relaxed_layout
from ssrics_like.model import CognitiveModel
from ssrics_like.perception import PerceptionBuffer, Pose
from ssrics_like.perception.profile import PerceptionProfile
from ssrics_like.productions.rulebook import load_rulebook
from ssrics_like.scenarios.modules import load_memory, load_perception

DRIFT = 0.05
PURPOSE = 3  # buildings of their own, in which nothing was tuned
FEW = 3  # landmarks: no more than these, and any rigid fit lays them nearly right
SPACING_M, SD_M, SD_RAD = 4.0, 0.15, 0.05
EGOMOTION = {"laser": "scans matched", "odometry": "wheels alone"}


class Drive(NamedTuple):
    course: str
    spec: Simulated | OnPlan
    egomotion: str


class Errors(NamedTuple):
    """Squared errors of each landmark by each way of laying them, shape (landmarks, 3), m^2."""

    course: str
    egomotion: str
    links: int
    squared: np.ndarray


def explored(drive: Drive) -> Errors:
    """Explore a building; compare what is remembered of it."""
    made = make_drive(drive.spec)
    profile = load_perception("human-like").model_copy(update={"egomotion": drive.egomotion})
    model = CognitiveModel(
        profile, load_rulebook(find("productions", "landmark")), load_memory("act-r"),
        frame=made.frame,
    )  # fmt: skip
    decisions = [d for o in made.observations for d in model.observe(o)] + model.finish()
    places = true_places(made, profile)
    robot = {d.landmark: d.true_pose for d in decisions if d.decision == "declared"}
    place = {d.landmark: places[d.event] for d in decisions if d.decision == "declared"}
    memory = model.topological
    layout = relaxed_layout(memory.nodes, memory.arcs)
    parts: dict[int, list[str]] = {}
    for name, placed in layout.items():
        parts.setdefault(placed.component, []).append(name)
    squared = []
    for names in parts.values():
        if len(names) <= FEW:
            continue
        chained = memory.links.seen_from(names[0], most=len(memory))
        there = xy([place[name] for name in names])
        squared.append([
            misses(xy([memory[name] for name in names]), xy([robot[name] for name in names])),
            misses(xy([chained[name].pose for name in names]), there),
            misses(xy([layout[name].pose for name in names]), there),
        ])  # fmt: skip
    pairs = {frozenset((arc.from_id, arc.to_id)) for arc in memory.arcs}
    return Errors(drive.course, drive.egomotion, len(pairs), np.hstack(squared).T)


def true_places(drive: BenchDrive, profile: PerceptionProfile) -> dict[int, Pose]:
    """Return where each reflex really is, by its event: as it is seen from the true pose."""
    buffer = PerceptionBuffer(
        profile, read_cue(find_cue(profile.doorways)),
        read_structure_cue(find_cue(profile.structure)),
    )  # fmt: skip
    here, reflexes = {}, []
    for observation in drive.observations:
        reflexes += buffer.update(observation)
        here[observation.index] = buffer.here
    reflexes += buffer.flush()
    return {r.event: r.true_pose.onward(r.place.seen_from(here[r.scan])) for r in reflexes}


def xy(poses: list[Pose] | list[Landmark]) -> np.ndarray:
    return np.array([(pose.x_m, pose.y_m) for pose in poses])


def misses(laid: np.ndarray, true: np.ndarray) -> np.ndarray:
    """Return the squared distances that are left after the best rigid fit, by complex numbers."""
    a, b = ((p - p.mean(axis=0)) @ (1, 1j) for p in (laid, true))
    turn = np.vdot(a, b)
    return np.abs(b - a * turn / abs(turn)) ** 2


def made_up(count: int) -> tuple[list[Landmark], list[Arc]]:
    """Return landmarks declared row by row, and arcs there and back between 3 in 2 neighbours."""
    rng = np.random.default_rng(0)
    side = math.ceil(math.sqrt(count))
    cells = [divmod(k, side) for k in range(count)]
    at = np.array([(row, side - 1 - k if row % 2 else k) for row, k in cells], float) * SPACING_M
    poses = [Pose(*xy_m, rng.uniform(-3, 3)) for xy_m in at + rng.normal(0, 0.5, at.shape)]
    onward = [(k, k + 1) for k in range(count - 1)]
    # Above the k-th cell of a row driven to and fro is the one as far from the turn.
    across = [(k, 2 * side * (k // side + 1) - 1 - k) for k in range(count)]
    across = [pair for pair in across if pair[0] + 1 < pair[1] < count]
    chosen = rng.choice(len(across), min(len(across), count // 2 + 1), replace=False)
    arcs = []
    for one, other in onward + [across[k] for k in sorted(chosen)]:
        noise = rng.normal(0.0, (SD_M, SD_M, SD_RAD))
        step = poses[other].seen_from(poses[one])
        step = Pose(step.x_m + noise[0], step.y_m + noise[1], step.theta_rad + noise[2])
        for start, end, seen in (
            (one, other, step), (other, one, Pose(0.0, 0.0, 0.0).seen_from(step))
        ):  # fmt: skip
            way_m = math.hypot(seen.x_m, seen.y_m)
            arcs.append(Arc(f"L{start}", f"L{end}", 1, way_m, 0.0, 0.0, 0.0, way_m, 0.0,
                            seen.x_m, seen.y_m, seen.theta_rad, SD_M, SD_RAD))  # fmt: skip
    return [
        Landmark(f"L{k}", p.x_m, p.y_m, p.theta_rad, 0.0, 0.0, 1) for k, p in enumerate(poses)
    ], arcs


def by_scipy(landmarks: list[Landmark], arcs: list[Arc]) -> np.ndarray:
    """Lay landmarks by scipy's least squares, differences in place of derivatives."""
    order = {landmark.id: k for k, landmark in enumerate(landmarks)}
    known = [arc for arc in arcs if order[arc.from_id] < order[arc.to_id]]
    i, j = (np.array([order[getattr(arc, end)] for arc in known]) for end in ("from_id", "to_id"))
    step = np.array([(arc.x_m, arc.y_m, arc.theta_rad) for arc in known])
    sd = np.array([(arc.position_sd_m, arc.position_sd_m, arc.direction_sd_rad) for arc in known])
    links = TopologicalMemory.restored(landmarks, arcs).links
    first = Pose(landmarks[0].x_m, landmarks[0].y_m, landmarks[0].theta_rad)
    start = np.zeros((len(landmarks), 3))
    for name, link in links.seen_from(landmarks[0].id, most=len(landmarks)).items():
        pose = first.onward(link.pose)
        start[order[name]] = pose.x_m, pose.y_m, pose.theta_rad

    def misfit(loose: np.ndarray) -> np.ndarray:
        poses = np.vstack([start[:1], loose.reshape(-1, 3)])
        away = (poses[j, :2] - poses[i, :2]) @ (1, 1j) * np.exp(-1j * poses[i, 2])
        off = np.column_stack([away.real, away.imag, poses[j, 2] - poses[i, 2]]) - step
        off[:, 2] = np.angle(np.exp(1j * off[:, 2]))
        return (off / sd).ravel()

    rows = 3 * np.arange(len(known))[:, None, None] + np.arange(3)[:, None]
    pairs = [np.broadcast_arrays(rows, 3 * end[:, None, None] + np.arange(3)) for end in (i, j)]
    at = tuple(np.concatenate([pair[k].ravel() for pair in pairs]) for k in (0, 1))
    filled = coo_array((np.ones(len(at[0])), at), shape=(3 * len(known), start.size)).tocsr()[:, 3:]
    found = least_squares(
        misfit, start[1:].ravel(), jac_sparsity=filled, x_scale="jac", ftol=None, gtol=None,
        xtol=1e-10, tr_solver="lsmr", tr_options={"atol": 1e-14, "btol": 1e-14},
    )  # fmt: skip
    return np.vstack([start[:1], found.x.reshape(-1, 3)])[:, :2]


def timed(count: int) -> None:
    landmarks, arcs = made_up(count)
    begun = time.perf_counter()
    layout = relaxed_layout(landmarks, arcs)
    ours_s = time.perf_counter() - begun
    begun = time.perf_counter()
    theirs = by_scipy(landmarks, arcs)
    theirs_s = time.perf_counter() - begun
    apart = np.sqrt(misses(xy([placed.pose for placed in layout.values()]), theirs).max())
    if apart > 1e-3:
        sys.exit(f"the two lay landmarks up to {apart:g} m apart")
    print(f"\n| {count} landmarks, {len(arcs)} arcs | seconds | times |\n|---|---|---|")
    print(f"| `relaxed_layout` | {ours_s:.2f} | 1 |")
    print(f"| `scipy.optimize.least_squares`, trf with lsmr, sparse differences, the same within "
          f"{apart:.0e} m | {theirs_s:.2f} | {theirs_s / ours_s:.1f} |")  # fmt: skip


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--maps", nargs="*", type=Path, default=[])
    parser.add_argument("--buildings", type=int, default=6)
    parser.add_argument("--seeds", type=int, default=1)
    parser.add_argument("--landmarks", type=int, default=1000)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    options = parser.parse_args()
    drifting = replace(NOMINAL, drift=DRIFT)
    specs: list[tuple[str, Simulated | OnPlan]] = [
        ("generated", Simulated(drifting, seed, PURPOSE)) for seed in range(options.buildings)
    ]
    specs += [
        ("plans", OnPlan(plan, 2 * seed + 1000, drifting))
        for plan in options.maps for seed in range(options.seeds)
    ]  # fmt: skip
    drives = [Drive(course, spec, egomotion) for course, spec in specs for egomotion in EGOMOTION]
    found: dict[tuple[str, str], list[Errors]] = {}
    with ProcessPoolExecutor(options.jobs) as pool:
        for errors in pool.map(explored, drives):
            found.setdefault((errors.course, errors.egomotion), []).append(errors)
    print("| root mean square error, m | drives | landmarks | links | declared, by the wheels "
          "| by the most certain way | relaxed layout |\n|" + "---|" * 7)  # fmt: skip
    for (course, egomotion), each in found.items():
        squared = np.vstack([errors.squared for errors in each])
        cells = [f"{course}, {EGOMOTION[egomotion]}", str(len(each)), str(len(squared)),
                 str(sum(errors.links for errors in each)),
                 *(f"{root:.2f}" for root in np.sqrt(squared.mean(axis=0)))]  # fmt: skip
        print("| " + " | ".join(cells) + " |")
    timed(options.landmarks)
    return 0


if __name__ == "__main__":
    sys.exit(main())
