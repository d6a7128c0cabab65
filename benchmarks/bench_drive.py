"""Simulated seconds a wall second of whole runs, where the time goes, and the whole command.

    python benchmarks/bench_drive.py [--seeds N] [--limit S] [--runs N] [--jobs N] [--repeats N]

Part 1: one run of the scenario `complex` in this process, with the full model and its tables and
trace written, for several seeds and modules of the mind, after a run to warm up.

Part 2: the same runs with a stopwatch in the calls that matter. Time counts for the innermost
call that is watched, so that nothing counts twice; what is not watched is given as the rest. The
stopwatch itself takes time: the last line compares with part 1.

Part 3: `ssrics run complex` as a user calls it, in a process of its own, with figures and report.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from functools import wraps
from pathlib import Path
from typing import Any, NamedTuple
from unittest import mock

import numpy as np

from ssrics_like.library import find
from ssrics_like.model import CognitiveModel
from ssrics_like.modules import LandmarkModules
from ssrics_like.perception import PerceptionBuffer
from ssrics_like.productions.engine import Engine
from ssrics_like.results.recorder import Recorder
from ssrics_like.scenarios.feeds import DriveFeed
from ssrics_like.scenarios.one_run import Part, Task, carry_out
from ssrics_like.scenarios.resolving import Resolved, load_resolved
from ssrics_like.world.laser import Laser
from ssrics_like.world.navigation import Navigator
from ssrics_like.world.occupancy import OccupancyGrid
from ssrics_like.world.simulation import Simulation

MINDS = {
    "`report`, rules `report`": [],  # as the scenario says
    "`report`, rules `landmark`": ["productions=landmark"],
    "`human-like`, rules `landmark`": ["perception=human-like", "productions=landmark"],
}
GOAL_RATE, GOAL_S = 500, 60  # simulated seconds a wall second and core; 14 runs with 2 jobs
REST = "the rest: clock, poses, observations"
WATCHED: dict[str, list[tuple[type, str]]] = {
    "setting up": [(DriveFeed, "__init__"), (CognitiveModel, "__init__")],
    "ray casting and noise": [(Laser, "scan")],
    "mapping": [(OccupancyGrid, "take"), (OccupancyGrid, "meet")],
    "planning": [(Navigator, "look"), (Navigator, "bump")],
    "driving and odometry": [(Simulation, "_move")],
    "perception": [(PerceptionBuffer, "update"), (PerceptionBuffer, "flush")],
    "cognition": [
        (CognitiveModel, "finish"), (Engine, "advance"), (Engine, "push"), (Engine, "settle"),
        (LandmarkModules, "admit"), (LandmarkModules, "overwrite"),
    ],
    "writing": [
        (Recorder, name)
        for name in ("__enter__", "observed", "decided_all", "traced", "retrieved", "finish",
                     "__exit__")
    ],
}  # fmt: skip


class Run(NamedTuple):
    """What a run took."""

    scans: int
    simulated_s: float
    wall_s: float


class Stopwatch:
    """Counts each moment for the innermost part at work."""

    def __init__(self) -> None:
        self.spent_s: Counter[str] = Counter()
        self._part = REST
        self._since_s = time.perf_counter()

    def turn_to(self, part: str) -> str:
        """Count the time since the last turn for the part before; return that."""
        before, now_s = self._part, time.perf_counter()
        self.spent_s[before] += now_s - self._since_s
        self._part, self._since_s = part, now_s
        return before

    def watching(self, call: Callable[..., Any], part: str) -> Callable[..., Any]:
        @wraps(call)
        def watched(*arguments: Any, **named: Any) -> Any:
            before = self.turn_to(part)
            try:
                return call(*arguments, **named)
            finally:
                self.turn_to(before)

        return watched

    @contextmanager
    def at_work(self) -> Iterator[None]:
        """Watch the calls of WATCHED meanwhile."""
        patches = [
            mock.patch.object(owner, name, self.watching(getattr(owner, name), part))
            for part, calls in WATCHED.items()
            for owner, name in calls
        ]
        for patch in patches:
            patch.start()
        self.turn_to(REST)
        self.spent_s.clear()
        try:
            yield
        finally:
            self.turn_to(REST)
            for patch in patches:
                patch.stop()


def load(chosen: list[str], seed: int, limit_s: float) -> Resolved:
    resolved = load_resolved(find("scenarios", "complex"), [*chosen, f"seed={seed}"])
    assert resolved.place is not None
    settings = resolved.place.settings.model_copy(update={"time_limit_s": limit_s})
    return replace(resolved, place=replace(resolved.place, settings=settings))


def one_run(resolved: Resolved) -> Run:
    with tempfile.TemporaryDirectory() as folder:
        start = time.perf_counter()
        (entry,) = carry_out(Task(0, (Part(resolved, Path(folder), "bench"),)), lambda _share: None)
        wall_s = time.perf_counter() - start
    return Run(entry["scans"], entry["duration_s"], wall_s)


def whole_command(runs: int, jobs: int) -> tuple[float, float]:
    """Return how long the command took, and how long until its runs were done."""
    with tempfile.TemporaryDirectory() as place:
        out = Path(place) / "out"
        command = [
            sys.executable, "-m", "ssrics_like", "run", "complex", "--runs", str(runs),
            "--jobs", str(jobs), "--out", str(out), "--quiet",
        ]  # fmt: skip
        start = time.perf_counter()
        subprocess.run(command, check=True)
        wall_s = time.perf_counter() - start
        manifest = json.loads((out / "manifest.json").read_text(encoding="utf-8"))
    return wall_s, manifest["wall_clock"]["seconds"]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", type=int, default=5, help="of parts 1 and 2")
    parser.add_argument("--limit", type=float, default=3600.0, help="of their simulated seconds")
    parser.add_argument("--runs", type=int, default=14, help="of the whole command")
    parser.add_argument("--jobs", type=int, default=2, help="of the whole command")
    parser.add_argument("--repeats", type=int, default=3, help="of the whole command")
    arguments = parser.parse_args()
    resolved = {
        name: [load(chosen, k, arguments.limit) for k in range(arguments.seeds)]
        for name, chosen in MINDS.items()
    }
    for each in resolved.values():
        one_run(each[0])
    bare: dict[str, list[Run]] = {name: [] for name in MINDS}
    watched: dict[str, list[tuple[Run, Counter[str]]]] = {name: [] for name in MINDS}
    for k in range(arguments.seeds):
        for name, each in resolved.items():
            bare[name].append(one_run(each[k]))
            watch = Stopwatch()
            with watch.at_work():
                run = one_run(each[k])
            watched[name].append((run, watch.spent_s))

    print(
        f"complex, one run, one core, {arguments.seeds} seeds; medians, in brackets the extremes; "
        f"load {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores\n"
    )
    print("| perception, rules | scans | simulated s | wall s | simulated s a wall second |")
    print("|---|---|---|---|---|")
    slowest = np.inf
    for name, runs in bare.items():
        rates = [run.simulated_s / run.wall_s for run in runs]
        slowest = min(slowest, float(np.median(rates)))
        scans, simulated_s, wall_s = np.median(runs, axis=0)
        print(
            f"| {name} | {scans:.0f} | {simulated_s:.0f} | {wall_s:.2f} | "
            f"{np.median(rates):.0f} ({min(rates):.0f}-{max(rates):.0f}) |"
        )
    print(f"\ngoal: {GOAL_RATE} simulated seconds a wall second and core: {slowest:.0f}\n")

    print("| milliseconds a simulated second | " + " | ".join(MINDS) + " |")
    print("|---" * (len(MINDS) + 1) + "|")

    def row(name: str, of: Callable[[Run, Counter[str]], float]) -> None:
        each = [
            float(np.median([1e3 * of(run, spent_s) / run.simulated_s for run, spent_s in pairs]))
            for pairs in watched.values()
        ]
        print(f"| {name} | " + " | ".join(f"{value:.3f}" for value in each) + " |")

    for part in (*WATCHED, REST):
        row(part, lambda _run, spent_s, part=part: spent_s[part])
    row("together", lambda _run, spent_s: spent_s.total())
    unwatched = [
        float(np.median([1e3 * run.wall_s / run.simulated_s for run in runs]))
        for runs in bare.values()
    ]
    print("| without stopwatch | " + " | ".join(f"{value:.3f}" for value in unwatched) + " |\n")

    times = [whole_command(arguments.runs, arguments.jobs) for _ in range(arguments.repeats)]
    wall_s, until_s = np.median(times, axis=0)
    print(f"| `ssrics run complex -n {arguments.runs} --jobs {arguments.jobs}` | seconds |")
    print("|---|---|")
    print(f"| all of it, median of {arguments.repeats} | {wall_s:.1f} |")
    print(f"| its runs, into one folder | {until_s:.1f} |")
    print(f"| starting, scores, figures and report | {wall_s - until_s:.1f} |")
    print(
        f"\ngoal: 14 runs with 2 jobs under {GOAL_S} s: {wall_s:.1f} s for {arguments.runs} with "
        f"{arguments.jobs}"
    )


if __name__ == "__main__":
    main()
