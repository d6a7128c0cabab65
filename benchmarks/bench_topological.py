"""The table of what topological memory is to reach, with 95 % intervals, in one run.

    python benchmarks/bench_topological.py [--maps PLAN ...] [--log LOG LABELS] [--buildings N]
        [--seeds N] [--errands N] [--doors N] [--kidnaps N] [--landmarks N] [--jobs N]

What is measured, and how, is told in `bench_recognition.py`, `bench_leading.py` and
`bench_large_memory.py`, which this runs. Shares have Wilson intervals. The two plain matchers, the
landmark nearest by odometry and the one whose view is most alike, get the same drives.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections import Counter
from pathlib import Path

import bench_large_memory
import bench_leading
import bench_recognition

from ssrics_like.comparison.proportions import wilson
from ssrics_like.comparison.recognition import RecognitionTally

PARTS = ["goto", "closed door", "kidnapped"]
GOALS = {"goto": "≥ 99", "closed door": "≥ 95", "kidnapped": "≥ 90"}
# Recognised, taken for another, landmarks a place, new.
OF_LOG, OF_VISITS = ("≥ 85", "0", "≤ 1.15", ""), ("≥ 95", "≤ 0.5", "", "≤ 5")
NONE = ("",) * 4  # a robot that is misled is beside the point
HEAD = ["", "course", "goal", "n", "the model", "nearest by odometry", "nearest view"]
Row = list[str]


def share(right: int, of: int) -> str:
    """Return a share in per cent with its interval."""
    if not of:
        return "–"
    low, high = wilson(right, of)
    return f"{100 * right / of:.1f} % ({100 * low:.1f}–{100 * high:.1f})"


def recognition_rows(course: str, visit: int, models: list[RecognitionTally]) -> list[Row]:
    """Return what was recognised on one visit, by the model and both matchers."""
    ours = models[0]
    name = bench_recognition.VISITS[visit]
    where = [f"{course}, visit {name}"]
    goals = OF_LOG if course == "log" else NONE if name == bench_recognition.MISLED else OF_VISITS
    rows = [
        ["recognised", *where, goals[0], str(ours.again)]
        + [share(tally.right, tally.again) for tally in models],
        ["taken for another", *where, goals[1], str(ours.recognised)]
        + [share(tally.wrong, tally.recognised) for tally in models],
        ["landmarks a place", *where, goals[2], str(ours.places)]
        + [f"{tally.landmarks_per_place:.2f}" for tally in models],
    ]
    if visit:
        rows.append(
            ["new", *where, goals[3], str(ours.marks)]
            + [share(tally.declared, tally.marks) for tally in models]
        )
    return rows


def leading_rows(part: str, course: str, found: Counter) -> list[Row]:
    """Return how errands of one kind went, or how often the robot found itself."""
    n, good = sum(found.values()), found["reached"] + found["located"]
    what = "located" if part == "kidnapped" else "reached"
    rows = [[f"{part}: {what}", course, GOALS[part], str(n), share(good, n), "", ""]]
    if part == "kidnapped":
        rows.append([f"{part}: wrong", course, "≤ 2", str(n), share(found["wrong"], n), "", ""])
    return rows


def large_rows(landmarks: int) -> list[Row]:
    """Return how long a large memory takes."""
    times = bench_large_memory.measured(landmarks)
    n = str(times.landmarks)
    return [
        ["recognising", "grid", "< 5 ms", n, f"{1000 * times.knowing_s:.1f} ms", "", ""],
        ["recognising, lost", "grid", "< 5 ms", n, f"{1000 * times.lost_s:.1f} ms", "", ""],
        ["saving", "grid", "< 1 s", n, f"{times.saving_s:.2f} s", "", ""],
        ["loading", "grid", "< 1 s", n, f"{times.loading_s:.2f} s", "", ""],
    ]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--maps", nargs="*", type=Path, default=[])
    parser.add_argument("--log", nargs=2, type=Path)
    for name, default in {"buildings": 10, "seeds": 1, "errands": 28, "doors": 3, "kidnaps": 25,
                          "landmarks": 10_000}.items():  # fmt: skip
        parser.add_argument(f"--{name}", type=int, default=default)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    options = parser.parse_args(namespace=argparse.Namespace(parts=PARTS))
    rows = large_rows(options.landmarks)  # first, before all cores are busy
    tallies = bench_recognition.tallied(bench_recognition.courses(options), options.jobs)
    for course, visit in dict.fromkeys((course, visit) for course, visit, _ in tallies):
        models = [tallies[course, visit, model] for model in range(3)]
        rows += recognition_rows(course, visit, models)
    for (part, course), found in bench_leading.counted(
        bench_leading.trials(options), options.jobs
    ).items():
        rows += leading_rows(part, course, found)
    for cells in [HEAD, ["---"] * len(HEAD), *rows]:
        print("| " + " | ".join(cells) + " |")
    return 0


if __name__ == "__main__":
    sys.exit(main())
