"""Base-level activation against closed forms and a literal reading of the equations."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ssrics_like.memory import base_level
from ssrics_like.memory.base_level import LEAST_AGE_S, ReferenceLog

TIMES = st.lists(st.floats(0, 1000), min_size=1, max_size=12)


def literal(references, t_s, decay, optimized, constant=0.0):
    """ACT-R's equations, one number at a time."""
    if decay is None:
        return constant
    ages = sorted(t_s - t for t in references)
    n = len(ages)
    if optimized is True:
        return constant + math.log(n / (1 - decay)) - decay * math.log(max(0.05, ages[-1]))
    kept = n if optimized is False else min(optimized, n)
    total = 0.0
    for age in ages[:kept]:
        total += max(0.05, age) ** -decay
    if n > kept:
        oldest, last = ages[-1], ages[kept - 1]
        difference = oldest ** (1 - decay) - last ** (1 - decay)
        total += (n - kept) * difference / ((1 - decay) * max(0.05, oldest - last))
    return constant + math.log(total)


@given(
    TIMES,
    st.floats(0, 5000),
    st.one_of(st.none(), st.floats(0.05, 0.95)),
    st.one_of(st.booleans(), st.integers(1, 6)),
    st.floats(-2, 2),
)
def test_agrees_with_the_literal_equations(references, later, decay, optimized, constant):
    t_s = max(references) + later
    found = base_level(references, t_s, decay=decay, optimized=optimized, constant=constant)
    expected = literal(references, t_s, decay, optimized, constant)
    assert found == pytest.approx(expected, rel=1e-9, abs=1e-9)


@given(TIMES, st.booleans() | st.integers(1, 6), st.randoms())
def test_order_of_references_does_not_matter(references, optimized, random):
    shuffled = list(references)
    random.shuffle(shuffled)
    kwargs = {"decay": 0.5, "optimized": optimized}
    assert base_level(shuffled, 1001.0, **kwargs) == pytest.approx(
        base_level(references, 1001.0, **kwargs), rel=1e-12, abs=1e-12
    )


def test_one_reference_decays_as_a_power_of_its_age():
    assert base_level([0.0], 4.0, decay=0.5) == pytest.approx(-0.5 * math.log(4.0))


def test_no_reference_is_younger_than_50_ms():
    for age in (0.0, 0.01, LEAST_AGE_S):
        assert base_level([1.0], 1.0 + age) == pytest.approx(-0.5 * math.log(0.05), rel=1e-12)


def test_hybrid_with_as_many_kept_as_there_are_is_exact():
    times = [0.0, 3.0, 7.0, 20.0]
    assert base_level(times, 30.0, optimized=4) == base_level(times, 30.0)


def test_hybrid_at_decay_one_is_the_limit_of_its_neighbours():
    times, t_s = [0.0, 1.0, 2.0, 5.0], 11.0
    below, above = (base_level(times, t_s, decay=d, optimized=2) for d in (1 - 1e-6, 1 + 1e-6))
    at = base_level(times, t_s, decay=1.0, optimized=2)
    assert at == pytest.approx((below + above) / 2, abs=1e-8)
    assert math.isfinite(base_level([0.0, 0.0], 0.0, decay=1.5, optimized=1))


def test_optimized_with_decay_one_is_refused():
    with pytest.raises(ValueError, match="decay below 1, got 1"):
        base_level([0.0], 1.0, decay=1.0, optimized=True)


def log_of(histories):
    log = ReferenceLog()
    for first, *later in histories:
        row = log.add_chunk(first)
        for t_s in later:
            log.add_reference(row, t_s)
    return log


@given(st.lists(TIMES, min_size=1, max_size=6), st.booleans() | st.integers(1, 4))
def test_many_chunks_at_once_are_as_one_at_a_time(histories, optimized):
    log = log_of(histories)
    t_s = max(map(max, histories)) + 3.0
    found = log.base_levels(t_s, decay=0.5, optimized=optimized, constant=0.3)
    one_by_one = [
        base_level(times, t_s, decay=0.5, optimized=optimized, constant=0.3) for times in histories
    ]
    assert found == pytest.approx(one_by_one, rel=1e-12, abs=1e-12)


@given(st.lists(TIMES, min_size=1, max_size=6), st.floats(0, 1000))
def test_references_after_the_moment_do_not_count(histories, t_s):
    found = log_of(histories).base_levels(t_s, decay=0.5, optimized=False, constant=0.0)
    for level, times in zip(found, histories, strict=True):
        past = [t for t in times if t <= t_s + 0.0005]
        expected = base_level(past, t_s) if past else -math.inf
        assert level == pytest.approx(expected, rel=1e-12, abs=1e-12)


def test_chunks_not_wanted_get_minus_infinity():
    log = log_of([[0.0], [0.0, 1.0], [2.0]])
    wanted = np.array([False, True, False])
    found = log.base_levels(5.0, decay=0.5, optimized=False, constant=0.0, wanted=wanted)
    assert found.tolist() == [-math.inf, base_level([0.0, 1.0], 5.0), -math.inf]


def test_equal_histories_tie_exactly_wherever_they_stand():
    rng = np.random.default_rng(0)
    times = np.sort(rng.uniform(0, 100, 7)).tolist()
    for others in range(1, 40):
        histories = [rng.uniform(0, 100, 3).tolist() for _ in range(others)]
        log = log_of([times, *histories, times])
        for optimized in (False, True, 3):
            levels = log.base_levels(101.0, decay=0.37, optimized=optimized, constant=0.0)
            assert levels[0] == levels[-1]
