"""Numbers in few bytes: they come back within half a step."""

import base64
import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from ssrics_like.results.files import plain
from ssrics_like.viewer.quantising import (
    NOTHING,
    RANGE_STEP_M,
    STEPS,
    in_steps,
    milliseconds,
    ranges_in_steps,
    turns,
)

PLACES = arrays(
    np.float64, st.integers(0, 20), elements=st.floats(-1e4, 1e4) | st.sampled_from([math.nan, math.inf])
)  # fmt: skip


def unpacked(text, kind):
    return np.frombuffer(base64.b64decode(text), kind)


@given(PLACES, st.sampled_from([0.001, 0.01, 1.0]))
def test_numbers_come_back_within_half_a_step(values, step):
    made = in_steps(values, step)
    assert plain(made) == made  # the page's six decimals lose nothing
    steps = unpacked(made["data"], "<u2")
    there = np.isfinite(values)
    assert (steps[~there] == NOTHING).all()
    back = made["least"] + made["step"] * steps[there]
    assert (abs(back - values[there]) <= made["step"] / 2 + 1e-6).all()
    if there.any():
        wide = values[there].max() - values[there].min()
        assert made["step"] <= max(step, wide / STEPS + 2e-6)


@given(arrays(np.float64, st.integers(0, 20), elements=st.floats(0, 2000) | st.just(math.nan)))
def test_ranges_are_centimetres_and_far_ones_nothing(ranges):
    steps = ranges_in_steps(ranges)
    for range_m, step in zip(ranges, steps.tolist(), strict=True):
        if step == NOTHING:
            assert math.isnan(range_m) or range_m > 650.0
        else:
            assert abs(step * RANGE_STEP_M - range_m) <= RANGE_STEP_M / 2 + 1e-9


def test_no_return_is_nothing():
    assert ranges_in_steps(np.array([math.inf, math.nan, -1.0])).tolist() == [NOTHING] * 3


@given(st.floats(-10.0, 10.0))
def test_angles_come_back_to_a_ten_thousandth(angle):
    (share,) = unpacked(turns([angle]), "<u2")
    assert abs(math.remainder(share / 65_536 * math.tau - angle, math.tau)) < 1e-4


def test_times_are_milliseconds():
    assert unpacked(milliseconds([0.0, 1.2344, 4e6]), "<u4").tolist() == [0, 1234, 4_000_000_000]
