"""The benchmark of the view still runs; how fast is not judged here."""

import subprocess
import sys
from pathlib import Path

import pytest

BENCHMARK = Path(__file__).parents[1] / "benchmarks" / "bench_view.py"


def printed(*arguments):
    return subprocess.run(
        [sys.executable, str(BENCHMARK), *arguments], capture_output=True, text=True, check=True
    ).stdout


def test_it_measures_a_frame_against_drawing_everything_anew():
    if not Path("/usr/bin/chromium").exists():
        pytest.skip("/usr/bin/chromium is not there")
    pytest.importorskip("playwright")
    out = printed("--scans", "400", "--frames", "10")
    assert "400 scans: a page of " in out
    assert "| script and painting, layers kept | " in out
    assert "Drawing everything anew takes " in out


def test_it_says_that_a_browser_is_missing(tmp_path):
    pytest.importorskip("playwright")
    gone = tmp_path / "chromium"
    assert printed("--browser", str(gone)) == f"{gone} is not there; nothing was measured\n"
