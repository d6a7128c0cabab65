"""Run lengths against a twin that works each one out from its own data, and marks of changes."""

import math

import numpy as np
import pytest
from designator_drives import ROOM, spots, straight, travelled
from scipy import stats
from scipy.special import logsumexp

from ssrics_like.designators import designate, make_designator
from ssrics_like.designators.bocpd import RunLengths
from ssrics_like.designators.conjugate import NormalInverseGamma

MEAN, WEIGHT, SHAPE, SCALE = 0.2, 0.5, 1.5, 0.4
HAZARD = 0.05


def prior(features):
    one = np.ones(features)
    return NormalInverseGamma(MEAN * one, WEIGHT * one, SHAPE * one, SCALE * one)


def log_next(run, x):
    """Return the log density of `x` after the data of a run: Murphy (2007), all data at once."""
    n = len(run)
    total = 0.0
    for f, datum in enumerate(x):
        data = run[:, f] if n else np.empty(0)
        mean = data.mean() if n else 0.0
        weight, shape = WEIGHT + n, SHAPE + n / 2
        middle = (WEIGHT * MEAN + n * mean) / weight
        scale = SCALE + 0.5 * ((data - mean) ** 2).sum()
        scale += 0.5 * WEIGHT * n * (mean - MEAN) ** 2 / weight
        spread = math.sqrt(scale * (weight + 1) / (shape * weight))
        total += stats.t.logpdf(datum, 2 * shape, middle, spread)
    return total


def twin(data):
    """Return the distribution of run lengths after each datum (Adams & MacKay, algorithm 1)."""
    joint, after = np.zeros(1), []
    for t, x in enumerate(data):
        seen = np.array([joint[r] + log_next(data[t - r : t], x) for r in range(t + 1)])
        change = logsumexp(seen) + math.log(HAZARD)
        joint = np.concatenate([[change], seen + math.log(1 - HAZARD)])
        after.append(np.exp(joint - logsumexp(joint)))
    return after


def signal(seed=0, features=2):
    """Make 25 data about 0 and 20 about 2."""
    rng = np.random.default_rng(seed)
    steps = np.repeat([[0.0], [2.0]], [25, 20], axis=0)
    return steps + rng.normal(0.0, 0.3, (45, features))


def test_run_lengths_are_those_of_the_twin():
    data = signal()
    runs = RunLengths(prior(2), HAZARD, longest=100)
    for x, expected in zip(data, twin(data), strict=True):
        runs.update(x)
        assert np.exp(runs.log_probability) == pytest.approx(expected, abs=1e-9)


def test_a_step_of_the_signal_is_a_new_run():
    runs = RunLengths(prior(2), HAZARD, longest=100)
    best = []
    for x in signal():
        runs.update(x)
        best.append(int(runs.log_probability.argmax()))
    assert best[10:25] == list(range(11, 26))  # all data so far
    assert best[30:] == list(range(6, 21))  # those since the step


@pytest.mark.parametrize("longest", [12, 30])
def test_cut_short_the_run_lengths_stay_nearly_the_same_in_constant_memory(longest):
    data = signal()
    runs = RunLengths(prior(2), HAZARD, longest)
    for t, (x, expected) in enumerate(zip(data, twin(data), strict=True)):
        runs.update(x)
        here = np.exp(runs.log_probability)
        assert here.size == min(t + 2, longest + 1)
        assert here.sum() == pytest.approx(1.0)
        assert here[:longest] == pytest.approx(expected[:longest], abs=0.05)


NARROW = np.full(ROOM.size, 0.9)


def test_changes_are_marked_where_they_came_after_the_lag():
    rng = np.random.default_rng(0)

    def ranges(x):
        return (ROOM if x < 8.0 - 1e-6 or x >= 16.0 - 1e-6 else NARROW) * rng.normal(
            1, 0.01, ROOM.size
        )

    drive = straight(24.0, ranges=ranges)
    marks = designate(make_designator("bocpd"), drive)
    assert spots(drive, marks)[:, 0] == pytest.approx([8.0, 16.0], abs=0.15)
    assert all(mark.strength > 0.5 for mark in marks)
    at_m = travelled(drive)
    for mark in marks:
        assert 0.5 <= at_m[mark.decided_scan] - at_m[mark.scan] <= 1.0


def test_noise_is_no_change():
    rng = np.random.default_rng(0)
    drive = straight(60.0, ranges=lambda _: ROOM * rng.normal(1, 0.02, ROOM.size))
    assert designate(make_designator("bocpd"), drive) == []
