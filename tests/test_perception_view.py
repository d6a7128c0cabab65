"""The view descriptor."""

import itertools
import math

import numpy as np
import pytest

from ssrics_like.errors import SettingsError
from ssrics_like.perception import describe_view


def test_a_dot_product_of_views_is_a_pearson_correlation():
    rng = np.random.default_rng(0)
    scans = rng.uniform(0.5, 8, (2, 180))
    one, other = (describe_view(scan, 36) for scan in scans)
    medians = np.median(scans.reshape(2, 36, 5), axis=2)
    assert one.dtype == np.float32
    assert one.shape == (36,)
    assert one @ other == pytest.approx(np.corrcoef(medians)[0, 1], abs=1e-6)
    assert one @ one == pytest.approx(1, abs=1e-6)


@pytest.mark.parametrize("beams", [37, 180, 181, 361, 682])
def test_every_beam_count_is_cut_into_equal_parts(beams):
    rng = np.random.default_rng(beams)
    scan = rng.uniform(0.5, 8, beams)
    edges = np.arange(37) * beams // 36
    medians = np.array([np.median(scan[a:b]) for a, b in itertools.pairwise(edges)])
    medians -= medians.mean()
    expected = medians / np.linalg.norm(medians)
    assert describe_view(scan, 36) == pytest.approx(expected, abs=1e-6)


def test_a_part_narrower_than_a_beam_takes_the_beam_that_covers_it():
    view = describe_view([1.0, 3.0], 4)
    assert view.tolist() == [-0.5, -0.5, 0.5, 0.5]


def test_one_bad_beam_does_not_show():
    scan = 3 + np.repeat(np.sin(np.linspace(0, 6, 36)), 5)
    spoilt = scan.copy()
    spoilt[[2, 60, 121]] = [80, math.nan, math.inf]
    assert describe_view(spoilt, 36).tolist() == describe_view(scan, 36).tolist()


def test_constant_and_blind_scans_have_a_view_of_zeros():
    for scan in (np.full(180, 8.0), np.full(180, math.nan), [5.0]):
        assert describe_view(scan, 12).tolist() == [0.0] * 12


def test_a_part_without_an_answer_stands_at_the_mean():
    view = describe_view([1.0, math.nan, 3.0], 3)
    assert view == pytest.approx([-math.sqrt(0.5), 0, math.sqrt(0.5)])


@pytest.mark.parametrize("size", [1, 0, 2.5, "many"])
def test_a_size_without_a_correlation_is_refused(size):
    with pytest.raises(SettingsError, match="view_beams is"):
        describe_view(np.ones(180), size)
