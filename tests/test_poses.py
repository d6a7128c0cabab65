"""Poses: one seen from another."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ssrics_like.poses import Pose

METRES = st.floats(-1e3, 1e3)
POSES = st.builds(Pose, METRES, METRES, st.floats(-math.pi, math.pi))


def test_a_step_ahead_goes_where_one_looks():
    pose = Pose(1.0, 2.0, math.pi / 2).onward(Pose(3.0, 0.5, math.pi / 2))
    assert (pose.x_m, pose.y_m, abs(pose.theta_rad)) == pytest.approx((0.5, 5.0, math.pi))


@given(POSES, POSES)
def test_seen_from_undoes_onward(one, other):
    again = one.onward(other.seen_from(one))
    assert again.distance_m(other) < 1e-9 * 1e3
    assert abs(math.remainder(again.theta_rad - other.theta_rad, math.tau)) < 1e-12


@given(POSES, POSES, POSES)
def test_steps_join_in_any_order(one, two, three):
    left, right = one.onward(two).onward(three), one.onward(two.onward(three))
    assert left.distance_m(right) < 1e-9 * 1e3
