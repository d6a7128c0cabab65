"""What a place is called: by its width, or by what was learned."""

import math

import numpy as np
import pytest
from buildings import Along, exact_laser, exact_robot, line, room, simulated

from ssrics_like.perception import PerceptionBuffer, PerceptionProfile
from ssrics_like.perception.layout import LAYOUT
from ssrics_like.perception.structure import KINDS, StructureCue, StructureWatch
from ssrics_like.perception.trees import BoostedTrees

THRESHOLDS = {"opening": 0.2, "junction": 0.5, "corner": 0.4, "hallway": 0.5}


def stump(name, at_most, below, above):
    """Return a tree with one question: log odds where a measure is at most so much, and above."""
    return BoostedTrees(
        0.0, np.array([0], np.int32), np.array([LAYOUT.index(name), -1, -1], np.int32),
        np.array([at_most, 0.0, 0.0]), np.array([1, -1, -1], np.int32),
        np.array([2, -1, -1], np.int32), np.array([0.0, below, above]),
    )  # fmt: skip


# Openings are never seen; where one goes on far to one side is a junction if it goes on ahead too.
BY_HAND = StructureCue(
    {
        "opening": stump("walls_oblique_rad", 1e9, -5.0, 0.0),
        "junction": stump("walls_greater_strip_m", 3.0, -5.0, 2.0),
        "corner": stump("walls_ahead_strip_m", 1.5, 4.0, -5.0),
        "hallway": stump("walls_lesser_strip_m", 1.5, 5.0, -5.0),
    },
    THRESHOLDS,
)


@pytest.mark.parametrize(
    ("sure", "word"),
    [
        ((0.0, 0.0, 0.0, 0.5), "corridor"),
        ((0.19, 0.49, 0.39, 0.49), "room"),
        ((0.2, 0.49, 0.39, 0.9), "opening"),
        ((0.3, 0.6, 0.5, 0.9), "junction"),
        ((0.3, 0.4, 0.45, 0.1), "corner"),
        ((0.9, 0.6, 0.5, 0.1), "opening"),
        ((0.6, 0.6, 0.6, 0.1), "opening"),
    ],
)
def test_the_most_certain_spot_that_is_certain_enough_names_a_place(sure, word):
    assert BY_HAND.word(np.array(sure)) == word


def test_probabilities_come_in_the_order_of_the_kinds():
    measures = np.zeros(len(LAYOUT))
    measures[LAYOUT.index("walls_greater_strip_m")] = 4.0
    expected = [1.0 / (1.0 + math.exp(-odds)) for odds in (-5.0, 2.0, 4.0, 5.0)]
    assert BY_HAND.probabilities(measures).tolist() == pytest.approx(expected)
    assert KINDS == ("opening", "junction", "corner", "hallway")


class Told:
    """Stands for a cue: probabilities are the measures, and so is the word."""

    def probabilities(self, measures):
        return measures

    def word(self, certainties):
        return certainties


def naive_mean(values, place):
    around = [values[i] for i in range(place - 2, place + 3) if 0 <= i < len(values)]
    return sum(around) / len(around)


def test_a_word_is_for_the_mean_of_a_place_and_its_neighbours():
    values = np.random.default_rng(2).random(30)
    watch = StructureWatch(Told(), 30)
    for i, value in enumerate(values):
        watch.update(0.1 * i, np.array([value]))
    for place in range(30):
        for off_m in (-0.04, 0.0, 0.04):
            word = watch.word_at(0.1 * place + off_m)
            assert word == pytest.approx(naive_mean(values, place))


def test_so_many_places_back_words_are_as_if_nothing_were_forgotten():
    values = np.random.default_rng(3).random(200)
    watch = StructureWatch(Told(), 24)
    for i, value in enumerate(values):
        watch.update(0.1 * i, np.array([value]))
        if i >= 26:
            assert watch.word_at(0.1 * (i - 23)) == pytest.approx(
                naive_mean(values[: i + 1], i - 23)
            )


def hallways(*boxes):
    grid = room(16.0, 12.0, walls=[(0.0, 0.0, 16.0, 12.0)])
    for box in boxes:
        x0, y0, x1, y1 = (round(edge / grid.cell_m) for edge in box)
        grid.cells[y0:y1, x0:x1] = 0
    return type(grid)(grid.cells, grid.cell_m)


PROFILE = PerceptionProfile(
    along="metres", structure="by hand", interval=12, mark="every", gradient=0.999
)


def reflexes(grid, places, profile=PROFILE, cue=BY_HAND):
    start = (*places[0], math.atan2(*(places[1] - places[0])[::-1]))
    buffer, fired = PerceptionBuffer(profile, None, cue), []
    for observation in simulated(grid, exact_robot(exact_laser()), start, [Along(places)]):
        fired += buffer.update(observation)
    return fired + buffer.flush()


@pytest.mark.parametrize("mark", ["every", "peak"])
def test_novel_places_in_a_drawn_t_have_their_words(mark):
    """A hallway along y = 6, 2 m wide, with a branch to the left, its middle at x = 8."""
    grid = hallways((1.0, 5.0, 15.0, 7.0), (7.0, 7.0, 9.0, 11.0))
    profile = PROFILE.model_copy(update={"mark": mark, "gradient": 0.97})
    fired = reflexes(grid, line((2.0, 6.0), (12.5, 6.0)), profile)
    words = [(r.pose.x_m, r.structure) for r in fired]
    assert all(not r.directed for r in fired)
    at_branch = {word for x, word in words if abs(x - 8.0) < 0.5}
    assert at_branch <= {"junction"}
    assert {word for x, word in words if abs(x - 8.0) > 1.9} <= {"corridor"}
    if mark == "every":
        assert len(words) > 30
        assert at_branch == {"junction"}


def test_a_cue_of_structure_alone_fires_no_reflex_of_its_own():
    grid = hallways((1.0, 5.0, 15.0, 7.0), (7.0, 7.0, 9.0, 11.0))
    way = line((2.0, 6.0), (12.5, 6.0))
    told = reflexes(grid, way)
    plain = reflexes(grid, way, PROFILE.model_copy(update={"structure": ""}), None)
    assert [r.scan for r in told] == [r.scan for r in plain]
    assert [r.perceived_s for r in told] == [r.perceived_s for r in plain]
    assert {r.structure for r in plain} == {"unknown"}


def test_a_profile_and_its_cue_come_together():
    with pytest.raises(ValueError, match="structure: 'by hand'; expected that cue"):
        PerceptionBuffer(PROFILE)
    with pytest.raises(ValueError, match="structure: ''; expected no cue"):
        PerceptionBuffer(PerceptionProfile(), None, BY_HAND)
