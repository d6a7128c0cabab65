"""Figures of people and models: closed forms, published values, and those of other packages."""

import math

import krippendorff
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from scipy.stats import norm, t
from statsmodels.stats.inter_rater import cohens_kappa, fleiss_kappa

from ssrics_like.people.consensus import consensus_of, consensus_of_others
from ssrics_like.people.hits import hits, paired_hits
from ssrics_like.people.raters import alpha, fleiss, kappas, mean_kappa, weighted_fleiss
from ssrics_like.people.resampling import (
    centred_interval,
    drawn,
    drawn_means,
    interval,
    mean_interval,
)

TABLES = hnp.arrays(bool, st.tuples(st.integers(2, 6), st.integers(2, 12)))


def table(*rows):
    return np.array([[c == "1" for c in row] for row in rows])


def test_counts_by_hand():
    # Marked 3 of 10 units, 4 wanted, 2 of them marked.
    found = hits(table("1110000000"), table("1101100000"))
    assert found.precision[0, 0] == pytest.approx(2 / 3)
    assert found.recall[0, 0] == pytest.approx(2 / 4)
    assert found.f[0, 0] == pytest.approx(2 * 2 / (3 + 4))
    assert found.agreement[0, 0] == pytest.approx(7 / 10)
    # p_e = .3 * .4 + .7 * .6 = .54
    assert found.kappa[0, 0] == pytest.approx((0.7 - 0.54) / (1 - 0.54))


def test_cohens_worked_table_of_two_clerks_has_kappa_of_two_fifths():
    # 20 both yes, 5 and 10 apart, 15 both no: p_o = .7, p_e = .5
    a = np.repeat([True, True, False, False], [20, 5, 10, 15])
    b = np.repeat([True, False, True, False], [20, 5, 10, 15])
    assert hits(a[np.newaxis], b[np.newaxis]).kappa[0, 0] == pytest.approx(0.4)
    assert kappas(np.vstack([a, b]))[0, 1] == pytest.approx(0.4)


def test_krippendorffs_published_binary_example():
    # Krippendorff (2011), section A: two observers, ten articles, alpha = .095.
    assert alpha(table("0100000010", "1110010000")) == pytest.approx(0.095, abs=5e-4)


def test_sensitivity_with_the_log_linear_correction():
    # 8 of 10 targets, 4 of 30 others: z(8.5 / 11) - z(4.5 / 31)
    wanted = np.arange(40) < 10
    marked = np.isin(np.arange(40), [*range(8), 10, 11, 12, 13])
    found = paired_hits(marked[np.newaxis], wanted[np.newaxis])
    z_hit, z_false = norm.ppf(8.5 / 11), norm.ppf(4.5 / 31)
    assert found.d_prime[0] == pytest.approx(z_hit - z_false)
    assert found.criterion[0] == pytest.approx(-(z_hit + z_false) / 2)


def test_a_perfect_observer_has_a_finite_sensitivity():
    wanted = table("1111000000")
    assert hits(wanted, wanted).d_prime[0, 0] == pytest.approx(
        norm.ppf(4.5 / 5) - norm.ppf(0.5 / 7)
    )


@pytest.mark.parametrize(
    ("marked", "wanted", "undefined"),
    [
        ("0000", "1100", {"precision"}),
        ("1100", "0000", {"precision", "recall", "f", "d_prime", "criterion"}),
        ("0000", "0000", {"precision", "recall", "f", "kappa", "d_prime", "criterion"}),
        ("1111", "1111", {"kappa", "d_prime", "criterion"}),
        ("1111", "1100", set()),
    ],
)
def test_what_cannot_be_said_is_not_a_number(marked, wanted, undefined):
    found = hits(table(marked), table(wanted))
    names = ("precision", "recall", "f", "kappa", "d_prime", "criterion")
    assert {name for name in names if math.isnan(found.measure(name)[0, 0])} == undefined


def test_who_marks_nothing_has_an_f_of_zero():
    assert hits(table("0000"), table("1100")).f[0, 0] == 0.0


@given(TABLES)
@settings(max_examples=60, deadline=None)
def test_kappa_is_that_of_statsmodels(marked):
    ours, count = hits(marked, marked), len(marked)
    pairs = kappas(marked)
    for i in range(count):
        for j in range(count):
            a, b = marked[i], marked[j]
            cells = [[(a & b).sum(), (a & ~b).sum()], [(~a & b).sum(), (~a & ~b).sum()]]
            if a.all() == b.all() and a.any() == b.any() and (a.all() or not a.any()):
                assert math.isnan(ours.kappa[i, j])
                assert math.isnan(pairs[i, j])
                continue
            theirs = cohens_kappa(np.array(cells), return_results=False)
            assert ours.kappa[i, j] == pytest.approx(theirs, abs=1e-12)
            if i != j:
                assert pairs[i, j] == pytest.approx(theirs, abs=1e-12)


