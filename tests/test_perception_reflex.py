"""The perception buffer: when it fires, and what a reflex says."""

import dataclasses
import math

import numpy as np
import pytest

from ssrics_like.perception import (
    LaserScan,
    NoveltyDetector,
    Observation,
    PerceptionBuffer,
    PerceptionProfile,
    Pose,
    ScanError,
    classify,
    condition,
    describe_view,
    novelty_profile,
)

BEAMS = 60
STEP_RAD = math.pi / BEAMS


def observation(index, ranges, angle_min=-math.pi / 2, step=STEP_RAD):
    return Observation(
        index=index,
        t_s=100.0 + 0.1 * index,
        pose=Pose(0.05 * index, 1.0, 0.0),
        scan=LaserScan(np.asarray(ranges, float), angle_min, step),
        true_pose=Pose(0.05 * index, 1.1, 0.0),
    )


def walk(scans, seed=0, beams=BEAMS):
    """Stand still, hurry, stand still, and so on; with a few dropouts."""
    rng = np.random.default_rng(seed)
    ranges = 4 + 2 * np.sin(np.linspace(0, 5, beams))
    rows = []
    for k in range(scans):
        if k % 40 >= 20:
            ranges = np.clip(ranges + rng.normal(0, 0.3, beams), 0.5, 7.5)
        row = ranges + rng.normal(0, 0.002, beams)
        row[rng.uniform(size=beams) < 0.01] = math.inf
        rows.append(row)
    return np.array(rows)


def profile(**settings):
    return PerceptionProfile(**{"interval": 10, "gradient": 0.99, **settings})


def run(buffer, rows):
    fired = []
    for k, row in enumerate(rows):
        fired += buffer.update(observation(k, row))
    return fired, buffer.flush()


ROWS = walk(200)
CONDITIONED = np.array([condition(row, 8.0, 5).ranges_m for row in ROWS])


@pytest.mark.parametrize("advance", ["sliding", "tumbling"])
@pytest.mark.parametrize(("anchor", "back"), [("newest", 0), ("middle", 4), ("oldest", 9)])
def test_every_novel_interval_fires_with_its_anchor_scan(advance, anchor, back):
    buffer = PerceptionBuffer(profile(mark="every", advance=advance, anchor=anchor))
    fired, rest = run(buffer, ROWS)
    taus = novelty_profile(CONDITIONED, 10, advance=advance)
    ends = np.arange(9, 200, 1 if advance == "sliding" else 10)
    assert rest == []
    expected = [(end, tau) for end, tau in zip(ends, taus, strict=True) if not tau > 0.75]
    assert 5 < len(expected) < len(taus)
    assert len(fired) == len(expected)
    for event, (reflex, (end, tau)) in enumerate(zip(fired, expected, strict=True)):
        scan = int(end) - back
        seen = observation(scan, ROWS[scan])
        assert (reflex.event, reflex.scan) == (event, scan)
        assert (reflex.t_s, reflex.pose, reflex.true_pose) == (seen.t_s, seen.pose, seen.true_pose)
        assert reflex.perceived_s == observation(int(end), ROWS[0]).t_s
        assert (reflex.modality, reflex.structure) == ("laser", "unknown")
        assert reflex.novelty == 1 - tau
        assert reflex.sector == classify(CONDITIONED[scan], seen.scan.bearings_rad)
        assert reflex.view.tolist() == describe_view(CONDITIONED[scan], 36).tolist()


def test_counters_give_the_novel_share_and_the_onsets():
    for mark in ("every", "onset", "peak"):
        buffer = PerceptionBuffer(profile(mark=mark))
        run(buffer, ROWS)
        novel = ~(novelty_profile(CONDITIONED, 10) > 0.75)
        assert buffer.intervals == 191
        assert buffer.novel_intervals == novel.sum()
        onsets = int(novel[0]) + np.count_nonzero(novel[1:] & ~novel[:-1])
        assert buffer.onsets == onsets >= 3
        assert buffer.restarts == 0


def test_quotient_and_novelty_are_those_of_the_latest_interval():
    buffer = PerceptionBuffer(profile())
    taus = novelty_profile(CONDITIONED, 10)
    for k, row in enumerate(ROWS[:30]):
        buffer.update(observation(k, row))
        if k < 9:
            assert (buffer.tau, buffer.novelty) == (None, None)
        else:
            assert (buffer.tau, buffer.novelty) == (taus[k - 9], 1 - taus[k - 9])


def test_onset_fires_once_a_stretch():
    buffer = PerceptionBuffer(profile(mark="onset"))
    fired, rest = run(buffer, ROWS)
    assert rest == []
    assert len(fired) == buffer.onsets


def test_a_peak_keeps_its_own_time_and_place_though_it_is_reported_later():
    buffer = PerceptionBuffer(profile(mark="peak", anchor="newest", prominence=0.2))
    fired, rest = run(buffer, ROWS)
    taus = novelty_profile(CONDITIONED, 10)
    assert len(fired) + len(rest) >= 3
    for reflex in fired + rest:
        assert reflex.novelty == 1 - taus[reflex.scan - 9]
        near = taus[max(reflex.scan - 9 - 3, 0) : reflex.scan - 9 + 4]
        assert reflex.novelty == 1 - near.min()
        assert reflex.perceived_s > reflex.t_s or reflex in rest
    assert [r.event for r in fired + rest] == list(range(len(fired + rest)))


