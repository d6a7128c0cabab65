"""What perceiving a landmark tells: an extended Kalman filter in full, closed forms, mixtures."""

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
    BOTH,
    HIT,
    measured,
)
from ssrics_like.poses import Pose

STILL = Link(Pose(0.0, 0.0, 0.0), 0.0, 0.0)
SD_M, SD_RAD = 0.1, 0.15
KINDS = {
    "HIT": (SD_M, SD_RAD), "ASTRAY": (ASTRAY_M, SD_RAD),
    "ASKEW": (SD_M, ASKEW_RAD), "BOTH": (ASTRAY_M, ASKEW_RAD),
}  # fmt: skip


def only(kind, monkeypatch):
    """Let nothing else happen."""
    for name in KINDS:
        monkeypatch.setattr(measurement, name, float(name == kind))


def test_how_often_each_kind_happens_adds_up():
    assert sum((HIT, ASTRAY, ASKEW, BOTH)) == pytest.approx(1.0)


def test_a_landmark_known_for_certain_and_hit_is_as_probable_as_can_be():
    onward = Link(Pose(3.0, 1.0, 0.5), 0.0, 0.0)
    found = measured(HERE, onward, STILL, onward.pose, SD_M, SD_RAD)
    assert found.nats == pytest.approx(0.0, abs=1e-12)
    assert found.fix.pose.distance_m(onward.pose) == pytest.approx(0.0, abs=1e-12)
    assert (found.fix.variance_m2, found.fix.variance_rad2, found.turned_rad) == (0.0, 0.0, 0.0)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("heading_rad", [0.0, 2.5])
@pytest.mark.parametrize(
    "off", [(0.05, 0.0, 0.0), (0.0, 0.08, 0.0), (0.0, 0.0, 0.07), (-0.04, -0.06, 0.05)]
)
def test_a_small_error_is_corrected_as_by_an_extended_kalman_filter(
    off, heading_rad, kind, monkeypatch
):
    only(kind, monkeypatch)
    sd_m, sd_rad = KINDS[kind]
    before = Link(Pose(2.0, 3.0, heading_rad), 0.01, 0.06**2)
    onward = Link(Pose(5.0, 0.0, 0.3), 0.004, 0.01**2)
    drift = Link(Pose(0.0, 0.0, 0.0), 0.002, 0.02**2)
    place = before.pose.onward(Pose(5.0 + off[0], off[1], 0.3 + off[2]))
    found = measured(before, onward, drift, place, SD_M, SD_RAD)
    # State: the landmark's frame, and how that before is turned; the former hangs on the latter.
    hangs = np.array([-5.0 * math.sin(heading_rad), 5.0 * math.cos(heading_rad), 1.0, 1.0])
    p = 0.06**2 * np.outer(hangs, hangs) + np.diag([0.016, 0.016, 0.01**2 + 0.02**2, 0.0])
    expected = before.pose.onward(onward.pose)
    z = np.array([place.x_m - expected.x_m, place.y_m - expected.y_m, off[2]])
    r = np.diag([sd_m**2, sd_m**2, sd_rad**2])
    s = p[:3, :3] + r
    gain = p[:, :3] @ np.linalg.inv(s)
    x_m, y_m, turn_rad, turned_rad = gain @ z
    left = p - gain @ p[:3]
    nats = 0.5 * (z @ np.linalg.inv(s) @ z + math.log(np.linalg.det(s) / np.linalg.det(r)))
    assert found.nats == pytest.approx(nats, abs=0.02)
    pose = found.fix.pose
    assert (pose.x_m, pose.y_m) == pytest.approx((expected.x_m + x_m, expected.y_m + y_m), abs=2e-3)
    assert pose.theta_rad == pytest.approx(expected.theta_rad + turn_rad, abs=3e-4)
    assert found.turned_rad == pytest.approx(turned_rad, abs=3e-4)
    assert found.fix.variance_rad2 == pytest.approx(left[2, 2], rel=0.02)
    assert found.fix.variance_m2 == pytest.approx(np.linalg.eigvalsh(left[:2, :2])[-1], rel=0.02)


@given(
    st.floats(-1.0, 1.0), st.floats(-1.0, 1.0), st.floats(-3.0, 3.0), st.booleans(),
    st.floats(1e-3, 0.1), st.floats(1e-4, 0.1),
)  # fmt: skip
def test_what_may_have_happened_is_averaged_by_how_probable_it_is(
    far_m, aside_m, askew_rad, directed, off_m2, frame_rad2
):
    before = Link(Pose(1.0, -2.0, 0.5), off_m2, frame_rad2)
    onward, drift = Link(Pose(4.0, 0.0, 0.2), 0.02, 0.01), Link(STILL.pose, 0.01, 0.002)
    place = before.pose.onward(Pose(4.0 + far_m, aside_m, 0.2 + askew_rad))
    sd_rad = SD_RAD if directed else math.inf
    found = measured(before, onward, drift, place, SD_M, sd_rad)
    odds, rows = [], []
    for kind in KINDS:
        with pytest.MonkeyPatch.context() as patch:
            only(kind, patch)
            one = measured(before, onward, drift, place, SD_M, sd_rad)
        odds.append(getattr(measurement, kind) * math.exp(-one.nats))
        at = one.fix.pose
        turn_rad = math.remainder(at.theta_rad - 0.7, math.tau)
        rows.append((at.x_m, at.y_m, turn_rad, *one.fix[1:], one.turned_rad))
    shares, rows = np.array(odds) / sum(odds), np.array(rows)
    mean = shares @ rows
    spread = shares @ (rows - mean) ** 2
    assert found.nats == pytest.approx(-math.log(sum(odds)), rel=1e-9, abs=1e-9)
    told = found.fix.pose
    assert (told.x_m, told.y_m, math.remainder(told.theta_rad - 0.7, math.tau)) == pytest.approx(
        mean[:3], abs=1e-9
    )
    assert found.fix.variance_m2 == pytest.approx(mean[3] + spread[0] + spread[1], abs=1e-9)
    assert found.fix.variance_rad2 == pytest.approx(mean[4] + spread[2], abs=1e-9)
    assert found.turned_rad == pytest.approx(mean[5], abs=1e-9)


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
    often = ASTRAY + BOTH
    astray = math.log(often * ASTRAY_M**2 / variance_m2[1]) - 0.5 * off2 / variance_m2[1]
    hit = math.log((1.0 - often) * SD_M**2 / variance_m2[0]) - 0.5 * off2 / variance_m2[0]
    found = measured(before, onward, STILL, place, SD_M)
    assert found.nats == pytest.approx(-np.logaddexp(hit, astray), rel=1e-6, abs=1e-6)
    assert found.turned_rad == 0.0


