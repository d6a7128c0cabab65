"""Surroundings: alike from either side, whatever of them is known."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ssrics_like.memory import Chunk, DeclarativeMemory, Request, SurroundingsSimilarity, View
from ssrics_like.memory.columns import SimilarityScale
from ssrics_like.memory.profile import MemoryProfile
from ssrics_like.memory.surroundings import (
    AHEAD_M,
    FEWEST,
    REACH_M,
    SAME,
    SAME_M,
    STRANGE,
    UNKNOWN_M,
    agreement,
    both_sides,
    by_direction,
)
from ssrics_like.memory.surroundings_similarity import KNOWN, MISTAKEN

N = 36


def view(lengths, unknown=0.0):
    return np.concatenate([lengths, np.broadcast_to(unknown, N), np.zeros(N)]).astype(np.float32)


def drawn(seed):
    return np.random.default_rng(seed).uniform(0.5, 6.0, N)


def looked_at_from(lengths, ahead_m):
    """Cast each ray against each edge between two directions, by solving for where they meet."""
    angles = np.arange(N) * 2 * np.pi / N
    corners = np.column_stack([lengths * np.cos(angles) - ahead_m, lengths * np.sin(angles)])
    found = np.full(N, REACH_M)
    for k, angle in enumerate(angles):
        ray = np.array([np.cos(angle), np.sin(angle)])
        for one, other in zip(corners, np.roll(corners, -1, axis=0), strict=True):
            sides = np.column_stack([ray, one - other])
            if abs(np.linalg.det(sides)) < 1e-12:
                continue
            distance, share = np.linalg.solve(sides, one)
            if distance > 0.0 and -1e-9 <= share <= 1.0 + 1e-9:
                found[k] = min(found[k], distance)
    return found


def naive(one, other):
    """Compare turn by turn and direction by direction."""
    best = None
    for ahead_m in AHEAD_M:
        lengths = looked_at_from(one[:N].astype(float), ahead_m)
        for turn in (-2, -1, 0, 1, 2, 16, 17, 18, 19, 20):
            agree = compared = 0
            for k in range(N):
                j = (k - turn) % N
                if one[N + j] >= UNKNOWN_M or other[N + k] >= UNKNOWN_M:
                    continue
                compared += 1
                a, b = lengths[j], float(other[k])
                agree += np.clip(1.7 - abs(a - b) / max(SAME_M, SAME * max(a, b)), 0.0, 1.0)
            if compared >= FEWEST:
                best = max(best or 0.0, agree / compared)
    return best


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 2**32 - 1), st.floats(0.0, 0.9))
def test_agreement_is_that_of_a_plain_loop(seed, hidden):
    rng = np.random.default_rng(seed)
    places = [view(drawn(seed + i), np.where(rng.random(N) < hidden, 2.0, 0.0)) for i in range(3)]
    places.append(view(np.roll(drawn(seed), 18) + rng.normal(0.0, 0.2, N)))
    found = agreement(places[0], np.array(places))
    for other, share in zip(places, found, strict=True):
        expected = naive(places[0], other)
        assert np.isnan(share) if expected is None else share == pytest.approx(expected, abs=1e-4)


@pytest.mark.parametrize("turn", [0, 2, -1, 16, 18, 19])
def test_a_place_is_the_same_from_the_other_side_and_twenty_degrees_aside(turn):
    lengths = drawn(1)
    assert agreement(view(lengths), view(np.roll(lengths, turn))[None]) == pytest.approx(1.0)
    assert agreement(view(lengths), view(np.roll(lengths, 9))[None]) < 0.6


def test_what_is_unknown_is_not_compared_and_too_little_says_nothing():
    lengths = drawn(2)
    half = np.where(np.arange(N) < 18, 3.0, 0.0)
    other = np.where(np.arange(N) < 18, 0.1, lengths)
    assert agreement(view(lengths, half), view(other, half)[None]) == pytest.approx(1.0)
    nearly = np.where(np.arange(N) < N - FEWEST + 1, 3.0, 0.0)
    assert np.isnan(agreement(view(lengths, nearly), view(lengths)[None])).all()


def test_similarity_goes_from_chance_to_the_same():
    column = SurroundingsSimilarity(-6.0, -3.0).column("view", SimilarityScale(0.0, -8.0))
    lengths = np.full(N, 3.0)
    for wrong in (0, 14, 36):  # of 36 directions
        other = np.where(np.arange(N) < wrong, 1.0, lengths)
        column.append(View(f"v{wrong}", view(other)))
    column.append(View("hidden", view(lengths, 6.0)))
    same, half, none, hidden = column.similarity(View("asked", view(lengths))).tolist()
    assert same == 0.0
    assert half == pytest.approx(-6.0 * (1 - (22 / 36 - STRANGE) / (KNOWN - STRANGE)))
    assert none == -6.0
    assert hidden == -3.0


def test_a_memory_recalls_the_place_with_these_surroundings():
    profile = MemoryProfile(activation_noise=0.0)
    memory = DeclarativeMemory(
        profile, np.random.default_rng(0), {"view": SurroundingsSimilarity(-6.0, -3.0)}
    )
    for i in range(5):
        memory.add(Chunk(f"L{i}", "landmark", {"view": View(f"v{i}", view(drawn(i)))}), 0.0)
    asked = View("asked", view(np.roll(drawn(3), 18)))
    found = memory.retrieve(Request("landmark", (("view", asked, False),)), 10.0)
    assert found.chunk.name == "L3"


def test_what_is_seen_where_a_view_was_taken_counts_for_that_view_if_it_agrees_more():
    column = SurroundingsSimilarity(-4.0, -3.0).column("view", SimilarityScale(0.0, -8.0))
    column.append(View("one", view(drawn(1))))
    column.append(None)
    column.append(View("two", view(drawn(2))))
    column.replace(0, View("other", view(drawn(3))))
    plain = column.similarity(View("now", view(drawn(2))))
    there = {
        "one": view(drawn(3)),
        "other": view(drawn(3)),
        "two": view(drawn(5)),
        "new": view(drawn(2)),
    }
    seen = column.similarity(View("now", view(drawn(2)), there))
    assert plain[2] == seen[2] == 0.0
    assert plain[0] < -3.0
    assert seen[0] == 0.0
    unknown = column.similarity(View("now", view(drawn(2)), {"other": view(drawn(3), 9.0)}))
    np.testing.assert_array_equal(unknown, plain)


@pytest.mark.parametrize("half", [0, 1])
@pytest.mark.parametrize("aside", [-2, 0, 1])
def test_what_is_seen_tells_from_which_side_and_how_turned(half, aside):
    remembered = view(drawn(4))
    seen = view(np.roll(drawn(4), 18 * half - aside))
    (sides,) = SurroundingsSimilarity(-7.0, -3.0).sides(seen, remembered[None])
    assert sides[half].nats == pytest.approx(0.0, abs=1e-6)
    assert sides[half].turn_rad == pytest.approx(aside * 2 * np.pi / N)
    assert sides[1 - half].nats < -3.0


def test_a_side_is_never_excluded_and_none_is_told_where_too_little_is_known():
    similarity = SurroundingsSimilarity(-60.0, -3.0)
    plain, hidden = similarity.sides(
        view(drawn(4)), np.array([view(drawn(4)), view(drawn(4), 9.0)])
    )
    assert plain.behind.nats == pytest.approx(np.log(MISTAKEN), abs=1e-3)
    assert hidden.ahead == hidden.behind == (0.0, None)


def test_the_better_side_is_what_agreement_says():
    rng = np.random.default_rng(3)
    places = np.array([view(drawn(i)) for i in range(5)])
    seen = view(np.roll(drawn(2), 18) + rng.normal(0.0, 0.1, N))
    found = both_sides(seen, by_direction(places))
    assert found.agreeing.max(axis=0) == pytest.approx(agreement(seen, places))
    assert found.agreeing[:, 2].argmax() == 1