def test_flush_reports_a_peak_that_was_kept_back_only_once():
    buffer = PerceptionBuffer(profile(mark="peak"))
    fired, (kept,) = run(buffer, ROWS[:38])
    assert fired == []
    assert kept.perceived_s == observation(37, ROWS[0]).t_s
    assert buffer.flush() == []


def test_examples_are_the_intervals_nearest_to_the_reports_figures():
    buffer = PerceptionBuffer(profile())
    assert buffer.example_novel is None
    assert buffer.example_bored is None
    run(buffer, ROWS)
    taus = novelty_profile(CONDITIONED, 10)
    novel = ~(taus > 0.75)
    for example, wanted, kind in (
        (buffer.example_novel, 0.34, novel),
        (buffer.example_bored, 0.96, ~novel),
    ):
        distance = np.where(kind, np.abs(taus - wanted), np.inf)
        assert example.interval == int(np.argmin(distance))
        assert example.scan == example.interval + 9
        assert example.tau == taus[example.interval]
        assert np.count_nonzero(example.correlations > 0.99) / 45 == example.tau


def test_a_laser_that_changes_restarts_the_interval():
    other = walk(60, seed=1, beams=40)
    buffer = PerceptionBuffer(profile(mark="peak"))
    before, _ = [], None
    for k, row in enumerate(ROWS[:35]):
        before += buffer.update(observation(k, row))
    intervals = buffer.intervals
    at_change = buffer.update(observation(35, other[0], step=math.pi / 40))
    assert buffer.restarts == 1
    assert len(before + at_change) == 1  # the peak so far is not lost
    assert (before + at_change)[0].scan < 35
    for k in range(1, 9):
        buffer.update(observation(35 + k, other[k], step=math.pi / 40))
    assert buffer.intervals == intervals
    buffer.update(observation(44, other[9], step=math.pi / 40))
    assert buffer.intervals == intervals + 1
    assert buffer.tau == novelty_profile(
        [condition(row, 8.0, 5).ranges_m for row in other[:10]], 10
    )
    # The same number of beams elsewhere is another laser too; rounding is not.
    buffer.update(observation(45, other[10], angle_min=-1.5707963, step=math.pi / 40))
    assert buffer.restarts == 1
    buffer.update(observation(46, other[11], angle_min=-1.0, step=math.pi / 40))
    assert buffer.restarts == 2


def test_a_refused_scan_leaves_the_buffer_as_it_was():
    buffer = PerceptionBuffer(profile())
    with pytest.raises(ScanError, match="observation 0 has no beams"):
        buffer.update(observation(0, []))
    with pytest.raises(ScanError, match="bearings do not rise"):
        buffer.update(observation(0, ROWS[0], step=-STEP_RAD))
    for k, row in enumerate(ROWS[:10]):
        buffer.update(observation(k, row))
    with pytest.raises(ScanError, match="observation 10 has no beams"):
        buffer.update(observation(10, []))
    assert (buffer.restarts, buffer.intervals) == (0, 1)
    buffer.update(observation(10, ROWS[10]))
    assert (buffer.restarts, buffer.intervals) == (0, 2)


def test_constant_and_blind_scans_pass_through():
    buffer = PerceptionBuffer(profile(mark="every"))
    rows = [np.full(BEAMS, math.inf)] * 10 + [np.full(BEAMS, math.nan)] * 10
    fired, _ = run(buffer, rows)
    assert buffer.tau == 0.0  # nothing in common: novel
    assert fired[-1].sector == "front"
    assert not fired[-1].view.any()


def test_repair_keeps_a_robot_that_stands_still_bored_in_spite_of_dropouts():
    rng = np.random.default_rng(3)
    wall = 4 + 2 * np.sin(np.linspace(0, 5, 180))
    rows = [np.where(rng.uniform(size=180) < 0.02, math.inf, wall) for _ in range(60)]
    shares = []
    for window in (0, 5):
        buffer = PerceptionBuffer(PerceptionProfile(repair_window=window))
        for k, row in enumerate(rows):
            buffer.update(observation(k, row, step=math.pi / 180))
        shares.append(buffer.novel_intervals / buffer.intervals)
    assert shares == [1.0, 0.0]


def test_the_buffer_and_the_detector_agree_on_settings():
    buffer = PerceptionBuffer(PerceptionProfile(interval=5, gradient=0.9, advance="tumbling"))
    detector = NoveltyDetector(5, 0.9, "tumbling")
    for k, row in enumerate(ROWS[:50]):
        buffer.update(observation(k, row))
        tau = detector.update(CONDITIONED[k])
        if tau is not None:
            assert buffer.tau == tau


def test_a_reflex_cannot_be_changed():
    buffer = PerceptionBuffer(profile(mark="every"))
    fired, _ = run(buffer, ROWS[:40])
    with pytest.raises(dataclasses.FrozenInstanceError):
        fired[0].novelty = 0.0
