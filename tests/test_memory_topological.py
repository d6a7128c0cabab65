"""Topological memory: landmarks, visits and the ways between them."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ssrics_like.memory import Landmark, TopologicalMemory


def three():
    memory = TopologicalMemory()
    for number, name in enumerate(["L1", "L2", "L3"]):
        memory.add_landmark(name, float(number), 0.0, 0.5, 10.0 * number, sector="left")
    return memory


def test_a_landmark_is_remembered_as_it_was_marked():
    memory = TopologicalMemory()
    made = memory.add_landmark(
        "L1", 1, 2, 3 * math.pi, 5, sector="left", novelty=0.25, gate=True, note=None, other=""
    )
    expected = Landmark(
        id="L1",
        x_m=1.0,
        y_m=2.0,
        theta_rad=math.pi,
        t_s=5.0,
        last_visit_s=5.0,
        visits=1,
        labels={"sector": "left", "novelty": 0.25, "gate": True},
    )
    assert made == memory["L1"] == memory.nodes[0] == expected
    assert len(memory) == 1
    assert "L1" in memory
    assert "L2" not in memory


def test_numpys_scalars_become_pythons():
    memory = TopologicalMemory()
    made = memory.add_landmark(
        np.str_("L1"), *np.zeros(4), sector=np.str_("left"), rank=np.int64(3), gate=np.bool_(1)
    )
    assert type(made.id) is str
    assert {name: type(value) for name, value in made.labels.items()} == {
        "sector": str,
        "rank": int,
        "gate": bool,
    }


def test_visits_are_counted_and_bring_labels_up_to_date():
    memory = three()
    memory.visit("L2", 40.0)
    visited = memory.visit("L2", 55.0, sector="front", novelty=0.5)
    assert (visited.visits, visited.t_s, visited.last_visit_s) == (3, 10.0, 55.0)
    assert visited.labels == {"sector": "front", "novelty": 0.5}
    assert memory["L2"] == visited
    assert [node.visits for node in memory.nodes] == [1, 3, 1]


def test_misses_are_counted_and_lie_before_the_last_visit_once_it_is_visited():
    memory = three()
    for _ in range(3):
        missed = memory.miss("L2")
    assert (missed.missed, missed.missed_since) == (0, 3)
    assert memory["L2"] == missed
    assert (missed.visits, missed.last_visit_s) == (1, 10.0)
    memory.visit("L2", 40.0)
    memory.miss("L2")
    visited = memory.visit("L2", 55.0)
    assert (visited.missed, visited.missed_since) == (4, 0)
    assert [node.missed for node in memory.nodes] == [0, 4, 0]
    with pytest.raises(KeyError, match="no landmark 'L4'"):
        memory.miss("L4")


MEASUREMENTS = st.lists(
    st.tuples(st.floats(0, 100), st.floats(-10, 10), st.floats(0, 200)), min_size=1, max_size=10
)


@given(MEASUREMENTS)
def test_an_arc_holds_means_and_spreads_of_all_traversals(measured):
    memory = three()
    for distance_m, bearing_rad, path_m in measured:
        memory.traverse("L1", "L2", distance_m, bearing_rad, path_m)
    arc = memory.arc("L1", "L2")
    distances, bearings, paths = np.array(measured).T
    assert arc.traversals == len(measured)
    assert arc.distance_m == pytest.approx(distances.mean(), abs=1e-9)
    assert arc.path_m == pytest.approx(paths.mean(), abs=1e-9)
    if len(measured) > 1:
        assert arc.distance_sd_m == pytest.approx(distances.std(ddof=1), abs=1e-6)
        assert arc.path_sd_m == pytest.approx(paths.std(ddof=1), abs=1e-6)
    resultant = abs(np.exp(1j * bearings).mean())
    assert arc.bearing_sd_rad == pytest.approx(math.sqrt(2 * max(0, 1 - resultant)), abs=1e-4)
    assert -math.pi < arc.bearing_rad <= math.pi


def test_one_traversal_has_no_spread():
    arc = three().traverse("L1", "L2", 3.0, 0.2, 4.0)
    assert (arc.distance_sd_m, arc.bearing_sd_rad, arc.path_sd_m) == (0.0, 0.0, 0.0)
    assert (arc.distance_m, arc.path_m) == (3.0, 4.0)
    assert arc.bearing_rad == pytest.approx(0.2)


def test_the_way_back_is_another_arc():
    memory = three()
    memory.traverse("L1", "L2", 3.0, 0.0, 3.0)
    memory.traverse("L2", "L1", 3.5, math.pi, 3.6)
    assert [(arc.from_id, arc.to_id) for arc in memory.arcs] == [("L1", "L2"), ("L2", "L1")]
    assert memory.arc("L1", "L2").distance_m == 3.0
    assert memory.arc("L2", "L1").bearing_rad == math.pi


def test_degree_counts_neighbours_once_and_not_itself():
    memory = three()
    assert memory.degree("L1") == 0
    for ends in [("L1", "L2"), ("L2", "L1"), ("L3", "L1"), ("L1", "L1")]:
        memory.traverse(*ends, 1.0, 0.0, 1.0)
    assert [memory.degree(name) for name in ("L1", "L2", "L3")] == [2, 1, 1]


def test_unknown_landmarks_and_arcs_are_named():
    memory = three()
    for act in (
        lambda: memory["L11"],
        lambda: memory.visit("L11", 1.0),
        lambda: memory.degree("L11"),
        lambda: memory.traverse("L1", "L11", 1.0, 0.0, 1.0),
    ):
        with pytest.raises(KeyError, match="no landmark 'L11' in topological memory; did you mean"):
            act()
    with pytest.raises(KeyError, match="no arc from 'L1' to 'L2'"):
        memory.arc("L1", "L2")
    assert memory.arcs == ()


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"id": "L1"}, "'L1' is in topological memory already"),
        ({"id": ""}, "expected printable text"),
        ({"id": "a\nb"}, "expected printable text"),
        ({"id": 4}, "expected printable text"),
        ({"x_m": math.nan}, "x_m is nan"),
        ({"t_s": math.inf}, "t_s is inf"),
        ({"closed": True}, "label 'closed' is reserved"),
        ({"visits": 3}, "label 'visits' is reserved"),
        ({"note": "a\tb"}, "expected printable text"),
        ({"novelty": math.nan}, "novelty is nan"),
        ({"missed": 1}, "label 'missed' is reserved"),
    ],
)
def test_a_landmark_that_cannot_be_kept_is_refused(changed, message):
    memory = three()
    given_ = {"id": "L4", "x_m": 0.0, "y_m": 0.0, "theta_rad": 0.0, "t_s": 0.0} | changed
    with pytest.raises(ValueError, match=message):
        memory.add_landmark(**given_)
    assert len(memory) == 3


def test_a_label_is_text_or_a_number():
    with pytest.raises(TypeError, match=r"label 'tags' is .*; expected text, a number"):
        three().visit("L1", 1.0, tags=["a"])


@pytest.mark.parametrize("measured", [(-1.0, 0.0, 1.0), (1.0, math.nan, 1.0), (1.0, 0.0, math.inf)])
def test_measurements_that_mean_nothing_are_refused(measured):
    memory = three()
    with pytest.raises(ValueError, match="expected a"):
        memory.traverse("L1", "L2", *measured)
    assert memory.arcs == ()


def test_a_memory_restored_goes_on_from_what_was_reported():
    memory = three()
    for distance_m, bearing_rad in [(3.0, 0.1), (3.4, -0.2), (2.9, 0.3)]:
        memory.traverse("L1", "L2", distance_m, bearing_rad, distance_m + 1)
    restored = TopologicalMemory.restored(memory.nodes, memory.arcs)
    assert restored.nodes == memory.nodes
    one, other = (m.traverse("L1", "L2", 5.0, 1.0, 6.0) for m in (memory, restored))
    for name in ("traversals", "distance_m", "distance_sd_m", "bearing_rad", "bearing_sd_rad"):
        assert getattr(other, name) == pytest.approx(getattr(one, name), abs=1e-9)
    with pytest.raises(KeyError, match="no landmark"):
        TopologicalMemory.restored(memory.nodes[:1], memory.arcs)


def test_a_way_found_shut_is_shut_both_ways_until_it_is_gone_again():
    memory = three()
    memory.traverse("L1", "L2", 3.0, 0.0, 3.0)
    memory.traverse("L2", "L1", 3.0, 0.0, 3.0)
    memory.traverse("L2", "L3", 3.0, 0.0, 3.0)
    memory.close("L2", "L1")
    memory.close("L1", "L2")
    assert [way.closed for way in memory.arcs] == [2, 2, 0]
    assert TopologicalMemory.restored(memory.nodes, memory.arcs).arcs == memory.arcs
    memory.traverse("L1", "L2", 3.0, 0.0, 3.0)
    assert [way.closed for way in memory.arcs] == [0, 0, 0]


def test_only_what_is_joined_can_be_shut():
    memory = three()
    memory.traverse("L1", "L2", 3.0, 0.0, 3.0)
    assert memory.joins("L2", "L1")
    assert not memory.joins("L1", "L3")
    with pytest.raises(KeyError, match="no arc between 'L1' and 'L3'"):
        memory.close("L1", "L3")


def test_what_is_told_late_does_not_make_a_landmark_older():
    memory = TopologicalMemory()
    memory.add_landmark("L1", 0.0, 0.0, 0.0, 0.0)
    memory.visit("L1", 50.0)
    assert memory.visit("L1", 40.0).last_visit_s == 50.0
