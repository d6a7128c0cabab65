"""The human ceiling, figures of a model, and of marks that know nothing."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from ssrics_like.comparison.way import Way
from ssrics_like.people import Marker
from ssrics_like.people.ceiling import model_against_others, people_against_others
from ssrics_like.people.chance_figures import chance_figures
from ssrics_like.people.figures import Crowd, DrawnRuns, Model
from ssrics_like.people.model_figures import model_figures
from ssrics_like.people.raters import kappas
from ssrics_like.people.resampling import drawn
from ssrics_like.people.route import route_of
from ssrics_like.people.units import Units

PEOPLE = hnp.arrays(bool, st.tuples(st.integers(2, 6), st.just(9)))
RUNS = hnp.arrays(bool, st.tuples(st.integers(1, 4), st.just(9)))


def f_of(marked, wanted):
    """The naive F: None where nothing is wanted."""
    if not wanted.any():
        return None
    return 2 * (marked & wanted).sum() / (marked.sum() + wanted.sum())


def others_of(people, person):
    rest = np.delete(people, person, axis=0)
    return rest.mean(axis=0) >= 0.5 if len(rest) else np.zeros(people.shape[1], bool)


def crowd_of(people, draws=50, seed=1):
    return Crowd.of(people, drawn(np.random.default_rng(seed), draws, len(people)))


@given(PEOPLE, RUNS)
@settings(max_examples=60, deadline=None)
def test_people_and_runs_meet_the_same_others_as_in_a_plain_loop(people, runs):
    crowd = crowd_of(people)
    drawn_runs = DrawnRuns(runs, np.ones((len(crowd.weights), len(runs))))
    mine, theirs, above = [], [], []
    for person in range(len(people)):
        others = others_of(people, person)
        own = f_of(people[person], others)
        if own is None:
            continue
        level = np.mean([f_of(run, others) for run in runs])
        mine.append(level)
        theirs.append(own)
        above.append(level > own)
    found = model_against_others(drawn_runs, crowd)
    ceiling = people_against_others(crowd)["f_others"].value
    if not mine:
        assert math.isnan(ceiling)
        assert math.isnan(found["f_ceiling"].value)
        return
    assert ceiling == pytest.approx(np.mean(theirs))
    assert found["f_others"].value == pytest.approx(np.mean(mine))
    assert found["f_ceiling"].value == pytest.approx(np.mean(mine) - np.mean(theirs))
    # A mean of equal numbers may be off by rounding, and then exceed one that it equals.
    ties = sum(a == pytest.approx(b) for a, b in zip(mine, theirs, strict=True))
    assert found["f_exceeds"].value == pytest.approx(np.mean(above), abs=ties / len(mine) + 1e-9)


def test_a_person_in_the_place_of_a_model_is_as_near_as_people():
    people = np.random.default_rng(2).random((8, 40)) < 0.3
    people[:, :10] = True
    crowd = crowd_of(people, 400)
    found = model_against_others(DrawnRuns(people, drawn(np.random.default_rng(3), 400, 8)), crowd)
    low, high = found["f_ceiling"].interval
    assert low < 0 < high


def test_the_consensus_itself_exceeds_everybody_who_errs():
    base = np.arange(30) < 6
    people = np.array([base ^ (np.arange(30) == 5 + k) for k in range(7)])
    crowd = crowd_of(people, 400)
    found = model_against_others(DrawnRuns(base[np.newaxis], np.ones((400, 1))), crowd)
    assert found["f_others"].value == 1.0
    assert found["f_exceeds"].value == 1.0
    # Seven of seven: Wilson (1927).
    assert found["f_exceeds"].interval == pytest.approx((7 / (7 + 1.959964**2), 1.0))
    assert found["f_others"].interval[1] == 1.0
    assert found["f_ceiling"].interval[0] > 0


def test_intervals_widen_with_fewer_people():
    generator = np.random.default_rng(4)
    base = np.arange(60) < 15
    people = np.array([base ^ (generator.random(60) < 0.12) for _ in range(40)])

    def width(count):
        low, high = people_against_others(crowd_of(people[:count], 500))["f_others"].interval
        return high - low

    assert width(5) > width(12) > width(40)


def test_figures_of_a_model_by_hand():
    people = np.array([[1, 1, 0, 0, 0, 0], [1, 1, 0, 0, 0, 0], [1, 0, 1, 0, 0, 0]], bool)
    runs = np.array([[1, 1, 1, 1, 0, 0], [1, 0, 0, 0, 0, 0]], bool)
    crowd = crowd_of(people)
    found = model_figures(
        DrawnRuns(runs, np.ones((50, 2))), crowd, kappas(np.vstack([people, runs]))
    )
    # The consensus is the first two units.
    assert found["precision"].value == pytest.approx((2 / 4 + 1) / 2)
    assert found["recall"].value == pytest.approx((1 + 1 / 2) / 2)
    assert found["f"].value == pytest.approx((4 / 6 + 2 / 3) / 2)
    # The runs agree about 3 of 6 units: p_o = .5, p_e = 4/6 * 1/6 + 2/6 * 5/6 = 14/36.
    assert found["consistency"].value == pytest.approx((18 / 36 - 14 / 36) / (1 - 14 / 36))


def test_what_marks_at_random_reach_is_a_closed_form():
    # Ten bins of a metre (the first and last half as long); the consensus is four in the middle.
    x = np.arange(0.0, 9.01, 0.05)
    way = Way.through(np.column_stack([x, np.zeros(len(x))]))
    units = Units((), route_of([way], 1.0, 1.0))
    assert len(units) == 10
    people = np.zeros((3, 10), bool)
    people[:, 3:7] = True
    mark = Marker("run 0", "m", np.array([[4.0, 0.0]]), np.array([math.nan]), ("",))
    runs = tuple(mark for _ in range(30))
    model = Model("m", runs, (way,) * 30)
    # Each run marked the bin in the middle of the four, and so has an F of 2 / (1 + 4).
    drawn_runs = DrawnRuns(units.marked(runs), np.ones((50, 30)))
    found = chance_figures(model, units, drawn_runs, crowd_of(people), np.random.default_rng(1))
    # One mark hits with probability 4/9, and then F = 2 / (1 + 4).
    expected = 4 / 9 * 2 / 5
    assert found["f_chance"].value == pytest.approx(expected, abs=0.01)
    chance = found["f_chance"].value
    assert found["f_corrected"].value == pytest.approx((0.4 - chance) / (1 - chance))


def test_a_run_without_a_path_has_no_chance():
    nowhere = Model(
        "m", (Marker("run 0", "m", np.empty((0, 2)), np.empty(0), ()),), (Way.through([]),)
    )
    units = Units((), route_of([], 1.0, 1.0))
    crowd = crowd_of(np.zeros((2, 0), bool))
    found = chance_figures(
        nowhere,
        units,
        DrawnRuns(np.zeros((1, 0), bool), np.ones((50, 1))),
        crowd,
        np.random.default_rng(1),
    )
    assert math.isnan(found["f_chance"].value)
    assert math.isnan(found["f_corrected"].value)
