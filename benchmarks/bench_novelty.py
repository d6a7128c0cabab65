"""Speed of perception, as ratios to named alternatives measured in the same run.

    python benchmarks/bench_novelty.py

Part 1: `novelty_profile` (sliding) on 20,000 scans of 180 beams, interval 50,
against a loop of `np.corrcoef` over all windows (run in full), against the bare
float32 matrix products that it cannot do without (row blocks against the block
and the 49 rows after it, the fastest of several block sizes), and against the
report's double loop over pairs (run on a few windows and scaled). The counts of
all windows must be those of the `np.corrcoef` loop; if not, the exit code is 1.

Part 2: time per scan of the streaming parts.

Part 3: time until the first reflex can be had in a fresh process.
"""

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterable
from functools import partial
from pathlib import Path

import numpy as np

from ssrics_like.perception import (
    LaserScan,
    NoveltyDetector,
    Observation,
    PerceptionBuffer,
    PerceptionProfile,
    Pose,
    SectorClassifier,
    condition,
    describe_view,
    novelty_profile,
)

SCANS, BEAMS, INTERVAL, GRADIENT = 20_000, 180, 50, 0.99
PAIRS = INTERVAL * (INTERVAL - 1) // 2
UPPER = np.triu_indices(INTERVAL, 1)
BLOCKS = (16, 32, 64, 96, 128)
PARTS = 10
DOUBLE_LOOP_WINDOWS = 5
STEP_RAD = np.pi / BEAMS

FIRST_USE = """
import time
start = time.perf_counter()
import numpy as np
from ssrics_like.perception import *
scan = LaserScan(np.linspace(1, 5, 180) ** 2 % 7, -1.57, 0.01745)
buffer = PerceptionBuffer(PerceptionProfile(interval=2, mark="every"))
for k in range(2):
    buffer.update(Observation(k, 0.1 * k, Pose(0, 0, 0), scan))
buffer.update(Observation(2, 0.2, Pose(0, 0, 0), LaserScan(scan.ranges_m[::-1], -1.57, 0.01745)))
novelty_profile(np.ones((60, 180)))
print(time.perf_counter() - start)
"""


def drive(scans: int, beams: int) -> np.ndarray:
    """Ranges that drift at a changing pace, with halts: novel and bored intervals."""
    rng = np.random.default_rng(2006)
    pace = 0.3 * rng.uniform(size=scans) ** 4
    pace[np.arange(scans) % 500 >= 300] = 0.001
    offset = np.zeros(beams)
    shape = 5 + 2 * np.sin(np.linspace(0, 3, beams))
    rows = np.empty((scans, beams))
    for row, scale in zip(rows, pace, strict=True):
        offset = (1.0 - 0.1 * scale) * offset + scale * rng.normal(size=beams)
        row[:] = np.clip(shape + offset, 0.1, 9.0)
    return rows


def times_s(work: Callable[[], object], repeats: int) -> list[float]:
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return times


def corrcoef_counts(scans: np.ndarray, windows: Iterable[int]) -> list[int]:
    return [
        int(np.count_nonzero(np.corrcoef(scans[k : k + INTERVAL])[UPPER] > GRADIENT))
        for k in windows
    ]


def bare_products(unit: np.ndarray, block: int) -> None:
    space = np.empty((block, block + INTERVAL - 1), np.float32)
    for top in range(0, len(unit), block):
        rows, columns = unit[top : top + block], unit[top : top + block + INTERVAL - 1]
        np.matmul(rows, columns.T, out=space[: len(rows), : len(columns)])


def double_loop(alpha: np.ndarray) -> int:
    """Count gamma as the report's pseudo-code does (section 2.1)."""
    gamma = 0
    for i in range(INTERVAL):
        for j in range(i + 1, INTERVAL):
            if np.corrcoef(alpha[i], alpha[j])[0, 1] > GRADIENT:
                gamma += 1
    return gamma


