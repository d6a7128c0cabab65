"""Retrieval among many landmarks, against a plain loop over the chunks, in one run.

    python benchmarks/bench_memory.py [landmarks] [references]

Both get the same memory, request and noise, and must choose the same landmark.
"""

from __future__ import annotations

import argparse
import math
import sys
import time
from collections.abc import Callable
from typing import Any

import numpy as np

from ssrics_like.memory import (
    Chunk,
    DeclarativeMemory,
    Listed,
    ListedSimilarity,
    MemoryParameters,
    Request,
    View,
    ViewSimilarity,
)

BEAMS = 180
EXPECTED, FAR = 500, -20.0  # landmarks that are expected somewhere; similarity of all others
SECTORS = ("left", "front", "right")
STRUCTURES = ("doorway", "opening", "junction", "corridor", "room")
PARAMETERS = MemoryParameters(
    retrieval_threshold=-20.0, mismatch_penalty=2.0, activation_noise=0.25
)


class LoopMemory:
    """The same retrieval, one chunk after another."""

    def __init__(self) -> None:
        self.chunks: list[tuple[Chunk, list[float]]] = []

    def retrieve(self, request: Request, t_s: float, rng: np.random.Generator) -> str:
        parameters, penalty = PARAMETERS, PARAMETERS.mismatch_penalty or 0.0
        best, best_name = -math.inf, ""
        for chunk, references in self.chunks:
            strength = sum(max(0.05, t_s - t) ** -(parameters.decay or 0.0) for t in references)
            total = math.log(strength)
            for slot, value, _ in request.slots:
                total += penalty * similarity(slot, value, chunk.slots[slot])
            p = min(max(rng.random(), 1e-4), 1 - 1e-4)
            total += parameters.activation_noise * math.log((1 - p) / p)
            if total > best:
                best, best_name = total, chunk.name
        return best_name


def similarity(slot: str, requested: Any, held: Any) -> float:
    if slot == "view":
        one, other = requested.descriptor, held.descriptor
        one, other = one - one.mean(), other - other.mean()
        r = float(one @ other) / math.sqrt(float(one @ one) * float(other @ other))
        return max(r, 0.0) - 1
    if slot == "place":
        return likeness_of_places(requested).similarities.get(held, FAR)
    return 0.0 if requested == held else -1.0


def likeness_of_places(requested: Any) -> Listed:
    del requested
    return Listed({f"place-of-L{number}": -0.01 * number for number in range(EXPECTED)}, FAR)


def fill(landmarks: int, references: int) -> tuple[DeclarativeMemory, LoopMemory, Request, float]:
    rng = np.random.default_rng(0)
    similarities = {"view": ViewSimilarity(), "place": ListedSimilarity(likeness_of_places)}
    memory = DeclarativeMemory(PARAMETERS, np.random.default_rng(1), similarities)
    loop = LoopMemory()
    adding_s = 0.0
    for number in range(landmarks):
        name = f"L{number}"
        slots = {
            "id": name,
            "sector": str(rng.choice(SECTORS)),
            "structure": str(rng.choice(STRUCTURES)),
            "view": View(f"view-{number}", rng.uniform(0.3, 8.0, BEAMS).astype(np.float32)),
            "place": f"place-of-{name}",
        }
        chunk, times = Chunk(name, "landmark", slots), sorted(rng.uniform(0, 3600, references))
        start = time.perf_counter()
        memory.add(chunk, times[0])
        for t_s in times[1:]:
            memory.strengthen(name, t_s)
        adding_s += time.perf_counter() - start
        loop.chunks.append((chunk, times))
    print(f"adding with its references: {1e6 * adding_s / landmarks:.1f} us a landmark")
    target = loop.chunks[landmarks // 2][0].slots
    request = Request(
        "landmark",
        (
            ("sector", target["sector"], False),
            ("structure", target["structure"], False),
            ("view", target["view"], False),
            ("place", "place-1", False),
        ),
    )
    return memory, loop, request, 3700.0


def best_s(call: Callable[[], object], repeats: int) -> float:
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        call()
        times.append(time.perf_counter() - start)
    return min(times)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("landmarks", nargs="?", type=int, default=10_000)
    parser.add_argument("references", nargs="?", type=int, default=5)
    options = parser.parse_args()
    landmarks, references = options.landmarks, options.references
    memory, loop, request, t_s = fill(landmarks, references)
    found = memory.retrieve(request, t_s)  # the generators of both begin at seed 1
    winner = loop.retrieve(request, t_s, np.random.default_rng(1))
    if found.chunk is None or found.chunk.name != winner:
        sys.exit(f"the two disagree: {found.candidates.best} against {winner}")
    fast = best_s(lambda: memory.retrieve(request, t_s), 50)
    slow = best_s(lambda: loop.retrieve(request, t_s, np.random.default_rng(1)), 3)
    print(f"retrieval among {landmarks} landmarks with {references} references each,")
    print(f"  winner {winner} in both: {1e3 * fast:.2f} ms against {1e3 * slow:.0f} ms")
    print(f"  ratio {slow / fast:.0f}")


if __name__ == "__main__":
    main()
