"""Furniture on any plan: away from what is kept clear, and in nobody's way."""

import math

import numpy as np
import pytest
from scipy import ndimage

from ssrics_like.errors import MapError
from ssrics_like.perception.observation import Pose
from ssrics_like.world.buildings.furniture import SORTS, WEIGHTS, furnish
from ssrics_like.world.buildings.pieces import Piece, patch
from ssrics_like.world.buildings.placing import CLEAR_M, Placing
from ssrics_like.world.grid import FREE, OCCUPIED, GridMap
from ssrics_like.world.reachable import clearance, reachable, roomiest, standing

RADIUS_M = 0.27


def hall(width_m=8.0, height_m=5.0, cell_m=0.05, walls=()):
    """Return an empty room with a wall round it and boxes (x0, y0, x1, y1) of wall in it."""
    rows, columns = round(height_m / cell_m), round(width_m / cell_m)
    cells = np.full((rows, columns), OCCUPIED, np.uint8)
    cells[2:-2, 2:-2] = FREE
    for x0, y0, x1, y1 in walls:
        cells[round(y0 / cell_m) : round(y1 / cell_m), round(x0 / cell_m) : round(x1 / cell_m)] = (
            OCCUPIED
        )
    return GridMap(cells, cell_m, Pose(3.0, -2.0, 0.4))


TWO_ROOMS = hall(walls=[(3.9, 0.0, 4.1, 2.0), (3.9, 2.9, 4.1, 5.0)])  # a doorway of 0.9 m


def strayed(before, after, start, radius_m=RADIUS_M):
    """Return where the robot fitted and got before, fits still, but does not get any more."""
    fits = clearance(after) > radius_m
    return standing(before, *start, radius_m) & fits & ~standing(after, *start, radius_m)


@pytest.mark.parametrize("seed", range(8))
def test_nothing_is_cut_off_and_clear_places_stay_clear(seed):
    clear = np.array([[1.0, 1.0], [4.0, 2.45], [7.0, 4.0]])
    done = furnish(TWO_ROOMS, np.random.default_rng(seed), 40, clear, RADIUS_M)
    assert (done.cell_m, done.origin) == (TWO_ROOMS.cell_m, TWO_ROOMS.origin)
    added = (done.cells != TWO_ROOMS.cells) & (TWO_ROOMS.cells == FREE)
    assert added.sum() > 200
    assert np.array_equal(done.cells != TWO_ROOMS.cells, added)  # nothing was taken away
    rows, columns = np.nonzero(added)
    middles = np.column_stack([columns + 0.5, rows + 0.5]) * done.cell_m
    apart = np.hypot(*(middles[:, None] - clear).T)
    assert apart.min() > CLEAR_M
    # All that is left over are single cells between the legs of tables.
    parts, count = ndimage.label(strayed(TWO_ROOMS, done, (1.0, 1.0)))
    assert all(size <= 40 for size in np.bincount(parts.ravel(), minlength=count + 1)[1:])
    assert reachable(done, 1.0, 1.0, RADIUS_M)[round(4.0 / 0.05), round(7.0 / 0.05)]


def test_the_same_seed_puts_the_same_furniture():
    def cells(seed):
        return furnish(TWO_ROOMS, np.random.default_rng(seed), 10, [[1.0, 1.0]], RADIUS_M).cells

    assert np.array_equal(cells(3), cells(3))
    assert not np.array_equal(cells(3), cells(4))
    assert (TWO_ROOMS.cells == hall(walls=[(3.9, 0.0, 4.1, 2.0), (3.9, 2.9, 4.1, 5.0)]).cells).all()


def test_no_pieces_change_nothing_and_a_full_plan_takes_no_more():
    rng = np.random.default_rng(0)
    assert np.array_equal(furnish(TWO_ROOMS, rng, 0, [[1.0, 1.0]], RADIUS_M).cells, TWO_ROOMS.cells)
    closet = hall(1.2, 1.2)
    assert np.array_equal(furnish(closet, rng, 5, [[0.6, 0.6]], RADIUS_M).cells, closet.cells)


def test_a_robot_that_does_not_fit_at_its_start_is_refused():
    with pytest.raises(MapError, match=r"radius 0.27 m does not fit at \(0.2, 0.2\)"):
        furnish(TWO_ROOMS, np.random.default_rng(0), 1, [[0.2, 0.2]], RADIUS_M)
    with pytest.raises(MapError, match="name at least where the robot starts"):
        furnish(TWO_ROOMS, np.random.default_rng(0), 1, [], RADIUS_M)


