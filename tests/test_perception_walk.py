"""Places along the way: evenly spaced, whatever the speed and the scan rate."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ssrics_like.perception.observation import Pose
from ssrics_like.perception.walk import CHORD_M, KEPT_M, Walk


def walked(poses, step_m=0.1, lag_m=0.4):
    walk = Walk(step_m, lag_m)
    found = []
    for i, pose in enumerate(poses):
        walk.advance(pose, i)
        found.append([])
        found[-1] += walk.places()
    return walk, found


def straight(spacing_m, length_m=3.0, heading=0.3):
    along = np.arange(0.0, length_m + 1e-9, spacing_m)
    return [Pose(s * math.cos(heading), s * math.sin(heading), heading) for s in along.tolist()]


@pytest.mark.parametrize("spacing_m", [0.01, 0.03, 0.09, 0.16, 0.5])
def test_places_lie_where_they_lie_whatever_the_spacing_of_scans(spacing_m):
    _, found = walked(straight(spacing_m))
    places = [place for each in found for place in each]
    at = [place.at_m for place in places]
    assert at == pytest.approx(np.arange(0.2, 2.601, 0.1)[: len(at)])
    assert len(at) >= (3.0 - spacing_m - 0.4 - 0.2) / 0.1
    for place in places:
        assert (place.x_m, place.y_m) == pytest.approx(
            (place.at_m * math.cos(0.3), place.at_m * math.sin(0.3))
        )
        assert place.heading_rad == pytest.approx(0.3)
        assert abs(place.nearest * spacing_m - place.at_m) <= max(spacing_m, KEPT_M) / 2 + KEPT_M


def test_a_place_is_handed_out_as_soon_as_the_robot_is_far_enough_past_it():
    _, found = walked(straight(0.05))
    for i, places in enumerate(found):
        for place in places:
            assert 0.4 - 1e-9 <= i * 0.05 - place.at_m < 0.4 + 0.05 + 1e-9


def test_direction_is_that_of_travel_not_of_the_robots_nose():
    poses = [Pose(-0.05 * i, 0.0, 0.0) for i in range(40)]  # backwards
    _, found = walked(poses)
    for places in found:
        for place in places:
            assert abs(place.heading_rad) == pytest.approx(math.pi)


def test_standing_takes_no_memory_and_gives_no_places():
    walk, _ = walked(straight(0.05))
    kept = len(walk._kept)
    end = straight(0.05)[-1]
    for turn in range(1000):
        walk.advance(Pose(end.x_m, end.y_m, 0.01 * turn), 0)
        assert not list(walk.places())
    assert len(walk._kept) == kept
    assert kept <= (0.4 + 2 * CHORD_M) / KEPT_M + 2


@settings(max_examples=50, deadline=None)
@given(st.lists(st.tuples(st.floats(0.0, 0.4), st.floats(-1.0, 1.0)), min_size=2, max_size=60))
def test_places_lie_on_the_path_in_order(steps):
    x = y = heading = 0.0
    poses = [Pose(0.0, 0.0, 0.0)]
    for length, turn in steps:
        heading += turn
        x, y = x + length * math.cos(heading), y + length * math.sin(heading)
        poses.append(Pose(x, y, heading))
    walk, found = walked(poses)
    places = [place for each in found for place in each]
    xy = np.array([[p.x_m, p.y_m] for p in poses])
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(xy, axis=0).T))])
    assert walk.travelled_m == pytest.approx(along[-1])
    assert [p.at_m for p in places] == sorted({p.at_m for p in places})
    for place in places:
        # What lies between observations that are kept is cut short by less than 2 cm.
        assert place.x_m == pytest.approx(np.interp(place.at_m, along, xy[:, 0]), abs=2 * KEPT_M)
        assert place.y_m == pytest.approx(np.interp(place.at_m, along, xy[:, 1]), abs=2 * KEPT_M)


@pytest.mark.parametrize("elsewhere", [(1e4, 0.0), (-6.0, 3.0), (math.nan, 0.0)])
def test_a_robot_that_is_carried_begins_anew(elsewhere):
    walk = Walk(0.1, 0.4)
    for pose in straight(0.05):
        assert walk.advance(pose, None)
        list(walk.places())
    before_m = walk.travelled_m
    x, y = elsewhere
    assert not walk.advance(Pose(x, y, 0.0), None)
    assert list(walk.places()) == []
    assert walk.travelled_m == before_m
    if math.isnan(x):
        assert not walk.advance(Pose(50.0, 0.0, 0.0), None)
        x, y = 50.0, 0.0
    found = []
    for i in range(1, 41):
        walk.advance(Pose(x + 0.05 * i, y, 0.0), None)
        found += walk.places()
    assert len(found) == pytest.approx((2.0 - 0.4 - 0.2) / 0.1, abs=2)
    assert all(place.at_m >= before_m + 0.2 - 1e-9 for place in found)
