"""Activation noise: logistic, clipped as in ACT-R."""

import math

import numpy as np
import pytest

from ssrics_like.memory.noise import activation_noise

DRAWS = 200_000


def clipped_variance():
    """Variance for s = 1, by the midpoint rule over p."""
    p = np.clip((np.arange(1_000_000) + 0.5) / 1_000_000, 1e-4, 1 - 1e-4)
    return float(np.mean(np.log((1 - p) / p) ** 2))


@pytest.mark.parametrize("scale", [0.1, 0.25, 0.5, 1.0])
def test_mean_is_zero_and_variance_that_of_a_logistic(scale):
    drawn = activation_noise(np.random.default_rng(1), scale, DRAWS)
    logistic = math.pi**2 * scale**2 / 3
    assert abs(drawn.mean()) < 5 * math.sqrt(logistic / DRAWS)
    assert drawn.var() == pytest.approx(logistic, rel=0.02)
    assert drawn.var() == pytest.approx(clipped_variance() * scale**2, rel=0.02)


def test_clipping_takes_a_fraction_of_a_percent_of_the_variance():
    assert 0.99 < clipped_variance() / (math.pi**2 / 3) < 1


def test_no_draw_exceeds_the_bound():
    drawn = activation_noise(np.random.default_rng(2), 2.0, DRAWS)
    assert np.abs(drawn).max() == pytest.approx(2.0 * math.log(9999), rel=1e-12)


def test_quantiles_are_those_of_a_logistic():
    drawn = activation_noise(np.random.default_rng(3), 0.7, DRAWS)
    for p in (0.1, 0.25, 0.5, 0.9):
        assert np.quantile(drawn, p) == pytest.approx(0.7 * math.log(p / (1 - p)), abs=0.02)


def test_the_same_seed_gives_the_same_noise():
    first, second = (activation_noise(np.random.default_rng(4), 1.0, 9) for _ in range(2))
    assert first.tolist() == second.tolist()
