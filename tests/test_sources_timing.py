"""Times never fall, good stamps are kept to the digit, and every case has its answer."""

import itertools
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ssrics_like.sources.timing import (
    CATCH_UP_STEP_S,
    LOOK_AHEAD,
    MAX_STEP_S,
    Timekeeper,
    usable,
)


def times(stamps, rate=10.0, look=LOOK_AHEAD):
    keeper = Timekeeper(stamps[:look], rate)
    return [keeper.time(stamp) for stamp in stamps], keeper


ANY_STAMPS = st.lists(
    st.one_of(
        st.floats(),
        st.floats(0, 10_000),
        st.integers(0, 50).map(float),
        st.sampled_from([0.0, 4.29497e9, 1.01893e9, -0.446, math.nan]),
    ),
    min_size=1,
    max_size=120,
)


@given(stamps=ANY_STAMPS, look=st.integers(1, 120))
def test_times_are_finite_and_never_fall_for_any_stamps(stamps, look):
    given_back, keeper = times(stamps, look=look)
    assert all(map(math.isfinite, given_back))
    assert all(after >= before for before, after in itertools.pairwise(given_back))
    assert keeper.repaired <= len(stamps)


@given(
    start=st.floats(-1e9, 2e9),
    steps=st.lists(st.floats(0.001, MAX_STEP_S * 0.999), min_size=1, max_size=60),
    look=st.integers(2, 60),
)
def test_good_stamps_are_kept_to_the_digit(start, steps, look):
    stamps = list(itertools.accumulate([start, *steps]))
    given_back, keeper = times(stamps, look=look)
    assert given_back == stamps
    assert (keeper.repaired, keeper.resets) == (0, 0)


@given(
    back=st.lists(st.booleans(), min_size=30, max_size=60),
    by=st.floats(0.06, 0.9),
)
def test_a_stamp_that_jitters_back_is_repaired_and_the_next_are_the_logs_own(back, by):
    back = [jitter and not before for before, jitter in itertools.pairwise([True, *back])]
    stamps = [10 + 0.6 * k - (1 + by) * 0.6 * jitter for k, jitter in enumerate(back)]
    given_back, keeper = times(stamps)
    for stamp, time, jitter in zip(stamps, given_back, back, strict=True):
        if not jitter:
            assert time == stamp
    assert keeper.repaired == sum(back)


def test_a_repaired_time_follows_the_one_before_by_a_millisecond():
    given_back, keeper = times([10.0, 10.6, 9.9, 10.6, math.nan, 5000.0, 11.2, 11.8, 12.4, 13.0])
    expected = [10.0, 10.6, 10.601, 10.602, 10.603, 10.604, 11.2, 11.8, 12.4, 13.0]
    assert given_back == pytest.approx(expected)
    assert keeper.repaired == 4


@pytest.mark.parametrize(
    ("stamps", "answer"),
    [
        ([], False),
        ([5.0], True),
        ([math.nan], False),
        ([1.01893e9] * 50, False),
        ([0.0] * 50, False),
        ([-0.446, -0.913, -1.343, 4.29497e9, 4.29497e9], False),
        ([0, 1, 0, 1, 2], True),  # 3 of 4
        ([0, 1, 0], True),  # exactly half
        ([0, 1, 0, -1], False),
        ([0, 4000, 8000], False),
    ],
)
def test_stamps_are_usable_if_half_of_the_steps_are_plausible(stamps, answer):
    assert usable(stamps) is answer


def test_unusable_stamps_give_the_stated_rate():
    given_back, keeper = times([0.0] * 4, rate=5.0)
    assert given_back == pytest.approx([0, 0.2, 0.4, 0.6])
    assert (keeper.usable, keeper.repaired) == (False, 0)


@pytest.mark.parametrize("restart", [0.0, 90.0, 1e6])
def test_a_clock_that_is_set_anew_goes_on_with_an_offset(restart):
    before = [100 + 0.1 * k for k in range(100)]
    after = [restart + 0.1 * k for k in range(300)]
    given_back, keeper = times(before + after)
    assert given_back[:100] == before
    assert keeper.resets == 1
    assert keeper.repaired == 20
    steps = [b - a for a, b in itertools.pairwise(given_back[119:])]
    assert steps == pytest.approx([0.1] * 280)
    # The two seconds in which the reset was noticed are given back.
    assert given_back[-1] - given_back[99] == pytest.approx(29.9, abs=0.01)


def test_after_a_reset_a_stamp_that_fits_as_it_stands_is_taken_at_its_word():
    before = [1000 + 0.1 * k for k in range(50)]
    glitch = [0.1 * k for k in range(30)]
    after = [1008 + 0.1 * k for k in range(50)]
    given_back, _ = times(before + glitch + after)
    assert given_back[-50:] == after


def test_a_clock_that_stands_still_is_bridged_at_the_typical_step():
    stamps = [0.1 * k for k in range(150)] + [14.9] * 120
    given_back, keeper = times(stamps)
    assert keeper.resets == 0
    assert given_back[-1] == pytest.approx(14.9 + 20 * CATCH_UP_STEP_S + 100 * 0.1)


def test_a_first_stamp_that_nothing_follows_is_no_beginning():
    stamps = [4.29497e9, 5.0, 5.1, 5.2]
    given_back, keeper = times(stamps)
    assert given_back == pytest.approx([4.999, 5.0, 5.1, 5.2])
    assert keeper.repaired == 1
