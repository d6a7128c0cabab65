"""Metres travelled, steps, and peaks against a twin that sees the whole drive."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ssrics_like.designators.path import CARRIED_M, Odometer, Steps
from ssrics_like.designators.peaks import AHEAD_MAX_M, Peaks
from ssrics_like.designators.protocol import Mark
from ssrics_like.perception.observation import Pose


def metres(places):
    odometer = Odometer()
    return [odometer.update(Pose(x, y, 0.0)) for x, y in places]


def test_the_odometer_adds_up_the_path():
    places = [(0.0, 0.0), (0.3, 0.4), (0.3, 0.4), (0.3, 0.0)]
    assert metres(places) == pytest.approx([0.0, 0.5, 0.5, 0.9])


def test_jitter_at_rest_is_no_path_but_creeping_is():
    rng = np.random.default_rng(0)
    assert metres(rng.uniform(-0.003, 0.003, (500, 2)))[-1] == 0.0
    creeping = [(0.004 * k, 0.0) for k in range(501)]
    assert metres(creeping)[-1] == pytest.approx(2.0, abs=0.01)


def test_being_carried_and_a_pose_without_numbers_are_no_path():
    places = [(0.0, 0.0), (1.0, 0.0), (1.0 + CARRIED_M, 0.0), (math.nan, 0.0), (7.0, 0.0)]
    assert metres(places) == pytest.approx([0.0, 1.0, 1.0, 1.0, 2.0])


def test_a_step_begins_at_the_first_scan_at_or_past_each_multiple():
    steps = Steps(0.1)
    begun = [steps.update(Pose(x, 0.0, 0.0)) for x in (0.0, 0.04, 0.11, 0.15, 0.2, 0.55, 0.58, 0.6)]
    assert [b is not None for b in begun] == [1, 0, 1, 0, 1, 1, 0, 1]
    assert begun[5] == pytest.approx(0.55)


def twin(at_m, scores, threshold, apart_m, ahead_m):
    """Find the peaks with the whole drive in hand, as the docstring of `Peaks` says."""
    found = []
    for i, score in enumerate(scores):
        if math.isnan(score) or score < threshold:
            continue
        before = [s for a, s in zip(at_m[:i], scores[:i], strict=True) if at_m[i] - a <= apart_m]
        after = [
            s for a, s in zip(at_m[i + 1 :], scores[i + 1 :], strict=True) if a - at_m[i] <= ahead_m
        ]
        if any(s >= score for s in before) or any(s > score for s in after):
            continue
        if not found or at_m[i] - at_m[found[-1]] > apart_m:
            found.append(i)
    return found


# Gaps and distances that binary fractions hold exactly, so that "within" is not a matter of luck.
GAPS = st.integers(1, 6).map(lambda n: n / 16)
SCORES = st.one_of(st.integers(0, 6).map(float), st.just(math.nan))


@given(
    st.lists(st.tuples(GAPS, SCORES), max_size=60),
    st.integers(0, 5),
    st.integers(1, 40).map(lambda n: n / 16),
    st.sampled_from([0.0, 0.25, 0.5]),
)
def test_peaks_are_those_of_a_twin_that_sees_the_whole_drive(steps, threshold, apart_m, lag_m):
    at_m = np.cumsum([gap for gap, _ in steps]).tolist()
    scores = [score for _, score in steps]
    peaks = Peaks(threshold, apart_m, lag_m)
    marks = []
    for k, (place_m, score) in enumerate(zip(at_m, scores, strict=True)):
        marks += peaks.update(place_m, score, 10 * k, 10 * k + 5)
    marks += peaks.flush(10 * len(at_m))
    expected = twin(at_m, scores, threshold, apart_m, peaks.ahead_m)
    assert [mark.scan for mark in marks] == [10 * k for k in expected]
    assert [mark.strength for mark in marks] == [scores[k] for k in expected]


def test_a_peak_is_decided_once_nothing_higher_can_come():
    peaks = Peaks(1.0, 0.3)
    scores = [0.0, 2.0, 1.5, 1.2, 1.1, 0.0]
    marks = [peaks.update(0.1 * k, score, k, k) for k, score in enumerate(scores)]
    assert marks == [[], [], [], [], [Mark(1, 4, 2.0)], []]
    assert peaks.flush(9) == []


def test_the_wait_ends_within_a_metre_and_a_lag_shortens_it():
    assert Peaks(0.0, 5.0).ahead_m == AHEAD_MAX_M
    assert Peaks(0.0, 0.5).ahead_m == 0.5
    assert Peaks(0.0, 5.0, 0.5).ahead_m == pytest.approx(0.3)
    assert Peaks(0.0, 5.0, 0.9).ahead_m == 0.0


def test_a_plateau_has_one_mark_and_the_end_of_the_drive_ends_the_wait():
    peaks = Peaks(1.0, 1.0)
    marks = [mark for k in range(100) for mark in peaks.update(0.1 * k, 1.0, k, k)]
    assert [mark.scan for mark in marks] == [0]
    late = Peaks(1.0, 1.0)
    assert late.update(3.0, 1.0, 30, 30) == []
    assert late.flush(31) == [Mark(30, 31, 1.0)]
