"""Routes over remembered arcs: shortest, either way, around what is shut."""

import networkx as nx
import pytest
from hypothesis import given
from hypothesis import strategies as st
from saved_memories import arc

from ssrics_like.memory import Route, shortest_routes


def way(one, other, path_m):
    made = arc(one, other)
    return made.__class__(**{**vars(made), "path_m": path_m})


def test_the_shorter_of_two_ways_is_taken():
    arcs = [way(1, 2, 4.0), way(2, 3, 4.0), way(1, 3, 9.0)]
    assert shortest_routes(arcs, "L1")["L3"] == Route(("L1", "L2", "L3"), 8.0)


def test_an_arc_can_be_gone_back():
    assert shortest_routes([way(1, 2, 4.0)], "L2")["L1"] == Route(("L2", "L1"), 4.0)


def test_of_two_arcs_between_landmarks_the_shorter_counts_in_both_directions():
    arcs = [way(1, 2, 4.0), way(2, 1, 3.0)]
    assert shortest_routes(arcs, "L1")["L2"].path_m == 3.0
    assert shortest_routes(arcs, "L2")["L1"].path_m == 3.0


def test_what_cannot_be_passed_is_left_out():
    arcs = [way(1, 2, 4.0), way(2, 3, 4.0), way(1, 3, 9.0)]
    routes = shortest_routes(arcs, "L1", lambda each: each.to_id != "L2")
    assert routes["L3"].landmarks == ("L1", "L3")
    assert routes["L2"].landmarks == ("L1", "L3", "L2")


def test_where_nothing_leads_there_is_no_route_but_the_start_is_always_there():
    assert shortest_routes([way(2, 3, 1.0)], "L1") == {"L1": Route(("L1",), 0.0)}


@given(
    st.lists(
        st.tuples(st.integers(1, 8), st.integers(1, 8), st.integers(1, 50)).filter(
            lambda each: each[0] != each[1]
        ),
        max_size=20,
    )
)
def test_routes_are_as_long_as_those_of_networkx(drawn):
    graph = nx.Graph()
    graph.add_node("L1")
    for one, other, metres in drawn:
        ends = (f"L{one}", f"L{other}")
        known = graph.get_edge_data(*ends, {"weight": metres})["weight"]
        graph.add_edge(*ends, weight=min(known, metres))
    lengths = nx.single_source_dijkstra_path_length(graph, "L1")
    routes = shortest_routes([way(*each) for each in drawn], "L1")
    assert {name: route.path_m for name, route in routes.items()} == pytest.approx(lengths)
    assert next(iter(routes)) == "L1"
    assert [r.path_m for r in routes.values()] == sorted(r.path_m for r in routes.values())
