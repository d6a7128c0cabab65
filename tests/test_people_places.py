"""Where marks fall: clusters, the route in bins, units."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.distance import pdist

from ssrics_like.comparison.way import Way
from ssrics_like.people.clusters import clusters_of, found_locations
from ssrics_like.people.markers import PEOPLE, Marker, people_of
from ssrics_like.people.route import route_of
from ssrics_like.people.units import Units
from ssrics_like.world.choices import Choice
from ssrics_like.world.locations import Location

METRES = st.floats(-20, 20, allow_nan=False).map(lambda v: round(v, 3))
MARKS = st.lists(st.tuples(METRES, METRES), max_size=25)


def straight(length_m, y_m=0.0, step_m=0.1):
    x = np.arange(0.0, length_m + step_m / 2, step_m)
    return Way.through(np.column_stack([x, np.full(len(x), y_m)]))


def marker(*xy, name="p"):
    return Marker(
        name, PEOPLE, np.array(xy, float).reshape(-1, 2), np.full(len(xy), np.nan), ("",) * len(xy)
    )


@given(MARKS, st.floats(0.1, 5))
@settings(max_examples=60, deadline=None)
def test_no_two_marks_of_a_cluster_lie_farther_apart_than_twice_the_radius(marks, radius_m):
    groups = clusters_of(marks, radius_m)
    assert len(groups) == len(marks)
    for group in set(groups.tolist()):
        mine = np.array(marks)[groups == group]
        assert len(mine) < 2 or pdist(mine).max() <= 2 * radius_m + 1e-9


def test_two_marks_that_look_like_a_table_of_distances_are_clustered():
    assert clusters_of([(0.0, 1.0), (1.0, 0.0)], 1.0).tolist() == [0, 0]
    assert len(set(clusters_of([(0.0, 5.0), (5.0, 0.0)], 1.0).tolist())) == 2


def test_a_found_location_was_marked_by_two_people_and_lies_in_their_middle():
    marks = [(0, 0), (0.4, 0), (5, 5), (5.1, 5), (9, 9), (0.2, 0.3)]
    found = found_locations(marks, [0, 1, 0, 0, 1, 2], 1.0, 3)
    # Two marks at (5, 5) are of one person; the one at (9, 9) is alone.
    assert [(place.id, place.kind) for place in found] == [("C1", "other")]
    assert (found[0].x_m, found[0].y_m) == pytest.approx((0.2, 0.1))


def test_a_single_participant_has_locations_of_their_own():
    found = found_locations([(3, 0), (0, 0)], [0, 0], 1.0, 1)
    assert [(place.id, place.x_m) for place in found] == [("C1", 0.0), ("C2", 3.0)]


def test_locations_are_named_from_the_most_marked():
    marks = [(0, 0), (0, 0), (8, 0), (8, 0), (8, 0)]
    found = found_locations(marks, [0, 1, 0, 1, 2], 1.0, 3)
    assert [(place.id, place.x_m) for place in found] == [("C1", 8.0), ("C2", 0.0)]


def test_a_straight_route_is_cut_in_bins_of_the_length():
    route = route_of([straight(10)], 1.0, 1.0)
    np.testing.assert_allclose(route.bins_m, np.column_stack([np.arange(11), np.zeros(11)]))
    assert route.dropped == 0


def test_driving_back_and_again_makes_no_further_bins():
    there = straight(10).xy_m
    back = Way.through(np.vstack([there, np.add(there[::-1], (0, 0.3))]))
    np.testing.assert_allclose(
        route_of([back, straight(10)], 1.0, 1.0).bins_m, route_of([straight(10)], 1.0, 1.0).bins_m
    )


def test_what_most_runs_never_came_by_is_left_out():
    ways = [straight(20), straight(10), straight(10)]
    route = route_of(ways, 1.0, 1.0)
    assert route.bins_m[:, 0].max() == pytest.approx(11.0)  # within a metre of where they turned
    assert route.dropped == 9
    assert route.most_came_by([(5, 0), (15, 0)]).tolist() == [True, False]
    assert route.any_came_by([(5, 0), (15, 0), (15, 3)]).tolist() == [True, True, False]


@given(st.lists(st.tuples(METRES, METRES), min_size=1, max_size=8), st.floats(0.3, 4))
@settings(max_examples=60, deadline=None)
def test_bins_keep_their_distance_and_leave_no_gap(corners, bin_m):
    # Steps below 5 m, as a robot drives them.
    legs = [np.linspace(a, b, 20) for a, b in zip(corners, corners[1:] or corners, strict=False)]
    way = Way.through(np.concatenate(legs))
    bins = route_of([way], bin_m, 1.0)._every_bin
    assert len(bins) < 2 or pdist(bins).min() >= bin_m - 1e-9
    for at_m in np.linspace(0, way.length_m, 50):
        assert np.hypot(*(bins - way.at(at_m)).T).min() <= 1.26 * bin_m


def units():
    places = (Location("A", 3.0, 0.5), Location("B", 7.0, 0.0), Location("far", 5.0, 9.0))
    return Units(places, route_of([straight(10)], 1.0, 1.0))


def test_bins_within_the_radius_of_a_location_are_joined_to_it():
    made = units()
    assert made.on_route.tolist() == [True, True, False]
    # Of the bins 0 ... 10, A takes 3 (at .5 m), B takes 6, 7 and 8.
    assert made.bins_m[:, 0].tolist() == [0, 1, 2, 4, 5, 9, 10]
    assert made.names == ("A", "B", *(f"bin {n}" for n in range(1, 8)))
    assert len(made) == 9


@pytest.mark.parametrize(
    ("mark", "unit"),
    [
        ((3.2, 0.4), "A"),
        ((7.9, 0.0), "B"),
        ((1.2, 0.6), "bin 2"),
        ((5.0, 0.9), "bin 5"),
        ((5.0, 1.2), ""),  # beside the route
        ((5.0, 8.8), ""),  # at a location that the route does not come by
        ((10.9, 0.0), "bin 7"),
        ((11.2, 0.0), ""),
    ],
)
def test_a_mark_falls_on_a_location_or_a_bin_or_off_the_route(mark, unit):
    made = units()
    (fell,) = made.of([mark])
    assert (*made.names, "")[fell] == unit


def test_marking_twice_is_as_good_as_once():
    table = units().marked([marker((3, 0), (3.2, 0)), marker()])
    assert table.sum(axis=1).tolist() == [1, 0]


def test_a_location_off_the_route_is_still_marked_by_whoever_marks_it():
    made = units()
    table = made.marked_locations([marker((5, 8.5), (3, 0))])
    assert table.tolist() == [[True, False, True]]


def test_long_bins_hold_whatever_lies_on_the_route():
    made = Units((), route_of([straight(20)], 5.0, 1.0))
    assert (made.of([(x, 0.5) for x in np.arange(0, 20, 0.7)]) >= 0).all()


def test_without_a_route_locations_are_the_units():
    made = Units((Location("A", 0, 0),), route_of([Way.through([])], 1.0, 1.0))
    assert made.names == ("A",)
    assert made.of([(0.5, 0), (4, 4)]).tolist() == [0, -1]


@given(MARKS)
@settings(max_examples=40, deadline=None)
def test_units_of_marks_are_near_them(marks):
    made = units()
    places = [(p.x_m, p.y_m) for p in made.locations[:2]]
    middles = np.vstack([places, made.bins_m])
    for mark, unit in zip(marks, made.of(marks).tolist(), strict=True):
        assert unit == -1 or np.hypot(*(middles[unit] - mark)) <= 1.0


def test_people_come_in_the_order_of_the_file():
    found = people_of(
        [Choice("b", "1", 0, 0, "door"), Choice("a", "1", 1, 1, t_s=3.0), Choice("b", "2", 2, 2)]
    )
    assert [(p.name, len(p), p.group) for p in found] == [("b", 2, "people"), ("a", 1, "people")]
    assert found[0].names == ("door", "2")
    assert found[1].t_s.tolist() == [3.0]
