"""How a landmark's chunk fades, is strengthened when met, and is forgotten."""

from __future__ import annotations

from ssrics_like.memory import Chunk, DeclarativeMemory, MemoryParameters, Request


def main() -> None:
    """Print base levels and what a retrieval gives at some moments."""
    memory = DeclarativeMemory(MemoryParameters(retrieval_threshold=-2.0, latency_factor=0.1))
    memory.add(Chunk("L1", "landmark", {"id": "L1", "sector": "left"}), 0.0)
    wanted = Request("landmark", (("sector", "left", False),))
    for t_s in (1.0, 10.0, 50.0, 100.0):
        found = memory.retrieve(wanted, t_s)
        print(
            f"{t_s:5.0f} s: base level {memory.base_level('L1', t_s):6.3f}, "
            f"{'recalled' if found.chunk else 'forgotten'} after {found.latency_s:.3f} s"
        )
    memory.strengthen("L1", 100.0)
    found = memory.retrieve(wanted, 150.0)
    print(f"met again at 100 s; at 150 s {'recalled' if found.chunk else 'forgotten'}")


if __name__ == "__main__":
    main()
