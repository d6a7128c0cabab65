"""Features of a single scan in closed form, and the classifier that learns from them."""

import itertools
import math

import numpy as np
import pytest
from buildings import DOOR, exact_laser, two_rooms
from designator_drives import driven, spots

from ssrics_like.designators import designate, make_designator, scan_features, train
from ssrics_like.designators.scan_features import FEATURES
from ssrics_like.errors import SettingsError
from ssrics_like.perception.observation import LaserScan

ALL_ROUND = (-math.pi, math.radians(1.0))  # 360 beams
HALF = (math.radians(-89.5), math.radians(1.0))  # 180 beams


def named(ranges_m, geometry):
    features = scan_features(LaserScan(np.asarray(ranges_m, float), *geometry))
    return dict(zip(FEATURES, features, strict=True))


def test_a_circle_about_the_laser():
    n, radius = 360, 2.0
    f = named(np.full(n, radius), ALL_ROUND)
    area = n / 2 * radius**2 * math.sin(math.tau / n)
    perimeter = 2 * n * radius * math.sin(math.pi / n)
    assert f["area"] == pytest.approx(area)
    assert f["perimeter"] == pytest.approx(perimeter)
    assert f["form_factor"] == pytest.approx(4 * math.pi * area / perimeter**2)
    assert f["form_factor"] == pytest.approx(1.0, abs=1e-3)
    assert f["compactness"] == pytest.approx(1.0, abs=1e-3)
    assert (f["outline_mean"], f["outline_std"]) == pytest.approx((radius, 0.0), abs=1e-9)
    # The second moment of a circle about its middle is r^2 / 2 along each axis.
    assert f["axis_major"] == pytest.approx(radius / math.sqrt(2))
    assert f["axis_ratio"] == pytest.approx(1.0)
    assert f["elongation"] == pytest.approx(0.0, abs=1e-6)
    assert [f[name] for name in FEATURES if name.startswith("fourier")] == pytest.approx(
        [0.0] * 11, abs=1e-9
    )
    assert f["step_mean"] == f["range_std"] == f["gaps_0.25m"] == 0.0
    assert f["gaps_relative_mean"] == f["range_over_most_mean"] == 1.0


def test_a_half_circle_is_closed_through_the_laser():
    f = named(np.full(180, 2.0), HALF)
    arc = 179 * 2 * 2.0 * math.sin(math.radians(0.5))
    assert f["area"] == pytest.approx(179 / 2 * 4.0 * math.sin(math.radians(1.0)))
    assert f["perimeter"] == pytest.approx(arc + 4.0)


def test_beams_of_two_lengths():
    """Every tenth beam is 1 m, the others 3 m: 36 dips, 72 steps less that across the end."""
    ranges = np.where(np.arange(360) % 10 == 5, 1.0, 3.0)
    f = named(ranges, ALL_ROUND)
    steps = 72 / 359
    assert f["step_mean"] == pytest.approx(2.0 * steps)
    assert f["step_std"] == pytest.approx(2.0 * math.sqrt(steps * (1 - steps)))
    assert (f["step_mean_to_1m"], f["step_mean_to_2m"]) == pytest.approx((0.0, steps))
    assert f["range_mean"] == pytest.approx(2.8)
    assert f["range_over_most_mean"] == pytest.approx(2.8 / 3.0)
    assert [f[f"gaps_{gap}m"] for gap in ("0.25", "0.5", "1", "2")] == [72, 72, 72, 0]
    assert f["gaps_relative_mean"] == pytest.approx(1.0 - steps * 2 / 3)
    # The two lowest minima are the first two dips, 10 degrees apart at 1 m.
    assert f["minima_angle"] == pytest.approx(math.radians(10))
    assert f["minima_distance"] == pytest.approx(2 * math.sin(math.radians(5)))


def test_a_corridor_is_long_and_a_square_is_not():
    angles = np.radians(np.arange(-180, 180))

    def box(half_x, half_y):
        with np.errstate(divide="ignore"):
            return np.minimum(half_x / np.abs(np.cos(angles)), half_y / np.abs(np.sin(angles)))

    square, corridor = named(box(1.5, 1.5), ALL_ROUND), named(box(6.0, 1.0), ALL_ROUND)
    assert square["area"] == pytest.approx(9.0, rel=0.01)
    assert corridor["area"] == pytest.approx(24.0, rel=0.02)
    assert corridor["perimeter"] == pytest.approx(28.0, rel=0.02)
    assert square["axis_ratio"] == pytest.approx(1.0, abs=0.01)
    assert corridor["axis_ratio"] < 0.5
    assert corridor["form_factor"] < square["form_factor"]


