"""Two models on the same people: differences, exact tests, corrections."""

import math

import numpy as np
import pytest

from ssrics_like.people.figures import Crowd, DrawnRuns
from ssrics_like.people.pairs import compared_pairs
from ssrics_like.people.resampling import drawn

PEOPLE, UNITS = 6, 30


def pairs_of(marked, people, locations=10, draws=400):
    crowd = Crowd.of(people, drawn(np.random.default_rng(1), draws, len(people)))
    runs = {
        name: DrawnRuns(table, np.ones((draws, len(table)))) for name, table in marked.items()
    }  # fmt: skip
    return compared_pairs(runs, crowd, locations, np.random.default_rng(2))


@pytest.fixture
def people():
    generator = np.random.default_rng(7)
    base = np.arange(UNITS) % 3 == 0
    return np.array([base ^ (generator.random(UNITS) < 0.1) for _ in range(PEOPLE)])


def test_a_model_that_is_nearer_to_each_person_is_told_by_the_exact_test(people):
    good = np.array([np.arange(UNITS) % 3 == 0])
    made = pairs_of({"good": good, "bad": ~good}, people)
    assert [pair.measure for pair in made] == ["f", "kappa", "locations"]
    for pair in made[:2]:
        # All six differences have one sign: of 2^6 changes of sign two are as extreme.
        assert pair.p == pytest.approx(2 / 2**PEOPLE)
        assert pair.p_holm == pair.p  # a single pair needs no correction
        assert pair.difference.value > 0
        low, high = pair.difference.interval
        assert 0 < low < pair.difference.value < high
        assert pair.count == PEOPLE
    locations = made[2]
    # Right about all 10 against none: 10 of 10 discordant, 2 * .5^10.
    assert (locations.count, locations.difference.value) == (10, 1.0)
    assert locations.p == pytest.approx(2 * 0.5**10)


def test_the_same_model_twice_differs_in_nothing(people):
    marks = np.array([np.arange(UNITS) % 2 == 0])
    for pair in pairs_of({"a": marks, "b": marks.copy()}, people):
        assert pair.difference.value == 0.0
        assert pair.p == 1.0


def test_exchanging_the_models_turns_the_sign(people):
    a, b = np.array([np.arange(UNITS) % 3 == 0]), np.array([np.arange(UNITS) % 4 == 0])
    forth, back = pairs_of({"a": a, "b": b}, people), pairs_of({"b": b, "a": a}, people)
    for one, other in zip(forth, back, strict=True):
        assert one.difference.value == pytest.approx(-other.difference.value)
        assert one.p == pytest.approx(other.p)


def test_three_models_make_three_pairs_with_holms_correction(people):
    x = np.arange(UNITS)
    marked = {"a": x % 3 == 0, "b": x % 4 == 0, "c": x % 3 == 1}
    made = pairs_of({name: row[np.newaxis] for name, row in marked.items()}, people)
    for measure in ("f", "kappa"):
        mine = sorted((pair for pair in made if pair.measure == measure), key=lambda pair: pair.p)
        assert [(pair.first, pair.second) for pair in sorted(mine, key=lambda q: q.first + q.second)] == [
            ("a", "b"), ("a", "c"), ("b", "c"),
        ]  # fmt: skip
        # Holm: (m - k) p, never falling, at most 1.
        most = 0.0
        for k, pair in enumerate(mine):
            most = max(most, min(1.0, (3 - k) * pair.p))
            assert pair.p_holm == pytest.approx(most)


def test_the_difference_is_of_means_over_runs(people):
    x = np.arange(UNITS)
    runs = np.array([x % 3 == 0, x % 5 == 0])
    one = np.array([x % 4 == 0])
    (pair, *_) = pairs_of({"runs": runs, "one": one}, people)

    def f(a, b):
        return 2 * (a & b).sum() / (a.sum() + b.sum())

    expected = np.mean(
        [np.mean([f(run, person) for run in runs]) - f(one[0], person) for person in people]
    )
    assert pair.difference.value == pytest.approx(expected)


def test_one_person_or_no_location_gives_no_probability(people):
    x = np.arange(UNITS)
    marked = {"a": (x % 3 == 0)[np.newaxis], "b": (x % 4 == 0)[np.newaxis]}
    made = pairs_of(marked, people[:1], locations=0)
    assert all(math.isnan(pair.p) and math.isnan(pair.p_holm) for pair in made)
    assert math.isfinite(made[0].difference.value)
    assert made[2].count == 0


def test_who_marked_nothing_is_left_out_of_f(people):
    people = people.copy()
    people[0] = False
    x = np.arange(UNITS)
    made = pairs_of({"a": (x % 3 == 0)[np.newaxis], "b": (x % 4 == 0)[np.newaxis]}, people)
    assert [pair.count for pair in made[:2]] == [PEOPLE - 1, PEOPLE]
