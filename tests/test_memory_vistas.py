"""Vistas: what is at the end of the hallway tells a place from others that are alike near by."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ssrics_like.memory import SurroundingsSimilarity, View
from ssrics_like.memory.columns import SimilarityScale
from ssrics_like.memory.surroundings import UNKNOWN_M, joined
from ssrics_like.memory.vistas import FAR_M, PAST, PAST_BY, SAME, SAME_M, contradiction, gathered

N = 36


def vista(**ends):
    """Nothing known but the directions named, as in ``d9=30.0``."""
    lengths = np.zeros(N, np.float32)
    for direction, length in ends.items():
        lengths[int(direction[1:])] = length
    return lengths


def of(seen, *remembered, turn=0):
    turns = np.full(len(remembered), turn)
    return contradiction(seen, turns, np.array(remembered).T)


def same(one, other):
    return one > 0 and other > 0 and abs(one - other) < max(SAME_M, SAME * max(one, other))


def naive(seen, remembered, turn):
    """Ask both vistas, direction by direction, in the words of the docstrings."""
    mine, others = np.roll(seen, turn).tolist(), remembered.tolist()
    beside = [[(k + j) % N for j in (-1, 0, 1)] for k in range(N)]
    compared = [
        k for k in range(N)
        if mine[k] > 0 and others[k] > 0
        and max(max(mine[i], others[i]) for i in beside[k]) >= FAR_M
    ]  # fmt: skip
    agree = [
        k for k in compared
        if any(same(mine[k], others[i]) or same(others[k], mine[i]) for i in beside[k])
    ]  # fmt: skip
    if any(not set(beside[k]) & set(agree) for k in compared):
        return 1.0
    past = any(
        all(0 < b[i] < -a[k] * (1 - PAST_BY) for i in beside[k])
        for a, b in ((mine, others), (others, mine)) for k in range(N)
    )  # fmt: skip
    return PAST if past else 0.0


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(-20, 20))
def test_contradiction_is_that_of_a_plain_loop(seed, turn):
    rng = np.random.default_rng(seed)

    def drawn():
        wide = rng.choice(
            [0.0, 7.0, 14.0, 15.0, 30.0, -25.0], N // 3, p=[0.4, 0.3, 0.1, 0.1, 0.05, 0.05]
        )
        return np.repeat(wide, 3).astype(np.float32)

    seen, others = drawn(), [drawn() for _ in range(3)]
    others.append(np.roll(seen, turn))
    expected = [naive(seen, other, turn) for other in others]
    assert of(seen, *others, turn=turn) == pytest.approx(expected)


def test_a_hallway_that_ends_elsewhere_contradicts():
    seen = vista(d9=30.0, d27=13.0)
    as_far, aside, moved, one_end, unseen = of(
        seen, vista(d9=31.0, d27=13.2), vista(d9=7.0, d10=30.5), vista(d9=17.0, d27=26.0),
        vista(d9=30.0, d27=15.0), vista(d0=30.0),
    )  # fmt: skip
    assert as_far == aside == unseen == 0.0
    assert moved == one_end == 1.0


def test_ends_in_the_room_say_nothing():
    assert of(vista(d9=7.0), vista(d9=10.0)) == 0.0
    assert of(vista(d9=7.0), vista(d9=FAR_M)) == 1.0


def test_an_end_that_agrees_beside_it_does_not_contradict():
    seen = vista(d8=17.0, d9=17.0, d10=31.0)
    assert of(seen, vista(d8=17.0, d9=17.0, d10=17.0)) == 0.0
    assert of(seen, vista(d8=17.0, d9=22.0, d10=22.0)) == 0.0
    assert of(seen, vista(d8=22.0, d9=22.0, d10=22.0)) == 1.0


def test_that_it_goes_on_at_least_so_far_contradicts_nearer_ends():
    at_least = vista(d9=-20.0)
    near, far = (vista(d8=end, d9=end, d10=end) for end in (14.0, 30.0))
    assert of(at_least, far) == of(far, at_least) == 0.0
    assert of(at_least, near) == of(near, at_least) == PAST
    assert of(at_least, vista(d9=14.0)) == 0.0  # a gap beside it
    assert of(vista(d9=-20.0, d20=30.0), vista(d8=9.0, d9=9.0, d10=9.0, d20=15.0)) == 1.0


def test_the_ends_seen_last_are_gathered():
    remembered = np.array([30.0, -20.0, 0.0, 10.0, -25.0, 12.0], np.float32)
    seen = np.array([22.0, 15.0, -5.0, -14.0, -30.0, 0.0], np.float32)
    assert gathered(remembered, seen).tolist() == [22.0, 15.0, -5.0, 10.0, -30.0, 12.0]


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
    assert a == c == 0.0
    assert b == pytest.approx(-3.0)
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
    assert nearer == pytest.approx(-1.0 - 3.0)


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
    assert joined(nothing, seen, 1.0) is seen
    behind = joined(nothing, seen, 3.0)  # the graph has it the other way round
    assert behind.reshape(3, N) == pytest.approx(np.roll(seen.reshape(3, N), 18, axis=1))
    assert joined(seen, nothing, 0.0) is None
    assert joined(seen, seen, 0.0) is None
    assert joined(seen, view(room(3), 0.0, vista()), 0.0) is None
    assert UNKNOWN_M < 6.0