def test_what_would_shut_a_doorway_is_not_put():
    placing = Placing(TWO_ROOMS, [[1.0, 1.0]], RADIUS_M)
    before = placing.standing
    assert not placing.put(Piece(kind="box", x_m=4.5, y_m=2.45, width_m=0.5, depth_m=1.0))
    assert not placing.put(Piece(kind="round", x_m=4.0, y_m=2.45, width_m=0.4))
    assert placing.standing is before
    assert np.array_equal(placing.cells, TWO_ROOMS.cells)
    # The same box a metre further in leaves a way round it.
    assert placing.put(Piece(kind="box", x_m=5.5, y_m=2.45, width_m=0.5, depth_m=1.0))
    assert placing.standing.sum() < before.sum()


def test_a_piece_stands_on_free_cells_away_from_what_is_kept_clear():
    placing = Placing(TWO_ROOMS, [[2.0, 2.5]], RADIUS_M)
    for x_m, y_m in [(0.2, 2.0), (2.0, 2.5), (2.0, 1.5), (-3.0, 2.0)]:
        box = Piece(kind="box", x_m=x_m, y_m=y_m, width_m=0.4, depth_m=0.4)
        put = placing.put(box)
        assert put == (x_m == -3.0), (x_m, y_m)  # off the plan there is nothing to put
    assert placing.put(Piece(kind="box", x_m=2.0, y_m=1.0, width_m=0.4, depth_m=0.4))
    assert not placing.put(Piece(kind="round", x_m=2.1, y_m=1.1, width_m=0.4))


def test_a_leaning_piece_may_touch_a_wall_but_not_block_the_way():
    placing = Placing(TWO_ROOMS, [[1.0, 1.0], [4.0, 2.45]], RADIUS_M)
    leaf = Piece(kind="box", x_m=4.55, y_m=1.98, width_m=0.85, depth_m=0.05)
    assert not placing.put(leaf)
    assert placing.put(leaf, leaning=True)
    across = Piece(kind="box", x_m=4.2, y_m=2.4, width_m=0.05, depth_m=0.8)
    assert not placing.put(across, leaning=True)


def test_where_the_robot_gets_to_is_kept_as_it_would_be_computed_anew():
    placing = Placing(TWO_ROOMS, [[1.0, 1.0]], RADIUS_M)
    rng = np.random.default_rng(5)
    for _ in range(60):
        x_m, y_m = rng.uniform(0.2, 7.8), rng.uniform(0.2, 4.8)
        placing.put(
            Piece(kind="box", x_m=x_m, y_m=y_m, width_m=0.5, depth_m=0.4, turn_rad=rng.uniform(0, 3))
        )  # fmt: skip
        anew = standing(GridMap(placing.cells, 0.05), 1.0, 1.0, RADIUS_M)
        assert np.array_equal(placing.standing, anew)


def test_weights_add_up_and_cupboards_stand_at_walls():
    assert math.isclose(sum(WEIGHTS), 1.0)
    assert len(SORTS) == len(WEIGHTS)
    done = furnish(hall(), np.random.default_rng(1), 12, [[4.0, 2.5]], RADIUS_M)
    added = done.cells != hall().cells
    assert added[2:6].any() or added[-6:-2].any() or added[:, 2:6].any() or added[:, -6:-2].any()


def test_every_real_plan_can_be_furnished(data_dir):
    from ssrics_like.maps import load_building

    for path in sorted((data_dir / "maps").glob("*/map.yaml")):
        grid = load_building(path).grid
        start = roomiest(grid)
        at = (start.x_m, start.y_m)
        done = furnish(grid, np.random.default_rng(1), 25, [at], RADIUS_M)
        assert (done.cells != grid.cells).sum() > 300, path
        lost = strayed(grid, done, at)
        parts, count = ndimage.label(lost)
        assert all(size <= 40 for size in np.bincount(parts.ravel(), minlength=count + 1)[1:]), path


def test_a_patch_is_cut_at_the_edges_of_the_grid():
    found = patch(Piece(kind="round", x_m=0.0, y_m=0.0, width_m=1.0), (10, 10), 0.1)
    assert (found.rows.start, found.columns.start) == (0, 0)
    assert found.cells[:5, :5].sum() == 20  # a quarter of a disc of 5 cells radius