@given(TABLES)
@settings(max_examples=60, deadline=None)
def test_agreement_of_all_with_weights_of_one_is_that_of_the_packages(marked):
    found_kappa, found_alpha = weighted_fleiss(marked, np.ones((1, len(marked))))
    if marked.all() or not marked.any():
        assert math.isnan(found_kappa[0])
        assert math.isnan(fleiss(marked))
        assert math.isnan(alpha(marked))
        return
    yes = marked.sum(axis=0)
    theirs = fleiss_kappa(np.column_stack([len(marked) - yes, yes]))
    assert found_kappa[0] == pytest.approx(theirs, abs=1e-9)
    assert fleiss(marked) == pytest.approx(theirs, abs=1e-9)
    theirs = krippendorff.alpha(marked.astype(float), level_of_measurement="nominal")
    assert found_alpha[0] == pytest.approx(theirs, abs=1e-9)
    assert alpha(marked) == pytest.approx(theirs, abs=1e-9)


def test_a_marker_drawn_twice_makes_no_pair_with_itself():
    marked = table("110010", "011010", "100110")
    kappa = kappas(marked)
    weights = np.array([[2.0, 1.0, 0.0], [3.0, 0.0, 0.0]])
    found = mean_kappa(kappa, weights)
    assert found[0] == pytest.approx(kappa[0, 1])  # 2 * 1 pairs, all of the same two
    assert math.isnan(found[1])
    assert np.isnan(weighted_fleiss(marked, weights)[0]).tolist() == [False, True]


def test_a_marker_drawn_many_times_is_that_marker_once():
    # Of two markers, one of them drawn four times, there are pairs of these two only.
    marked = table("1100000000", "0000000000", "1111100000")
    once = weighted_fleiss(marked, np.array([[1.0, 1.0, 0.0]]))[0]
    assert weighted_fleiss(marked, np.array([[1.0, 4.0, 0.0]]))[0] == pytest.approx(once)
    assert weighted_fleiss(marked, np.array([[7.0, 2.0, 0.0]]))[0] == pytest.approx(once)
    # p_o = .8, the mean share of marked units .1: 1 - .2 / .18
    assert once == pytest.approx(1 - 0.2 / 0.18)


def test_one_marker_agrees_with_nobody():
    alone = table("1100")
    assert math.isnan(fleiss(alone))
    assert math.isnan(alpha(alone))
    assert np.isnan(kappas(alone)).all()
    assert np.isnan(weighted_fleiss(alone, np.ones((3, 1)))[0]).all()


def test_consensus_is_what_at_least_half_marked():
    marked = table("1110", "1100", "1000", "0000")
    assert consensus_of(marked).tolist() == [[True, True, False, False]]
    # Without the first: 2 of 3, 1 of 3; without the last: 3 of 3, 2 of 3.
    assert consensus_of_others(marked)[[0, 3]].tolist() == [
        [True, False, False, False], [True, True, False, False],
    ]  # fmt: skip


@given(TABLES, st.integers(0, 2**32 - 1))
@settings(max_examples=40, deadline=None)
def test_consensus_of_drawn_people_is_that_of_the_people_repeated(marked, seed):
    weights = drawn(np.random.default_rng(seed), 5, len(marked))
    for row, chosen in zip(consensus_of(marked, weights), weights.astype(int), strict=True):
        people = np.repeat(marked, chosen, axis=0)
        assert row.tolist() == (people.mean(axis=0) >= 0.5).tolist()


def test_nobody_else_means_no_consensus():
    assert not consensus_of_others(table("1100")).any()


def test_draws_have_as_many_as_there_are():
    weights = drawn(np.random.default_rng(1), 50, 7)
    assert (weights.sum(axis=1) == 7).all()
    assert drawn(np.random.default_rng(1), 50, 0).shape == (50, 0)


def test_the_interval_of_a_mean_is_about_students():
    generator = np.random.default_rng(3)
    values = generator.normal(5.0, 2.0, 15)
    people = drawn(generator, 20_000, 15)
    value, (low, high) = mean_interval(values[:, np.newaxis], people, np.ones((20_000, 1)))
    half = t.ppf(0.975, 14) * values.std(ddof=1) / math.sqrt(15)
    assert value == pytest.approx(values.mean())
    assert high - low == pytest.approx(2 * half, rel=0.05)


def test_drawn_means_are_those_of_repeated_rows_and_columns():
    generator = np.random.default_rng(4)
    values = generator.normal(size=(4, 3))
    values[1, 2] = np.nan
    people, runs = drawn(generator, 6, 4), drawn(generator, 6, 3)
    for found, p, r in zip(
        drawn_means(values, people, runs), people.astype(int), runs.astype(int), strict=True
    ):
        repeated = np.repeat(np.repeat(values, p, axis=0), r, axis=1)
        assert found == pytest.approx(np.nanmean(repeated))


def test_one_of_a_kind_has_no_interval():
    assert all(map(math.isnan, interval(np.ones(100), 1)))
    assert all(map(math.isnan, interval(np.full(100, np.nan), 5)))


def test_a_centred_interval_is_moved_and_keeps_its_limits():
    draws = np.random.default_rng(5).normal(0.7, 0.1, 4000)
    low, high = centred_interval(draws, 0.95, 12, "f")
    plain_low, _ = interval(draws, 12)
    assert low == pytest.approx(plain_low + 0.25, abs=0.01)
    assert high == 1.0
    assert centred_interval(draws, 0.95, 12)[1] > 1.0
