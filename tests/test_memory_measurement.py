"""What perceiving a landmark tells: an extended Kalman filter in full, and closed forms."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ssrics_like.memory import measurement
from ssrics_like.memory.links import HERE, Link
from ssrics_like.memory.measurement import (
    ASKEW,
    ASKEW_RAD,
    ASTRAY,
    ASTRAY_M,
    measured_direction,
    measured_place,
)
from ssrics_like.poses import Pose

STILL = Link(Pose(0.0, 0.0, 0.0), 0.0, 0.0)
SD_M = 0.1


def gaussian(square, variances, peak):
    """Return a density, its peak being 1 where nothing but the perception is uncertain."""
    return peak / math.sqrt(math.prod(variances)) * math.exp(-0.5 * square)


def test_a_landmark_known_for_certain_and_hit_is_as_probable_as_can_be():
    onward = Link(Pose(3.0, 1.0, 0.5), 0.0, 0.0)
    found = measured_place(HERE, onward, STILL, Pose(3.0, 1.0, 0.0), SD_M)
    assert found.nats == pytest.approx(0.0, abs=1e-12)
    assert found.fix.pose.distance_m(onward.pose) == pytest.approx(0.0, abs=1e-12)
    assert (found.fix.variance_m2, found.fix.variance_rad2, found.turned_rad) == (0.0, 0.0, 0.0)
    assert measured_direction(onward, 0.0, 0.1).nats == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("off", [(0.0, 0.0), (0.2, 0.0), (0.0, 0.3), (-0.3, 0.4), (1.0, -1.0)])
def test_a_place_is_as_probable_as_two_gaussians_have_it(off):
    before = Link(Pose(0.0, 0.0, 0.0), 0.01, 0.05**2)
    onward, drift = Link(Pose(4.0, 0.0, 0.0), 0.02, 0.0), Link(Pose(0.0, 0.0, 0.0), 0.03, 0.0)
    x_m, y_m = 4.0 + off[0], off[1]
    found = measured_place(before, onward, drift, Pose(x_m, y_m, 0.0), SD_M)
    seen_m, turn = math.hypot(x_m, y_m), math.atan2(y_m, x_m)
    total = 0.0
    for share, sd_m in ((1.0 - ASTRAY, SD_M), (ASTRAY, ASTRAY_M)):
        along = 0.06 + sd_m**2
        across = along + 0.05**2 * 4.0 * seen_m
        chord2 = 2.0 * 4.0 * seen_m * (1.0 - math.cos(turn))
        square = (seen_m - 4.0) ** 2 / along + chord2 / across
        total += share * gaussian(square, (along, across), sd_m**2)
    assert found.nats == pytest.approx(-math.log(total), rel=1e-9)


@given(
    st.floats(-9.0, 9.0), st.floats(-9.0, 9.0), st.floats(-9.0, 9.0), st.floats(-9.0, 9.0),
    st.floats(-3.0, 3.0), st.floats(0.0, 0.5),
)  # fmt: skip
def test_where_the_heading_is_known_only_how_far_it_is_off_counts(x_m, y_m, u_m, v_m, turn, m2):
    before = Link(Pose(1.0, -2.0, turn), m2, 0.0)
    onward = Link(Pose(x_m, y_m, 0.0), 0.0, 0.0)
    place = before.pose.onward(Pose(u_m, v_m, 0.0))
    off2 = (x_m - u_m) ** 2 + (y_m - v_m) ** 2
    variance_m2 = m2 + SD_M**2, m2 + ASTRAY_M**2
    astray = math.log(ASTRAY * ASTRAY_M**2 / variance_m2[1]) - 0.5 * off2 / variance_m2[1]
    hit = math.log((1.0 - ASTRAY) * SD_M**2 / variance_m2[0]) - 0.5 * off2 / variance_m2[0]
    found = measured_place(before, onward, STILL, place, SD_M)
    assert found.nats == pytest.approx(-np.logaddexp(hit, astray), rel=1e-6, abs=1e-6)
    assert found.turned_rad == 0.0


@pytest.mark.parametrize("heading_rad", [0.0, 2.5])
@pytest.mark.parametrize("off", [(0.05, 0.0), (0.0, 0.08), (-0.04, -0.06)])
def test_a_small_error_is_corrected_as_by_an_extended_kalman_filter(off, heading_rad, monkeypatch):
    monkeypatch.setattr(measurement, "ASTRAY", 0.0)
    before = Link(Pose(2.0, 3.0, heading_rad), 0.01, 0.06**2)
    onward = Link(Pose(5.0, 0.0, 0.3), 0.004, 0.01**2)
    drift = Link(Pose(0.0, 0.0, 0.0), 0.002, 0.02**2)
    place = before.pose.onward(Pose(5.0 + off[0], off[1], 0.0))
    found = measured_place(before, onward, drift, place, SD_M)
    # State: where the landmark lies, and the heading of the frame before; the former hangs on it.
    lever = np.array([-math.sin(heading_rad), math.cos(heading_rad)]) * 5.0
    p = np.zeros((3, 3))
    p[:2, :2] = 0.016 * np.eye(2) + 0.06**2 * np.outer(lever, lever)
    p[2, 2], p[:2, 2], p[2, :2] = 0.06**2, 0.06**2 * lever, 0.06**2 * lever
    expected = before.and_then(onward).pose
    residual = np.array([place.x_m - expected.x_m, place.y_m - expected.y_m])
    gain = p[:, :2] @ np.linalg.inv(p[:2, :2] + SD_M**2 * np.eye(2))
    state = np.array([expected.x_m, expected.y_m, 0.0]) + gain @ residual
    left = p - gain @ p[:2]
    assert (found.fix.pose.x_m, found.fix.pose.y_m) == pytest.approx(state[:2], abs=2e-3)
    assert found.turned_rad == pytest.approx(state[2], abs=2e-4)
    assert found.fix.pose.theta_rad == pytest.approx(heading_rad + 0.3 + state[2], abs=2e-4)
    assert found.fix.variance_rad2 == pytest.approx(left[2, 2] + 0.01**2 + 0.02**2, rel=0.02)
    assert found.fix.variance_m2 == pytest.approx(np.linalg.eigvalsh(left[:2, :2])[-1], rel=0.02)


def test_of_a_frame_turned_by_anything_only_the_distance_is_known():
    before = Link(Pose(0.0, 0.0, 0.0), 0.01, 10.0)
    onward = Link(Pose(5.0, 0.0, 0.0), 0.0, 0.0)
    for turn in (0.0, 1.0, -2.0):
        at = Pose(5.0 * math.cos(turn), 5.0 * math.sin(turn), 0.0)
        found = measured_place(before, onward, STILL, at, SD_M)
        assert found.fix.pose.theta_rad == pytest.approx(turn, abs=2e-3)
        assert found.fix.pose.distance_m(at) < 0.02
        assert found.fix.variance_rad2 < 0.06**2


def test_what_is_perceived_astray_corrects_less():
    before, onward = Link(Pose(0.0, 0.0, 0.0), 0.03, 0.05**2), Link(Pose(4.0, 0.0, 0.0), 0.0, 0.0)
    near, far = (
        measured_place(before, onward, STILL, Pose(4.0 + off_m, 0.0, 0.0), SD_M)
        for off_m in (0.1, 1.0)
    )
    assert near.fix.pose.x_m - 4.0 > 0.4 * 0.1
    assert far.fix.pose.x_m - 4.0 < 0.25 * 1.0
    assert far.fix.variance_m2 > near.fix.variance_m2


@pytest.mark.parametrize("turn_rad", [0.0, 0.1, -0.3, 1.5])
def test_a_direction_is_as_probable_as_two_gaussians_have_it(turn_rad):
    fix = Link(Pose(1.0, 2.0, 3.0), 0.5, 0.05**2)
    found = measured_direction(fix, turn_rad, 0.1)
    parts = [
        share * gaussian(turn_rad**2 / (0.05**2 + sd**2), (0.05**2 + sd**2,), sd)
        for share, sd in ((1.0 - ASKEW, 0.1), (ASKEW, ASKEW_RAD))
    ]
    assert found.nats == pytest.approx(-math.log(sum(parts)), rel=1e-9)
    gains = [0.05**2 / (0.05**2 + sd**2) for sd in (0.1, ASKEW_RAD)]
    gain = sum(part * each for part, each in zip(parts, gains, strict=True)) / sum(parts)
    assert found.turned_rad == pytest.approx(gain * turn_rad, rel=1e-9, abs=1e-12)
    wrapped = math.remainder(3.0 + gain * turn_rad, math.tau)
    assert found.fix == pytest.approx(Link(Pose(1.0, 2.0, wrapped), 0.5, (1.0 - gain) * 0.05**2))
