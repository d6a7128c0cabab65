"""Plans are drawn exactly; furniture is as solid as it should be."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import ValidationError
from scipy import ndimage

from ssrics_like.errors import MapError
from ssrics_like.world.buildings.pieces import Piece, patch
from ssrics_like.world.buildings.plan import Passage, Plan, Rectangle, Space, build, draw, window
from ssrics_like.world.grid import FREE, OCCUPIED
from ssrics_like.world.locations import Location


def two_rooms(**more):
    """Return two rooms of 2 x 1 m with a doorway of 0.4 m between them."""
    return Plan(
        "Two rooms", 5.0, 1.4,
        (
            Space(id="left", x_m=(0.2, 2.2), y_m=(0.2, 1.2)),
            Space(id="right", x_m=(2.4, 4.8), y_m=(0.2, 1.2)),
        ),
        (Passage(id="D", x_m=2.3, y_m=0.7, axis="x", width_m=0.4, depth_m=0.2),),
        **more,
    )  # fmt: skip


def test_edges_on_cell_boundaries_are_exact():
    for cell_m in (0.05, 0.1, 0.2):
        cells = draw(two_rooms(), cell_m).cells
        assert cells.shape == (round(1.4 / cell_m), round(5.0 / cell_m))
        # 2 x 1 + 2.4 x 1 of rooms, 0.2 x 0.4 of doorway
        assert (cells == FREE).sum() == round((2.0 + 2.4 + 0.08) / cell_m**2)
        row = cells[round(0.7 / cell_m)]
        assert (row == OCCUPIED).sum() == round(0.4 / cell_m)
        assert (cells[round(0.3 / cell_m)] == OCCUPIED).sum() == round(0.6 / cell_m)
        assert (cells[0] == OCCUPIED).all()


def test_walls_stand_in_spaces_and_passages_cut_through_them():
    wall = Rectangle(x_m=(0.2, 2.2), y_m=(0.7, 0.8))
    gap = Passage(x_m=1.0, y_m=0.75, axis="y", width_m=0.6, depth_m=0.1)
    plan = two_rooms(walls=(wall,))
    assert (draw(plan).cells == FREE).sum() == 1792 - 80  # 4.48 square metres, less 2 x 0.1
    cut = Plan(plan.title, 5.0, 1.4, plan.spaces, (*plan.passages, gap), plan.walls)
    assert (draw(cut).cells == FREE).sum() == 1792 - 80 + 24


def test_places_are_passages_that_have_a_name_and_the_others():
    corner = Location("C", 1.0, 1.0, kind="corner")
    plan = two_rooms(places=(corner,))
    nameless = Passage(x_m=1.0, y_m=0.7, axis="y", width_m=0.4)
    plan = Plan(plan.title, 5.0, 1.4, plan.spaces, (*plan.passages, nameless), places=plan.places)
    assert plan.locations == (Location("D", 2.3, 0.7, "", "doorway"), corner)
    building = build(plan, 0.1)
    assert building.locations == plan.locations
    assert (building.title, building.grid.cell_m) == ("Two rooms", 0.1)


def test_a_plan_with_too_many_cells_is_refused():
    with pytest.raises(MapError, match=r"5000 x 5000 m has 10000000000 cells of 0\.05 m"):
        draw(Plan("x", 5000.0, 5000.0, ()))


@pytest.mark.parametrize("bad", [(1.0, 1.0), (2.0, 1.0), (1.0,), (0.0, math.nan), (0.0, 1e9)])
def test_spans_rise_and_are_finite(bad):
    with pytest.raises(ValidationError):
        Rectangle(x_m=bad, y_m=(0.0, 1.0))


@given(st.integers(0, 400), st.integers(1, 400), st.sampled_from([0.01, 0.05, 0.1, 0.25]))
@settings(deadline=None)
def test_multiples_of_a_cell_are_never_off_by_one(first, size, cell_m):
    span = (first * cell_m, (first + size) * cell_m)
    rows, columns = window(Rectangle(x_m=span, y_m=(0.0, 1.0)), cell_m)
    assert (columns.start, columns.stop) == (first, first + size)
    assert rows == slice(0, round(1.0 / cell_m))


def solid(piece, cell_m=0.05, size=80, **options):
    """Return a square of cells with a piece in it."""
    cells = np.zeros((size, size), np.bool_)
    found = patch(piece, cells.shape, cell_m, **options)
    cells[found.rows, found.columns] = found.cells
    return cells


def test_a_box_on_cell_boundaries_fills_them_whichever_way_it_is_turned():
    box = Piece(kind="box", x_m=2.0, y_m=1.5, width_m=1.0, depth_m=0.4)
    cells = solid(box)
    assert cells.sum() == 20 * 8
    assert cells[26:34, 30:50].all()
    turned = solid(box.model_copy(update={"turn_rad": 1.5708}))
    assert turned.sum() == 20 * 8
    assert turned[20:40, 36:44].all()
    assert np.array_equal(solid(box.model_copy(update={"turn_rad": math.pi})), cells)


def test_a_turned_box_and_a_round_thing_have_their_areas():
    box = Piece(kind="box", x_m=2.0, y_m=2.0, width_m=2.0, depth_m=1.0, turn_rad=0.5)
    assert solid(box, 0.01, 400).sum() * 1e-4 == pytest.approx(2.0, rel=0.01)
    bin_ = Piece(kind="round", x_m=2.0, y_m=2.0, width_m=1.0)
    assert solid(bin_, 0.01, 400).sum() * 1e-4 == pytest.approx(math.pi / 4, rel=0.01)


@given(st.floats(0, 7), st.floats(1.5, 2.5), st.floats(1.5, 2.5))
@settings(max_examples=60, deadline=None)
def test_a_thin_door_leaf_is_a_line_without_gaps(turn, x, y):
    leaf = Piece(kind="box", x_m=x, y_m=y, width_m=0.9, depth_m=0.01, turn_rad=turn)
    cells = solid(leaf)
    assert ndimage.label(cells, np.ones((3, 3)))[1] == 1
    assert cells.sum() >= 0.9 / 0.05 * max(abs(math.cos(turn)), abs(math.sin(turn))) - 2


@given(st.sampled_from(["table", "chair"]), st.floats(0, 7), st.floats(1.5, 2.5))
@settings(max_examples=60, deadline=None)
def test_tables_and_chairs_stand_on_four_legs_and_cover_more(kind, turn, x):
    piece = Piece(kind=kind, x_m=x, y_m=2.0, width_m=0.8, depth_m=0.6, turn_rad=turn)
    legs = solid(piece)
    assert ndimage.label(legs, np.ones((3, 3)))[1] == 4
    whole = solid(piece, whole=True)
    assert not (legs & ~whole).any()
    assert whole.sum() * 0.0025 == pytest.approx(0.48, rel=0.15)


def test_a_desk_stands_on_drawers_and_two_legs():
    cells = solid(Piece(kind="desk", x_m=2.0, y_m=2.0, width_m=1.6, depth_m=0.8))
    parts, count = ndimage.label(cells)
    assert count == 3
    # 0.42 m of drawers on the left, 0.8 m deep
    assert max(np.bincount(parts.ravel())[1:]) == pytest.approx(0.42 * 0.8 / 0.0025, rel=0.1)


@given(
    st.sampled_from(["box", "round", "table", "chair", "desk"]), st.floats(-3, 7), st.floats(-3, 7),
    st.floats(0.01, 5), st.floats(0.01, 5), st.floats(-9, 9),
)  # fmt: skip
@settings(max_examples=100, deadline=None)
def test_furniture_may_reach_beyond_the_grid(kind, x, y, width, depth, turn):
    piece = Piece(kind=kind, x_m=x, y_m=y, width_m=width, depth_m=depth, turn_rad=turn)
    cells = solid(piece)
    if 0 < x < 4 and 0 < y < 4 and kind in ("box", "round"):
        # A cell is solid if its middle is: of a thin piece that may be a neighbour's.
        row, column = math.floor(y / 0.05), math.floor(x / 0.05)
        assert cells[max(row - 1, 0) : row + 2, max(column - 1, 0) : column + 2].any()
