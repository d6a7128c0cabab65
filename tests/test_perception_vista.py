"""The vista of a place: what one sees at the end of the hallway."""

import math

import numpy as np
import pytest

from ssrics_like.perception.observation import Pose
from ssrics_like.perception.vista import (
    DIRECTIONS,
    FARTHEST_M,
    FEWEST,
    MEMORY_M,
    MOST,
    NEAR_M,
    NEAREST_M,
    RATIO,
    Vista,
)

BEARINGS = np.radians(np.arange(-89.5, 90.0))
LENGTH_M, HALF_M = 30.0, 1.2  # a hallway, along x


def hallway(pose, end_m=LENGTH_M, bearings=BEARINGS):
    """Ranges in a hallway that ends at x = end_m, and 10 m behind its beginning."""
    angles = pose.theta_rad + bearings
    cos, sin = np.cos(angles), np.sin(angles)
    with np.errstate(divide="ignore"):
        along = np.where(cos > 0, (end_m - pose.x_m) / cos, (-10.0 - pose.x_m) / cos)
        aside = np.where(sin > 0, (HALF_M - pose.y_m) / sin, (-HALF_M - pose.y_m) / sin)
    return np.minimum(along, np.where(sin == 0.0, np.inf, aside))


def vista_after(*poses, ranges=None):
    vista = Vista()
    for i, pose in enumerate(poses):
        vista.take(pose, BEARINGS, hallway(pose) if ranges is None else ranges, 0.2 * i)
    return vista


def test_one_sees_to_the_end_of_the_hallway():
    vista = vista_after(Pose(0.3, 0.1, 0.0))
    ahead = vista.view_of(Pose(0.0, 0.0, 0.0))
    assert ahead[0] == pytest.approx(LENGTH_M, abs=0.1)
    assert np.all(ahead[10:27] == 0.0)  # behind
    assert ahead[7] == 0.0  # nearer than a vista begins
    assert ahead[1] < 0.0  # along the wall it goes on at least so far
    assert ahead[35] == pytest.approx(LENGTH_M, abs=0.1)  # the end, up to ten degrees aside
    turned = vista.view_of(Pose(0.0, 0.0, math.pi / 2))
    assert turned[27] == pytest.approx(LENGTH_M, abs=0.1)


def test_it_is_seen_from_near_the_place_only_and_forgotten_on_the_way():
    place = Pose(0.0, 0.0, 0.0)
    assert not vista_after(Pose(NEAR_M + 0.1, 0.0, 0.0)).view_of(place).any()
    vista = vista_after(place)
    assert vista.view_of(place).any()
    vista.take(Pose(5.0, 0.0, 0.0), BEARINGS, hallway(Pose(5.0, 0.0, 0.0)), MEMORY_M + 0.1)
    assert not vista.view_of(place).any()


def test_a_robot_that_stands_keeps_one_scan():
    vista = Vista()
    for end_m in (LENGTH_M, 40.0):
        vista.take(Pose(0.0, 0.0, 0.0), BEARINGS, hallway(Pose(0.0, 0.0, 0.0), end_m), 0.0)
    assert vista.view_of(Pose(0.0, 0.0, 0.0))[0] == pytest.approx(LENGTH_M, abs=0.1)


def test_a_robot_that_turns_and_turns_keeps_so_many_scans():
    vista = Vista()
    for i in range(2 * MOST):
        pose = Pose(0.0, 0.0, 0.1 * i)
        vista.take(pose, BEARINGS, hallway(pose), 0.0)
    assert len(vista._kept) == MOST


@pytest.mark.parametrize("reading", [0.0, -1.0, FARTHEST_M, 81.83, math.inf, math.nan])
def test_readings_that_are_none_say_nothing(reading):
    vista = vista_after(Pose(0.0, 0.0, 0.0), ranges=np.full(len(BEARINGS), reading))
    assert not vista.view_of(Pose(0.0, 0.0, 0.0)).any()


def seen_of(ranges):
    pose = Pose(0.0, 0.0, 0.0)
    return vista_after(pose, ranges=ranges).view_of(pose)


def test_few_beams_are_no_end():
    ranges = np.full(len(BEARINGS), 8.0)
    ranges[88:90] = 25.0
    assert FEWEST > 2
    seen = seen_of(ranges)
    assert seen.shape == (DIRECTIONS,)
    assert seen[:9] == pytest.approx(8.0)
    assert not seen[11:26].any()


def test_the_wall_counts_not_the_doorway_in_it():
    ranges = np.full(len(BEARINGS), 20.0)
    ranges[89:91] = 45.0
    assert seen_of(ranges)[0] == pytest.approx(20.0)


def test_the_wider_of_two_walls_counts():
    ranges = np.full(len(BEARINGS), 9.0)
    ranges[86:94] = 21.0  # 8 beams of 21 m are wider than 12 of 9 m
    assert seen_of(ranges)[0] == pytest.approx(21.0)
    ranges[86:94] = 9.5
    assert seen_of(ranges)[0] == pytest.approx(9.2, abs=0.05)  # one wall, where classes meet


def test_along_a_wall_it_goes_on_at_least_so_far():
    ranges = np.full(len(BEARINGS), 3.0)
    ranges[86:94] = 14.0 + 2.0 * np.arange(8)  # recedes too fast to be faced
    seen = seen_of(ranges)
    third = 24.0
    assert third / RATIO <= -seen[0] <= third
    ranges[86:94] *= 0.4
    assert not seen_of(ranges).any()
    assert NEAREST_M > 3.0