def batch(scans: np.ndarray) -> bool:
    novelty_profile(scans[:100])  # compiled or loaded before it is timed
    unit = scans.astype(np.float32)
    # The loop runs in parts with the others between them, so that whatever else
    # the machine does slows all alike.
    profile_times: list[float] = []
    products_times: dict[int, list[float]] = {size: [] for size in BLOCKS}
    corrcoef_s = 0.0
    expected: list[int] = []
    for part in np.array_split(np.arange(SCANS - INTERVAL + 1), PARTS):
        profile_times += times_s(lambda: novelty_profile(scans), 3)
        for size in BLOCKS:
            products_times[size] += times_s(partial(bare_products, unit, size), 3)
        start = time.perf_counter()
        expected += corrcoef_counts(scans, part)
        corrcoef_s += time.perf_counter() - start
    # The loop's time is a sum over good and bad moments, so compare it with medians.
    profile_s = float(np.median(profile_times))
    products_s = min(float(np.median(times)) for times in products_times.values())
    sample = np.linspace(0, SCANS - INTERVAL, DOUBLE_LOOP_WINDOWS).astype(int)
    start = time.perf_counter()
    literal = [double_loop(scans[k : k + INTERVAL]) for k in sample]
    double_s = (time.perf_counter() - start) / len(sample) * len(expected)

    counts = np.rint(novelty_profile(scans) * PAIRS).astype(int)
    same = np.array_equal(counts, expected) and counts[sample].tolist() == literal
    print(f"novelty_profile, sliding, {SCANS} x {BEAMS}, interval {INTERVAL}")
    print(f"  tau from {counts.min() / PAIRS:.2f} to {counts.max() / PAIRS:.2f}, "
          f"mean {counts.mean() / PAIRS:.2f}")  # fmt: skip
    print(f"  {'':34}{'seconds':>10}{'ratio':>10}")
    scaled = f"double loop ({len(sample)} windows, scaled)"
    for name, seconds in (
        ("novelty_profile", profile_s),
        ("bare float32 products", products_s),
        ("loop of np.corrcoef", corrcoef_s),
        (scaled, double_s),
    ):
        print(f"  {name:34}{seconds:10.4f}{seconds / profile_s:10.2f}")
    print(f"  counts of all {len(expected)} windows equal: {'yes' if same else 'NO'}")
    print(f"  goals: np.corrcoef loop >= 100 ({corrcoef_s / profile_s:.0f}), "
          f"time <= 4 x products ({profile_s / products_s:.2f})\n")  # fmt: skip
    return same


def streaming(scans: np.ndarray) -> None:
    rows = scans[:4000]
    bearings = -np.pi / 2 + STEP_RAD * np.arange(BEAMS)
    seen = [
        Observation(k, 0.1 * k, Pose(0.0, 0.0, 0.0), LaserScan(row, bearings[0], STEP_RAD))
        for k, row in enumerate(rows)
    ]
    dropouts = rows.copy()
    dropouts[np.random.default_rng(0).uniform(size=rows.shape) < 0.05] = np.inf
    robust, maximum = (SectorClassifier(bearings, rule) for rule in ("robust", "maximum"))

    def detect() -> None:
        detector = NoveltyDetector(INTERVAL, GRADIENT)
        for row in rows:
            detector.update(row)

    def buffer(profile: PerceptionProfile) -> Callable[[], None]:
        def work() -> None:
            perception = PerceptionBuffer(profile)
            for observation in seen:
                perception.update(observation)

        return work

    print(f"per scan of {BEAMS} beams{'':22}{'us':>8}{'goal':>8}")
    for name, goal, work in (
        ("NoveltyDetector.update", 15, detect),
        ("condition", 5, lambda: [condition(row, 8.0, 5) for row in rows]),
        ("condition, 5 % dropouts", 5, lambda: [condition(row, 8.0, 5) for row in dropouts]),
        ("sector, robust", 20, lambda: [robust.classify(row) for row in rows]),
        ("sector, maximum", 20, lambda: [maximum.classify(row) for row in rows]),
        ("view", "", lambda: [describe_view(row, 36) for row in rows]),
        ("PerceptionBuffer, default", 60, buffer(PerceptionProfile())),
        ("PerceptionBuffer, a mark each scan", 60, buffer(PerceptionProfile(mark="every"))),
    ):
        work()
        print(f"  {name:40}{min(times_s(work, 3)) / len(rows) * 1e6:8.2f}{goal:>8}")
    print()


def first_use() -> None:
    package = Path(__file__).parents[1]
    with tempfile.TemporaryDirectory() as cache:
        environment = {**os.environ, "PYTHONPATH": str(package), "NUMBA_CACHE_DIR": cache}
        print("first use in a fresh process")
        for name in ("nothing cached, compiling", "kernels from the cache"):
            done = subprocess.run(
                [sys.executable, "-c", FIRST_USE],
                env=environment, capture_output=True, text=True, check=True,
            )  # fmt: skip
            print(f"  {name:40}{float(done.stdout):8.2f} s")


def main() -> int:
    scans = drive(SCANS, BEAMS)
    same = batch(scans)
    streaming(scans)
    first_use()
    return 0 if same else 1


if __name__ == "__main__":
    raise SystemExit(main())
