"""Learning structure: examples, labels, thresholds, and what is counted."""

import numpy as np
import pytest

from ssrics_like.errors import SettingsError
from ssrics_like.perception.structure import BESIDE, KINDS, StructureCue
from ssrics_like.training import drives
from ssrics_like.training.examples import Example
from ssrics_like.training.structure_examples import Asked, StructureExample, structure_example
from ssrics_like.training.structure_labels import spots, structure_labels
from ssrics_like.training.structure_scoring import (
    Counts,
    Scored,
    added,
    averaged,
    by_passage,
    by_place,
    choose_thresholds,
    stretches,
    words,
)
from ssrics_like.world.buildings.plan import Passage, Plan, Space
from ssrics_like.world.locations import Location

# A hallway along x, y from 0 to 2; a room above it from x = 6 on, open to it at x = 8.
PLAN = Plan(
    "by hand", 12.0, 6.0,
    (
        Space(id="h", kind="hallway", x_m=(0.0, 12.0), y_m=(0.0, 2.0)),
        Space(id="r", kind="room", x_m=(6.0, 12.0), y_m=(2.2, 6.0)),
    ),
    (
        Passage(id="O01", kind="opening", x_m=8.0, y_m=2.1, axis="y", width_m=2.0),
        Passage(kind="doorway", x_m=11.0, y_m=2.1, axis="y", width_m=0.9),
    ),
    places=(Location("J01", 3.0, 1.0, "", "junction"), Location("C01", 10.0, 1.0, "", "corner")),
)  # fmt: skip


def along(xy):
    """Return a drive over places, 0.1 m of path apart, through the building."""
    xy = np.array(xy, float).reshape(-1, 2)
    none = np.empty((0, 2))
    return StructureExample(
        Example(0.1 * np.arange(len(xy)), xy, np.empty((len(xy), 0), np.float32), none, none), PLAN
    )


def test_spots_are_those_of_the_plan():
    assert spots(PLAN, "opening").tolist() == [[8.0, 2.1]]
    assert spots(PLAN, "junction").tolist() == [[3.0, 1.0]]
    assert spots(PLAN, "corner").tolist() == [[10.0, 1.0]]
    assert spots(Plan("empty", 1.0, 1.0, ()), "opening").shape == (0, 2)


@pytest.mark.parametrize(
    ("place", "told"),
    [
        ((4.19, 1.0), (0, 1, 0, 1)),
        ((4.21, 1.0), (0, -1, 0, 1)),
        ((4.99, 1.0), (0, -1, 0, 1)),
        ((5.01, 1.0), (0, 0, 0, 1)),
        ((10.0, 1.79), (0, 0, 1, 1)),
        ((8.0, 2.44), (1, 0, 0, 0)),
        ((8.0, 2.46), (-1, 0, 0, 0)),
        ((8.0, 3.01), (0, 0, 0, 0)),
        ((8.0, 2.1), (1, 0, 0, -1)),  # in neither space
        ((9.0, 4.0), (0, 0, 0, 0)),
    ],
)
def test_labels_by_distance_and_by_space(place, told):
    assert tuple(structure_labels(along([place]))[0]) == told


def test_means_are_those_over_a_place_and_its_neighbours():
    p = np.random.default_rng(1).random((50, 4))
    expected = [p[max(i - BESIDE, 0) : i + BESIDE + 1].mean(axis=0) for i in range(50)]
    assert np.allclose(averaged(p), expected)
    assert averaged(np.empty((0, 4))).shape == (0, 4)


def scored(certainties, told):
    return Scored(along([(1.0, 1.0)] * len(told)), np.array(certainties), np.array(told, np.int8))


def test_each_kinds_threshold_has_the_greatest_f_by_place():
    """Sure .9 .8 .7 .6 .5 of what is so, so, not so, so, left out: F is greatest from .6 on."""
    sure = np.array([0.9, 0.8, 0.7, 0.6, 0.5, 0.05])
    told = np.array([1, 1, 0, 1, -1, 0])
    for column, kind in enumerate(KINDS):
        certainties, truth = np.zeros((6, 4)), np.zeros((6, 4), int)
        truth[0] = 1  # so that the other kinds have something to find
        certainties[:, column], truth[:, column] = sure, told
        drive = scored(certainties, truth)
        assert choose_thresholds([drive])[kind] == 0.06  # F is 6/7 from here up to .6
        lone = choose_thresholds([scored(certainties[:3], truth[:3])])
        assert lone[kind] == 0.71  # F is 1 from here up to .8


