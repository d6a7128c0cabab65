"""Which readings count as no return, and which long readings stay."""

import numpy as np
import pytest

from ssrics_like.sources.no_return import NoReturnRule


def scans(*values, count=20):
    """Make scans of ordinary readings up to 6 m that also hold the given values."""
    rng = np.random.default_rng(0)
    return [np.concatenate([rng.uniform(0.5, 6, 90), values]) for _ in range(count)]


def cleaned(all_scans, stated=0.0):
    rule = NoReturnRule()
    for ranges in all_scans:
        rule.learn(ranges, stated)
    out = [ranges.copy() for ranges in all_scans]
    number = sum(rule.clean(ranges, k) for k, ranges in enumerate(out))
    return out, number


@pytest.mark.parametrize("value", [0.0, -1.0, -np.inf, np.inf, 81.83, 81.91, 655.35, 1e300])
def test_values_that_are_no_return_in_every_log(value):
    out, number = cleaned(scans(value, count=1))
    assert number == 1
    assert np.isposinf(out[0][-1])


def test_a_beam_without_any_answer_stays_nan():
    out, number = cleaned(scans(np.nan))
    assert number == 0
    assert np.isnan(out[0][-1])


@pytest.mark.parametrize("value", [8.183, 8.191, 32.763, 32.767, 50.0, 51.05, 51.16])
def test_a_ceiling_where_readings_pile_up_is_no_return(value):
    out, number = cleaned(scans(value))
    assert number == 20
    assert all(np.isposinf(ranges[-1]) for ranges in out)


@pytest.mark.parametrize("value", [8.19, 32.76, 50.0, 51.1])
def test_the_same_value_stays_where_the_log_has_longer_readings(value):
    for longer in (value + 3, 81.83):
        out, _ = cleaned(scans(value, longer))
        assert all(ranges[-2] == value for ranges in out)


def test_a_wall_at_a_ceiling_stays_because_its_neighbours_are_as_frequent():
    out, number = cleaned([np.linspace(7.7, 8.19, 40) for _ in range(50)])
    assert number == 0
    assert np.isfinite(out).all()


def test_a_single_reading_at_a_ceiling_stays():
    out, number = cleaned([*scans(3.0), *scans(8.19, count=1)])
    assert number == 0
    assert out[-1][-1] == 8.19


def test_a_stated_range_is_believed_while_nothing_is_longer():
    assert cleaned(scans(12.0), stated=12.0)[1] == 20
    assert cleaned(scans(12.0, 13.0), stated=12.0)[1] == 0


def test_a_wrong_stated_range_does_not_hide_readings():
    out, number = cleaned(scans(25.56, 81.83), stated=50.0)  # as in the Intel log
    assert number == 20
    assert all(ranges[-2] == 25.56 for ranges in out)


def test_a_longer_reading_later_gives_the_ceiling_up_and_says_so():
    rule = NoReturnRule()
    first, later = scans(8.19), scans(8.19, 20.0)
    for ranges in first:
        rule.learn(ranges)
    assert sum(rule.clean(ranges, k) for k, ranges in enumerate(first)) == 20
    for k, ranges in enumerate(later, 20):
        rule.learn(ranges)
        assert rule.clean(ranges, k) == 0
    assert rule.given_up == [(8.18, 20)]
    (note,) = rule.notes()
    assert note.startswith("Readings from 8.18 m on were taken as no return up to scan 20, ")


def test_scans_without_a_single_reading_are_no_trouble():
    out, number = cleaned([np.full(5, np.nan), np.full(5, np.inf), np.zeros(5)])
    assert number == 10
    assert np.isnan(out[0]).all()
