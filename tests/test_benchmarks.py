"""The benchmarks still run; how fast is not judged here."""

import subprocess
import sys
from pathlib import Path

import pytest

BENCHMARKS = Path(__file__).parents[1] / "benchmarks"
DEMO = BENCHMARKS.parent / "scenarios" / "logs" / "demo.log.gz"


@pytest.mark.parametrize(
    ("script", "arguments", "said"),
    [
        ("bench_model.py", [], "times as long"),
        ("bench_flat.py", ["--scans", "1642"], "1642 scans"),
        ("report_rule.py", [DEMO], "| demo.log.gz | 1642 |"),
    ],
)
def test_a_benchmark_runs(script, arguments, said):
    done = subprocess.run(
        [sys.executable, BENCHMARKS / script, *arguments],
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    assert said in done.stdout
