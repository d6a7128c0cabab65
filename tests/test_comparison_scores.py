"""Scores of runs: published values, closed forms, naive twins, and nothing at all."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ssrics_like.comparison.agreement import consistency
from ssrics_like.comparison.chance import clock_marks, mean_by_chance, random_marks
from ssrics_like.comparison.matching import match
from ssrics_like.comparison.proportions import chance_corrected, harmonic_mean, wilson
from ssrics_like.comparison.scores import Drive, score_runs
from ssrics_like.world.locations import Location


def wilson_by_formula(found, tried, z=1.959963984540054):
    """Wilson (1927): (p + z^2/2n -+ z sqrt(p(1-p)/n + z^2/4n^2)) / (1 + z^2/n)."""
    p = found / tried
    middle = p + z**2 / (2 * tried)
    half = z * math.sqrt(p * (1 - p) / tried + z**2 / (4 * tried**2))
    return (middle - half) / (1 + z**2 / tried), (middle + half) / (1 + z**2 / tried)


@settings(max_examples=50, deadline=None)
@given(st.integers(1, 200).flatmap(lambda n: st.tuples(st.integers(0, n), st.just(n))))
def test_the_interval_is_wilsons(counts):
    assert wilson(*counts) == pytest.approx(wilson_by_formula(*counts), abs=1e-9)


def test_the_reports_own_shares_have_the_published_intervals():
    # Report, table 1: 57, 78, 57, 71, 57 and 71 % of 14 runs are 8, 11, 8, 10, 8 and 10 runs.
    assert sum([8, 11, 8, 10, 8, 10]) == 55
    assert [round(value, 2) for value in wilson(55, 84)] == [0.55, 0.75]
    # Brown, Cai & DasGupta (2001), "Interval estimation for a binomial proportion": at p = 0 the
    # lower limit is 0 and the upper z^2 / (n + z^2).
    assert wilson(0, 14) == pytest.approx((0.0, 1.959964**2 / (14 + 1.959964**2)), abs=1e-6)
    assert all(math.isnan(value) for value in wilson(0, 0))


def test_chance_correction_and_the_harmonic_mean():
    assert chance_corrected(0.65, 0.44) == pytest.approx(0.375)
    assert chance_corrected(0.3, 0.3) == 0.0
    assert chance_corrected(1.0, 0.3) == 1.0
    assert math.isnan(chance_corrected(1.0, 1.0))
    assert harmonic_mean(0.5, 1.0) == pytest.approx(2 / 3)
    assert harmonic_mean(0.0, 0.0) == 0.0
    assert math.isnan(harmonic_mean(math.nan, 1.0))


@settings(max_examples=60, deadline=None)
@given(st.integers(2, 6), st.integers(1, 5), st.integers(0, 2**32 - 1))
def test_consistency_agrees_with_a_loop_over_pairs(runs, places, seed):
    found = np.random.default_rng(seed).random((runs, places)) < 0.5
    pairs = [np.mean(a == b) for a, b in itertools.combinations(found, 2)]
    assert consistency(found) == pytest.approx(np.mean(pairs))


def test_consistency_is_one_for_equal_runs_and_nothing_for_a_single_one():
    assert consistency([[True, False]] * 3) == 1.0
    assert consistency([[True, True], [False, False]]) == 0.0
    assert math.isnan(consistency([[True]]))
    assert math.isnan(consistency(np.zeros((3, 0))))


def random_marks_by_walking(path, distances):
    """Walk along the path to each distance, a leg at a time."""
    places = []
    for distance in distances:
        left = distance
        for a, b in itertools.pairwise(path):
            length = math.dist(a, b)
            if length > 5.0:
                continue
            if left < length:
                share = left / length
                places.append([u + share * (v - u) for u, v in zip(a, b, strict=True)])
                break
            left -= length
    return places


def test_random_marks_lie_where_walking_leads():
    # A turn on the spot, and a stretch of 30 m over which the robot was carried.
    path = [(0, 0), (3, 0), (3, 0), (3, 4), (33, 4), (33, 6), (32, 6)]
    marks = random_marks(path, 500, np.random.default_rng(1))
    distances = np.random.default_rng(1).uniform(0.0, 10.0, 500)
    np.testing.assert_allclose(marks, random_marks_by_walking(path, distances), atol=1e-9)


def test_marks_of_a_robot_that_stood_still_lie_where_it_stood():
    assert random_marks([(2, 3)], 4, np.random.default_rng(0)).tolist() == [[2, 3]] * 4
    assert random_marks([(2, 3)] * 3, 4, np.random.default_rng(0)).tolist() == [[2, 3]] * 4


@pytest.mark.parametrize("aside_m", [0.0, 0.6])
@pytest.mark.parametrize("count", [1, 7])
def test_chance_on_a_straight_path_has_its_closed_form(aside_m, count):
    # Within 1 m of a place that lies aside is a chord of the path; each mark hits it with
    # p = 2 sqrt(1 - aside^2) / length, and n marks find the place with 1 - (1 - p)^n.
    p = 2 * math.sqrt(1 - aside_m**2) / 40
    expected = 1 - (1 - p) ** count
    draws = 20_000
    chance = mean_by_chance(
        [(x, 0) for x in range(41)],
        count,
        lambda marks: match(marks, [(15, aside_m)], 1.0) >= 0,
        np.random.default_rng(3),
        draws,
    )
    tolerance = 4 * math.sqrt(expected * (1 - expected) / draws)
    assert chance == pytest.approx([expected], abs=tolerance)


def test_chance_without_a_path_is_not_known():
    chance = mean_by_chance([], 3, lambda _: np.zeros(2), np.random.default_rng(0))
    assert np.isnan(chance).tolist() == [True, True]


STRAIGHT = np.column_stack([np.linspace(0, 50, 501), np.zeros(501)])
PLACES = (
    Location("1", 10.0, 0.0),
    Location("2", 20.0, 0.0),
    Location("3", 40.0, 0.0),
    Location("J", 20.5, 0.0, kind="junction"),
    Location("O", 30.0, 0.0, kind="opening"),
)


def drive(*xs, path=STRAIGHT, length_m=50.0):
    return Drive(np.array([(x, 0.0) for x in xs]).reshape(-1, 2), path, length_m)


def test_two_runs_counted_by_hand():
    # Run 0: doorway 1 three times (two repetitions), doorway 2 once, near the junction too;
    # a false mark at 46 m. Run 1: the opening, doorway 1.
    runs = [drive(9.8, 10.0, 10.4, 20.2, 46.0), drive(30.1, 9.5)]
    scores = score_runs(runs, PLACES, 1.0, np.random.default_rng(0))
    assert scores.found.tolist() == [
        [True, True, False, True, False],
        [True, False, False, False, True],
    ]
    first, second = scores.runs
    assert (first.marks, first.merged, first.right) == (5, 3, 2)
    assert (first.designated, first.found, first.repeats) == (3, 2, 2)
    assert first.recall == pytest.approx(2 / 3)
    assert first.precision == pytest.approx(2 / 3)
    assert first.duplicates == 1.0
    assert first.marks_per_100_m == 10.0
    assert (second.recall, second.precision, second.duplicates) == (pytest.approx(1 / 3), 1.0, 0.0)
    both = scores.pooled
    assert both.recall == pytest.approx(3 / 6)
    assert both.precision == pytest.approx(4 / 5)
    assert both.marks_per_100_m == pytest.approx(7.0)
    assert both.duplicates == pytest.approx(2 / 3)
    assert both.f == pytest.approx(2 * 0.5 * 0.8 / 1.3)
    assert both.interval == wilson(3, 6)
    # They agree about doorways 1 and 3.
    assert scores.consistency == pytest.approx(2 / 3)
    assert [place.share for place in scores.places] == [1.0, 0.5, 0.0, 0.5, 0.5]
    assert [place.designated for place in scores.places] == [True, True, True, False, False]


def test_chance_of_runs_follows_the_closed_form():
    runs = [drive(*np.linspace(1, 49, 6))] * 20
    scores = score_runs(runs, PLACES[:3], 1.0, np.random.default_rng(5))
    expected = 1 - (1 - 2 / 50) ** 6
    assert [place.chance for place in scores.places] == pytest.approx([expected] * 3, abs=0.03)
    assert scores.pooled.chance == pytest.approx(expected, abs=0.02)
    pool = scores.pooled
    assert pool.corrected_recall == pytest.approx((pool.recall - pool.chance) / (1 - pool.chance))


def test_equal_generators_give_equal_scores():
    runs = [drive(9.8, 25.0), drive(11.0)]
    twice = [score_runs(runs, PLACES, 1.0, np.random.default_rng(9)) for _ in range(2)]
    assert twice[0].places == twice[1].places
    assert twice[0].runs == twice[1].runs


@pytest.mark.parametrize(
    ("drives", "locations"),
    [
        ([], PLACES),
        ([drive()], PLACES),
        ([drive(1.0)], ()),
        ([drive(1.0)], PLACES[3:]),
        ([drive(1.0, path=STRAIGHT[:1], length_m=0.0)], PLACES),
        ([drive(1.0, path=STRAIGHT[:0], length_m=0.0)], PLACES),
    ],
)  # fmt: skip
def test_what_cannot_be_said_is_nan(drives, locations):
    scores = score_runs(drives, locations, 1.0, np.random.default_rng(0))
    tally = scores.pooled
    assert math.isnan(scores.consistency)
    doors = len(drives) * sum(place.kind == "doorway" for place in locations)
    assert math.isnan(tally.recall) == (doors == 0)
    assert math.isnan(tally.precision) == (tally.marks == 0)
    assert math.isnan(tally.duplicates) == (tally.found == 0)
    assert math.isnan(tally.marks_per_100_m) == (tally.length_m == 0)
    for value in tally.figures().values():
        assert math.isnan(value) or 0 <= value <= 100


@pytest.mark.parametrize(
    ("marks", "expected"), [(1, 0.02), (10, 0.2), (40, 0.8), (50, 1.0), (80, 1.0)]
)
def test_a_clock_finds_a_place_as_often_as_the_closed_form_says(marks, expected):
    # 100 m at a constant speed, m marks 100 / m apart, a window of 2 m: min(1, 2 m / 100).
    path = np.column_stack([np.linspace(0.0, 100.0, 10_001), np.zeros(10_001)])
    share = mean_by_chance(
        path, marks, lambda drawn: [match(drawn, [(50.0, 0.0)], 1.0)[0] >= 0],
        np.random.default_rng(1), 4000, clock_marks,
    )  # fmt: skip
    assert share[0] == pytest.approx(expected, abs=0.03)


def test_a_clock_marks_at_equal_intervals():
    path = np.column_stack([np.arange(100.0), np.zeros(100)])
    x = clock_marks(path, 10, np.random.default_rng(3))[:, 0]
    assert np.array_equal(np.diff(x), np.full(9, 10.0))
    assert len(clock_marks(path, 0, np.random.default_rng(3))) == 0
