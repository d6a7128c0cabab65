"""Saving and loading a run's memory, against pickle and against plain json with indent, in one run.

    python benchmarks/bench_memory_files.py [landmarks] [references]

All three write the same memory and must read back the same landmarks.
"""

from __future__ import annotations

import argparse
import itertools
import json
import pickle
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from ssrics_like.memory import (
    Arc,
    Chunk,
    DeclarativeMemory,
    Landmark,
    MemoryParameters,
    PastRun,
    RememberedChunk,
    SavedMemory,
    View,
    load_memory_file,
    save_memory_file,
)

BEAMS = 36
REPEATS = 3


def made(landmarks: int, references: int) -> SavedMemory:
    """Return a memory of so many landmarks, each joined to the next."""
    rng = np.random.default_rng(0)
    names = [f"L{number}" for number in range(1, landmarks + 1)]
    chunks = tuple(
        RememberedChunk(
            Chunk(
                name,
                "landmark",
                {
                    "id": name,
                    "sector": str(rng.choice(["left", "front", "right"])),
                    "structure": "doorway",
                    "view": View(f"view-{name}", rng.normal(0.0, 0.3, BEAMS)),
                    "place": f"place-of-{name}",
                },
            ),
            tuple(sorted(rng.uniform(0, 3600, references).tolist(), reverse=True)),
        )
        for name in names
    )
    nodes = tuple(
        Landmark(name, *rng.uniform(-3, 3, 3).tolist(), -3600.0, -10.0, references,
                 {"sector": "left", "structure": "doorway", "novelty": 0.75})
        for name in names
    )  # fmt: skip
    arcs = tuple(
        Arc(one, other, 2, *rng.uniform(0, 3, 6).tolist())
        for one, other in itertools.pairwise(names)
    )
    origins = {name: f"0123456789ab/{name}" for name in names}
    run = PastRun("0123456789ab", 0.0)
    return SavedMemory(3600.0, "odometry", (run,), chunks, nodes, arcs, origins)


def with_pickle(memory: SavedMemory, path: Path) -> Callable[[], SavedMemory]:
    path.write_bytes(pickle.dumps(memory))
    return lambda: pickle.loads(path.read_bytes())


def with_json(memory: SavedMemory, path: Path) -> Callable[[], Any]:
    data = asdict(memory)
    path.write_text(json.dumps(data, indent=1, default=np.ndarray.tolist))
    return lambda: json.loads(path.read_text())


def with_ours(memory: SavedMemory, path: Path) -> Callable[[], SavedMemory]:
    save_memory_file(memory, path)
    return lambda: load_memory_file(path)


def best_s(call: Callable[[], object]) -> float:
    times = []
    for _ in range(REPEATS):
        start = time.perf_counter()
        call()
        times.append(time.perf_counter() - start)
    return min(times)


def names_in(memory: Any) -> list[str]:
    if isinstance(memory, SavedMemory):
        return [landmark.id for landmark in memory.landmarks]
    return [landmark["id"] for landmark in memory["landmarks"]]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("landmarks", nargs="?", type=int, default=10_000)
    parser.add_argument("references", nargs="?", type=int, default=5)
    options = parser.parse_args()
    landmarks, references = options.landmarks, options.references
    memory = made(landmarks, references)
    print(f"{landmarks} landmarks, views of {BEAMS}, {references} references each")
    ways = {"ssrics-memory": with_ours, "pickle": with_pickle, "json, indent 1": with_json}
    found: dict[str, tuple[float, float]] = {}
    with tempfile.TemporaryDirectory() as folder:
        for name, way in ways.items():
            path = Path(folder) / "memory"
            saving_s = best_s(lambda way=way, path=path: way(memory, path))  # type: ignore[misc]
            load = way(memory, path)
            if names_in(load()) != names_in(memory):
                sys.exit(f"{name} reads other landmarks than it wrote")
            found[name] = saving_s, best_s(load)
            size_mb = path.stat().st_size / 1e6
            print(
                f"  {name:<15} save {saving_s:.3f} s, load {found[name][1]:.3f} s, {size_mb:.1f} MB"
            )
        ours = found["ssrics-memory"]
        for name in ("pickle", "json, indent 1"):
            save, load_s = (other / mine for other, mine in zip(found[name], ours, strict=True))
            print(f"  {name} takes {save:.2f} times as long to save, {load_s:.2f} to load")
        save_memory_file(memory, Path(folder) / "memory.json")
        loaded = load_memory_file(Path(folder) / "memory.json")
    recall_s = best_s(lambda: loaded.recall_into(DeclarativeMemory(MemoryParameters())))
    graph_s = best_s(loaded.topological)
    print(f"  into declarative memory {recall_s:.3f} s, into the graph {graph_s:.3f} s")


if __name__ == "__main__":
    main()
