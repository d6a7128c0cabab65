"""Bayesian surprise on drives where something changes at a known place."""

import math

import numpy as np
import pytest
from designator_drives import ROOM, observation, spots, straight
from scipy import stats

from ssrics_like.designators import designate, make_designator
from ssrics_like.designators.conjugate import dirichlet_kl
from ssrics_like.designators.readings import SUMMARY, ReadingSettings, summary
from ssrics_like.designators.surprise_histogram import PRIOR
from ssrics_like.perception.observation import LaserScan

NARROW = np.full(ROOM.size, 0.9)
BOTH = ["surprise-histogram", "surprise-gaussian"]
LOW = {"surprise-histogram": {"threshold_nats": 0.7}, "surprise-gaussian": {"threshold_nats": 0.1}}


def step(x):
    return ROOM if x < 7.0 - 1e-6 else NARROW


@pytest.mark.parametrize("name", BOTH)
def test_a_change_of_the_surroundings_is_marked_at_once_where_it_comes(name):
    drive = straight(14.0, ranges=step)
    marks = designate(make_designator(name, **LOW[name]), drive)
    assert spots(drive, marks)[:, 0] == pytest.approx([7.0])
    assert designate(make_designator(name, **LOW[name]), straight(14.0)) == []


@pytest.mark.parametrize("name", BOTH)
def test_the_number_of_beams_hardly_matters(name):
    drives = [
        [
            observation(k, (0.05 * k, 0.0, 0.0), np.full(beams, step(0.05 * k)[0]))
            for k in range(280)
        ]
        for beams in (45, 180, 720)
    ]
    marks = [designate(make_designator(name, **LOW[name]), drive) for drive in drives]
    assert [[m.scan for m in found] for found in marks] == [[140]] * 3
    strengths = [found[0].strength for found in marks]
    assert strengths == pytest.approx([strengths[1]] * 3, rel=0.02)


def test_the_strength_is_the_divergence_worked_out_by_hand():
    """Two steps of 0.1 m: 3 m everywhere, then 0.9 m everywhere; bins of 0.5 m."""
    drive = straight(0.1, spacing_m=0.1, ranges=lambda x: ROOM if x == 0 else NARROW)
    (mark,) = designate(make_designator("surprise-histogram", evidence=20.0, forget_m=2.0), drive)
    before = np.full(17, PRIOR)
    keep = math.exp(-0.1 / 2.0)
    before[6] += 20.0 / (1.0 - keep) * keep  # from 3.0 to 3.5 m, seen all along, then faded
    after = before.copy()
    after[1] += 20.0  # from 0.5 to 1.0 m
    assert mark.strength == pytest.approx(dirichlet_kl(after, before))
    draws = stats.dirichlet(after).rvs(40_000, random_state=np.random.default_rng(0))
    ratio = stats.dirichlet(after).logpdf(draws.T) - stats.dirichlet(before).logpdf(draws.T)
    assert mark.strength == pytest.approx(ratio.mean(), rel=0.02)


def test_what_was_seen_long_ago_surprises_more_than_what_was_seen_just_now():
    def strongest(forget_m, gap_m):
        def ranges(x):
            return NARROW if 5.0 <= x < 6.0 or 6.0 + gap_m <= x else ROOM

        drive = straight(12.0 + gap_m, ranges=ranges)
        chosen = {"forget_m": forget_m, "threshold_nats": 0.02, "apart_m": 1.0}
        marks = designate(make_designator("surprise-histogram", **chosen), drive)
        return next(m.strength for m in marks if drive[m.scan].pose.x_m >= 6.0 + gap_m - 0.1)

    assert strongest(4.0, 20.0) > 2.0 * strongest(4.0, 2.0)
    assert strongest(1000.0, 20.0) < strongest(4.0, 20.0)


def test_the_summary_of_a_scan_is_finite_for_any_number_of_beams():
    for beams in range(1, 12):
        scan = LaserScan(np.linspace(1.0, 2.0, beams), -0.5, 0.1)
        features = summary(scan, ReadingSettings())
        assert features.shape == (len(SUMMARY),)
        assert np.isfinite(features).all()
    assert summary(LaserScan(np.full(5, math.nan), 0.0, 0.1), ReadingSettings()) is None


def test_the_summary_is_of_logarithms_of_the_share_of_the_cap():
    """Twice the ranges under twice the cap are the same scan; NaN beams are left out."""
    rng = np.random.default_rng(0)
    ranges = rng.uniform(0.5, 7.5, 60)
    here = summary(LaserScan(ranges, -1.0, 0.03), ReadingSettings())
    twice = summary(LaserScan(2.0 * ranges, -1.0, 0.03), ReadingSettings(range_cap_m=16.0))
    assert here == pytest.approx(twice)
    with_nan = np.insert(ranges, 30, math.nan)
    left_out = summary(LaserScan(with_nan, -1.0, 0.03), ReadingSettings(repair_window=0))
    assert left_out == pytest.approx(here)
    mean = SUMMARY.index("mean")
    assert here[mean] * 0.4 - 1.4 == pytest.approx(np.log(ranges / 8.0).mean())
    mirrored = summary(LaserScan(ranges[::-1], -1.0, 0.03), ReadingSettings())
    right, left = SUMMARY.index("near_right"), SUMMARY.index("near_left")
    assert (mirrored[right], mirrored[left]) == pytest.approx((here[left], here[right]))
