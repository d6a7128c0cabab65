"""Which novel intervals are marked."""

import itertools

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ssrics_like.errors import SettingsError
from ssrics_like.perception import make_marker


def marked(mark, novelties, prominence=0.1, threshold=0.75, patience=1000):
    """Indices marked, and after which interval each was reported (None: by flush)."""
    marker = make_marker(mark, threshold, prominence, patience)
    reports = []
    for k, novelty in enumerate(novelties):
        index = marker.update(1 - novelty)
        if index is not None:
            reports.append((index, k))
    index = marker.flush()
    if index is not None:
        reports.append((index, None))
    assert marker.intervals == len(novelties)
    return reports


def test_every_marks_each_novel_interval_at_once():
    assert marked("every", [0.1, 0.5, 0.9, 0.2, 0.25, 1.0]) == [(1, 1), (2, 2), (4, 4), (5, 5)]


def test_onset_marks_the_first_of_each_stretch():
    assert marked("onset", [0.1, 0.5, 0.9, 0.2, 0.25, 1.0]) == [(1, 1), (4, 4)]
    assert marked("onset", [0.9, 0.9]) == [(0, 0)]


def test_a_peak_is_reported_when_novelty_has_dropped_by_the_prominence():
    assert marked("peak", [0.3, 0.6, 0.8, 0.75, 0.65, 0.6]) == [(2, 4)]


def test_a_peak_is_reported_when_the_stretch_or_the_log_ends():
    assert marked("peak", [0.3, 0.32, 0.31, 0.1, 0.1]) == [(1, 3)]
    assert marked("peak", [0.3, 0.9, 0.85]) == [(1, None)]


def test_of_a_plateau_the_first_interval_is_the_peak():
    assert marked("peak", [0.5, 0.9, 0.9, 0.9, 0.5]) == [(1, 4)]


def test_a_plateau_is_not_waited_out():
    assert marked("peak", [0.3, *[0.9] * 50], patience=5) == [(1, 6)]
    # A higher peak later in the same stretch is one of its own; a ripple is not.
    assert marked("peak", [0.5] * 8 + [0.55, 0.9, 0.7], patience=5) == [(0, 5), (9, 10)]


def test_ripples_smaller_than_the_prominence_are_not_marked():
    falling = [0.9, 0.7, 0.75, 0.65, 0.7, 0.6, 0.65, 0.1]
    assert marked("peak", falling) == [(0, 1)]
    rising = [0.5, 0.6, 0.55, 0.65, 0.6, 0.7, 0.1]
    assert marked("peak", rising) == [(5, 6)]


def test_a_second_peak_needs_a_rise_by_the_prominence():
    assert marked("peak", [0.9, 0.5, 0.55, 0.7, 0.8, 0.6]) == [(0, 1), (4, 5)]


def test_nothing_is_marked_while_bored():
    for mark in ("every", "onset", "peak"):
        assert marked(mark, [0.0, 0.1, 0.2, 0.24]) == []
        assert marked(mark, []) == []


def test_flushing_ends_the_stretch():
    for mark, expected in (("onset", 1), ("peak", None)):
        marker = make_marker(mark, 0.75, 0.1, 1000)
        marker.update(0.2)
        marker.flush()
        assert marker.flush() is None
        assert marker.candidate is None
        assert marker.update(0.2) == expected


@given(st.lists(st.floats(0, 1)), st.floats(0.01, 0.5))
def test_peaks_are_novel_in_order_and_no_two_without_a_valley(novelties, prominence):
    found = [index for index, _ in marked("peak", novelties, prominence)]
    taus = [1 - novelty for novelty in novelties]
    assert found == sorted(set(found))
    for index in found:
        assert not taus[index] > 0.75
    for one, other in itertools.pairwise(found):
        valley = min(1 - tau for tau in taus[one : other + 1])
        assert valley <= 0.25 or valley <= 1 - taus[one] - prominence + 1e-12
    stretches = sum(not tau > 0.75 and (k == 0 or taus[k - 1] > 0.75) for k, tau in enumerate(taus))
    assert len(found) >= stretches


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("peaks", 0.75, 0.1), "mark is 'peaks'; .*did you mean 'peak'"),
        (("peak", 0.75, 0.0), "prominence is 0.0"),
        (("every", 75, 0.1), "threshold is 75; expected a fraction"),
    ],
)
def test_wrong_settings_are_refused(arguments, message):
    with pytest.raises(SettingsError, match=message):
        make_marker(*arguments, 20)


def test_only_peak_needs_a_prominence():
    assert make_marker("onset", 0.75, 0.0, 20).update(0.1) == 0
