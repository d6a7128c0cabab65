"""The report's ten bars."""

import numpy as np
import pytest

from ssrics_like.errors import SettingsError
from ssrics_like.perception import NoveltyDetector, correlation_histogram


def test_ten_equal_bins_whose_last_begins_at_the_gradient():
    counts, edges = correlation_histogram([0.995, 0.99, 0.985, 0.905, 0.2, -1.0, 1.0], 0.99)
    assert edges == pytest.approx(np.arange(0.90, 1.001, 0.01))
    assert edges[-2] == 0.99
    assert edges[-1] == 1.0
    assert counts.tolist() == [3, 0, 0, 0, 0, 0, 0, 0, 1, 3]
    assert np.issubdtype(counts.dtype, np.integer)


def test_figures_one_and_two_have_their_bored_share_in_the_last_bar():
    for bored in (420, 1176):
        counts, _ = correlation_histogram([0.9999] * bored + [0.95] * (1225 - bored))
        assert counts.sum() == 1225
        assert counts[-1] == bored


def test_the_last_bar_is_what_tau_counts():
    rng = np.random.default_rng(1)
    scans = 3 + np.cumsum(rng.normal(0, 0.03, (50, 30)), axis=0) + rng.uniform(0, 3, 30)
    detector = NoveltyDetector()
    (tau,) = [t for t in map(detector.update, scans) if t is not None]
    counts, _ = correlation_histogram(detector.correlations())
    assert 0 < tau < 1
    assert counts[-1] == round(tau * 1225)


def test_rounding_beyond_one_and_wide_bins_lose_no_pair():
    counts, edges = correlation_histogram([1 + 1e-15, -1.0], 0.5, bins=5)
    assert counts.tolist() == [0, 1, 0, 0, 1]
    assert edges[0] == -1.5
    assert correlation_histogram([])[0].tolist() == [0] * 10


@pytest.mark.parametrize(("gradient", "bins"), [(1.0, 10), (0.0, 10), (0.99, 1)])
def test_wrong_settings_are_refused(gradient, bins):
    with pytest.raises(SettingsError):
        correlation_histogram([0.5], gradient, bins)