@pytest.mark.parametrize("bearing_rad", [0.0, 1.0, 2.0, 3.0, -2.5, -1.5, -0.5])
@pytest.mark.parametrize("seen_m", [0.0, 0.1, 0.3, 0.5])
@pytest.mark.parametrize("way_m", [0.0, 0.2, 0.5])
def test_after_a_short_way_it_lies_between_where_it_was_expected_and_where_it_is_perceived(
    way_m, seen_m, bearing_rad
):
    """A landmark that is met again at once lies where it is itself: no bearing is expected."""
    before, onward = Link(Pose(2.0, 1.0, 0.4), 0.02, 0.05**2), Link(Pose(way_m, 0.0, 0.0), 0.0, 0.0)
    at = Pose(seen_m * math.cos(bearing_rad), seen_m * math.sin(bearing_rad), 0.0)
    found = measured(before, onward, STILL, before.pose.onward(at), SD_M).fix.pose
    found = found.seen_from(before.pose)
    way = np.array([at.x_m - way_m, at.y_m])
    off = np.array([found.x_m - way_m, found.y_m])
    assert abs(way[0] * off[1] - way[1] * off[0]) <= 0.02 * np.hypot(*way)
    assert -0.02 * np.hypot(*way) <= way @ off <= way @ way


def test_of_a_frame_turned_by_anything_only_the_distance_is_known():
    before = Link(Pose(0.0, 0.0, 0.0), 0.01, 10.0)
    onward = Link(Pose(5.0, 0.0, 0.0), 0.0, 0.0)
    for turn in (0.0, 1.0, -2.0):
        at = Pose(5.0 * math.cos(turn), 5.0 * math.sin(turn), 0.0)
        found = measured(before, onward, STILL, at, SD_M)
        assert found.fix.pose.theta_rad == pytest.approx(turn, abs=2e-3)
        assert found.fix.pose.distance_m(at) < 0.02
        assert found.fix.variance_rad2 < 0.07**2


@given(st.floats(-math.pi, math.pi), st.floats(-0.1, 0.1))
def test_a_frame_turned_by_anything_may_be_turned_by_anything_else(turn_rad, askew_rad):
    """Place and direction agree on how it is turned, on whichever side of half a turn."""
    before = Link(Pose(0.0, 0.0, 0.0), 0.01, 10.0)
    onward = Link(Pose(5.0, 0.0, 0.0), 0.001, 0.0001)
    at = Pose(5.0 * math.cos(turn_rad), 5.0 * math.sin(turn_rad), turn_rad + askew_rad)
    found = measured(before, onward, STILL, at, SD_M, SD_RAD)
    straight = measured(before, onward, STILL, Pose(5.0, 0.0, askew_rad), SD_M, SD_RAD).nats
    assert found.nats == pytest.approx(straight + 0.5 * turn_rad**2 / 10.0, abs=0.1)
    assert math.remainder(found.fix.pose.theta_rad - turn_rad, math.tau) == pytest.approx(
        0.0, abs=0.06
    )


def test_what_is_perceived_astray_corrects_less():
    before, onward = Link(Pose(0.0, 0.0, 0.0), 0.03, 0.05**2), Link(Pose(4.0, 0.0, 0.0), 0.0, 0.0)
    near, far = (
        measured(before, onward, STILL, Pose(4.0 + off_m, 0.0, 0.0), SD_M) for off_m in (0.1, 1.0)
    )
    assert near.fix.pose.x_m - 4.0 > 0.4 * 0.1
    assert far.fix.pose.x_m - 4.0 < 0.25 * 1.0
    assert far.fix.variance_m2 > near.fix.variance_m2


def test_a_doorway_that_is_entered_at_a_slant_is_astray_and_askew_at_the_cost_of_one():
    before, onward = Link(Pose(0.0, 0.0, 0.0), 0.001, 0.03**2), Link(Pose(4.0, 0.0, 0.0), 0.0, 0.0)
    hit, astray, askew, both = (
        measured(before, onward, STILL, Pose(4.0 + far_m, 0.0, turn_rad), SD_M, SD_RAD).nats
        for far_m, turn_rad in ((0.0, 0.0), (0.6, 0.0), (0.0, 0.9), (0.6, 0.9))
    )
    assert both - hit < (astray - hit) + (askew - hit) - 0.5
