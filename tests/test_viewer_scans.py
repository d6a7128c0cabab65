"""Scans that a results folder does not hold: cast anew, or read from the log."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial import cKDTree
from viewer_runs import DEMO_LOG, results

from ssrics_like.errors import ResultsError, SourceError
from ssrics_like.perception.observation import Pose
from ssrics_like.report.reading import read_pictures
from ssrics_like.results.reading import read_records
from ssrics_like.sources import open_log
from ssrics_like.viewer.manifest import said_in
from ssrics_like.viewer.notes import missing_in, scans_note
from ssrics_like.viewer.quantising import NOTHING, ranges_in_steps
from ssrics_like.viewer.scans import (
    BEAMS_MAX,
    BEAMS_MIN,
    READINGS_MAX,
    cast_anew,
    read_from_log,
    strides,
)
from ssrics_like.viewer.tables import read_poses
from ssrics_like.world.grid import FREE, OCCUPIED, GridMap
from ssrics_like.world.laser import Laser, leaps
from ssrics_like.world.robot import LaserProfile


@given(st.integers(0, 2_000_000), st.integers(1, 2000))
def test_a_page_holds_no_more_readings_than_it_may(scans, beams):
    by_scan, by_beam = strides(scans, beams)
    kept = -(-beams // by_beam)
    assert kept <= BEAMS_MAX
    assert kept >= min(beams, BEAMS_MIN)
    assert scans // by_scan * kept <= READINGS_MAX


def test_twenty_thousand_scans_keep_each_a_half_of_180_beams():
    assert strides(20_000, 180) == (1, 2)
    assert strides(1642, 180) == (1, 1)


def room():
    """A room of 6 m by 4 m with a pillar, shifted and turned in its map."""
    cells = np.full((80, 120), FREE, np.uint8)
    cells[[0, -1]] = OCCUPIED
    cells[:, [0, -1]] = OCCUPIED
    cells[30:36, 70:80] = OCCUPIED
    return GridMap(cells, 0.05, Pose(2.0, -1.0, 0.4))


def test_scans_are_those_of_the_laser_without_its_faults():
    grid, laser = room(), LaserProfile(beams=90, step_deg=2.0, noise_m=0.5, dropout=0.5, mixed=0.5)
    poses = [grid.pose_in_map(Pose(1.0 + 0.3 * i, 1.5, 0.7 * i)) for i in range(8)]
    made = cast_anew(grid, laser, np.array([[p.x_m, p.y_m, p.theta_rad] for p in poses]))
    exact = Laser(laser.model_copy(update={"noise_m": 0.0, "dropout": 0.0, "mixed": 0.0}), None)
    leap = leaps(grid.solid)
    for row, pose in zip(made.ranges, poses, strict=True):
        scan = exact.scan(leap, grid.cell_m, grid.pose_in_grid(pose))
        apart = row.astype(int) - ranges_in_steps(scan.ranges_m).astype(int)
        assert abs(apart).max() <= 1
    assert made.first_rad == pytest.approx(math.radians(-89.5))
    assert made.step_rad == pytest.approx(math.radians(2.0))


def test_thinned_beams_keep_their_bearings():
    grid, laser = room(), LaserProfile(beams=720, first_bearing_deg=-89.5, step_deg=0.25)
    pose = grid.pose_in_map(Pose(3.0, 1.0, 0.2))
    made = cast_anew(grid, laser, np.array([[pose.x_m, pose.y_m, pose.theta_rad]]))
    scan = Laser(laser.model_copy(update={"noise_m": 0.0}), None).scan(
        leaps(grid.solid), grid.cell_m, grid.pose_in_grid(pose)
    )
    assert made.ranges.shape == (1, BEAMS_MAX)
    assert made.step_rad == pytest.approx(4 * math.radians(0.25))
    assert (made.ranges[0] == ranges_in_steps(scan.ranges_m)[::4]).all()


def demo():
    folder = results("demo")
    said = said_in(folder, json.loads((folder / "manifest.json").read_text()))
    return said, read_poses(folder, read_records(folder).runs[0])


def test_scans_of_a_log_are_those_of_its_poses():
    said, poses = demo()
    made = read_from_log(DEMO_LOG, said, poses[:, 0])
    assert made.poses.tolist() == list(range(len(poses)))
    times = {round(t, 6): row for t, row in zip(poses[:, 0], made.ranges, strict=True)}
    found = 0
    for observation in open_log(DEMO_LOG):
        row = times.get(round(observation.t_s, 6))
        if row is not None:
            found += 1
            assert (row == ranges_in_steps(observation.scan.ranges_m)).all()
    assert found == len(poses) > 1000
    assert (made.ranges != NOTHING).mean() > 0.5


def test_scans_of_a_log_end_where_the_run_saw_walls():
    said, poses = demo()
    made = read_from_log(DEMO_LOG, said, poses[:, 0])
    outline = read_pictures(results("demo"), read_records(results("demo")).runs[0]).outline
    seen = cKDTree((np.column_stack([outline.x, outline.y]) + 0.5) * outline.cell_m)
    ranges = made.ranges / 100.0
    angles = poses[made.poses, 3:] + made.first_rad + made.step_rad * np.arange(ranges.shape[1])
    ends = np.stack([ranges * np.cos(angles), ranges * np.sin(angles)], -1)
    ends += poses[made.poses, np.newaxis, 1:3]
    away_m, _ = seen.query(ends[ranges < 7.9])
    assert len(away_m) > 10_000
    assert (away_m < 1.5 * outline.cell_m).mean() > 0.97


def test_another_log_is_refused_by_its_digest():
    said, poses = demo()
    other = replace(said, sha256="f" * 64)
    with pytest.raises(ResultsError, match="is not the log that the results were made from"):
        read_from_log(DEMO_LOG, other, poses[:, 0])


def test_a_log_without_a_scan_for_each_pose_is_refused():
    said, poses = demo()
    with pytest.raises(ResultsError, match="holds no scan at "):
        read_from_log(DEMO_LOG, said, poses[:, 0] + 0.031)


def test_a_missing_log_is_one_clear_line(tmp_path):
    said, poses = demo()
    with pytest.raises(SourceError, match="no such file"):
        read_from_log(tmp_path / "gone.log", said, poses[:, 0])


def test_the_note_names_what_the_saved_map_does_not_show():
    world = {"robot": {}, "doors": [{}], "people": None, "furniture": None}
    assert "Doors that shut are not on the saved map" in scans_note("m", world, is_read=True)
    world |= {"people": {"count": 3}, "furniture": {"pieces": 2}}
    assert missing_in(world).startswith("Furniture, people and doors that shut are")
    assert missing_in({"furniture": {"pieces": 2}}).startswith("Furniture is")
    assert missing_in({"doors": []}) == ""
    assert "--log robot.log adds them" in scans_note("robot.log", {}, is_read=False)