def test_without_a_place_of_a_kind_there_is_no_threshold_to_choose():
    truth = np.ones((6, 4), int)
    truth[:, 2] = [0, 0, 0, -1, -1, 0]
    with pytest.raises(SettingsError, match="no place on the held-out drives lies at a corner"):
        choose_thresholds([scored(np.full((6, 4), 0.5), truth)])


CUE = StructureCue({}, dict.fromkeys(KINDS, 0.5))


def test_words_are_those_of_the_cue():
    certainties = np.random.default_rng(4).random((200, 4))
    drive = scored(certainties, np.zeros((200, 4)))
    said = words(CUE, drive)
    assert said.tolist() == [CUE.word(one) for one in certainties]
    assert set(said) == {"opening", "junction", "corner", "corridor", "room"}


def test_places_are_counted_but_for_arguable_ones():
    told = [
        (0, 1, 0, 1),  # a junction, called so
        (0, 1, 0, 1),  # a junction, called a corridor
        (0, -1, 0, 1),  # arguable
        (0, 0, 0, 1),  # a corridor, called a junction
        (0, 0, 0, 0),  # a room, called so
        (0, 0, 0, -1),  # neither space
        (1, 1, 0, 1),  # an opening at a junction, called an opening
    ]
    said = np.array(["junction", "corridor", "junction", "junction", "room", "room", "opening"])
    counts = by_place(said, np.array(told, np.int8))
    assert counts["junction"] == Counts(told=3, found=1, said=2, right=1)
    assert counts["opening"] == Counts(1, 1, 1, 1)
    assert counts["corner"] == Counts(0, 0, 0, 0)
    assert counts["corridor"] == Counts(told=1, found=0, said=1, right=0)
    assert counts["room"] == Counts(1, 1, 1, 1)
    assert np.isnan(counts["corner"].recall)
    assert counts["junction"].f == pytest.approx(2 * (1 / 3) * (1 / 2) / (1 / 3 + 1 / 2))


def test_stretches_of_a_path():
    at_m = 0.1 * np.arange(50)
    which = np.zeros(50, bool)
    which[[3, 4, 14, 26, 27]] = True  # 1.0 m apart belong together, 1.2 m do not
    assert [s.tolist() for s in stretches(which, at_m)] == [[3, 4, 14], [26, 27]]
    assert stretches(np.zeros(50, bool), at_m) == []


def test_passages_are_found_and_words_are_right():
    """Out along the hallway and back: the junction and the corner are passed twice each."""
    x = np.concatenate([np.arange(0.0, 12.0, 0.1), np.arange(12.0, 0.0, -0.1)])
    one = along(np.column_stack([x, np.ones(len(x))]))
    said = np.full(len(x), "corridor")
    said[35:38] = "junction"  # 0.5 m from the middle: found, and right
    said[70:75] = "junction"  # far away: false
    said[160:170] = "corner"  # on the way back, from x = 8 to 7: too early
    counts = by_passage(said, one)
    assert counts["junction"] == Counts(told=2, found=1, said=2, right=1)
    assert counts["corner"] == Counts(told=2, found=0, said=1, right=0)
    assert counts["opening"].told == 0  # 1.1 m aside is not through
    assert added([counts["junction"], counts["corner"]]) == Counts(4, 1, 3, 1)


@pytest.mark.parametrize("clutter", [False, True])
def test_a_seed_decides_about_an_example_and_its_plan_has_hallways_that_meet(monkeypatch, clutter):
    monkeypatch.setattr(drives, "LIMIT_S", 60.0)
    asked = Asked(np.random.SeedSequence(3, spawn_key=(0, 1)), clutter)
    one, again = structure_example(asked), structure_example(asked)
    assert one.example.measures.shape[1] == 85
    assert np.array_equal(one.example.measures, again.example.measures)
    assert one.plan == again.plan
    # The labelled places of the building are those of the plan: one frame.
    others = np.concatenate([spots(one.plan, kind) for kind in ("opening", "junction", "corner")])
    assert np.allclose(np.sort(one.example.others_m, axis=0), np.sort(others, axis=0))
    assert len(structure_labels(one)) == len(one.example.at_m) > 10
