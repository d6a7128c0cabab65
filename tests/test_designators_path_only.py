"""Designators that look at the path alone, and the report's rule."""

import math

import numpy as np
import pytest
from designator_drives import observation, spots, straight
from scipy import stats

from ssrics_like.designators import designate, make_designator
from ssrics_like.designators.report_rule import ReportRuleSettings
from ssrics_like.perception import PerceptionBuffer
from ssrics_like.scenarios.modules import load_perception


@pytest.mark.parametrize(("metres", "every_m"), [(20.0, 3.0), (12.0, 3.0), (2.9, 3.0), (30.0, 0.7)])
def test_every_so_many_metres_there_is_one_mark(metres, every_m):
    drive = straight(metres)
    marks = designate(make_designator("every-metres", every_m=every_m), drive)
    count = math.floor(metres / every_m + 1e-9)
    assert len(marks) == count
    expected = every_m * np.arange(1, count + 1)
    assert spots(drive, marks)[:, 0] == pytest.approx(expected, abs=0.05 + 1e-9)
    assert all(mark.scan == mark.decided_scan for mark in marks)


def test_scans_farther_apart_than_the_distance_are_each_marked_once():
    drive = straight(20.0, spacing_m=2.0)
    marks = designate(make_designator("every-metres", every_m=0.5), drive)
    assert [mark.scan for mark in marks] == list(range(1, 11))
    marks = designate(make_designator("random", per_100_m=5000.0), drive)
    assert [mark.scan for mark in marks] == list(range(1, 11))


def test_random_marks_have_the_rate_and_gaps_of_a_poisson_process():
    drive = straight(5000.0, spacing_m=0.5)
    marks = designate(make_designator("random", per_100_m=10.0, seed=3), drive)
    assert len(marks) == pytest.approx(500, abs=4 * math.sqrt(500))
    gaps = np.diff(spots(drive, marks)[:, 0])
    assert stats.kstest(gaps, stats.expon(scale=10.0).cdf).pvalue > 0.001
    assert stats.kstest(gaps, stats.uniform(0.0, 20.0).cdf).pvalue < 0.001


def test_random_marks_are_those_of_the_seed():
    drive = straight(200.0, spacing_m=0.5)
    marks = [designate(make_designator("random", seed=seed), drive) for seed in (1, 1, 2)]
    assert marks[0] == marks[1] != marks[2]


def corner(turn_rad, spot=True):
    """Drive 5 m, turn on the spot in 20 scans or along 1 m of path, drive 5 m."""
    poses = [(0.05 * k, 0.0, 0.0) for k in range(100)]
    x, y, theta = poses[-1]
    for _ in range(20):
        theta += turn_rad / 20
        if not spot:
            x, y = x + 0.05 * math.cos(theta), y + 0.05 * math.sin(theta)
        poses.append((x, y, theta))
    for _ in range(100):
        x, y = x + 0.05 * math.cos(theta), y + 0.05 * math.sin(theta)
        poses.append((x, y, theta))
    return [observation(k, pose) for k, pose in enumerate(poses)]


@pytest.mark.parametrize("turn_rad", [1.57, -1.57, 3.1, 2 * math.pi])
def test_a_turn_on_the_spot_is_marked_where_it_was_made(turn_rad):
    drive = corner(turn_rad)
    marks = designate(make_designator("turning", threshold_rad=1.2), drive)
    assert len(marks) == 1
    assert spots(drive, marks)[0] == pytest.approx([4.95, 0.0], abs=0.2)
    assert marks[0].strength == pytest.approx(abs(turn_rad), rel=0.15)


def test_a_curve_is_marked_in_its_middle():
    drive = corner(math.pi / 2, spot=False)
    marks = designate(make_designator("turning", threshold_rad=0.5), drive)
    assert len(marks) == 1
    assert marks[0].scan == pytest.approx(110, abs=3)
    # Weights of a triangle over a curve as long as it: half of the turn.
    assert marks[0].strength == pytest.approx(math.pi / 4, rel=0.1)


@pytest.mark.parametrize("turn_rad", [0.0, 0.4])
def test_a_slight_turn_is_not_marked(turn_rad):
    assert designate(make_designator("turning", threshold_rad=0.5), corner(turn_rad)) == []


def test_the_settings_of_the_report_are_those_of_its_profile():
    profile, settings = load_perception("report"), ReportRuleSettings()
    for name in ("advance", "mark", "interval", "gradient", "threshold", "range_cap_m"):
        assert getattr(settings, name) == getattr(profile, name), name


def wander(scans=600, seed=0):
    rng = np.random.default_rng(seed)
    ranges = 3.0 + np.sin(np.linspace(0.0, 6.0, 60))
    seen = []
    for k in range(scans):
        if k // 60 % 2:
            ranges = np.clip(ranges + rng.normal(0.0, 0.3, 60), 0.5, 7.5)
        seen.append(observation(k, (0.05 * k, 0.0, 0.0), ranges + rng.normal(0.0, 0.002, 60)))
    return seen


@pytest.mark.parametrize("advance", ["tumbling", "sliding"])
@pytest.mark.parametrize("mark", ["every", "onset", "peak"])
def test_the_report_marks_the_reflexes_of_its_perception(advance, mark):
    drive = wander()
    profile = load_perception("report").model_copy(
        update={"advance": advance, "mark": mark, "interval": 20}
    )
    buffer = PerceptionBuffer(profile)
    reflexes = [reflex for seen in drive for reflex in buffer.update(seen)] + buffer.flush()
    chosen = {"advance": advance, "mark": mark, "interval": 20}
    marks = designate(make_designator("report", **chosen, sector_check=False), drive)
    assert [(m.scan, m.strength) for m in marks] == [(r.scan, r.novelty) for r in reflexes]
    changes, last = [], None
    for reflex in reflexes:
        if reflex.sector != last:
            changes.append(reflex.scan)
            last = reflex.sector
    checked = designate(make_designator("report", **chosen), drive)
    assert [m.scan for m in checked] == changes
    assert len(changes) > 0
    assert len(changes) < len(reflexes) or mark != "every"
