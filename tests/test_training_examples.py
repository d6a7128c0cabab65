"""From a drive to what is learned from it: augmentation, measures, true places, labels."""

import math
from dataclasses import replace

import numpy as np
import pytest
from buildings import Along, exact_robot, simulated, two_rooms

from ssrics_like.perception.conditioning import condition
from ssrics_like.perception.gap import FEATURES
from ssrics_like.perception.observation import Pose
from ssrics_like.perception.surroundings import Surroundings
from ssrics_like.training import drives
from ssrics_like.training.augmentation import augmented, key_frames
from ssrics_like.training.drives import TrainingDrive, travelled
from ssrics_like.training.examples import Example, described, example
from ssrics_like.training.labels import labels
from ssrics_like.workers import in_order

DOORS, OTHERS = np.array([[3.0, 1.5]]), np.array([[5.0, 1.5]])


def made(poses, true_xy=None, beams=4):
    poses = np.asarray(poses, float)
    scans = len(poses)
    ranges = np.arange(scans)[:, None] + np.zeros(beams)  # a scan's readings tell its number
    places = poses[:, :2] if true_xy is None else np.asarray(true_xy, float)
    return TrainingDrive(poses, ranges, np.linspace(-1, 1, beams), places, DOORS, OTHERS)


@pytest.fixture(scope="module")
def through():
    """A drive straight through the doorway of two rooms, from x = 1 to x = 5."""
    robot = exact_robot()
    seen = list(simulated(two_rooms(), robot, (1.0, 1.5), [Along([(5.0, 1.5)])]))
    return TrainingDrive(
        np.array([(o.pose.x_m, o.pose.y_m, o.pose.theta_rad) for o in seen]),
        np.array([o.scan.ranges_m for o in seen]),
        robot.laser.bearings_rad,
        np.array([(o.true_pose.x_m, o.true_pose.y_m) for o in seen]),
        DOORS,
        OTHERS,
    )


def test_the_length_of_a_path():
    assert travelled(np.array([[0, 0, 9.0], [3, 4, 9], [3, 4, 0], [3, 5, 0]])).tolist() == [
        0, 5, 5, 6,
    ]  # fmt: skip


def test_key_frames_are_so_far_or_so_turned_from_the_last():
    straight = made([(0.1 * i, 0.0, 0.0) for i in range(11)])
    assert key_frames(straight, 0.25, 0.3).tolist() == [0, 3, 6, 9]
    turning = made([(0.0, 0.0, math.pi - 0.25 + 0.1 * i) for i in range(9)])  # across +-180
    assert key_frames(turning, 0.25, 0.25).tolist() == [0, 3, 6]


@pytest.mark.parametrize("seed", range(12))
def test_an_augmented_drive_is_the_same_drive_turned_and_thinned(seed):
    rng = np.random.default_rng(99)
    way = np.cumsum(rng.normal(0.1, 0.02, (200, 2)), axis=0)
    headings = np.arctan2(*np.gradient(way, axis=0).T[::-1])
    drive = made(np.column_stack([way, headings]), way + 7.0)
    other = augmented(drive, np.random.default_rng(seed))
    kept = other.ranges_m[:, 0].astype(int)
    assert kept[0] == 0
    assert (np.diff(kept) > 0).all()
    assert np.array_equal(other.true_xy_m, drive.true_xy_m[kept])
    assert len(other.poses) == len(kept) >= 40
    # Turned about the origin by one angle; errors are at most a few centimetres and degrees.
    by = np.angle(np.exp(1j * (other.poses[:, 2] - drive.poses[kept, 2])))
    turn = np.exp(1j * by).mean()
    expected = (way[kept] @ [1, 1j]) * turn / abs(turn)
    assert np.abs(other.poses[:, :2] @ [1, 1j] - expected).max() < 0.1 + 0.002 * 30
    assert np.abs(np.angle(np.exp(1j * by) / turn)).max() < 0.04


