"""Vistas: how far one sees from a place tells it from others that are alike near by."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ssrics_like.memory import SurroundingsSimilarity, View
from ssrics_like.memory.columns import SimilarityScale
from ssrics_like.memory.surroundings import UNKNOWN_M, joined
from ssrics_like.memory.vistas import (
    AGREEING,
    FAR_M,
    FARTHER,
    LESS_FAR,
    SAME,
    SAME_M,
    contradiction,
    farther,
)
from ssrics_like.perception.vista_kernels import farther as perceived_farther

N = 36


def vista(**ends):
    """Walls at 4 m, but for the directions named, as in ``d9=30.0``."""
    lengths = np.full(N, 4.0, np.float32)
    for direction, length in ends.items():
        lengths[int(direction[1:])] = length
    return lengths


def of(seen, *remembered, turn=0):
    turns = np.full(len(remembered), turn)
    return contradiction(seen, turns, np.array(remembered).T)


def naive(seen, remembered, turn):
    """Ask both vistas, direction by direction, in the words of the docstrings."""
    rolled = np.roll(seen, turn)
    counts = {"agree": 0, "farther": 0, "less": 0}
    for mine, others, above, below in (
        (rolled, remembered, "farther", "less"), (remembered, rolled, "less", "farther"),
    ):  # fmt: skip
        for k in range(N):
            beside = [(k + j) % N for j in (1, -1)]
            peak, found = float(mine[k]), [float(others[i]) for i in (k, *beside)]
            if abs(peak) <= FAR_M or any(abs(mine[i]) > abs(peak) for i in beside) or 0 in found:
                continue
            like = [x for x in found
                    if abs(abs(peak) - abs(x)) < max(SAME_M, SAME * max(abs(peak), abs(x)))]  # fmt: skip
            if like:
                counts["agree"] += peak > 0 and like[0] > 0
                continue
            longest = max(found, key=abs)
            if abs(longest) < abs(peak):
                counts[above] += longest > 0
            else:
                counts[below] += peak > 0
    return np.dot([n > 0 for n in counts.values()], (AGREEING, FARTHER, LESS_FAR))


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(-20, 20))
def test_contradiction_is_that_of_a_plain_loop(seed, turn):
    rng = np.random.default_rng(seed)

    def drawn():
        lengths = rng.choice([3.0, 14.0, 15.0, 30.0, 45.0], N, p=[0.6, 0.1, 0.1, 0.1, 0.1])
        return (lengths * rng.choice([1.0, -1.0, 0.0], N, p=[0.8, 0.15, 0.05])).astype(np.float32)

    seen, others = drawn(), [drawn() for _ in range(3)]
    others.append(np.roll(seen, turn))
    expected = [naive(seen, other, turn) for other in others]
    assert of(seen, *others, turn=turn) == pytest.approx(expected)


def test_a_hallway_that_ends_as_far_agrees_and_another_one_contradicts():
    seen = vista(d9=30.0, d27=13.0)
    same, no_hallway, moved, unseen = of(
        seen, vista(d9=31.0, d28=13.2), vista(), vista(d9=17.0, d27=26.0), np.zeros(N, np.float32)
    )
    assert same == AGREEING
    assert no_hallway == FARTHER
    assert moved == pytest.approx(FARTHER + LESS_FAR)
    assert unseen == 0.0


def test_nobody_sees_through_walls_but_somebody_may_stand_in_the_way():
    near, far = vista(d9=15.0), vista(d9=30.0)
    assert of(far, near) == FARTHER
    assert of(near, far) == LESS_FAR


def test_that_it_goes_on_at_least_so_far_contradicts_only_nearer_ends():
    at_least = vista(d9=-20.0)
    assert of(at_least, vista(d9=30.0)) == 0.0
    assert of(vista(d9=30.0), at_least) == 0.0
    assert of(at_least, vista(d9=14.0)) == FARTHER
    assert of(vista(d9=14.0), at_least) == LESS_FAR


def test_the_farther_of_two_vistas_and_an_end_rather_than_what_may_be_one():
    one = np.array([30.0, -20.0, 0.0, 10.0, -25.0], np.float32)
    other = np.array([-32.0, 12.0, 5.0, -14.0, 24.0], np.float32)
    expected = [30.0, -20.0, 5.0, -14.0, 24.0]
    assert farther(one, other).tolist() == expected
    assert farther(other, one).tolist() == expected


def test_the_farther_one_is_what_perception_takes_for_it():
    lengths = np.random.default_rng(0).uniform(-30.0, 30.0, (2, 200)).astype(np.float32)
    one, other = np.round(lengths / 5.0) * 5.0  # often as far, or nearly
    expected = [perceived_farther(a, b) for a, b in zip(one.tolist(), other.tolist(), strict=True)]
    assert farther(one, other).tolist() == expected


def view(lengths, unknown, far):
    return np.concatenate([lengths, np.broadcast_to(unknown, N), far]).astype(np.float32)


def room(seed=1):
    return np.random.default_rng(seed).uniform(0.5, 6.0, N)


def test_a_vista_tells_places_apart_that_are_alike_near_by():
    column = SurroundingsSimilarity(-6.0, -3.0).column("view", SimilarityScale(0.0, -8.0))
    for name, far in {"A": vista(d9=30.0), "B": vista(d9=15.0), "C": vista()}.items():
        column.append(View(name, view(room(), 0.0, far)))
    column.append(View("D", view(room(2), 0.0, vista(d9=15.0))))
    seen = View("seen", view(np.roll(room(), 18), 0.0, np.roll(vista(d9=30.0), 18)))
    a, b, c, d = column.similarity(seen).tolist()
    assert a == 0.0  # no more than equal
    assert b == c == pytest.approx(-3.0 * FARTHER)
    assert d <= -4.0


def test_a_place_that_looks_the_same_from_both_sides_is_compared_from_both():
    hallway = np.where(np.arange(N) % 18 < 3, 6.0, 1.2)  # nearly the same half a turn aside
    far, near = vista(d1=30.0, d19=14.0), vista(d1=14.0, d19=30.0)
    column = SurroundingsSimilarity(-6.0, -3.0).column("view", SimilarityScale(-1.0, -8.0))
    column.append(View("A", view(hallway, 0.0, far)))
    for turned in (far, near):
        seen = column.similarity(View("seen", view(hallway, 0.0, turned)))
        assert seen == pytest.approx(-1.0)
    nearer = column.similarity(View("seen", view(hallway, 0.0, vista(d1=22.0))))
    assert nearer == pytest.approx(-1.0 - 3.0 * LESS_FAR)


def test_a_view_that_is_replaced_is_compared_as_if_it_had_always_been_there():
    views = [View(f"v{i}", view(room(i), 0.0, vista(d9=20.0 + i))) for i in range(4)]
    columns = [
        SurroundingsSimilarity(-6.0, -3.0).column("view", SimilarityScale(0.0, -8.0))
        for _ in range(2)
    ]
    for each in views[:3]:
        columns[0].append(each)
    columns[0].similarity(views[0])  # from here on all are kept ready to be compared
    columns[0].replace(1, views[3])
    for i in (0, 3, 2):
        columns[1].append(views[i])
    for asked in views:
        one, other = (column.similarity(asked) for column in columns)
        assert one.tolist() == other.tolist()


def test_what_is_seen_where_the_place_lies_has_its_own_vista():
    column = SurroundingsSimilarity(-6.0, -3.0).column("view", SimilarityScale(0.0, -8.0))
    column.append(View("A", view(room(), 0.0, vista(d9=30.0))))
    askew = view(np.roll(room(), 5), 0.0, np.roll(vista(d9=30.0), 5))
    there = {"A": view(room(), 0.0, vista(d9=30.0))}
    assert column.similarity(View("seen", askew)) < -3.0
    assert column.similarity(View("seen", askew, there)) == pytest.approx(0.0)


@pytest.mark.parametrize("half", [0, 1])
def test_what_is_seen_of_a_place_is_added_turned_as_it_is(half):
    unknown = np.where(np.arange(N) < 8, 3.0, 0.0)
    square = np.full(N, 3.0)  # by which no side is told from the other
    remembered = view(np.where(unknown, 1.0, square), unknown, vista(d9=-20.0))
    far = vista(d9=30.0, d27=13.0)
    found = joined(remembered, view(square, 0.0, np.roll(far, 18 * half)), half * np.pi + 0.2)
    assert found == pytest.approx(view(square, 0.0, far))


def test_a_place_of_which_nothing_is_known_takes_the_first_view():
    seen = view(room(), 0.0, vista(d9=30.0))
    nothing = view(np.full(N, 6.0), 6.0, np.zeros(N))
    assert joined(nothing, seen, np.pi / 2) is seen
    assert joined(seen, nothing, 0.0) is None
    assert joined(seen, seen, 0.0) is None
    assert joined(seen, view(room(3), 0.0, vista()), 0.0) is None
    assert UNKNOWN_M < 6.0
