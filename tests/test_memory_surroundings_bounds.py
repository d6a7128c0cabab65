"""Places of which a bound tells that they are strange, against comparing all of them, to the bit."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ssrics_like.memory import SurroundingsSimilarity, View, surroundings
from ssrics_like.memory.columns import SimilarityScale
from ssrics_like.memory.surroundings import (
    FEWEST,
    REACH_M,
    STRANGE,
    UNKNOWN_M,
    agreement,
    both_sides,
    by_direction,
)
from ssrics_like.memory.surroundings_bounds import (
    LANES,
    LEVEL_M,
    MOST,
    POINTS,
    TURNS,
    bounds_by_level,
)
from ssrics_like.memory.surroundings_kernels import looked_at_from

N = 36
ASIDES = (0, -1, 1, -2, 2)


def naive(view, rows):
    """Compare all, turn by turn, in float32; directions are summed up in their order."""
    same_m, same = np.float32(surroundings.SAME_M), np.float32(surroundings.SAME)
    none = np.float32(1.0 + surroundings.NEARLY)
    looked = np.empty((len(surroundings.AHEAD_M), N))
    for ahead_m, out in zip(surroundings.AHEAD_M, looked, strict=True):
        looked_at_from(view[:N].astype(float), ahead_m, REACH_M, out)
    looked, seen = looked.astype(np.float32), view[N : 2 * N] < UNKNOWN_M
    lengths, known = rows[:, :N], rows[:, N : 2 * N] < UNKNOWN_M
    best, turns = np.full((2, len(rows)), np.nan), np.zeros((2, len(rows)), int)
    for half in (0, 1):
        for turn in ASIDES:
            share = np.full(len(rows), -1.0, np.float32)
            for each in looked:
                agreeing, compared = np.zeros((2, len(rows)), np.float32)
                for k in range(N):
                    j = (k - turn - half * N // 2) % N
                    both = known[:, k] & seen[j]
                    per_m = [
                        np.float32(1.0) / np.maximum(same_m, same * length)
                        for length in (each[j], lengths[:, k])
                    ]
                    less = np.abs(each[j] - lengths[:, k]) * np.minimum(*per_m)
                    agrees = np.clip(none - less, 0.0, 1.0)
                    agreeing += np.where(both, agrees, np.float32(0.0))
                    compared += both
                enough = compared >= FEWEST
                share[enough] = np.maximum(share, agreeing / np.maximum(compared, 1))[enough]
            better = (share >= 0.0) & ~(share <= best[half])
            best[half, better], turns[half, better] = share[better], turn
    return best, turns * 2.0 * np.pi / N


def assert_as_naive(view, rows):
    expected, turned = naive(view, rows)
    alike = expected > STRANGE
    for exact in (True, False):
        found = both_sides(view, by_direction(rows), exact=exact)
        np.testing.assert_array_equal(np.isnan(found.agreeing), np.isnan(expected))
        np.testing.assert_array_equal(found.agreeing[alike], expected[alike])
        np.testing.assert_allclose(found.turned_rad[alike], turned[alike], atol=1e-12)
        assert not (found.agreeing[~alike] > STRANGE).any()
        if exact:
            np.testing.assert_array_equal(found.agreeing, expected)
    np.testing.assert_array_equal(agreement(view, rows), np.fmax(*expected))


def rows_of(lengths, unknown=0.0):
    unknown = np.broadcast_to(unknown, lengths.shape)
    return np.concatenate([lengths, unknown, np.zeros(lengths.shape)], axis=-1).astype(np.float32)


def test_the_kernel_looks_at_a_view_in_all_the_ways_there_are():
    assert len(surroundings.AHEAD_M) == POINTS
    assert 2 * surroundings.ASIDE + 1 == TURNS


def test_a_bound_is_just_above_what_it_bounds():
    rng = np.random.default_rng(0)
    views = rng.uniform(0.0, REACH_M, (POINTS, N)).astype(np.float32)
    views[:, ::2] = np.round(views[:, ::2] / LEVEL_M) * LEVEL_M
    borders = np.arange(130) * np.float32(LEVEL_M)  # longer ones than any view, too
    others = np.concatenate([borders, np.nextafter(borders[1:], 0), rng.uniform(0.0, 8.0, 500)])
    lengths = np.repeat(others.astype(np.float32)[:, None], N, axis=1)
    levels = by_direction(rows_of(lengths)).levels[:, 0]
    scale = surroundings.SAME_M, surroundings.SAME, surroundings.NEARLY
    bounds = bounds_by_level(views, np.ones(N, np.bool_), *scale, 2).view(np.uint8)
    bounds = bounds.reshape(-1, N + 4, 2, LANES)[levels, 2 : N + 2, 0]  # as it is, not turned
    for point, view in enumerate(views):
        per_m = [1 / np.maximum(scale[0], scale[1] * each) for each in (view, lengths)]
        less = np.abs(view - lengths) * np.minimum(*per_m).astype(np.float32)
        spare = bounds[..., point] / 4 - np.clip(np.float32(1.0 + scale[2]) - less, 0.0, 1.0)
        assert spare.min() >= 0.0
        near = lengths < REACH_M
        assert spare[near].max() < 0.25 + LEVEL_M / scale[0] + 1e-4
    assert (bounds[..., POINTS] == 1).all()


@settings(max_examples=40, deadline=None)
@given(
    st.integers(0, 2**32 - 1), st.sampled_from([0.0, 0.05, 0.3, 0.6]),
    st.sampled_from([0.0, 0.3, 0.6, 0.75]), st.booleans(),
)  # fmt: skip
def test_nothing_that_agrees_more_than_strange_places_is_missed(seed, noise_m, hidden, coarse):
    rng = np.random.default_rng(seed)
    room = rng.uniform(0.0, 7.0, N) if seed % 2 else rng.normal(rng.uniform(0.5, 6.0), 0.4, N)
    turns = rng.choice([-19, -18, -2, 0, 1, 2, 9, 17, 20], 60)
    lengths = np.array([np.roll(room, turn) for turn in turns])
    lengths = np.maximum(lengths + rng.normal(0.0, noise_m, lengths.shape), 0.0)
    if coarse:  # on the borders between steps of length
        room, lengths = np.round(room * 16) / 16, np.round(lengths * 16) / 16
    unknown = np.where(rng.random(lengths.shape) < hidden, rng.choice([1.0, 6.0]), 0.99)
    view = rows_of(room, np.where(rng.random(N) < hidden, 2.0, 0.0))
    assert_as_naive(view, rows_of(lengths, unknown))


def test_places_that_agree_in_half_of_the_directions_or_barely_more():
    near = np.full(N, 3.0)
    wrong = np.arange(N)[:, None] > np.arange(N)  # in none, one, ... of all directions
    aside_m = np.linspace(0.2, 0.7, 50)[:, None]  # a direction more agrees in part
    half = np.where(np.arange(N) < N // 2, near, 1.0)
    barely = np.where(np.arange(N) == N // 2, near + aside_m, half)
    rows = rows_of(np.concatenate([np.where(wrong, 1.0, near), [half], barely]))
    expected, _ = naive(rows_of(near), rows)
    assert (np.abs(expected - STRANGE) < 1e-3).any()
    assert_as_naive(rows_of(near), rows)


@pytest.mark.parametrize("seed", range(20))
def test_of_turns_that_agree_equally_the_least_counts(seed, monkeypatch):
    # Sums of these are exact, so that many are equal.
    for name, value in {"SAME_M": 0.5, "SAME": 0.0, "NEARLY": 0.0, "AHEAD_M": (0.0,) * 3}.items():
        monkeypatch.setattr(surroundings, name, value)
    rng = np.random.default_rng(seed)
    lengths = 2.0 + rng.integers(0, 3, (2000, N)) / 8
    unknown = np.where(rng.random(lengths.shape) < 0.7, 2.0, 0.0)
    assert_as_naive(rows_of(lengths[0]), rows_of(lengths, unknown))


@pytest.mark.parametrize("n", [0, 1, 2, 500])
def test_any_number_of_places(n):
    rng = np.random.default_rng(n)
    lengths = rng.uniform(0.5, 6.0, (n, N))
    view = rows_of(lengths[n // 2] if n else rng.uniform(0.5, 6.0, N))
    assert_as_naive(view, rows_of(lengths))


def test_views_that_come_and_change_between_requests_are_compared_as_if_all_came_first():
    rng = np.random.default_rng(1)
    views = [View(f"v{i}", row) for i, row in enumerate(rows_of(rng.uniform(0.5, 6.0, (9, N))))]
    asked = [View(f"asked-{i}", view.descriptor) for i, view in enumerate(views)]
    one, other = (
        SurroundingsSimilarity(-6.0, -3.0).column("view", SimilarityScale(0.0, -8.0))
        for _ in range(2)
    )
    for view in views[:3]:
        one.append(view)
    one.similarity(asked[0])
    for view in views[3:6]:
        one.append(view)
    one.replace(1, views[7])  # made ready already
    one.replace(4, views[8])  # not yet
    for i in (0, 7, 2, 3, 8, 5):
        other.append(views[i])
    for each in asked:
        assert one.similarity(each).tolist() == other.similarity(each).tolist()


@pytest.mark.parametrize("directions", [MOST + 1, 180])
def test_views_of_more_directions_than_a_byte_bounds_are_refused(directions):
    view = np.concatenate([np.full(directions, 2.0), np.zeros(2 * directions)]).astype(np.float32)
    with pytest.raises(ValueError, match=f"views of {directions} directions: at most {MOST}"):
        agreement(view, view[None])


def test_views_of_as_many_directions_as_a_byte_bounds_agree_with_themselves():
    lengths = np.random.default_rng(0).uniform(0.5, 6.0, MOST)
    view = np.concatenate([lengths, np.zeros(2 * MOST)]).astype(np.float32)
    assert agreement(view, view[None])[0] > 0.99
