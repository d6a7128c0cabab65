"""How well landmarks are known again, on marks made by hand."""

import numpy as np
import pytest

from ssrics_like.comparison.recognition import Marked, Recogniser, RecognitionTally

PLACES = np.array([[0.0, 0.0], [5.0, 0.0], [10.0, 0.0]])


def at(x_m, decision, landmark=""):
    return Marked(x_m, 0.0, decision, landmark)


def test_each_mark_counts_where_it_belongs():
    marks = [
        at(0.1, "declared", "L1"),
        at(5.9, "declared", "L2"),
        at(-0.9, "recognised", "L1"),  # the same place, though a metre off
        at(4.2, "recognised", "L1"),  # another
        at(4.9, "declared", "L3"),  # a second landmark of the second place
        at(0.0, "unsure"),
        at(7.3, "declared", "L4"),  # of no labelled place
        at(7.7, "recognised", "L4"),
        at(10.0, "unsure"),
    ]
    tally = Recogniser(PLACES).count(marks)
    assert tally == RecognitionTally(
        marks=9, again=5, right=2, doubled=1, unsure=2, recognised=3, wrong=1, declared=4,
        landmarks=3, places=2,
    )  # fmt: skip
    assert tally.recall == pytest.approx(2 / 5)
    assert tally.wrong_share == pytest.approx(1 / 3)
    assert tally.new_share == pytest.approx(4 / 9)
    assert tally.landmarks_per_place == 1.5
    low, high = tally.recall_interval
    assert 0 < low < 0.4 < high < 1


def test_a_second_drive_knows_the_landmarks_of_the_first():
    recogniser = Recogniser(PLACES)
    recogniser.count([at(0.0, "declared", "L1")])
    second = recogniser.count([at(0.2, "recognised", "L1"), at(10.0, "declared", "L2")])
    assert (second.again, second.right, second.declared, second.landmarks) == (1, 1, 1, 2)
    total = RecognitionTally(marks=1) + second
    assert total.marks == 3


def test_without_labels_nearness_decides():
    tally = Recogniser(np.empty((0, 2))).count(
        [at(0.0, "declared", "L1"), at(0.5, "recognised", "L1"), at(0.7, "recognised", "L1")]
    )
    assert (tally.again, tally.right, tally.wrong) == (1, 1, 1)
    assert np.isnan(RecognitionTally().recall)


def test_a_landmark_that_was_never_declared_is_refused():
    with pytest.raises(ValueError, match="'L7' is recognised but was never declared"):
        Recogniser(PLACES).count([at(0.0, "recognised", "L7")])
