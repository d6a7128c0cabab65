"""Intervals and tests of few people and few runs: what cannot be had is not shown, and said."""

import math

import numpy as np
import pytest
from people_choices import at_doors, compared, near, write_choices
from results_folders import build_world
from scipy.stats import norm, t

from ssrics_like.people.ceiling import people_against_others
from ssrics_like.people.chance_figures import chance_figures
from ssrics_like.people.figures import Crowd, DrawnRuns, Model
from ssrics_like.people.files import people_rows
from ssrics_like.people.hits import MEASURES
from ssrics_like.people.markers import Marker
from ssrics_like.people.model_figures import model_figures
from ssrics_like.people.pairs import compared_pairs
from ssrics_like.people.raters import fleiss, kappas
from ssrics_like.people.resampling import LEAST, drawn, interval, widened_tail
from ssrics_like.people.route import route_of
from ssrics_like.people.units import Units
from ssrics_like.report.people_tables import figure_table


@pytest.fixture(scope="module")
def world(tmp_path_factory):
    return build_world(tmp_path_factory.mktemp("world") / "world", runs=6, poses=400)


@pytest.fixture(scope="module")
def other(tmp_path_factory):
    return build_world(
        tmp_path_factory.mktemp("other") / "other", runs=6, poses=400, misses=0.8, seed=5
    )


def test_the_least_number_is_that_of_which_the_interval_lies_within_the_draws():
    # Drawn n of n, one marker alone comes with probability n^-n. Where the widened percentile lies
    # below that, the interval is from the least to the largest marker, whatever the others did.
    within = [n for n in range(2, 30) if widened_tail(n) > n**-n]
    assert within == list(range(LEAST, 30))
    assert widened_tail(12) == pytest.approx(norm.cdf(math.sqrt(12 / 11) * t.ppf(0.025, 11)))


def test_fewer_than_the_least_have_no_interval_and_neither_have_equal_draws():
    draws = np.random.default_rng(1).normal(size=500)
    assert all(map(math.isnan, interval(draws, LEAST - 1)))
    assert all(map(math.isfinite, interval(draws, LEAST)))
    assert all(map(math.isnan, interval(np.full(500, 0.7), 12)))


@pytest.mark.parametrize("people", [2, 3, 4])
def test_of_few_people_only_shares_have_intervals_and_the_notes_say_why(
    world, other, tmp_path, people
):
    made = compared([world, other], write_choices(tmp_path / "c.csv", at_doors(people)))
    known = {
        (group, name)
        for group, figures in made.figures.items()
        for name, figure in figures.items()
        if math.isfinite(figure.interval[0])
    }
    models = ("world", "other")
    names = ("f_exceeds", "kappa_exceeds", "consistency")  # Wilson's twice; over six runs
    assert known <= {(model, name) for model in models for name in names}
    assert {("world", "f_exceeds"), ("world", "consistency")} <= known
    assert all(math.isnan(pair.difference.interval[0]) for pair in made.pairs)
    assert any(
        f"There are {people} participants. Intervals of figures need {LEAST}" in note
        for note in made.notes
    )
    least = {2: ".5", 3: ".25", 4: ".125"}[people]
    assert any(
        f"p of models compared over people cannot be below {least}," in n for n in made.notes
    )
    assert figure_table(made).title == "Agreement"


def test_five_people_have_intervals_but_no_small_p(world, other, tmp_path):
    made = compared([world, other], write_choices(tmp_path / "c.csv", at_doors(5)))
    assert math.isfinite(made.figures["people"]["alpha"].interval[0])
    assert any("cannot be below .0625, however" in note for note in made.notes)
    assert made.pairs[0].p >= 2 / 2**5
    assert figure_table(made).title == "Agreement, with 95 % intervals"


def test_few_runs_are_told_of(tmp_path):
    one = build_world(tmp_path / "one", runs=1, poses=200)
    three = build_world(tmp_path / "three", runs=3, poses=200)
    made = compared([one, three], write_choices(tmp_path / "c.csv", at_doors(6)))
    assert any(note.startswith("Of one there is one run: ") for note in made.notes)
    assert any(note.startswith("Of three there are 3 runs; the interval of") for note in made.notes)
    assert math.isnan(made.figures["three"]["consistency"].interval[0])
    assert all(math.isnan(pair.p_runs) for pair in made.pairs)


@pytest.fixture(scope="module")
def drawn_twice():
    """Twelve people about a base, and six runs that err more."""
    generator = np.random.default_rng(3)
    base = np.arange(60) % 5 == 0
    people = np.array([base ^ (generator.random(60) < 0.06) for _ in range(12)])
    runs = np.array([base ^ (generator.random(60) < 0.15) for _ in range(6)])
    crowd = Crowd.of(people, drawn(generator, 1500, 12))
    return crowd, DrawnRuns(runs, drawn(generator, 1500, 6))


def test_agreement_with_a_run_has_an_interval_about_it(drawn_twice):
    crowd, runs = drawn_twice
    kappa = kappas(np.vstack([crowd.marked, runs.marked]))
    found = model_figures(runs, crowd, kappa)
    for name in ("fleiss", "alpha"):
        low, high = found[name].interval
        assert low < found[name].value < high
        # Narrower than people alone would be wide, for one run is a thirteenth of the markers.
        assert 0.0 < high - low < 0.5
    naive = np.mean([fleiss(np.vstack([crowd.marked, run])) for run in runs.marked])
    assert found["fleiss"].value == pytest.approx(naive)


