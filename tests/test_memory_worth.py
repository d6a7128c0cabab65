"""Salience, relevance, permanence: closed forms, bounds, and what makes them rise and fall."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ssrics_like.memory.worth import choice, permanence, relevance, surprise

LIKENESS = st.lists(st.floats(-50, 0), max_size=30).map(np.array)
USES = st.lists(st.integers(0, 1000), max_size=8)
SPANS = st.floats(0, 1e9)
COUNTS = st.integers(0, 200)
HISTORIES = st.fixed_dictionaries(
    {
        "lasted_s": SPANS,
        "unseen_s": SPANS,
        "confirmed": COUNTS,
        "missed": COUNTS,
        "missed_since": COUNTS,
        "lasting_s": st.floats(1e-3, 1e6),
    }
)
SEEN_ONCE = {
    "lasted_s": 0.0, "unseen_s": 60.0, "confirmed": 0, "missed": 0, "missed_since": 0,
    "lasting_s": 60.0,
}  # fmt: skip


@pytest.mark.parametrize(
    ("likeness", "bits"),
    [
        ([], 0.0),  # nothing to compare with
        ([0.0, 0.0, 0.0], 0.0),  # all the same
        ([-np.inf] * 7, 3.0),  # one of eight that is like no other
        ([0.0, -np.inf, -np.inf], 1.0),  # two pairs
        ([-6.0] * 7, math.log2(8 / (1 + 7 * math.exp(-6)))),
    ],
)
def test_surprise_is_the_logarithm_of_the_mean_likeness(likeness, bits):
    assert surprise(np.array(likeness)) == pytest.approx(bits, abs=1e-12)


@given(LIKENESS)
def test_surprise_lies_between_nothing_and_that_of_one_like_no_other(likeness):
    assert 0.0 <= surprise(likeness) <= math.log2(len(likeness) + 1) + 1e-12


@given(LIKENESS, st.floats(0, 10))
def test_what_is_less_like_the_others_is_more_surprising(likeness, less):
    assert surprise(likeness - less) >= surprise(likeness) - 1e-12


@pytest.mark.parametrize(
    ("traversals", "bits"),
    [
        ([], 0.0),
        ([0, 0], 0.0),
        ([9], 0.0),  # a dead end
        ([2, 2], 1.0),
        ([5, 5, 5, 5], 2.0),
        ([3, 1], 0.75 * math.log2(4 / 3) + 0.25 * 2.0),
    ],
)
def test_choice_is_the_entropy_of_the_ways(traversals, bits):
    assert choice(traversals) == pytest.approx(bits, abs=1e-12)


@given(USES)
def test_choice_lies_between_none_and_that_of_ways_used_alike(traversals):
    assert 0.0 <= choice(traversals) <= math.log2(max(1, len(traversals))) + 1e-9


def test_relevance_is_choice_times_use():
    assert relevance([4, 4], mean=2.0) == 1.0 * 8 / 2
    assert relevance([9], mean=2.0) == 0.0
    assert relevance([], mean=0.0) == 0.0


@given(USES, st.floats(1e-3, 1e3))
def test_relevance_is_never_negative_and_grows_with_use(traversals, mean):
    twice = [2 * n for n in traversals]
    assert relevance(traversals, mean) >= 0.0
    assert relevance(twice, mean) == pytest.approx(2 * relevance(traversals, mean))


@pytest.mark.parametrize(
    ("changes", "expected"),
    [
        ({}, 0.5),  # lasting_s is the median of what was seen once
        ({"unseen_s": 0.0}, 1.0),
        ({"unseen_s": -0.05}, 1.0),  # clocks that are rounded
        ({"lasted_s": 600.0, "unseen_s": 600.0}, 660 / 1260),
        ({"missed_since": 1}, 30 / 90),  # q = 1 - 1/2
        ({"missed_since": 2, "confirmed": 8}, 0.6 / 60.6),  # q = 1 - 9/10
        ({"missed_since": 1, "confirmed": 1, "missed": 1}, 30 / 90),  # q = 1 - 2/4
        ({"missed_since": 10_000}, 0.0),  # q^k is too small for a number
        ({"missed_since": 10_000, "unseen_s": 0.0}, 1.0),
    ],
)
def test_permanence_follows_from_how_long_it_lasted_and_how_often_it_was_missed(changes, expected):
    assert permanence(**{**SEEN_ONCE, **changes}) == pytest.approx(expected, abs=1e-12)


def naive(lasted_s, unseen_s, confirmed, missed, missed_since, lasting_s):
    miss = 1 - (confirmed + 1) / (confirmed + missed + 2)
    there = (lasted_s + lasting_s) * miss**missed_since
    return there / (there + unseen_s)


@given(HISTORIES)
def test_permanence_is_a_probability_and_agrees_with_the_formula_as_it_stands(history):
    found = permanence(**history)
    assert 0.0 <= found <= 1.0
    assert found == pytest.approx(naive(**history), rel=1e-9, abs=1e-12)


@given(HISTORIES, st.floats(1e-3, 1e6), st.integers(1, 9))
def test_time_and_misses_lower_permanence_and_what_lasted_longer_has_more(history, more_s, more):
    found = permanence(**history)

    def changed(key, by):
        return permanence(**{**history, key: history[key] + by})

    assert changed("unseen_s", more_s) <= found
    assert changed("missed_since", more) <= found
    assert changed("lasted_s", more_s) >= found


@given(HISTORIES, st.integers(1, 9))
def test_a_miss_counts_the_more_the_more_reliably_it_was_seen(history, more):
    found = permanence(**history)
    assert permanence(**{**history, "confirmed": history["confirmed"] + more}) <= found + 1e-12
    assert permanence(**{**history, "missed": history["missed"] + more}) >= found - 1e-12
