"""Landmarks that the robot goes through and does not perceive."""

import itertools
import math

import numpy as np
import pytest

from ssrics_like.memory import Here, Uncertainty, Whereabouts
from ssrics_like.memory.links import Links
from ssrics_like.memory.passing import PAST_M, Passing
from ssrics_like.poses import Pose

CERTAIN = Uncertainty(0.15, 0.2, 0.0, 0.0, 0.0)
DOORS = 4
APART_M = 4.0


@pytest.fixture
def corridor():
    """Four doors in a row have been marked; the robot is in the last one, L4."""
    whereabouts = Whereabouts(CERTAIN, Links())
    for i in range(DOORS):
        whereabouts.find(f"L{i + 1}", Here(Pose(APART_M * i, 0.0, 0.0), True, APART_M * i, 0.0))
    return whereabouts, Passing(whereabouts._links)


def drive(passing, whereabouts, path_m, y_m=0.0, marked=(), started_m=12.0):
    """Go along the corridor, marking at some places a metre after them; what was missed."""
    missed, travelled_m, waiting = [], started_m, list(marked)
    for before, x_m in itertools.pairwise(path_m):
        travelled_m += abs(x_m - before)
        for place in [place for place in waiting if abs(x_m - place) > 1.0 and x_m < place]:
            waiting.remove(place)
            passing.marked(Pose(place + 0.2, y_m, 0.0))
        missed += passing.go(Pose(x_m, y_m, math.pi), travelled_m, whereabouts.known)
    return missed


def test_who_goes_through_without_marking_misses_it_once(corridor):
    whereabouts, passing = corridor
    back = np.arange(12.0, -4.0, -0.1).tolist()
    assert drive(passing, whereabouts, back, marked=[12.0, 4.0]) == ["L3", "L1"]


def test_who_goes_by_misses_nothing(corridor):
    whereabouts, passing = corridor
    back = np.arange(12.0, -4.0, -0.1).tolist()
    assert drive(passing, whereabouts, back, y_m=0.6) == []


def test_who_turns_back_misses_nothing(corridor):
    whereabouts, passing = corridor
    there = np.arange(10.0, 8.05, -0.1).tolist()
    assert drive(passing, whereabouts, [*there, *reversed(there)] * 3) == []


def test_a_mark_may_come_some_way_after_the_place(corridor):
    whereabouts, passing = corridor
    past = np.arange(10.0, 8.0 - PAST_M + 0.2, -0.1).tolist()
    assert drive(passing, whereabouts, past) == []
    passing.marked(Pose(8.3, 0.2, 0.0))
    assert drive(passing, whereabouts, [past[-1], past[-1] - 1.0], started_m=20.0) == []


def test_a_mark_may_come_before_the_middle(corridor):
    whereabouts, passing = corridor
    drive(passing, whereabouts, np.arange(10.0, 8.1, -0.1).tolist())
    passing.marked(Pose(8.1, 0.0, 0.0))
    on = np.arange(8.1, 4.5, -0.1).tolist()
    assert drive(passing, whereabouts, on, started_m=13.9) == []


def test_a_place_where_the_landmark_is_no_longer_believed_to_be_is_not_missed(corridor):
    whereabouts, passing = corridor
    drive(passing, whereabouts, np.arange(10.0, 7.0, -0.1).tolist())
    aside = Here(Pose(7.0, 1.5, 0.0), True, 18.0, 0.0)
    whereabouts.find("L9", aside)  # something is learned, and all is reckoned anew
    whereabouts.expect(Here(Pose(6.0, 1.0, 0.0), True, 19.0, 0.0), ["L1", "L2", "L3", "L4", "L9"])
    whereabouts.recognise("L2", Here(Pose(6.0, 1.0, 0.0), True, 19.0, 0.0), {}, 0.0)
    assert passing.go(Pose(5.0, 1.0, 0.0), 25.0, whereabouts.known) == []


def test_a_robot_that_is_lost_misses_nothing(corridor):
    whereabouts, passing = corridor
    passing.go(Pose(8.0, 0.0, 0.0), 16.0, whereabouts.known)
    whereabouts.lose()
    assert passing.go(Pose(7.0, 0.0, 0.0), 30.0, whereabouts.known) == []


def test_what_is_badly_known_is_not_missed():
    whereabouts = Whereabouts(Uncertainty(0.15, 0.2, 0.2, 0.0, 0.0), Links())
    for i in range(DOORS):
        whereabouts.find(f"L{i + 1}", Here(Pose(APART_M * i, 0.0, 0.0), True, APART_M * i, 0.0))
    passing = Passing(whereabouts._links)
    back = np.arange(11.0, -4.0, -0.1).tolist()
    assert drive(passing, whereabouts, back) == []
