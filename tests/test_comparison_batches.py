"""Many sets of marks at once give what one after the other gives."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from ssrics_like.comparison import batches
from ssrics_like.comparison.batches import merged, passages_found, places_found
from ssrics_like.comparison.matching import match
from ssrics_like.comparison.merging import merge

QUARTERS = st.integers(0, 16).map(lambda n: n / 4)
RADII = st.sampled_from([0.25, 0.5, 1.0, 2.0])


def sets(*shape):
    sizes = st.tuples(*(st.integers(low, high) for low, high in shape))
    return sizes.flatmap(lambda size: arrays(np.float64, size, elements=QUARTERS))


@settings(max_examples=150, deadline=None)
@given(sets((1, 4), (0, 6), (2, 2)), sets((0, 5), (2, 2)), RADII)
def test_places_are_found_as_set_by_set(marks, places, radius_m):
    found = places_found(marks, places, radius_m)
    assert found.shape == (len(marks), len(places))
    for one, row in zip(marks, found, strict=True):
        expected = match(one, places, radius_m) >= 0
        # Of equally good pairings either may be taken; how many are found is certain.
        assert row.sum() == expected.sum()


def test_sets_too_large_to_be_looked_at_together_give_the_same(monkeypatch):
    generator = np.random.default_rng(0)
    marks, places = generator.uniform(0, 8, (50, 9, 2)), generator.uniform(0, 8, (7, 2))
    whole = places_found(marks, places, 1.0)
    monkeypatch.setattr(batches, "AT_ONCE", 100)
    assert np.array_equal(places_found(marks, places, 1.0), whole)
    assert np.array_equal(whole, [match(one, places, 1.0) >= 0 for one in marks])


@settings(max_examples=150, deadline=None)
@given(sets((1, 4), (0, 6)), sets((0, 5)), RADII)
def test_passages_are_found_as_by_assignment(along_m, passages_m, radius_m):
    along_m, passages_m = np.sort(along_m, axis=1), np.sort(passages_m)
    line = np.column_stack([passages_m, np.zeros(len(passages_m))])
    expected = [
        (match(np.column_stack([row, np.zeros(len(row))]), line, radius_m) >= 0).sum()
        for row in along_m
    ]
    assert passages_found(along_m, passages_m, radius_m).tolist() == expected


@settings(max_examples=150, deadline=None)
@given(sets((1, 4), (0, 8), (2, 2)), RADII)
def test_marks_are_merged_as_set_by_set(marks, radius_m):
    groups = merged(marks, radius_m)
    for one, row in zip(marks, groups, strict=True):
        there = row[np.isfinite(row[:, 0])]
        np.testing.assert_allclose(there, merge(one, radius_m))
    assert groups.shape[1] == max(len(merge(one, radius_m)) for one in marks)
