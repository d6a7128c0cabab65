"""Running estimates against the same figures computed from all values at once."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ssrics_like.memory.statistics import RunningDirection, RunningMean, wrapped

VALUES = st.lists(st.floats(-1e4, 1e4), min_size=1, max_size=30)
ANGLES = st.lists(st.floats(-7, 7), min_size=1, max_size=30)


def running(kind, values):
    estimate = kind()
    for value in values:
        estimate = estimate.with_value(value)
    return estimate


@given(VALUES)
def test_running_mean_is_the_mean_and_deviation_of_all(values):
    estimate = running(RunningMean, values)
    assert estimate.n == len(values)
    assert estimate.mean == pytest.approx(np.mean(values), rel=1e-9, abs=1e-9)
    expected = np.std(values, ddof=1) if len(values) > 1 else 0.0
    assert estimate.deviation == pytest.approx(expected, rel=1e-6, abs=1e-6)


@given(ANGLES)
def test_running_direction_is_that_of_the_sum_of_unit_vectors(angles):
    estimate = running(RunningDirection, angles)
    total = np.exp(1j * np.array(angles)).sum()
    assert estimate.resultant == pytest.approx(min(1.0, abs(total) / len(angles)), abs=1e-9)
    expected = math.sqrt(2 * max(0.0, 1 - abs(total) / len(angles)))
    assert estimate.deviation == pytest.approx(expected, abs=1e-4)
    if abs(total) > 1e-6:
        assert math.cos(estimate.mean_rad - np.angle(total)) == pytest.approx(1.0, abs=1e-6)
    assert -math.pi < estimate.mean_rad <= math.pi


@given(ANGLES, st.floats(-7, 7))
def test_turning_all_angles_turns_the_mean_and_leaves_the_spread(angles, turn):
    estimate = running(RunningDirection, angles)
    turned = running(RunningDirection, [angle + turn for angle in angles])
    assert turned.resultant == pytest.approx(estimate.resultant, abs=1e-9)
    if estimate.resultant > 1e-3:
        difference = wrapped(turned.mean_rad - estimate.mean_rad - turn)
        assert difference == pytest.approx(0.0, abs=1e-6)


def test_directions_either_side_of_backwards_average_backwards():
    estimate = running(RunningDirection, [math.pi - 0.1, -math.pi + 0.1])
    assert abs(estimate.mean_rad) == pytest.approx(math.pi)
    assert estimate.deviation == pytest.approx(math.sqrt(2 * (1 - math.cos(0.1))))


def test_opposite_directions_have_no_mean_and_the_greatest_spread():
    estimate = running(RunningDirection, [0.3, 0.3 + math.pi])
    assert estimate.deviation == pytest.approx(math.sqrt(2))
    assert estimate.mean_rad == 0.3


@given(VALUES, st.floats(-1e4, 1e4))
def test_an_estimate_rebuilt_goes_on_as_before(values, later):
    estimate = running(RunningMean, values)
    rebuilt = RunningMean.of(estimate.n, estimate.mean, estimate.deviation)
    one, other = estimate.with_value(later), rebuilt.with_value(later)
    assert other.mean == pytest.approx(one.mean)
    assert other.deviation == pytest.approx(one.deviation, rel=1e-6, abs=1e-6)


@given(ANGLES, st.floats(-7, 7))
def test_a_direction_rebuilt_goes_on_as_before(angles, later):
    estimate = running(RunningDirection, angles)
    rebuilt = RunningDirection.of(estimate.n, estimate.mean_rad, estimate.deviation)
    one, other = estimate.with_value(later), rebuilt.with_value(later)
    assert other.resultant == pytest.approx(one.resultant, abs=1e-9)


@given(st.floats(-1e3, 1e3))
def test_wrapping_keeps_the_direction(angle):
    assert -math.pi < wrapped(angle) <= math.pi
    assert math.cos(wrapped(angle) - angle) == pytest.approx(1.0, abs=1e-9)


def test_nothing_measured_is_zero():
    assert RunningMean().deviation == 0.0
    assert RunningDirection().deviation == 0.0