INVARIANT = ("area", "perimeter", "form_factor", "compactness", "axis_major", "axis_minor",
             "kurtosis", *(name for name in FEATURES if name.startswith("fourier")))  # fmt: skip


def test_a_laser_that_looks_all_round_may_be_turned():
    rng = np.random.default_rng(0)
    ranges = 3.0 + 2.0 * np.sin(np.radians(np.arange(360) * 2)) + rng.uniform(0, 0.5, 360)
    here, turned = named(ranges, ALL_ROUND), named(np.roll(ranges, 77), ALL_ROUND)
    for name in INVARIANT:
        assert turned[name] == pytest.approx(here[name], rel=1e-6, abs=1e-9), name
    assert here["axis_ratio"] < 0.95


def test_features_hardly_depend_on_the_number_of_beams():
    coarse, fine = (
        driven(two_rooms(), [(1.0, 1.5), (1.2, 1.5)], laser)[0].scan
        for laser in (exact_laser(181, 181.0), exact_laser(724, 181.0))
    )
    few, many = scan_features(coarse), scan_features(fine)
    for name, one, other in zip(FEATURES, few, many, strict=True):
        if not name.startswith(("gaps", "minima", "fourier")):
            assert one == pytest.approx(other, rel=0.1, abs=0.02), name


def test_any_number_of_beams_has_finite_features():
    for beams in (1, 2, 3, 5, 1081):
        features = scan_features(LaserScan(np.linspace(0.5, 3.0, beams), -0.5, 0.003))
        assert features.shape == (len(FEATURES),)
        assert np.isfinite(features).all()
    assert scan_features(LaserScan(np.full(9, math.nan), 0.0, 0.1)) is None


WAYS = ([(1.0, 1.5), (5.0, 1.5)], [(1.2, 0.9), DOOR, (4.9, 2.2)], [(4.8, 1.9), DOOR, (1.0, 1.2)])


def labelled(ways):
    scans, labels = [], []
    for way in ways:
        for seen in driven(two_rooms(), way):
            scans.append(seen.scan)
            labels.append(math.dist((seen.pose.x_m, seen.pose.y_m), DOOR) < 0.4)
    return scans, labels


def test_a_trained_model_marks_the_door_on_a_drive_that_it_has_not_seen():
    pytest.importorskip("sklearn")
    model = train(*labelled(WAYS), seed=0)
    drive = driven(two_rooms(), [(1.1, 1.7), DOOR, (5.0, 1.3)])
    marks = designate(make_designator("boosted-scan", model=model, threshold=0.5), drive)
    assert len(marks) == 1
    assert math.dist(spots(drive, marks)[0], DOOR) < 0.5
    here = [model.probability(seen.scan) for seen in drive]
    assert marks[0].strength == max(here)
    again = train(*labelled(WAYS), seed=0)
    assert here == [again.probability(seen.scan) for seen in drive]
    assert math.isnan(model.probability(LaserScan(np.full(180, math.nan), *HALF)))


def test_scans_without_any_answer_are_left_out_of_training():
    pytest.importorskip("sklearn")
    scans, labels = labelled(WAYS[:1])
    blind = LaserScan(np.full(180, math.nan), *HALF)
    with_blind = train([blind, *scans, blind], [True, *labels, False], seed=0)
    without = train(scans, labels, seed=0)
    assert [with_blind.probability(s) for s in scans] == [without.probability(s) for s in scans]


def test_labels_must_fit_the_scans():
    pytest.importorskip("sklearn")
    scans, labels = labelled(WAYS[:1])
    with pytest.raises(SettingsError, match=r"labels have shape \(3,\)"):
        train(scans, labels[:3], seed=0)
    for alike in ([True] * len(scans), [False] * len(scans)):
        with pytest.raises(SettingsError, match="all alike"):
            train(scans, alike, seed=0)
    assert len(set(itertools.chain(labels))) == 2