def test_augmented_drives_begin_at_any_heading_and_keep_few_or_all_scans():
    drive = made([(0.1 * i, 0.0, 0.0) for i in range(100)])
    several = [augmented(drive, np.random.default_rng(seed)) for seed in range(30)]
    headings = [one.poses[0, 2] for one in several]
    assert min(headings) < -2
    assert max(headings) > 2
    assert min(len(one.poses) for one in several) <= 34
    assert max(len(one.poses) for one in several) == 100


def test_dense_poses_keep_their_places():
    """An error a scan would make a path of 1 cm steps much longer than it is."""
    drive = made([(0.01 * i, 0.0, 0.0) for i in range(300)])
    for seed in range(10):
        assert augmented(drive, np.random.default_rng(seed)).travelled_m[-1] < 3.0


def test_places_are_described_as_the_model_describes_them(through):
    found = described(through)
    surroundings = Surroundings()
    expected = []
    for pose, ranges in zip(through.poses, through.ranges_m, strict=True):
        conditioned = condition(ranges, 8.0, 5).ranges_m
        expected += surroundings.update(Pose(*pose), through.bearings_rad, conditioned, None)
    assert len(found.at_m) == len(expected) > 25
    assert found.measures.shape == (len(expected), len(FEATURES))
    assert np.allclose(found.measures, [one.measures for one in expected], rtol=1e-6)
    assert np.allclose(found.at_m, [one.place.at_m for one in expected])


def test_true_places_are_those_of_the_truth_whatever_odometry_says(through):
    off = replace(through, poses=through.poses * [1.1, 1.1, 1.0] + [50.0, 9.0, 0.0])
    found = described(off)
    start_x = through.true_xy_m[0, 0]
    assert np.allclose(found.xy_m[:, 0], start_x + found.at_m / 1.1, atol=1e-6)
    assert np.allclose(found.xy_m[:, 1], 1.5, atol=1e-6)


def test_the_doorway_is_the_narrowest_place_of_the_drive(through):
    found = described(through)
    width = found.measures[:, FEATURES.index("width_m")]
    assert abs(found.xy_m[width.argmin(), 0] - 3.0) <= 0.15
    assert width.min() == pytest.approx(0.9, abs=0.11)


def test_a_drive_too_short_for_a_place_has_none():
    found = described(made([(0.0, 0.0, 0.0), (0.1, 0.0, 0.0)]))
    assert found.measures.shape == (0, len(FEATURES))
    assert found.xy_m.shape == (0, 2)
    assert labels(found).tolist() == []


def test_labels_by_distance():
    x = np.array([0.0, 0.29, 0.31, 0.59, 0.61, 5.0, 5.9, 6.1])
    places = np.column_stack([x, np.zeros(len(x))])
    none = np.empty((len(x), 0), np.float32)
    one = Example(x, places, none, np.array([[0.0, 0.0]]), np.array([[5.0, 0.0]]))
    assert labels(one).tolist() == [1, 1, -1, -1, 0, -1, -1, 0]
    # What is beyond doubt in a doorway is so beside a junction too.
    both = replace(one, doorways_m=np.array([[0.0, 0.0], [5.2, 0.0]]))
    assert labels(both).tolist() == [1, 1, -1, -1, 0, 1, -1, 0]
    empty = replace(one, doorways_m=np.empty((0, 2)), others_m=np.empty((0, 2)))
    assert labels(empty).tolist() == [0] * 8


def short_example(seed):
    """Make an example of a drive of a minute; in a worker too, which no fixture reaches."""
    drives.LIMIT_S = 60.0
    return example(seed)


def test_examples_are_the_same_in_other_processes(monkeypatch):
    monkeypatch.setattr(drives, "LIMIT_S", 60.0)
    seeds = [np.random.SeedSequence(4, spawn_key=(1, number)) for number in (1, 2)]
    one, other = in_order(short_example, seeds, 2)
    again = short_example(seeds[1])
    assert one.measures.shape != other.measures.shape
    for name in ("at_m", "xy_m", "measures", "doorways_m", "others_m"):
        assert np.array_equal(getattr(other, name), getattr(again, name)), name
    assert (labels(other) == 1).any()
