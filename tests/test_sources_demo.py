"""The log that ships is what its script makes, and is as it is described."""

import gzip
import importlib.util
import math
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from ssrics_like.sources import open_log

ROOT = Path(__file__).parents[1]
SCRIPT = ROOT / "examples" / "make_demo_log.py"
LOG = ROOT / "scenarios" / "logs" / "demo.log.gz"


@pytest.fixture(scope="module")
def demo():
    spec = importlib.util.spec_from_file_location("make_demo_log", SCRIPT)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def run(*arguments):
    return subprocess.run(
        [sys.executable, SCRIPT, *arguments], check=True, capture_output=True, text=True
    ).stdout


def test_the_script_makes_the_shipped_log_again(tmp_path):
    assert run("-o", tmp_path / "again.log.gz") == ""
    again = gzip.decompress((tmp_path / "again.log.gz").read_bytes())
    assert again == gzip.decompress(LOG.read_bytes())
    assert LOG.stat().st_size < 700_000


def test_the_truth_names_every_doorway():
    lines = run("--truth").splitlines()
    assert lines[0] == "id,kind,x_m,y_m"
    assert lines[1] == "A,doorway,3.000,2.000"
    assert len(lines) == 7


def test_the_drive_is_realistic_and_passes_doorways_twice(demo):
    x, y, theta = np.array(demo.drive()).T
    moved = np.hypot(np.diff(x), np.diff(y))
    assert 70 < moved.sum() < 90
    assert moved.max() <= 0.09 + 1e-9
    assert np.abs(np.diff(theta)).max() <= 0.09 + 1e-9
    sides = demo.building()
    start, along = sides[:, :2], sides[:, 2:] - sides[:, :2]
    to = np.stack([x, y], axis=1)[:, None] - start
    share = np.clip((to * along).sum(-1) / (along**2).sum(-1), 0, 1)
    assert np.linalg.norm(to - share[..., None] * along, axis=-1).min() > 0.35
    for name, door_x, door_y, _, kind in demo.DOORWAYS:
        across = (y > door_y) if kind == "-" else (x > door_x)
        near = np.hypot(x - door_x, y - door_y) < 1
        passages = np.count_nonzero(np.diff(across) & near[1:])
        assert passages == (3 if name == "B" else 1 if name in ("BC", "C") else 2), name


def test_rays_are_exact(demo):
    room = np.array(demo.box(-1.0, -2.0, 3.0, 4.0))
    ranges = demo.scan(room, 0.0, 0.0, 0.0)
    assert ranges[90] == pytest.approx(3.0)  # ahead
    assert ranges[0] == pytest.approx(2.0)  # right
    assert ranges[135] == pytest.approx(3.0 * math.sqrt(2))
    assert demo.scan(room, 0.0, 0.0, math.pi)[90] == pytest.approx(1.0)


def test_the_shipped_log_reads_clean():
    source = open_log(LOG, strict=True)
    seen = list(source)
    assert (source.format, source.frame) == ("carmen", "odometry")
    assert source.report.warnings() == []
    assert 0.002 < source.report.no_return_share < 0.004
    assert seen[-1].t_s == pytest.approx((len(seen) - 1) / 10)
    assert len(seen[0].scan.ranges_m) == 180
