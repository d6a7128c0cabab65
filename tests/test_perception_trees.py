"""Boosted trees against a walk through them in plain Python, and peaks against their definition."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ssrics_like.perception.peaks import Peaks
from ssrics_like.perception.trees import BoostedTrees


def grown(rng, trees, features):
    """Grow trees at random, at most three questions deep."""
    rows = []

    def node(depth):
        at = len(rows)
        rows.append(None)
        if depth == 0 or rng.random() < 0.2:
            rows[at] = (-1, 0.0, 0, 0, rng.normal())
        else:
            left, right = node(depth - 1), node(depth - 1)
            rows[at] = (int(rng.integers(features)), rng.normal(), left, right, 0.0)
        return at

    roots = [node(3) for _ in range(trees)]
    feature, threshold, left, right, value = zip(*rows, strict=True)
    return BoostedTrees(
        0.3, np.array(roots, np.int32), np.array(feature, np.int32), np.array(threshold),
        np.array(left, np.int32), np.array(right, np.int32), np.array(value),
    )  # fmt: skip


def naive(trees, measures):
    total = trees.baseline
    for root in trees.roots:
        at = root
        while trees.feature[at] != -1:
            low = measures[trees.feature[at]] <= trees.threshold[at]
            at = trees.left[at] if low else trees.right[at]
        total += trees.value[at]
    return 1 / (1 + math.exp(-total))


@pytest.mark.parametrize("seed", range(5))
def test_trees_are_walked_as_they_are_written(seed):
    rng = np.random.default_rng(seed)
    trees = grown(rng, 8, 4)
    for measures in rng.normal(size=(50, 4)):
        assert trees.probability(measures) == pytest.approx(naive(trees, measures))


def test_what_equals_a_threshold_goes_left():
    trees = BoostedTrees(
        0.0, np.array([0], np.int32), np.array([0, -1, -1], np.int32), np.array([1.5, 0.0, 0.0]),
        np.array([1, 0, 0], np.int32), np.array([2, 0, 0], np.int32), np.array([0.0, 1.0, -1.0]),
    )  # fmt: skip
    assert trees.probability([1.5]) == pytest.approx(1 / (1 + math.exp(-1.0)))
    assert trees.probability([1.6]) == pytest.approx(1 / (1 + math.exp(1.0)))


@pytest.mark.parametrize(("odds", "probability"), [(-1e4, 0.0), (1e4, 1.0), (0.0, 0.5)])
def test_extreme_odds_overflow_nothing(odds, probability):
    none = np.zeros(0, np.int32)
    trees = BoostedTrees(odds, none, none, np.zeros(0), none, none, np.zeros(0))
    assert trees.probability([1.0]) == probability


def peaks_of(scores, threshold=0.5, apart_m=0.8, ahead_m=0.2):
    peaks = Peaks(threshold, apart_m, ahead_m)
    found = []
    for i, score in enumerate(scores):
        found += [(at, i) for _, at in peaks.update(i * 0.1, score, i)]
    return found + [(at, len(scores) - 1) for _, at in peaks.flush()]


def by_definition(scores, threshold=0.5, apart=8, ahead=2):
    found = []
    for i, score in enumerate(scores):
        around = scores[max(i - ahead, 0) : i + ahead + 1]
        first = score > max(scores[max(i - ahead, 0) : i], default=-math.inf)
        if score >= threshold and first and score >= max(around) and (
            not found or i - found[-1] >= apart
        ):  # fmt: skip
            found.append(i)
    return found


@settings(max_examples=300, deadline=None)
@given(st.lists(st.sampled_from([0.0, 0.3, 0.5, 0.6, 0.7, 0.9]), max_size=40))
def test_peaks_are_those_of_the_definition(scores):
    found = peaks_of(scores)
    assert [at for at, _ in found] == by_definition(scores)
    for at, decided in found:
        assert decided == min(at + 2, len(scores) - 1)


def test_of_a_plateau_the_first_counts_and_the_lower_of_two_near_ones_does_not():
    assert [at for at, _ in peaks_of([0, 0.9, 0.9, 0.9, 0, 0, 0.8, 0])] == [1]
    assert [at for at, _ in peaks_of([0, 0.9] + [0] * 8 + [0.8, 0])] == [1, 10]
