"""The benchmarks still run; how fast is not judged here."""

import subprocess
import sys
from pathlib import Path

import pytest

BENCHMARKS = Path(__file__).parents[1] / "benchmarks"
DEMO = BENCHMARKS.parent / "scenarios" / "logs" / "demo.log.gz"
WITHOUT = "import runpy, sys; sys.modules[{!r}] = None; del sys.argv[0]; runpy.run_path({!r}, run_name='__main__')"


def printed(*command):
    return subprocess.run(
        [sys.executable, *command], capture_output=True, text=True, check=True
    ).stdout


@pytest.mark.parametrize(
    ("script", "arguments", "said"),
    [
        ("bench_model.py", [], "times as long"),
        ("bench_memory_files.py", ["200", "2"], "times as long to save"),
        ("bench_flat.py", ["--scans", "1642"], "1642 scans"),
        (
            "bench_doorways.py",
            ["--scans", "400", "--gaps", "20", "--repeats", "1"],
            "ways round the 20 gaps: same",
        ),
        ("bench_layout.py", ["--buildings", "0", "--landmarks", "100"], "relaxed_layout"),
        ("bench_large_memory.py", ["100"], "times as long as recognising"),
        (
            "bench_topological.py",
            [
                "--buildings",
                "1",
                "--errands",
                "1",
                "--doors",
                "1",
                "--kidnaps",
                "1",
                "--landmarks",
                "100",
                "--jobs",
                "1",
            ],
            "| kidnapped: wrong | generated |",
        ),
        (
            "bench_study.py",
            ["--people", "3", "--responses", "5", "--pause", "0"],
            "| 3 | 15 | 15 | 0 |",
        ),
        ("report_rule.py", [DEMO], "| demo.log.gz | 1642 |"),
        (
            "bench_drive.py",
            ["--seeds", "1", "--limit", "30", "--runs", "1", "--repeats", "1"],
            "| `ssrics run complex -n 1 --jobs 2` | seconds |",
        ),
    ],
)
def test_a_benchmark_runs(script, arguments, said):
    assert said in printed(BENCHMARKS / script, *arguments)


@pytest.mark.parametrize(
    ("script", "peer", "module", "arguments", "said"),
    [
        (
            "bench_rays.py", "irsim-x", "irsim", ["--scans", "40", "--repeats", "1"],
            ["as drawn, ranges of numpy: same", "ragged, ranges of numpy: same"],
        ),
        (
            "bench_planning.py", "scikit-image", "skimage", ["--plans", "4", "--repeats", "1"],
            ["cost of the 4 ways", "none: same", "frontiers of the 4 searches: same"],
        ),
    ],
)  # fmt: skip
def test_a_benchmark_runs_without_an_optional_peer_and_says_so(
    script, peer, module, arguments, said
):
    path = str(BENCHMARKS / script)
    out = printed("-c", WITHOUT.format(module, path), path, *arguments)
    assert f"{peer} is left out: it is not installed here (pip install {peer})" in out
    assert [text for text in said if text not in out] == []
