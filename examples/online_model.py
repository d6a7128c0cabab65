"""Feed a log to the model one observation at a time, as a robot would.

Usage: python examples/online_model.py [LOG]
"""

from __future__ import annotations

import sys

from ssrics_like import CognitiveModel, load_memory, load_perception, load_productions, open_log
from ssrics_like.library import folder


def main() -> None:
    """Print every decision when it is made, and the landmarks at the end."""
    log = sys.argv[1] if len(sys.argv) > 1 else folder("scenarios") / "logs" / "demo.log.gz"
    source = open_log(log)
    model = CognitiveModel(
        load_perception("human-like"),
        load_productions("landmark"),
        load_memory("act-r"),
        seed=1,
        frame=source.frame,
    )

    def tell(decisions: list) -> None:
        for d in decisions:
            print(
                f"{d.decided_s:7.1f} s  {d.decision:<10} {d.landmark:<4} "
                f"at {d.pose.x_m:6.2f}, {d.pose.y_m:5.2f} m  {d.sector:<5} by rule '{d.rule}'"
            )

    for observation in source:
        tell(model.observe(observation))
    tell(model.finish())

    print()
    for arc in model.topological.arcs[:5]:
        way = f"{arc.from_id} -> {arc.to_id}"
        print(f"{way}: {arc.distance_m:.1f} m, driven {arc.traversals} times")


if __name__ == "__main__":
    main()
