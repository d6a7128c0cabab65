"""Similarities of slot values: tables, functions, lists and views."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ssrics_like.memory import (
    FunctionSimilarity,
    Listed,
    ListedSimilarity,
    TableSimilarity,
    View,
    ViewSimilarity,
)
from ssrics_like.memory.columns import SimilarityScale

SCALE = SimilarityScale(0.0, -1.0)


def filled(similarity, values, scale=SCALE):
    column = similarity.column("slot", scale)
    for value in values:
        column.append(value)
    return column


def test_symbols_are_equal_or_different():
    column = filled(
        TableSimilarity(), ["left", "right", None, "left", 3], SimilarityScale(0.5, -2.0)
    )
    assert column.similarity("left")[[0, 1, 3, 4]].tolist() == [0.5, -2.0, 0.5, -2.0]
    assert column.similarity("front")[[0, 1, 3, 4]].tolist() == [-2.0] * 4
    assert column.present.tolist() == [True, True, False, True, True]
    assert column.equals("left").tolist() == [True, False, False, True, False]
    assert column.equals(3.0).tolist() == [False, False, False, False, True]


def test_table_pairs_hold_either_way_and_may_override_equality():
    table = TableSimilarity({("left", "front"): -0.3, ("front", "front"): -0.1})
    column = filled(table, ["left", "front", "right"])
    assert column.similarity("left").tolist() == [0.0, -0.3, -1.0]
    assert column.similarity("front").tolist() == [-0.3, -0.1, -1.0]
    assert column.fully_similar("front").tolist() == [False, False, False]


def test_function_gets_requested_value_first_and_may_leave_it_to_equality():
    def below(requested, value):
        if isinstance(requested, str) or isinstance(value, str):
            return None
        return -0.1 if requested < value else -0.4

    column = filled(FunctionSimilarity(below), [1.0, 5.0, "x"])
    assert column.similarity(3.0).tolist() == [-0.4, -0.1, -1.0]
    assert column.similarity("x").tolist() == [-1.0, -1.0, 0.0]


def test_coded_values_are_ordered_as_numbers_only():
    column = filled(TableSimilarity(), [1, 2.5, None, "abc"])
    assert column.ordered(">", 1).tolist() == [False, True, False, False]
    assert column.ordered("<=", 2.5).tolist() == [True, True, False, False]
    with pytest.raises(TypeError, match="> needs a number, got 'abc'"):
        column.ordered(">", "abc")


def test_coded_values_cannot_be_replaced():
    with pytest.raises(ValueError, match="only a slot with a continuous similarity"):
        filled(TableSimilarity(), ["left"]).replace(0, "right")


DESCRIPTORS = st.integers(2, 30).flatmap(
    lambda n: st.lists(
        st.lists(st.floats(0, 80, width=32), min_size=n, max_size=n), min_size=2, max_size=8
    )
)


@given(DESCRIPTORS)
def test_view_similarity_is_the_correlation_no_less_than_zero(rows):
    views = [View(f"v{i}", np.array(row, np.float32)) for i, row in enumerate(rows)]
    requested, *stored = views
    found = filled(ViewSimilarity(), stored).similarity(requested)
    for similarity, view in zip(found, stored, strict=True):
        pair = np.array([requested.descriptor, view.descriptor], np.float64)
        flat = pair.min(axis=1) == pair.max(axis=1)
        if flat.any():
            r = float(flat.all() and pair[0, 0] == pair[1, 0])
        else:
            centred = pair - pair.mean(axis=1, keepdims=True)
            r = centred[0] @ centred[1] / math.sqrt(np.prod((centred**2).sum(axis=1)))
        assert similarity == pytest.approx(max(r, 0.0) - 1, abs=2e-6)
        assert -1 <= similarity <= 0


def test_view_similarity_spans_the_scale_asked_for():
    up, down = (View(n, np.array(d)) for n, d in [("up", [1, 2, 3]), ("down", [3, 2, 1])])
    column = filled(ViewSimilarity(), [up, down], SimilarityScale(1.0, -2.0))
    assert column.similarity(View("other", up.descriptor * 2 + 5)) == pytest.approx([1.0, -2.0])


def test_equal_views_are_equally_similar_wherever_they_stand():
    rng = np.random.default_rng(0)
    view = View("v", rng.uniform(0, 8, 181))
    for others in (0, 1, 3, 15, 60):
        rest = [View(f"o{i}", rng.uniform(0, 8, 181)) for i in range(others)]
        found = filled(ViewSimilarity(), [view, *rest, view]).similarity(view)
        assert found[0] == found[-1]
        assert found[0] == pytest.approx(0.0, abs=1e-6)


def test_views_of_another_length_or_kind_are_refused():
    column = filled(ViewSimilarity(), [None, View("a", np.arange(4))])
    with pytest.raises(ValueError, match="view 'b' has 3 numbers, the others have 4"):
        column.check(View("b", np.arange(3)))
    with pytest.raises(TypeError, match="takes a View, got 'b'"):
        column.similarity("b")
    with pytest.raises(TypeError, match="have no order"):
        column.ordered("<", 3.0)


def test_a_view_is_a_row_of_finite_numbers():
    with pytest.raises(ValueError, match="not finite"):
        View("v", np.array([1.0, np.nan]))
    with pytest.raises(ValueError, match="shape"):
        View("v", np.zeros((2, 2)))
    descriptor = np.arange(3.0)
    view = View("v", descriptor)
    descriptor[0] = 9
    assert view.descriptor.tolist() == [0, 1, 2]
    assert view.descriptor.dtype == np.float32
    assert view == View("v", np.arange(3))
    assert view != View("w", np.arange(3))
    assert hash(view) == hash(View("v", np.arange(3)))


def test_replacing_a_view_changes_what_it_is_similar_to():
    one, two = View("one", np.array([1, 2, 4])), View("two", np.array([4, 1, 1]))
    column = filled(ViewSimilarity(), [None, one])
    column.replace(1, two)
    assert column.similarity(two)[1] == pytest.approx(0.0, abs=1e-6)
    assert column.equals(two).tolist() == [False, True]
    with pytest.raises(ValueError, match="empty"):
        column.replace(0, two)


def test_listed_values_have_the_similarity_of_the_moment_and_all_others_another():
    now = {"L1": -0.5, "L9": -0.1}
    column = filled(ListedSimilarity(lambda asked: Listed(now if asked == "here" else {}, -20.0)),
                    ["L1", None, "L2"])  # fmt: skip
    assert column.similarity("here")[[0, 2]].tolist() == [-0.5, -20.0]
    assert column.similarity("there")[[0, 2]].tolist() == [-20.0, -20.0]
    now["L2"] = -3.0
    assert column.similarity("here")[[0, 2]].tolist() == [-0.5, -3.0]
    assert column.present.tolist() == [True, False, True]
