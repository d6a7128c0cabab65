"""Marks that know nothing lie where they should, and find places as often as closed forms say."""

import itertools
import math

import numpy as np
import pytest

from ssrics_like.comparison.batches import passages_found, places_found
from ssrics_like.comparison.chance import clock_marks, random_marks
from ssrics_like.comparison.way import Way

STRAIGHT = Way.through([(x, 0) for x in range(41)])


def by_walking(path, distances):
    """Walk along the path to each distance, a leg at a time."""
    places = []
    for distance in distances:
        left = distance
        for a, b in itertools.pairwise(path):
            length = math.dist(a, b)
            if length > 5.0:
                continue
            if left <= length and length > 0:
                share = left / length
                places.append([a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])])
                break
            left -= length
    return places


def test_random_marks_lie_where_walking_leads():
    # A turn on the spot, and a stretch of 30 m over which the robot was carried.
    path = [(0, 0), (3, 0), (3, 0), (3, 4), (33, 4), (33, 6), (32, 6)]
    way = Way.through(path)
    assert way.along_m.tolist() == [0, 3, 3, 7, 7, 9, 10]
    along = random_marks(way, 50, np.random.default_rng(1), 10)
    assert along.shape == (10, 50)
    assert (np.diff(along, axis=1) >= 0).all()
    np.testing.assert_allclose(
        way.at(along).reshape(-1, 2), by_walking(path, along.ravel()), atol=1e-9
    )


def test_marks_of_a_robot_that_stood_still_lie_where_it_stood():
    for path in ([(2, 3)], [(2, 3)] * 3):
        way = Way.through(path)
        assert way.length_m == 0
        for placing in (random_marks, clock_marks):
            along = placing(way, 4, np.random.default_rng(0), 2)
            assert way.at(along).tolist() == [[[2, 3]] * 4] * 2


def test_the_ends_of_a_way_are_on_it():
    assert STRAIGHT.at([0.0, 0.25, 40.0]).tolist() == [[0, 0], [0.25, 0], [40, 0]]
    assert Way.through([]).length_m == 0


@pytest.mark.parametrize("aside_m", [0.0, 0.6])
@pytest.mark.parametrize("count", [1, 7])
def test_chance_on_a_straight_path_has_its_closed_form(aside_m, count):
    # Within 1 m of a place that lies aside is a chord of the path; each mark hits it with
    # p = 2 sqrt(1 - aside^2) / length, and n marks find the place with 1 - (1 - p)^n.
    p = 2 * math.sqrt(1 - aside_m**2) / 40
    expected = 1 - (1 - p) ** count
    draws = 20_000
    along = random_marks(STRAIGHT, count, np.random.default_rng(3), draws)
    chance = places_found(STRAIGHT.at(along), np.array([[15.0, aside_m]]), 1.0).mean()
    assert chance == pytest.approx(expected, abs=4 * math.sqrt(expected * (1 - expected) / draws))


def test_chance_of_a_passage_has_its_closed_form():
    # At the very start of the way only half of the window can be met.
    for passage_m, window_m in ((15.0, 2.0), (0.0, 1.0)):
        expected = 1 - (1 - window_m / 40) ** 5
        along = random_marks(STRAIGHT, 5, np.random.default_rng(4), 20_000)
        chance = passages_found(along, np.array([passage_m]), 1.0).mean()
        assert chance == pytest.approx(expected, abs=0.012)


@pytest.mark.parametrize(
    ("marks", "expected"), [(1, 0.02), (10, 0.2), (40, 0.8), (50, 1.0), (80, 1.0)]
)
def test_a_clock_finds_a_place_as_often_as_the_closed_form_says(marks, expected):
    # 100 m at a constant speed, m marks 100 / m apart, a window of 2 m: min(1, 2 m / 100).
    way = Way.through(np.column_stack([np.linspace(0.0, 100.0, 10_001), np.zeros(10_001)]))
    along = clock_marks(way, marks, np.random.default_rng(1), 4000)
    found = places_found(way.at(along), np.array([[50.0, 0.0]]), 1.0)
    assert found.mean() == pytest.approx(expected, abs=0.03)


def test_a_clock_marks_at_equal_intervals():
    way = Way.through(np.column_stack([np.arange(100.0), np.zeros(100)]))
    along = clock_marks(way, 10, np.random.default_rng(3), 3)
    assert np.array_equal(np.diff(along, axis=1), np.full((3, 9), 10.0))
    assert clock_marks(way, 0, np.random.default_rng(3), 3).shape == (3, 0)
