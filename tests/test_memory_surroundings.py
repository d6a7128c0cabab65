"""Surroundings: alike from either side, whatever of them is known."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ssrics_like.memory import Chunk, DeclarativeMemory, Request, SurroundingsSimilarity, View
from ssrics_like.memory.columns import SimilarityScale
from ssrics_like.memory.profile import MemoryProfile
from ssrics_like.memory.surroundings import (
    FEWEST,
    SAME,
    SAME_M,
    UNKNOWN_M,
    agreement,
)

N = 36


def view(lengths, unknown=0.0):
    return np.concatenate([lengths, np.broadcast_to(unknown, N)]).astype(np.float32)


def drawn(seed):
    return np.random.default_rng(seed).uniform(0.5, 6.0, N)


def naive(one, other):
    """Compare turn by turn and direction by direction."""
    best = None
    for turn in (-1, 0, 1, 17, 18, 19):
        agree = compared = 0
        for k in range(N):
            j = (k - turn) % N
            if one[N + j] >= UNKNOWN_M or other[N + k] >= UNKNOWN_M:
                continue
            compared += 1
            a, b = float(one[j]), float(other[k])
            agree += abs(np.float32(a) - np.float32(b)) < max(SAME_M, SAME * max(a, b))
        if compared >= FEWEST:
            best = max(best or 0.0, agree / compared)
    return best


@given(st.integers(0, 2**32 - 1), st.floats(0.0, 0.9))
def test_agreement_is_that_of_a_plain_loop(seed, hidden):
    rng = np.random.default_rng(seed)
    places = [view(drawn(seed + i), np.where(rng.random(N) < hidden, 2.0, 0.0)) for i in range(3)]
    places.append(view(np.roll(drawn(seed), 18) + rng.normal(0.0, 0.2, N)))
    found = agreement(places[0], np.array(places))
    for other, share in zip(places, found, strict=True):
        expected = naive(places[0], other)
        assert np.isnan(share) if expected is None else share == pytest.approx(expected)


@pytest.mark.parametrize("turn", [0, 1, -1, 17, 18, 19])
def test_a_place_is_the_same_from_the_other_side_and_ten_degrees_aside(turn):
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
    column = SurroundingsSimilarity(-6.0).column("view", SimilarityScale(0.0, -8.0))
    lengths = np.full(N, 3.0)
    for wrong in (0, 18, 36):  # of 36 directions
        other = np.where(np.arange(N) < wrong, 1.0, lengths)
        column.append(View(f"v{wrong}", view(other)))
    column.append(View("hidden", view(lengths, 6.0)))
    same, half, none, hidden = column.similarity(View("asked", view(lengths))).tolist()
    assert same == 0.0
    assert half == pytest.approx(-6.0 * (1 - (0.5 - 0.4) / 0.35))
    assert none == -6.0
    assert hidden == -3.0


def test_a_memory_recalls_the_place_with_these_surroundings():
    profile = MemoryProfile(activation_noise=0.0)
    memory = DeclarativeMemory(
        profile, np.random.default_rng(0), {"view": SurroundingsSimilarity(-6.0)}
    )
    for i in range(5):
        memory.add(Chunk(f"L{i}", "landmark", {"view": View(f"v{i}", view(drawn(i)))}), 0.0)
    asked = View("asked", view(np.roll(drawn(3), 18)))
    found = memory.retrieve(Request("landmark", (("view", asked, False),)), 10.0)
    assert found.chunk.name == "L3"
