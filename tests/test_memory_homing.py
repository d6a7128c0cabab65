"""Homing by view: a remembered place is found where it looks as remembered."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from snapshots import seen_in_room

from ssrics_like.memory.homing import FEWEST, REACH_M, STEP_M, where_alike
from ssrics_like.memory.surroundings import agreement
from ssrics_like.poses import Pose

TRUE = Pose(0.0, 0.0, 0.4)
REMEMBERED = seen_in_room(TRUE)


@settings(deadline=None)  # the first one compiles
@given(st.floats(-1.2, 1.2), st.floats(-1.0, 1.0))
def test_a_place_is_found_from_wherever_it_is_believed_to_be(x_m, y_m):
    believed = TRUE.onward(Pose(x_m, y_m, 0.0))
    found = where_alike(REMEMBERED, seen_in_room, believed)
    if found is None:  # it looks right enough where it is believed to be
        assert agreement(seen_in_room(believed), REMEMBERED[np.newaxis])[0] > 0.85
        return
    assert found.distance_m(TRUE) <= 2.1 * STEP_M  # it may be looked at from 0.3 m before
    assert found.theta_rad == pytest.approx(TRUE.theta_rad)


def test_it_is_not_looked_for_farther_than_it_may_be():
    asked = []

    def look(place):
        asked.append(place)
        return seen_in_room(place)

    where_alike(REMEMBERED, look, TRUE)
    assert max(place.distance_m(TRUE) for place in asked) == pytest.approx(
        math.hypot(REACH_M, REACH_M)
    )


def test_what_looks_otherwise_or_is_hardly_known_is_not_found():
    wide = np.concatenate([np.full(36, 6.0), np.zeros(72)]).astype(np.float32)
    assert where_alike(wide, seen_in_room, TRUE) is None
    dark = np.concatenate([np.full(72, 6.0), np.zeros(36)]).astype(np.float32)
    assert where_alike(dark, seen_in_room, TRUE) is None
    beside = TRUE.onward(Pose(1.2, -0.6, 0.0))
    for known in (FEWEST - 1, FEWEST):
        found = where_alike(REMEMBERED, lambda place, n=known: seen_in_room(place, known=n), beside)
        assert (found is not None) == (known >= FEWEST)
