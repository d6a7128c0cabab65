"""What landmarks in both memories are worth, and how it looks in rules."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ssrics_like.memory import Chunk, DeclarativeMemory, TopologicalMemory, View
from ssrics_like.memory.appraisal import Appraisal
from ssrics_like.memory.profile import MemoryProfile
from ssrics_like.memory.worth import Worth

QUIET = MemoryProfile(activation_noise=0.0)
UNLIKE = math.exp(QUIET.surroundings_difference)


def surroundings(length_m, unknown_m=0.0):
    return View(f"view-{length_m}", np.repeat([length_m, unknown_m], 36).astype(np.float32))


def appraised(views, *, surround=True, profile=QUIET, ways=()):
    """Landmarks L1, L2 ... with views (None: without), and how they were gone between."""
    declarative = DeclarativeMemory(
        profile, similarities=profile.similarities(surroundings=surround)
    )
    topological = TopologicalMemory()
    for i, view in enumerate(views):
        name = f"L{i + 1}"
        topological.add_landmark(name, 0.0, 0.0, 0.0, 0.0)
        slots = {"id": name} if view is None else {"id": name, "view": view}
        declarative.add(Chunk(name, "landmark", slots), 0.0)
    for one, other, times in ways:
        for _ in range(times):
            topological.traverse(f"L{one}", f"L{other}", 1.0, 0.0, 1.0)
    return Appraisal(declarative, topological, profile.lasting_s), topological


def test_salience_tells_one_that_looks_like_no_other_from_two_that_look_alike():
    found, _ = appraised([surroundings(1), surroundings(2), surroundings(2), surroundings(5)])
    alone, pair = math.log2(4 / (1 + 3 * UNLIKE)), math.log2(4 / (2 + 2 * UNLIKE))
    saliences = [found.salience(f"L{i}") for i in (1, 2, 3, 4)]
    assert saliences == pytest.approx([alone, pair, pair, alone], abs=1e-9)


def test_salience_of_scans_goes_by_their_correlation():
    up, down = View("up", np.arange(8.0)), View("down", -np.arange(8.0))
    found, _ = appraised([up, down], surround=False)
    assert found.salience("L1") == pytest.approx(math.log2(2 / (1 + math.exp(-2))), abs=1e-6)


def test_a_view_that_cannot_be_compared_even_with_itself_is_the_same_as_itself():
    found, _ = appraised([surroundings(1, unknown_m=2.0)])
    assert found.salience("L1") == 0.0


def test_without_a_view_there_is_no_salience_and_others_are_not_compared_with_it():
    found, topological = appraised([surroundings(1), None, surroundings(1)])
    topological.add_landmark("L9", 0.0, 0.0, 0.0, 0.0)  # the rule set keeps no memory of it
    assert [found.salience(name) for name in ("L1", "L2", "L9")] == [0.0, None, None]


@pytest.mark.parametrize(
    ("changes", "nats"),
    [
        ({"mismatch_penalty": None}, -7.0),  # no partial matching: as if the penalty were 1
        ({"mismatch_penalty": 0.5}, -3.5),
        ({"max_similarity": 2.0}, -9.0),  # the same is always the logarithm 0
        ({"mismatch_penalty": -1.0}, 0.0),  # nothing does better than the same
    ],
)
def test_salience_weighs_views_as_partial_matching_does(changes, nats):
    profile = QUIET.model_copy(update=changes)
    found, _ = appraised([surroundings(1), surroundings(3)], profile=profile)
    assert found.salience("L1") == pytest.approx(math.log2(2 / (1 + math.exp(nats))), abs=1e-9)


VIEWS = st.lists(st.sampled_from([0.5, 1.0, 1.1, 2.0, 2.2, 5.0]), min_size=1, max_size=9)


@given(VIEWS)
def test_salience_lies_between_0_and_the_logarithm_of_their_number(lengths_m):
    found, _ = appraised([surroundings(length_m) for length_m in lengths_m])
    for worth in found.worths(0.0).values():
        assert 0.0 <= worth.salience <= math.log2(len(lengths_m)) + 1e-12


def test_a_new_view_is_the_more_surprising_the_fewer_are_like_it():
    found, _ = appraised([])
    assert found.surprise(surroundings(1)) == 0.0
    found, _ = appraised([surroundings(1), surroundings(1), surroundings(4)])
    assert found.surprise(surroundings(1)) == pytest.approx(math.log2(4 / (3 + UNLIKE)))
    assert found.surprise(surroundings(2)) == pytest.approx(math.log2(4 / (1 + 3 * UNLIKE)))


def test_relevance_is_choice_times_use_of_the_ways_either_way():
    # L2 lies between L1 and L3, and was passed there and back; L4 was never gone to.
    found, _ = appraised([None] * 4, ways=[(1, 2, 1), (2, 3, 2), (3, 2, 1), (2, 1, 2)])
    # Traversals: 3, 6, 3, 0; their mean is 3.
    assert [found.relevance(f"L{i}") for i in (1, 2, 3, 4)] == pytest.approx([0, 6 / 3, 0, 0])


def test_a_way_that_is_shut_and_one_that_leads_back_are_no_choice():
    found, topological = appraised([None] * 3, ways=[(1, 2, 1), (2, 1, 1), (2, 3, 2), (2, 2, 5)])
    assert found.relevance("L2") == pytest.approx(4 / (8 / 3))
    topological.close("L2", "L1")
    assert topological.traversals("L2") == {"L3": 2}
    assert topological.traversals("L1") == {}
    assert topological.mean_traversals == pytest.approx(4 / 3)
    assert found.relevance("L2") == 0.0
    topological.traverse("L1", "L2", 1.0, 0.0, 1.0)  # gone again, it is open
    assert found.relevance("L2") == pytest.approx(choice_of(3, 2) * 5 / (10 / 3))


def choice_of(*traversals):
    shares = np.array(traversals) / sum(traversals)
    return -float(shares @ np.log2(shares))


STEPS = st.lists(
    st.tuples(st.integers(1, 4), st.integers(1, 4), st.sampled_from(["go", "go", "close"])),
    max_size=30,
)


@given(STEPS)
def test_the_mean_of_traversals_is_that_of_all_landmarks(steps):
    _, graph = appraised([None] * 4)
    for one, other, what in steps:
        ends = f"L{one}", f"L{other}"
        if what == "go":
            graph.traverse(*ends, 1.0, 0.0, 1.0)
        elif graph.joins(*ends):
            graph.close(*ends)
    again = TopologicalMemory.restored(graph.nodes, graph.arcs)
    for memory in (graph, again):
        counts = [sum(memory.traversals(name).values()) for name in memory]
        assert memory.mean_traversals == pytest.approx(sum(counts) / 4)


def test_permanence_goes_by_confirmations_misses_and_time():
    found, graph = appraised([None])
    assert found.permanence("L1", 60.0) == 0.5
    graph.miss("L1")
    assert found.permanence("L1", 60.0) == pytest.approx(30 / 90)
    graph.visit("L1", 240.0)
    # c = 1, m = 1, S = 240 s: the miss is over, and makes others count less.
    assert found.permanence("L1", 240.0) == 1.0
    assert found.permanence("L1", 540.0) == 0.5
    graph.miss("L1")
    assert found.permanence("L1", 540.0) == pytest.approx(150 / 450)


def test_all_landmarks_at_once_are_worth_what_they_are_one_by_one():
    found, graph = appraised(
        [surroundings(1), surroundings(2), None], ways=[(1, 2, 3), (2, 3, 1), (3, 1, 1)]
    )
    graph.visit("L2", 90.0)
    graph.miss("L3")
    assert found.worths(100.0) == {
        name: Worth(found.salience(name), found.relevance(name), found.permanence(name, 100.0))
        for name in graph
    }


def test_what_rules_ask_is_told_of_the_landmark_recalled_or_of_the_view_asked_for():
    found, _ = appraised([surroundings(1), surroundings(2)], ways=[(1, 2, 1)])
    asked = surroundings(4)
    names = ("salience", "relevance", "permanence")
    assert [found.measure(name, "L1", asked, 60.0) for name in names] == [
        found.salience("L1"), 0.0, 0.5,
    ]  # fmt: skip
    assert [found.measure(name, None, asked, 60.0) for name in names] == [
        found.surprise(asked), None, None,
    ]  # fmt: skip
    assert {found.measure(name, None, None, 60.0) for name in names} == {None}
    assert {found.measure(name, "task-1", asked, 60.0) for name in names} == {None}
