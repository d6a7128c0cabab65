"""Links between landmarks, and what they say of those farther off."""

import math

import networkx as nx
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ssrics_like.memory.links import HERE, LEAST_M, LEAST_RAD, Link, Links
from ssrics_like.poses import Pose

METRES = st.floats(-20.0, 20.0)
VARIANCES = st.floats(1e-3, 4.0)
LINKS = st.builds(
    Link,
    st.builds(Pose, METRES, METRES, st.floats(-math.pi, math.pi)),
    VARIANCES,
    st.floats(1e-4, 0.5),
)


def same(one, other):
    assert one.pose.distance_m(other.pose) < 1e-6
    assert abs(math.remainder(one.pose.theta_rad - other.pose.theta_rad, math.tau)) < 1e-9
    assert one[1:] == pytest.approx(other[1:])


@given(LINKS)
def test_back_and_forth_is_where_one_was(link):
    same(link.reversed.reversed, link)
    there_and_back = link.and_then(link.reversed)
    assert there_and_back.pose.distance_m(HERE.pose) < 1e-6
    assert there_and_back.variance_m2 >= 2 * link.variance_m2


@given(LINKS, LINKS)
def test_the_mean_lies_nearer_to_the_more_certain(one, other):
    mean = one.averaged_with(other)
    assert mean.variance_m2 == pytest.approx(1 / (1 / one.variance_m2 + 1 / other.variance_m2))
    near = mean.pose.distance_m(one.pose) * other.variance_m2
    assert near == pytest.approx(mean.pose.distance_m(other.pose) * one.variance_m2, abs=1e-6)


def test_an_error_of_direction_grows_with_the_length_of_what_follows():
    turn = Link(Pose(0.0, 0.0, 0.0), 0.0, 0.01)
    ahead = turn.and_then(Link(Pose(10.0, 0.0, 0.0), 0.04, 0.0))
    assert ahead.variance_m2 == pytest.approx(0.04 + 0.01 * 100.0)
    assert ahead.variance_rad2 == pytest.approx(0.01)


def test_what_is_measured_again_becomes_more_certain_up_to_a_limit():
    links = Links()
    for _ in range(10_000):
        links.relate("L1", "L2", Link(Pose(3.0, 4.0, 1.0), 0.25, 0.01))
    link = links.between("L1", "L2")
    assert link == Link(Pose(3.0, 4.0, 1.0), pytest.approx(LEAST_M**2), pytest.approx(LEAST_RAD**2))
    same(links.between("L2", "L1"), link.reversed)
    assert links.between("L1", "L3") is None


def test_links_need_not_agree():
    links = Links()
    links.relate("A", "B", Link(Pose(1.0, 0.0, 0.0), 0.01, 0.01))
    links.relate("B", "C", Link(Pose(1.0, 0.0, 0.0), 0.01, 0.01))
    links.relate("A", "C", Link(Pose(5.0, 0.0, 0.0), 4.0, 0.01))  # a long way round
    seen = links.seen_from("A")
    assert seen["C"].pose == Pose(2.0, 0.0, 0.0)  # by the more certain way
    assert links.between("A", "C").pose == Pose(5.0, 0.0, 0.0)


@given(st.lists(st.tuples(st.integers(0, 6), st.integers(0, 6), VARIANCES), max_size=20))
def test_each_is_seen_by_the_way_of_least_variance(pairs):
    links, graph = Links(), nx.Graph()
    graph.add_node("0")
    for a, b, variance in pairs:
        if a != b and not graph.has_edge(str(a), str(b)):
            # Without direction errors variances simply add up.
            links.relate(str(a), str(b), Link(Pose(0.0, 0.0, 0.0), variance, 1e-9))
            graph.add_edge(str(a), str(b), weight=variance)
    expected = nx.single_source_dijkstra_path_length(graph, "0")
    seen = links.seen_from("0")
    assert seen.keys() == expected.keys()
    for name, variance in expected.items():
        assert seen[name].variance_m2 == pytest.approx(variance)


def test_only_the_most_certain_are_expected_anywhere():
    links = Links()
    for i in range(50):
        links.relate(f"L{i}", f"L{i + 1}", Link(Pose(1.0, 0.0, 0.0), 0.01, 0.0001))
    assert list(links.seen_from("L0", most=5)) == ["L0", "L1", "L2", "L3", "L4"]


def test_nonsense_is_refused():
    with pytest.raises(ValueError, match="'A' cannot lie away from itself"):
        Links().relate("A", "A", Link(Pose(1.0, 0.0, 0.0), 1.0, 1.0))
    with pytest.raises(ValueError, match="a variance is not above 0"):
        Links().relate("A", "B", HERE)
