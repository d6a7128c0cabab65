"""Recognising among many landmarks, against comparing them one after another, in one run.

    python benchmarks/bench_large_memory.py [landmarks]

Landmarks lie on a grid, 6 m apart, each joined to its neighbours, each with five references and a
view of what surrounds it. The default model begins with this memory; it perceives a doorway, once
knowing where it was last, once lost. Recognising is what a retrieval takes: expecting landmarks
somewhere, comparing views, base levels, noise.
"""

from __future__ import annotations

import argparse
import math
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ssrics_like.library import find
from ssrics_like.memory import (
    Arc,
    Chunk,
    Here,
    Hypothesis,
    Landmark,
    PastRun,
    RememberedChunk,
    SavedMemory,
    View,
    load_memory_file,
    save_memory_file,
)
from ssrics_like.memory.links import Link
from ssrics_like.memory.surroundings import agreement
from ssrics_like.model import CognitiveModel
from ssrics_like.perception.reflex import Reflex
from ssrics_like.perception.surround_view import DIRECTIONS
from ssrics_like.perception.surroundings import DECIMALS
from ssrics_like.poses import Pose
from ssrics_like.productions.interface import SlotTest
from ssrics_like.productions.rulebook import load_rulebook
from ssrics_like.scenarios.modules import load_memory, load_perception

APART_M = 6.0
REFERENCES = 5
REPEATS, LOOPS = 15, 3


@dataclass(frozen=True)
class Times:
    """Seconds; the least of several."""

    landmarks: int
    knowing_s: float
    lost_s: float
    loop_s: float
    saving_s: float
    loading_s: float


def memory_of(landmarks: int) -> SavedMemory:
    """Return a memory of a grid of landmarks."""
    rng = np.random.default_rng(0)
    side = math.isqrt(landmarks)
    names = [f"L{number + 1}" for number in range(side * side)]
    lengths = rng.uniform(0.5, 6.0, (len(names), DIRECTIONS))
    vistas = rng.uniform(1.0, 40.0, lengths.shape)
    views = np.concatenate([lengths, np.zeros_like(lengths), vistas], axis=1)
    views = np.round(views, DECIMALS).astype(np.float32)
    chunks = tuple(
        RememberedChunk(
            Chunk(name, "landmark", {
                "id": name, "sector": "front", "structure": "doorway",
                "view": View(f"view-{i}", views[i]), "place": f"place-of-{name}",
            }),
            tuple(rng.uniform(0.0, 3600.0, REFERENCES).tolist()),
        )
        for i, name in enumerate(names)
    )  # fmt: skip
    nodes = tuple(
        Landmark(name, APART_M * (i % side), APART_M * (i // side), 0.0, -3600.0, -1.0, REFERENCES,
                 {"structure": "doorway"})
        for i, name in enumerate(names)
    )  # fmt: skip
    pairs = [(i, i + 1, 0.0) for i in range(len(names)) if (i + 1) % side]
    pairs += [(i, i + side, math.pi / 2) for i in range(len(names) - side)]
    arcs = tuple(
        Arc(names[i], names[j], 1, APART_M, 0.0, turn, 0.0, APART_M, 0.0,
            APART_M * math.cos(turn), APART_M * math.sin(turn), 0.0, 0.05, 0.01)
        for i, j, turn in pairs
    )  # fmt: skip
    origins = {name: f"0123456789ab/{name}" for name in names}
    past = (PastRun("0123456789ab", 0.0),)
    return SavedMemory(3600.0, "odometry", past, chunks, nodes, arcs, origins)


def perceived(memory: SavedMemory, event: int, landmark: int) -> Reflex:
    """Return the reflex of a doorway that looks like one in memory, nearly."""
    view = memory.chunks[landmark].chunk.slots["view"]
    assert isinstance(view, View)
    node = memory.landmarks[landmark]
    noise = np.random.default_rng(event).normal(0.0, 0.1, view.descriptor.shape)
    place = Pose(node.x_m + 0.1, node.y_m - 0.1, 0.05)
    return Reflex(
        event, event, float(event), place, None, float(event), 3.0, "laser", 0.5, "front",
        "doorway", place, True, 0.0, 0, (view.descriptor + np.abs(noise)).astype(np.float32),
    )  # fmt: skip


def model_with(memory: SavedMemory) -> CognitiveModel:
    model = CognitiveModel(
        load_perception("human-like"), load_rulebook(find("productions", "landmark")),
        load_memory("act-r"), remembered=memory,
    )  # fmt: skip
    model._modules.begin(0.0)  # noqa: SLF001 - only the modules are timed
    return model


def recognising_s(memory: SavedMemory, *, lost: bool) -> float:
    """Return how long the modules take to recognise; exits if it is not the right landmark."""
    modules = model_with(memory)._modules  # noqa: SLF001 - as above
    times = []
    for event in range(REPEATS):
        there = (event + 1) * (len(memory.landmarks) // (REPEATS + 1)) + 1  # no end of a row
        before = memory.landmarks[there - 1]
        if lost:
            modules.whereabouts.lose()
        else:
            at = Pose(before.x_m, before.y_m, 0.0)
            fix = Hypothesis(before.id, Link(at, 0.0, 0.0), Here(at, True, 0.0, 0.0), 0.0)
            modules.whereabouts.hypotheses = (fix,)
            modules.go(at, 1.0)  # on its way it reckons where landmarks lie from there
        modules.admit(perceived(memory, event, there))
        tests = (
            SlotTest("structure", "doorway"),
            SlotTest("view", f"view-{event}"),
            SlotTest("place", f"place-{event}"),
        )
        start = time.perf_counter()
        found = modules.recall("landmark", tests, float(event), {})
        times.append(time.perf_counter() - start)
        if found.chunk is None or found.chunk.name != memory.landmarks[there].id:
            sys.exit(f"recognised {found.chunk}, not {memory.landmarks[there].id}")
    return min(times)


def comparing_one_by_one_s(memory: SavedMemory) -> float:
    """Return how long it takes to compare a view with all others one after another."""
    views = [chunk.chunk.slots["view"] for chunk in memory.chunks]
    rows = [view.descriptor[None] for view in views if isinstance(view, View)]
    return least_s(lambda: [agreement(rows[0][0], row) for row in rows], 1)


def least_s(call: Callable[[], object], repeats: int = LOOPS) -> float:
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        call()
        times.append(time.perf_counter() - start)
    return min(times)


def measured(landmarks: int) -> Times:
    """Time a memory of so many landmarks, the square number below."""
    memory = memory_of(landmarks)
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "memory.json"
        saving_s = least_s(lambda: save_memory_file(memory, file))
        loading_s = least_s(lambda: load_memory_file(file))
        loaded = load_memory_file(file)
    return Times(
        len(memory.landmarks), recognising_s(loaded, lost=False), recognising_s(loaded, lost=True),
        comparing_one_by_one_s(memory), saving_s, loading_s,
    )  # fmt: skip


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("landmarks", nargs="?", type=int, default=10_000)
    times = measured(parser.parse_args().landmarks)
    print(f"{times.landmarks} landmarks")
    print(f"  recognised, knowing where it was last  {1000 * times.knowing_s:.2f} ms")
    print(f"  recognised, lost                       {1000 * times.lost_s:.2f} ms")
    print(f"  views compared one after another take {times.loop_s / times.knowing_s:.0f} times as "
          "long as recognising")  # fmt: skip
    print(f"  saved in {times.saving_s:.2f} s, loaded in {times.loading_s:.2f} s")


if __name__ == "__main__":
    main()
