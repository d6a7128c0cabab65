"""The two frames of a floor plan, and which cell a place is in."""

import math

import numpy as np
import pytest
from buildings import drawn
from hypothesis import given
from hypothesis import strategies as st

from ssrics_like.perception.observation import Pose
from ssrics_like.world.grid import AT_ORIGIN, GridMap

numbers = st.floats(-50.0, 50.0)
poses = st.builds(Pose, numbers, numbers, st.floats(-math.pi, math.pi))


def grid_at(origin):
    return GridMap(np.zeros((4, 6), np.uint8), 0.5, origin)


@given(poses, poses)
def test_to_the_map_and_back_again_is_the_same_pose(origin, pose):
    grid = grid_at(origin)
    for there, back in (
        (grid.pose_in_map, grid.pose_in_grid), (grid.pose_in_grid, grid.pose_in_map),
    ):  # fmt: skip
        again = back(there(pose))
        assert (again.x_m, again.y_m) == pytest.approx((pose.x_m, pose.y_m), abs=1e-9)
        assert math.remainder(again.theta_rad - pose.theta_rad, math.tau) == pytest.approx(0.0)
        assert abs(there(pose).theta_rad) <= math.pi


@given(poses, st.lists(st.tuples(numbers, numbers), min_size=1, max_size=5))
def test_places_change_frame_as_poses_do(origin, places):
    grid = grid_at(origin)
    in_map, in_grid = grid.points_in_map(places), grid.points_in_grid(places)
    assert in_map.shape == in_grid.shape == (len(places), 2)
    for (x, y), a, b in zip(places, in_map, in_grid, strict=True):
        pose = Pose(x, y, 0.0)
        assert a == pytest.approx((grid.pose_in_map(pose).x_m, grid.pose_in_map(pose).y_m))
        assert b == pytest.approx((grid.pose_in_grid(pose).x_m, grid.pose_in_grid(pose).y_m))


def test_the_grids_corner_lies_at_the_origin_and_it_turns_counter_clockwise():
    grid = grid_at(Pose(10.0, -5.0, math.pi / 2))
    at_corner = grid.pose_in_map(AT_ORIGIN)
    assert (at_corner.x_m, at_corner.y_m, at_corner.theta_rad) == (10.0, -5.0, math.pi / 2)
    # A metre along the columns is a metre up in the map; a metre along the rows is one to the left.
    ahead = grid.pose_in_map(Pose(1.0, 0.0, 0.0))
    assert (ahead.x_m, ahead.y_m) == pytest.approx((10.0, -4.0))
    aside = grid.pose_in_map(Pose(0.0, 1.0, 3.0))
    assert (aside.x_m, aside.y_m) == pytest.approx((9.0, -5.0))
    assert aside.theta_rad == pytest.approx(3.0 + math.pi / 2 - math.tau)


def test_without_an_origin_both_frames_are_one():
    grid = GridMap(np.zeros((4, 6), np.uint8), 0.5)
    assert grid.pose_in_map(Pose(1.25, 0.5, 0.3)) == Pose(1.25, 0.5, 0.3)
    assert grid.size_m == (3.0, 2.0)


def test_a_cell_holds_its_lower_and_left_edge():
    grid = drawn(
        """
        #.
        .?
        """,
        cell_m=0.5,
    )
    assert grid.cell_of(0.0, 0.0) == (0, 0)
    assert grid.cell_of(0.49, 0.5) == (1, 0)
    assert grid.cell_of(0.5, 0.49) == (0, 1)
    assert grid.cell_of(-0.01, 1.0) == (2, -1)
    assert grid.is_free(0.1, 0.1)
    assert not grid.is_free(0.1, 0.6)  # a wall
    assert not grid.is_free(0.6, 0.1)  # where nobody looked
    assert grid.is_free(0.9, 0.9)
    for outside in [(-0.01, 0.1), (0.1, -0.01), (1.0, 0.9), (0.9, 1.0)]:
        assert not grid.is_free(*outside)
    assert grid.solid.tolist() == [[False, True], [True, False]]
