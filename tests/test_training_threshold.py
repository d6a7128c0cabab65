"""Passages, peaks and the threshold that finds seven of eight."""

from dataclasses import replace

import numpy as np
import pytest

from ssrics_like.perception.doorways import DoorwayCue, DoorwayWatch
from ssrics_like.perception.observation import Pose
from ssrics_like.perception.surroundings import Described
from ssrics_like.perception.walk import STEP_M, Place
from ssrics_like.training.examples import Example
from ssrics_like.training.passages import passages, tally
from ssrics_like.training.threshold import choose_threshold, peaks, scores


class Told:
    """Stands for trees: the probability is the first measure."""

    def probability(self, measures):
        return float(measures[0])


def straight(probabilities, doorways_x, others_x=()):
    """Return a drive along the x axis, with labelled places on it."""
    at = STEP_M * np.arange(1, len(probabilities) + 1)
    on = [np.column_stack([x, np.zeros(len(x))]) for x in (at, doorways_x, others_x)]
    return Example(at, on[0], np.array(probabilities)[:, None], *on[1:])


def watched(probabilities, threshold):
    """Return what the model's own watch finds: the naive twin of `peaks`."""
    watch = DoorwayWatch(DoorwayCue(Told(), threshold))
    seen = []
    for i, p in enumerate(probabilities):
        place = Place(STEP_M * (i + 2), 0.0, 0.0, 0.0, i)
        seen += watch.update(Described(place, np.array([p]), Pose(0.0, 0.0, 0.0)))
    return [one.place.place.nearest for one in seen + watch.flush()]


@pytest.mark.parametrize("seed", range(20))
def test_peaks_are_those_of_the_models_own_watch(seed):
    rng = np.random.default_rng(seed)
    p = rng.random(400)
    if seed % 2:
        p = np.round(np.convolve(p, np.ones(4) / 4, "same"), 1)  # with plateaus
    score = scores(Told(), straight(p, []))
    for threshold in (0.2, 0.5, 0.6, 0.8):
        found = peaks(score, threshold).tolist()
        assert found == watched(p, threshold)
    assert len(peaks(score, 0.2)) > 10


@pytest.mark.parametrize("length", range(5))
def test_short_drives_have_peaks_as_the_watch_has(length):
    p = [0.9] * length
    assert peaks(scores(Told(), straight(p, [])), 0.5).tolist() == watched(p, 0.5)


def test_each_time_through_a_doorway_is_a_passage():
    """Out 3 m and back, by a doorway at 2 m; another is passed 0.6 m aside, a third at the end."""
    x = np.concatenate([np.arange(0, 3, 0.1), np.arange(3, 0, -0.1)])
    xy = np.column_stack([x, np.zeros(len(x))])
    doorways = np.array([[2.0, 0.1], [1.0, 0.6], [3.2, 0.0]])
    drive = Example(0.1 * np.arange(len(x)), xy, np.empty((len(x), 0)), doorways, np.empty((0, 2)))
    found = passages(drive)
    assert found.place.tolist() == [0, 2, 0]
    assert found.along_m.tolist() == pytest.approx([2.0, 3.0, 4.0])
    assert len(passages(replace(drive, doorways_m=np.empty((0, 2))))) == 0


def test_a_peak_finds_a_passage_within_a_metre():
    drive = straight(np.zeros(200), [5.0, 10.0], [15.0])
    at = [round(x / STEP_M) - 1 for x in (4.1, 11.2, 15.5, 18.0)]
    found = tally(drive, np.array(at))
    assert (found.passages, found.passed) == (2, 1)
    assert (found.marks, found.merged, found.right) == (4, 4, 2)
    none = tally(drive, np.array([], int))
    assert (none.passages, none.passed, none.merged) == (2, 0, 0)


def test_the_highest_threshold_that_finds_seven_of_eight():
    doorways = 5.0 * np.arange(1, 11)
    sure = np.array([0.95, 0.9, 0.85, 0.8, 0.75, 0.7, 0.65, 0.6, 0.425, 0.2])
    p = np.zeros(560)
    for x, value in zip(doorways, sure, strict=True):
        middle = round(x / STEP_M) - 1
        p[middle - 2 : middle + 3] = value
    p[30:35] = 0.5  # and one where nothing is
    chosen = choose_threshold(Told(), [straight(p, doorways)])
    assert chosen.threshold == 0.42
    assert chosen.tally.pass_recall == 0.9
    assert chosen.tally.precision == 0.9
    # In two buildings the passages of both count.
    chosen = choose_threshold(Told(), [straight(p, doorways), straight(p, doorways[:8])])
    assert (chosen.tally.passages, chosen.tally.passed) == (18, 16)
    assert chosen.threshold == 0.6


def test_where_no_threshold_finds_seven_of_eight_the_lowest_is_taken():
    chosen = choose_threshold(Told(), [straight(np.zeros(100), [5.0])])
    assert chosen.threshold == 0.01
    assert chosen.tally.passed == 0
