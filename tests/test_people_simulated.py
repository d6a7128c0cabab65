"""Simulated participants, and whether what is known of them is found again."""

import importlib.util
import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.stats import multivariate_normal, norm

from ssrics_like.people import Participants, Settings, simulated_choices
from ssrics_like.people.hits import hits
from ssrics_like.people.places import standing_places
from ssrics_like.people.raters import kappas
from ssrics_like.people.simulated import decisions, shared_evidence
from ssrics_like.world.building import Building
from ssrics_like.world.grid import FREE, OCCUPIED, GridMap
from ssrics_like.world.locations import Location

FILE = Path(__file__).parents[1] / "benchmarks" / "bench_people.py"


@pytest.fixture(scope="module")
def bench():
    spec = importlib.util.spec_from_file_location("bench_people", FILE)
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module  # dataclasses look their module up
    spec.loader.exec_module(module)
    yield module
    del sys.modules[spec.name]


def marked(who, targets=3000, others=6000, seed=1):
    generator = np.random.default_rng(seed)
    is_target = np.arange(targets + others) < targets
    return decisions(
        who, is_target, shared_evidence(len(is_target), generator), generator
    ), is_target


@pytest.mark.parametrize("shared", [0.0, 0.4, 1.0])
def test_rates_of_hits_and_false_alarms_are_those_of_the_parameters(shared):
    who = Participants(20, 2.0, 1.3, 0.0, shared)
    found, target = marked(who)
    assert found[:, target].mean() == pytest.approx(norm.cdf(2.0 - 1.3), abs=0.02)
    assert found[:, ~target].mean() == pytest.approx(norm.cdf(-1.3), abs=0.01)


def test_sensitivity_and_criterion_are_found_again():
    who = Participants(4, 2.0, 1.3, 0.0, 0.0)
    found, target = marked(who)
    measured = hits(found, target[np.newaxis])
    np.testing.assert_allclose(measured.d_prime, 2.0, atol=0.12)
    np.testing.assert_allclose(measured.criterion, who.bias, atol=0.06)
    assert who.bias == pytest.approx(1.3 - 2.0 / 2)


@pytest.mark.parametrize("shared", [0.0, 0.5])
def test_kappa_is_that_of_the_bivariate_normal(shared):
    # Two people's evidence about a place correlates by what is shared.
    who = Participants(2, 1.8, 1.2, 0.0, shared)
    found, target = marked(who, targets=20_000, others=20_000)
    both = multivariate_normal(cov=[[1, shared], [shared, 1]])
    together = np.mean([both.cdf([1.8 - 1.2] * 2), both.cdf([-1.2] * 2)])
    p = np.mean([norm.cdf(1.8 - 1.2), norm.cdf(-1.2)])
    agree, expected = 1 - 2 * p + 2 * together, p**2 + (1 - p) ** 2
    assert kappas(found)[0, 1] == pytest.approx((agree - expected) / (1 - expected), abs=0.02)
    assert target.sum() == 20_000


def test_all_that_is_shared_makes_everybody_say_the_same():
    found, _ = marked(Participants(5, 1.0, 0.5, 0.0, 1.0), 50, 50)
    assert (found == found[0]).all()


def test_choices_lie_about_their_places_and_equal_seeds_give_equal_choices():
    who = Participants(30, 6.0, 2.0, 0.25, 0.0)
    targets, others = [(0, 0), (10, 0)], [(5, 5)]
    made = simulated_choices(who, targets, others, np.random.default_rng(8))
    assert made == simulated_choices(who, targets, others, np.random.default_rng(8))
    assert made != simulated_choices(who, targets, others, np.random.default_rng(9))
    assert {choice.participant for choice in made} == {f"P{n:02d}" for n in range(1, 31)}
    near = np.array([(c.x_m, c.y_m) for c in made if abs(c.x_m) < 3])
    assert len(near) == 30
    assert near.std() == pytest.approx(0.25, abs=0.06)


def test_people_stand_at_doorways_other_labels_and_on_the_rest_of_the_floor():
    cells = np.full((60, 120), OCCUPIED, np.uint8)
    cells[5:55, 5:100] = FREE
    cells[5:55, 105:110] = FREE  # cannot be walked to
    places = (Location("D", 2.0, 3.0), Location("J", 8.0, 3.0, "", "junction"))
    targets, others = standing_places(Building("hall", GridMap(cells, 0.1), places))
    assert targets.tolist() == [[2.0, 3.0]]
    assert others[0].tolist() == [8.0, 3.0]
    rest = others[1:]
    assert len(rest) > 5
    assert rest[:, 0].max() < 10.0
    for x, y in ((2.0, 3.0), (8.0, 3.0)):
        assert np.hypot(*(rest - (x, y)).T).min() >= 2.0
    # Without a doorway, every label is a target.
    only = Building("hall", GridMap(cells, 0.1), places[1:])
    assert standing_places(only)[0].tolist() == [[8.0, 3.0]]


def test_intervals_hold_the_truth_about_as_often_as_they_say(bench):
    # Of 12 studies 95 % would be 11.4; fewer than 8 come about once in 20 000 times.
    generator = np.random.default_rng(2)
    who = Participants(10, 3.0, 1.5, 0.2, 0.3)
    held = {}
    for seed in range(12):
        made = bench.study(who, 5, Settings(bench.RADIUS_M, bench.STEP_M, seed, 300), generator)
        for one in made:
            assert one.told
            held[one.measure] = held.get(one.measure, 0) + one.held
            low, high = one.figure.interval
            assert low < one.figure.value < high
    assert set(held) == {"d', people", "kappa, people", "Fleiss' kappa", "ceiling, F", "d', robot"}
    assert min(held.values()) >= 8, held


def test_the_benchmarks_closed_forms_are_those_of_many_people(bench):
    who = Participants(4000, 2.0, 1.2, 0.0, 0.3)
    generator = np.random.default_rng(5)
    _, target = bench.places()
    common = shared_evidence(len(target), generator)
    chances = bench.probabilities(who, target, common)
    made = decisions(who, target, common, generator)
    np.testing.assert_allclose(made.mean(axis=0), chances, atol=0.035)
    some = kappas(made[:60])
    assert np.nanmean(some) == pytest.approx(bench.kappa(chances), abs=0.03)