def test_f_above_chance_has_an_interval_drawn_with_the_same_people_and_runs():
    # A straight way of 30 bins; people and runs mark some of the first ten, and now and then more.
    generator = np.random.default_rng(8)
    x = np.arange(0.0, 29.01, 0.1)
    from ssrics_like.comparison.way import Way

    way = Way.through(np.column_stack([x, np.zeros(len(x))]))
    units = Units((), route_of([way], 1.0, 1.0))
    base = np.arange(30) % 3 == 0
    people = np.array([base ^ (generator.random(30) < 0.08) for _ in range(10)])
    tables = np.array([base ^ (generator.random(30) < 0.15) for _ in range(7)])
    runs = tuple(
        Marker(f"run {i}", "m", np.column_stack([np.flatnonzero(row), np.zeros(row.sum())]) * 1.0,
               np.full(row.sum(), math.nan), ("",) * int(row.sum()))
        for i, row in enumerate(tables)
    )  # fmt: skip
    crowd = Crowd.of(people, drawn(generator, 1000, 10))
    drawn_runs = DrawnRuns(units.marked(runs), drawn(generator, 1000, 7))
    found = chance_figures(
        Model("m", runs, (way,) * 7), units, drawn_runs, crowd, np.random.default_rng(1)
    )
    value, chance = found["f_corrected"].value, found["f_chance"].value
    low, high = found["f_corrected"].interval
    assert 0 < low < value < high <= 1
    assert found["f_chance"].interval[0] < chance < found["f_chance"].interval[1]
    f = model_figures(drawn_runs, crowd, kappas(np.vstack([people, drawn_runs.marked])))["f"]
    assert value == pytest.approx((f.value - chance) / (1 - chance))
    # Scaled from F by 1 / (1 - chance), but for how chance itself wavers.
    wide = (f.interval[1] - f.interval[0]) / (1 - chance)
    assert high - low == pytest.approx(wide, rel=0.25)


def test_one_lucky_run_that_all_people_see_is_no_difference_of_models():
    # Both models mark at random, but one of the runs of the first has met the base by luck.
    generator = np.random.default_rng(4)
    base = np.arange(90) % 3 == 0
    people = np.array([base ^ (generator.random(90) < 0.05) for _ in range(12)])
    crowd = Crowd.of(people, drawn(generator, 200, 12))
    random = generator.random((5, 90)) < 1 / 3
    models = {"lucky": np.vstack([base, random[:2]]), "plain": random[2:]}
    pairs = compared_pairs(
        {name: DrawnRuns(table, np.ones((200, 3))) for name, table in models.items()},
        crowd, 90, np.random.default_rng(5),
    )  # fmt: skip
    for pair in pairs[:2]:
        assert pair.p < 0.001  # every person sees it
        assert pair.p_runs >= 0.1  # of 20 ways to share six runs out, few are so extreme
        assert pair.p_holm == pair.p_runs


def test_models_that_are_alike_are_seldom_told_apart():
    # Five runs of either model err alike. Over people alone most such pairs would differ.
    generator = np.random.default_rng(6)
    base = np.arange(90) % 3 == 0
    found = []
    for _ in range(25):
        people = np.array([base ^ (generator.random(90) < 0.05) for _ in range(7)])
        runs = {
            name: DrawnRuns(
                np.array([base ^ (generator.random(90) < 0.15) for _ in range(5)]), np.ones((3, 5))
            )
            for name in ("a", "b")
        }
        pair = compared_pairs(runs, Crowd.of(people, np.ones((3, 7))), 0, generator)[0]
        found.append((pair.p <= 0.05, pair.p_holm <= 0.05))
    over_people, both = np.mean(found, axis=0)
    assert over_people > 0.3
    assert both <= 0.2  # 0.05, and more than three standard errors of 25 studies


def test_the_test_over_runs_is_exact_for_few_of_them():
    base = np.arange(60) % 3 == 0
    people = np.array([base ^ (np.arange(60) == k) for k in range(6)])
    crowd = Crowd.of(people, np.ones((10, 6)))
    good = np.array([base ^ (np.arange(60) == 10 + k) for k in range(4)])
    bad = np.array([~base ^ (np.arange(60) == 20 + k) for k in range(4)])
    pairs = compared_pairs(
        {"good": DrawnRuns(good, np.ones((10, 4))), "bad": DrawnRuns(bad, np.ones((10, 4)))},
        crowd, 0, np.random.default_rng(1),
    )  # fmt: skip
    # All four are better than the other four: of C(8, 4) = 70 ways to share them out, two.
    assert pairs[0].p_runs == pytest.approx(2 / 70)
    assert pairs[0].p == pytest.approx(2 / 2**6)
    assert pairs[0].p_holm == pytest.approx(2 / 2**6)


def test_a_person_alone_has_no_ceiling(world, tmp_path):
    made = compared([world], write_choices(tmp_path / "c.csv", {"only": [near(0), near(1)]}))
    assert all(math.isnan(f.value) for f in people_against_others(made.crowd).values())
    assert "There is one participant" in made.notes[0]
    own = [row for row in people_rows(made) if row["measured"] in ("people", "world")]
    assert len(own) == 2
    assert all(math.isnan(row[name]) for row in own for name in MEASURES)


def test_of_one_person_models_are_compared_over_runs_and_that_decides_nothing(
    world, other, tmp_path
):
    made = compared([world, other], write_choices(tmp_path / "c.csv", {"only": [near(0), near(1)]}))
    for pair in made.pairs[:2]:
        assert math.isfinite(pair.p_runs)
        assert math.isnan(pair.p)
        assert math.isnan(pair.p_holm)
