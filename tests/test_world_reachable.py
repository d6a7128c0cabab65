"""Clearance and reach of a disc on small grids whose answers can be counted by hand."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from ssrics_like.errors import MapError
from ssrics_like.perception.observation import Pose
from ssrics_like.world.grid import FREE, OCCUPIED, UNKNOWN, GridMap
from ssrics_like.world.reachable import clearance, reachable, roomiest, standing


def grid_of(text, cell_m=1.0):
    """Make a grid from a drawing: '.' free, '#' occupied, '?' unknown; the top line is on top."""
    lines = text.split()
    values = {".": FREE, "#": OCCUPIED, "?": UNKNOWN}
    return GridMap(np.array([[values[c] for c in line] for line in lines[::-1]], np.uint8), cell_m)


def grids():
    shapes = st.tuples(st.integers(1, 9), st.integers(1, 9))
    cells = arrays(np.uint8, shapes, elements=st.sampled_from([FREE, FREE, OCCUPIED, UNKNOWN]))
    return st.builds(GridMap, cells, st.sampled_from([0.05, 1.0]))


def true_clearance(grid):
    """Distance from each centre to the nearest point of any solid square, cell by cell."""
    rows, columns = grid.cells.shape
    solid = [
        (r, c)
        for r in range(-1, rows + 1)
        for c in range(-1, columns + 1)
        if not (0 <= r < rows and 0 <= c < columns) or grid.cells[r, c] != FREE
    ]
    return (
        np.array(
            [
                [
                    min(
                        math.hypot(max(abs(r - r2) - 0.5, 0), max(abs(c - c2) - 0.5, 0))
                        for r2, c2 in solid
                    )
                    for c in range(columns)
                ]
                for r in range(rows)
            ]
        )
        * grid.cell_m
    )


def test_clearance_is_measured_to_the_walls_edge_and_the_grids_edge():
    grid = grid_of(
        """
        .....
        .....
        ##?..
        """,
        cell_m=0.1,
    )
    expected = [[0, 0, 0, 0.05, 0.05], [0.05, 0.05, 0.05, None, 0.05], [0.05] * 5]
    got = clearance(grid)
    assert got[1, 3] == pytest.approx((math.sqrt(2) - 0.5) * 0.1)
    assert [[c if c is not None else got[1, 3] for c in row] for row in expected] == pytest.approx(
        got
    )


@given(grids())
@settings(deadline=None)
def test_clearance_is_too_large_by_a_fifth_of_a_cell_at_most(grid):
    error = clearance(grid) - true_clearance(grid)
    assert error.min() >= -1e-12
    assert error.max() <= (math.sqrt(0.5) - 0.5) * grid.cell_m + 1e-12
    assert (clearance(grid) == 0)[grid.solid].all()


def test_a_narrow_door_stops_a_wide_robot_only():
    grid = grid_of(
        """
        #########
        #...#...#
        #.......#
        #...#...#
        #########
        """
    )
    assert reachable(grid, 1.5, 2.5, 0.4)[2].tolist() == [False] + [True] * 7 + [False]
    wide = reachable(grid, 2.5, 2.5, 1.1)
    assert wide[2].tolist() == [False] + [True] * 3 + [False] * 5
    assert wide.sum() == 5  # the middle of the room and its four neighbours: 1.1 reaches no corner
    assert reachable(grid, 2.5, 2.5, 1.45).sum() == 9
    assert not reachable(grid, 1.5, 2.5, 1.1).any()  # it does not fit where it starts
    assert not reachable(grid, 4.5, 1.5, 0.1).any()  # in the wall
    assert not reachable(grid, -1.0, 99.0, 0.1).any()  # not on the map


def test_cells_that_touch_at_a_corner_only_are_not_connected():
    grid = grid_of(
        """
        .#
        #.
        """
    )
    assert reachable(grid, 0.5, 1.5, 0.1).sum() == 1


@given(grids(), st.floats(0, 9), st.floats(0, 9), st.floats(0.01, 3))
@settings(max_examples=60, deadline=None)
def test_the_body_stays_on_free_cells_and_a_slimmer_robot_gets_everywhere_a_wider_one_does(
    grid, x, y, radius
):
    x, y, radius = x * grid.cell_m, y * grid.cell_m, radius * grid.cell_m
    wide = reachable(grid, x, y, radius)
    slim = reachable(grid, x, y, radius / 2)
    assert not (wide & grid.solid).any()
    assert not (standing(grid, x, y, radius) & ~standing(grid, x, y, radius / 2)).any()
    row, column = grid.cell_of(x, y)
    if wide.any():
        assert wide[row, column]
        assert slim[row, column]


def test_the_roomiest_cell_is_the_first_of_equals_in_the_largest_part():
    grid = grid_of(
        """
        ......##########
        ......#...#....#
        ......#...#....#
        ......#........#
        ......#...#....#
        ......##########
        """
    )
    # The room on the left is the largest part by cells (36), and its four middle cells tie.
    assert roomiest(grid) == Pose(2.5, 2.5, 0.0)
    shut = GridMap(grid.cells[1:-1, 3:], 0.5)
    # Now the two rooms with the door between them are the largest part, 29 cells of 41.
    assert roomiest(shut) == Pose(5.5 * 0.5, 1.5 * 0.5, 0.0)


@given(grids())
@settings(deadline=None)
def test_the_roomiest_cell_is_free_or_there_is_none(grid):
    if (grid.cells != FREE).all():
        with pytest.raises(MapError, match="no cell"):
            roomiest(grid)
    else:
        start = roomiest(grid)
        assert grid.is_free(start.x_m, start.y_m)
