"""No-return values are capped, dropouts repaired, openings kept."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ssrics_like.errors import SettingsError
from ssrics_like.perception import ScanError, condition


def naive_condition(ranges, cap, window):
    """Written again from the documentation of `condition`."""
    capped = [r if math.isnan(r) or 0 < r < cap else cap for r in ranges]
    measured = [0 < r < cap for r in ranges]
    result = list(capped)
    if window:
        for k, own in enumerate(measured):
            if not own:
                first = min(max(k - window // 2, 0), max(len(ranges) - window, 0))
                near = sorted(r for r in capped[first : first + window] if not math.isnan(r))
                if near:
                    result[k] = near[(len(near) - 1) // 2]
    return result, measured


@settings(max_examples=200, deadline=None)
@given(
    st.lists(
        st.one_of(
            st.sampled_from([math.nan, math.inf, -math.inf, 0.0, -1.0, 8.0, 81.83, 7.9]),
            st.floats(0.1, 10.0),
        ),
        min_size=1,
        max_size=14,
    ),
    st.sampled_from([0, 3, 5, 7]),
)
def test_agrees_with_the_rule_written_out(ranges, window):
    expected, measured = naive_condition(ranges, 8.0, window)
    scan = condition(ranges, 8.0, window)
    assert np.array_equal(scan.ranges_m, expected, equal_nan=True)
    assert scan.measured.tolist() == measured


@pytest.mark.parametrize("value", [math.inf, -math.inf, 0.0, -3.0, 8.0, 81.83])
def test_every_kind_of_no_return_becomes_the_cap(value):
    scan = condition([1.0, value, 2.0], 8.0, 0)
    assert scan.ranges_m.tolist() == [1.0, 8.0, 2.0]
    assert scan.measured.tolist() == [True, False, True]


@pytest.mark.parametrize("window", [3, 5, 7, 9])
@pytest.mark.parametrize("start", [0, 1, 10, "end"])
def test_a_dropout_is_filled_and_an_opening_stays_wherever_it_lies(window, start):
    for run in range(1, window + 2):
        first = 30 - run if start == "end" else start
        wall = np.full(30, 2.5)
        wall[first : first + run] = math.inf
        repaired = condition(wall, 8.0, window).ranges_m
        expected = wall if run > window // 2 else np.full(30, 2.5)
        assert repaired.tolist() == np.minimum(expected, 8.0).tolist()


def test_a_beam_without_any_answer_takes_its_neighbours_value():
    nan = math.nan
    assert condition([1.0, nan, 3.0, 4.0, 5.0], 8.0, 3).ranges_m[1] == 1.0
    assert condition([1.0, nan, math.inf, 4.0, 5.0], 8.0, 3).ranges_m.tolist()[1] == 1.0
    far_from_any = condition([nan] * 5 + [3.0], 8.0, 3).ranges_m
    assert np.isnan(far_from_any[:4]).all()
    assert far_from_any[4:].tolist() == [3.0, 3.0]
    assert np.isnan(condition([nan, 1.0], 8.0, 0).ranges_m[0])
    assert np.isnan(condition([nan, nan], 8.0, 5).ranges_m).all()


def test_the_scan_handed_in_is_left_alone():
    ranges = np.array([1.0, math.inf, 1.0])
    ranges.flags.writeable = False
    scan = condition(ranges, 8.0, 3)
    assert scan.ranges_m.tolist() == [1.0, 1.0, 1.0]
    assert ranges[1] == math.inf
    assert scan.ranges_m.flags.writeable


@pytest.mark.parametrize("cap", [0.0, -1.0, math.nan, math.inf])
def test_a_cap_that_is_no_length_is_refused(cap):
    with pytest.raises(SettingsError, match="range_cap_m is"):
        condition([1.0], cap, 0)


@pytest.mark.parametrize("window", [1, 2, 4, -3])
def test_a_window_without_a_middle_is_refused(window):
    with pytest.raises(SettingsError, match=r"repair_window is .* odd"):
        condition([1.0], 8.0, window)


def test_an_empty_scan_is_refused():
    with pytest.raises(ScanError, match="at least one beam"):
        condition([], 8.0, 0)
