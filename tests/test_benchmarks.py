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
        ("bench_rays.py", ["--scans", "40", "--repeats", "1"], "ragged, ranges of numpy: same"),
        (
            "bench_planning.py",
            ["--plans", "4", "--repeats", "1"],
            "frontiers of the 4 searches: same",
        ),
        ("bench_drive.py", ["--seeds", "1", "--runs", "1", "--repeats", "1"], "| together |"),
    ],
)
def test_a_benchmark_runs(script, arguments, said):
    done = subprocess.run(
        [sys.executable, BENCHMARKS / script, *arguments],
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    assert said in done.stdout


@pytest.mark.parametrize(
    ("script", "peer"),
    [("bench_rays.py", "irsim-x"), ("bench_planning.py", "scikit-image")],
)
def test_a_missing_peer_is_named(script, peer):
    missing = {"irsim-x": "irsim", "scikit-image": "skimage"}[peer]
    code = (
        f"import sys, runpy; sys.modules[{missing!r}] = None; sys.argv = [{script!r}, *'{{}}'.split()]"
    )
    assert code
