"""The real logs: number of scans, frames, times, no-return values, agreement with the truth."""

import csv
import math

import numpy as np
import pytest

from ssrics_like.sources import open_log

# name, format, frame, beams, scans, stamps usable, longest reading that may remain (m)
LOGS = [
    ("wean-1.log", "cmu", "odometry", 180, 713, True, 60),
    ("wean-2.log", "cmu", "odometry", 180, 2251, True, 60),
    ("wean-3.log", "cmu", "odometry", 180, 1241, True, 60),
    ("intel-lab.log.gz", "vertex2", "corrected", 180, 2672, True, 26),
    ("aces-corrected.log.gz", "carmen", "corrected", 180, 440, True, 49.92),
    ("edmonton-corrected.log.gz", "carmen", "corrected", 180, 340, True, 50.8),
    ("infinite-corridor-corrected.log.gz", "carmen", "corrected", 180, 1941, False, 50.9),
    ("orebro-corrected.log.gz", "carmen", "corrected", 181, 237, False, 32.7),
    ("belgioioso-corrected.log.gz", "carmen", "corrected", 361, 395, False, 80),
    ("seattle-corrected.log.gz", "carmen", "corrected", 361, 241, True, 41),
    ("loop5.log", "odometry-laser", "odometry", 181, 551, False, 8.18),
    ("mines-exp1.dat", "mm-rows", "odometry", 682, 756, True, 5.6),
]


@pytest.mark.parametrize("log", LOGS, ids=lambda log: log[0])
def test_every_real_log_reads_as_described(data_dir, log):
    name, kind, frame, beams, scans, timed, longest = log
    source = open_log(data_dir / "logs" / name, strict=True)
    assert (source.format, source.frame) == (kind, frame)
    seen = list(source)
    assert len(seen) == scans
    ranges = np.array([o.scan.ranges_m for o in seen])
    assert ranges.shape == (scans, beams)
    assert ranges[np.isfinite(ranges)].max() < longest
    assert np.nanmin(ranges) > 0
    assert 0.004 < source.report.no_return_share < 0.07 or kind == "mm-rows"
    assert (np.diff([o.t_s for o in seen]) > 0).all()
    assert source.report.timing.usable is timed
    assert timed or seen[-1].t_s == (scans - 1) / 10
    assert source.report.malformed == 0
    assert source.progress == 1.0


def test_poses_and_kept_times_are_those_of_the_truth_on_intel(data_dir):
    source = open_log(data_dir / "logs" / "intel-lab.log.gz")
    with (data_dir / "truth" / "intel_lab" / "poses.csv").open(encoding="ascii") as file:
        truth = [[float(value) for value in row] for row in list(csv.reader(file))[1:]]
    kept = 0
    for seen, (scan, t_s, x_m, y_m, theta) in zip(source, truth, strict=True):
        assert seen.index == scan
        assert seen.pose.x_m == pytest.approx(x_m, abs=6e-5)
        assert seen.pose.y_m == pytest.approx(y_m, abs=6e-5)
        assert math.remainder(seen.pose.theta_rad - theta, math.tau) == pytest.approx(0, abs=6e-6)
        assert abs(seen.t_s - t_s) < 1.0
        kept += seen.t_s == t_s
    assert kept == 2672 - source.report.timing.repaired
    assert source.report.timing.repaired < 120  # 97 backward stamps, some over two scans


@pytest.mark.parametrize("number", [1, 2, 3])
def test_times_are_those_of_the_truth_on_wean(data_dir, number):
    source = open_log(data_dir / "logs" / f"wean-{number}.log")
    with (data_dir / "truth" / f"wean{number}" / "poses.csv").open(encoding="ascii") as file:
        truth = [float(row["t_s"]) for row in csv.DictReader(file)]
    assert [o.t_s for o in source] == truth


def cells(observations, flip):
    """Count 10 cm cells that the scans' ends fall in: few when beams are in order."""
    points = []
    for seen in observations:
        ranges = seen.scan.ranges_m
        near = (ranges > 0.2) & (ranges < 5.5)
        bearings = seen.scan.bearings_rad * (-1 if flip else 1) + seen.pose.theta_rad
        x = seen.pose.x_m + ranges[near] * np.cos(bearings[near])
        y = seen.pose.y_m + ranges[near] * np.sin(bearings[near])
        points.append(np.floor(np.stack([x, y], axis=1) / 0.1))
    return len(np.unique(np.concatenate(points), axis=0))


@pytest.mark.parametrize("name", ["wean-1.log", "intel-lab.log.gz", "loop5.log", "mines-exp1.dat"])
def test_beams_run_from_right_to_left(data_dir, name):
    """A mirrored scan blurs the map that the poses draw; for rows this also tests the wheels."""
    seen = list(open_log(data_dir / "logs" / name))[:600]
    windows = [seen[k : k + 15] for k in range(0, len(seen), 15)]
    straight = sum(cells(window, flip=False) for window in windows)
    mirrored = sum(cells(window, flip=True) for window in windows)
    assert straight < 0.85 * mirrored
