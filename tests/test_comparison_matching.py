"""Marks and places are paired one to one, as many as can be and as near as can be."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ssrics_like.comparison.matching import match
from ssrics_like.comparison.merging import merge

POINT = st.tuples(st.integers(0, 12), st.integers(0, 12)).map(lambda p: (p[0] / 4, p[1] / 4))


def best_by_trying(marks, places, radius_m):
    """Try every way to give places marks, or none: most pairs, then least total distance."""
    best = (0, 0.0)
    options = [*range(len(marks)), *[None] * len(places)]
    for chosen in set(itertools.permutations(options, len(places))):
        lengths = [math.dist(marks[i], place) for i, place in zip(chosen, places, strict=True)
                   if i is not None]  # fmt: skip
        if all(length <= radius_m for length in lengths):
            best = max(best, (len(lengths), -sum(lengths)))
    return best


@settings(max_examples=150, deadline=None)
@given(
    st.lists(POINT, max_size=4), st.lists(POINT, max_size=3), st.sampled_from([0.0, 0.5, 1.0, 2.0])
)
def test_no_other_pairing_has_more_pairs_or_shorter_ones(marks, places, radius_m):
    found = match(marks, places, radius_m)
    pairs = [(i, j) for j, i in enumerate(found) if i >= 0]
    assert len({i for i, _ in pairs}) == len(pairs)
    lengths = [math.dist(marks[i], places[j]) for i, j in pairs]
    assert all(length <= radius_m for length in lengths)
    count, total = best_by_trying(marks, places, radius_m)
    assert (len(lengths), sum(lengths)) == (count, pytest.approx(-total))


def test_one_mark_between_two_places_finds_one_of_them():
    assert match([(0.4, 0)], [(0, 0), (1, 0)], 1.0).tolist() == [0, -1]


def test_more_pairs_go_before_nearer_ones():
    # The second mark is nearest to the first place, but the only one that reaches the second.
    assert match([(-0.9, 0), (0.1, 0)], [(0, 0), (1, 0)], 1.0).tolist() == [0, 1]


def test_the_radius_belongs_to_the_place():
    assert match([(1.0, 0)], [(0, 0)], 1.0).tolist() == [0]
    assert match([(1.0 + 1e-9, 0)], [(0, 0)], 1.0).tolist() == [-1]


@pytest.mark.parametrize(("marks", "places"), [([], []), ([], [(0, 0)]), ([(0, 0)], [])])
def test_nothing_finds_nothing(marks, places):
    assert match(marks, places, 1.0).tolist() == [-1] * len(places)


def merged_by_loop(marks, radius_m):
    groups = []
    for mark in marks:
        near = [group for group in groups if math.dist(group[0], mark) <= radius_m]
        if near:
            min(near, key=lambda group: math.dist(group[0], mark)).append(mark)
        else:
            groups.append([mark])
    return [tuple(sum(values) / len(group) for values in zip(*group, strict=True))
            for group in groups]  # fmt: skip


@settings(max_examples=100, deadline=None)
@given(st.lists(POINT, max_size=20), st.sampled_from([0.0, 0.5, 1.0]))
def test_merging_agrees_with_a_loop(marks, radius_m):
    expected = merged_by_loop(marks, radius_m)
    np.testing.assert_allclose(merge(marks, radius_m), np.reshape(expected, (-1, 2)))


def test_marks_along_a_corridor_do_not_all_become_one():
    marks = [(0.25 * i, 0.0) for i in range(21)]  # 5 m; neighbours are 0.25 m apart
    # Begun at 0, 1.25, 2.5, 3.75 and 5 m.
    assert merge(marks, 1.0)[:, 0].tolist() == [0.5, 1.75, 3.0, 4.25, 5.0]
