"""How the report's literal rule behaves on real logs: the table of docs/report-rule.md.

Usage: python benchmarks/report_rule.py LOG [LOG ...]
"""

from __future__ import annotations

import math
import sys
from collections import Counter
from pathlib import Path

from ssrics_like import CognitiveModel, load_memory, load_perception, load_productions, open_log
from ssrics_like.errors import SsricsError

COLUMNS = (
    "log", "scans", "m", "intervals", "novel, %", "onsets", "marked", "dismissed", "marks / 100 m",
)  # fmt: skip
READINGS = ("tumbling", "sliding")


def row(path: Path, advance: str) -> list[str]:
    """Replay a log with the report's profile and rules; only the advance of intervals differs."""
    profile = load_perception("report").model_copy(update={"advance": advance})
    model = CognitiveModel(profile, load_productions("report"), load_memory("act-r"))
    decided: Counter[str] = Counter()
    length_m, scans, previous = 0.0, 0, None
    for observation in open_log(path):
        decided.update(d.decision for d in model.observe(observation))
        here = observation.pose
        if previous is not None:
            length_m += math.hypot(here.x_m - previous.x_m, here.y_m - previous.y_m)
        previous = here
        scans += 1
    decided.update(d.decision for d in model.finish())
    seen = model.perception
    share = 100 * seen.novel_intervals / seen.intervals if seen.intervals else math.nan
    per_100_m = 100 * decided["declared"] / length_m if length_m else math.nan
    return [
        path.name, str(scans), f"{length_m:.1f}", str(seen.intervals), f"{share:.1f}",
        str(seen.onsets), str(decided["declared"]), str(decided["dismissed"]), f"{per_100_m:.1f}",
    ]  # fmt: skip


def main() -> None:
    """Print one table a reading."""
    logs = [Path(name) for name in sys.argv[1:]]
    if not logs:
        sys.exit(__doc__)
    for advance in READINGS:
        print(f"{advance} intervals\n")
        print("| " + " | ".join(COLUMNS) + " |")
        print("|---" * len(COLUMNS) + "|")
        for path in logs:
            try:
                print("| " + " | ".join(row(path, advance)) + " |")
            except SsricsError as error:
                sys.exit(f"report_rule: {error}")
        print()


if __name__ == "__main__":
    main()
