"""How long a reflex takes to be decided, and a log to be replayed.

Prints ratios against stock pyactr (its own memory and rule parser) in the same run.
Usage: python benchmarks/bench_model.py [LOG]
"""

from __future__ import annotations

import sys
import tempfile
import time
from pathlib import Path

import numpy as np

from ssrics_like.library import find, folder
from ssrics_like.memory.profile import MemoryProfile
from ssrics_like.modules import LandmarkModules
from ssrics_like.perception.observation import Pose
from ssrics_like.perception.reflex import Reflex
from ssrics_like.productions.engine import Engine
from ssrics_like.productions.interface import BufferChunk
from ssrics_like.productions.rulebook import load_rulebook
from ssrics_like.scenarios.modules import load_memory
from ssrics_like.scenarios.resolving import resolve
from ssrics_like.scenarios.runner import run_scenario
from ssrics_like.scenarios.schema import make_scenario

RULES = Path(__file__).parents[1] / "tests" / "rules"
LANDMARKS = 100
REFLEXES = 200


def reflex(event: int, t_s: float, x_m: float, rng: np.random.Generator) -> Reflex:
    """Return a reflex somewhere on a line."""
    return Reflex(
        event=event, scan=event, t_s=t_s, pose=Pose(x_m, 0.0, 0.0), true_pose=None,
        perceived_s=t_s, travelled_m=x_m, modality="laser", novelty=0.5, sector="front",
        structure="unknown", place=Pose(x_m, 0.0, 0.0), directed=False, turned_rad=0.0, carried=0,
        view=rng.normal(size=36).astype(np.float32),
    )  # fmt: skip


def seconds_per_reflex(profile: MemoryProfile) -> float:
    """Fill a memory with landmarks, then time reflexes at them, each decided before the next."""
    rng = np.random.default_rng(0)
    modules = LandmarkModules(profile, rng, lambda _: None, lambda *_: None)
    engine = Engine(load_rulebook(find("productions", "landmark")), modules, modules)
    start = 0.0
    for i in range(LANDMARKS + REFLEXES):
        if i == LANDMARKS:
            assert len(modules.topological) == LANDMARKS
            start = time.perf_counter()
        x_m = 10.0 * (i if i < LANDMARKS else rng.integers(LANDMARKS))
        engine.push("orienting", modules.admit(reflex(i, 5.0 * i, x_m, rng)), 5.0 * i)
        engine.settle()
    return (time.perf_counter() - start) / REFLEXES


def seconds_per_percept(*, stock: bool) -> float:
    """Time a smaller rule set, which stock pyactr understands too, over as many chunks."""
    rng = np.random.default_rng(0)
    parameters = {"retrieval_threshold": -9.0, "latency_factor": 0.001, "decay": 0.5}
    exact = MemoryProfile(**parameters, mismatch_penalty=None, activation_noise=0.0)
    modules = LandmarkModules(exact, rng, lambda _: None, lambda *_: None)
    engine = Engine(
        load_rulebook(RULES / "parity.yaml"), modules, modules, stock=parameters if stock else None
    )
    start = 0.0
    for i in range(LANDMARKS + REFLEXES):
        if i == LANDMARKS:
            start = time.perf_counter()
        word = f"word-{i if i < LANDMARKS else rng.integers(LANDMARKS)}"
        engine.push("orienting", BufferChunk("reflex", {"event": "e", "sector": word}), 20.0 * i)
        engine.settle()
    assert engine.firings == 3 * LANDMARKS + 2 * REFLEXES  # built once each, then recognised
    return (time.perf_counter() - start) / REFLEXES


def main() -> None:
    """Print the table."""
    profile = load_memory("act-r").model_copy(update={"place_drift": 0.0})
    print(
        f"reflex decided by the landmark rules, {LANDMARKS} landmarks in memory: "
        f"{seconds_per_reflex(profile) * 1e3:.2f} ms"
    )
    own, stock = (seconds_per_percept(stock=stock) for stock in (False, True))
    print(
        f"percept decided by the reference rules, {LANDMARKS} chunks: {own * 1e3:.2f} ms, "
        f"on stock pyactr {stock * 1e3:.2f} ms, {stock / own:.1f} times as long"
    )
    log = Path(sys.argv[1]) if len(sys.argv) > 1 else folder("scenarios") / "logs" / "demo.log.gz"
    resolved = resolve(make_scenario({"source": {"log": str(log.absolute())}}), Path.cwd())
    for attempt in ("first, kernels loaded or compiled", "again"):
        with tempfile.TemporaryDirectory() as out:
            start = time.perf_counter()
            manifest = run_scenario(resolved, Path(out))
            taken = time.perf_counter() - start
        scans = manifest["runs"][0]["scans"]
        print(
            f"replay of {log.name} ({attempt}): {taken:.2f} s, {scans / taken:.0f} scans per second"
        )


if __name__ == "__main__":
    main()
