"""A passage is a path through the gap of a doorway, to the other side."""

import math

import numpy as np
import pytest
from results_folders import DOOR_M, DOORS, building

from ssrics_like.comparison.drive import Passages
from ssrics_like.comparison.passages import passages_through, thresholds
from ssrics_like.comparison.way import Way
from ssrics_like.perception.observation import Pose
from ssrics_like.world.grid import GridMap
from ssrics_like.world.locations import Location

GATE = [[[2.0, -0.5], [2.0, 0.5]]]
NOWHERE = np.full((1, 2, 2), np.nan)


def passed(*path, lines=GATE):
    return passages_through(Way.through(path), lines).along_m.tolist()


def test_a_path_through_the_gap_passes_where_it_crosses_the_line():
    assert passed((0, 0), (1.5, 0), (3, 0)) == [2.0]
    assert passed((0.5, -1.5), (3.5, 1.5)) == [pytest.approx(1.5 * math.sqrt(2))]


def test_a_path_beside_the_gap_or_along_the_wall_passes_nothing():
    assert passed((0, 0.6), (4, 0.6)) == []
    assert passed((1.9, -3), (1.9, 3)) == []
    assert passed((0, 0), (1.99, 0), (0, 0)) == []


def test_in_and_out_again_are_two_passages_if_the_robot_stayed_a_metre_inside():
    assert passed((0, 0), (2.6, 0), (0, 0)) == [2.0, pytest.approx(3.2)]


def test_a_robot_that_turns_back_on_the_threshold_has_not_passed():
    assert passed((0, 0), (2.4, 0), (0, 0)) == []


def test_wavering_on_the_threshold_is_one_passage():
    assert passed((0, 0), (2.2, 0), (1.9, 0), (4, 0)) == [pytest.approx(2.2 + 0.2)]


def test_a_robot_that_is_carried_over_the_line_has_not_passed():
    assert passed((0, 0), (1, 0), (8, 0)) == []
    assert passed((0, 0), (1, 0), (8, 0), (3, 0), (1, 0)) == [pytest.approx(1 + 5 + 1)]


def test_passages_stand_in_order_of_the_way_with_the_places_they_lead_through():
    lines = [[[4.0, -1], [4.0, 1]], *NOWHERE, *GATE]
    found = passages_through(Way.through([(x, 0) for x in (0, 3, 6, 3, 0)]), lines)
    assert found.place.tolist() == [2, 0, 0, 2]
    assert found.along_m.tolist() == [2, 4, 8, 10]


@pytest.mark.parametrize("path", [[], [(2.0, 0.0)], [(2.0, 0.0)] * 3])
def test_without_a_way_nothing_is_passed(path):
    assert len(passages_through(Way.through(path), GATE)) == 0
    assert len(passages_through(Way.through(path), NOWHERE)) == 0


def test_those_through_chosen_places_can_be_taken():
    chosen = Passages.of([0, 1, 0], [3.0, 1.0, 2.0]).through(np.array([True, False]))
    assert (chosen.place.tolist(), chosen.along_m.tolist()) == ([0, 0], [2.0, 3.0])


@pytest.mark.parametrize("origin", [Pose(-14.5, -10.0, 0.0), Pose(3.0, -2.0, 0.7)])
def test_the_line_of_a_doorway_stands_across_its_gap(origin):
    plain = building().grid
    grid = GridMap(plain.cells, plain.cell_m, origin)
    doors = grid.points_in_map(plain.points_in_grid(DOORS))
    lines = thresholds(grid, [Location(str(i), *at) for i, at in enumerate(doors.tolist())])
    np.testing.assert_allclose(lines.mean(axis=1), doors, atol=plain.cell_m)
    widths = np.hypot(*(lines[:, 1] - lines[:, 0]).T)
    np.testing.assert_allclose(widths, 2 * DOOR_M, atol=1.5 * plain.cell_m)
    # Doors 1 and 4 stand in walls along y, so do their lines; the others' along x.
    along = lines[:, 1] - lines[:, 0]
    angle = np.arctan2(along[:, 1], along[:, 0]) - origin.theta_rad
    upright = np.abs(np.sin(angle)) > 0.99
    assert upright.tolist() == [i % 3 == 1 for i in range(6)]


def test_places_in_no_gap_have_no_line():
    grid = building().grid
    places = [Location("wall", 0.0, 3.1), Location("room", 10.0, 0.0), Location("off", 99.0, 0.0)]
    assert np.isnan(thresholds(grid, places)).all()
    assert thresholds(grid, []).shape == (0, 2, 2)
