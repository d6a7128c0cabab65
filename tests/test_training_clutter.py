"""Clutter to train in: the robot still gets about, and what is a doorway is labelled."""

from dataclasses import replace

import numpy as np
import pytest
from buildings import DOOR, room, two_rooms
from scipy import ndimage
from scipy.spatial.distance import cdist

from ssrics_like.perception.observation import Pose
from ssrics_like.training import conditions
from ssrics_like.training.buildings import training_building
from ssrics_like.training.false_gaps import false_gaps
from ssrics_like.training.frames import door_frames
from ssrics_like.training.jambs import clutter_jambs
from ssrics_like.training.obstacles import Obstacles
from ssrics_like.training.probing import free_way, near_any
from ssrics_like.training.rough_walls import rough_walls
from ssrics_like.world.buildings.pieces import Piece
from ssrics_like.world.grid import FREE, GridMap
from ssrics_like.world.reachable import reachable, standing

RADIUS_M = 0.23
START = Pose(1.0, 1.0, 0.0)
HALLWAY = room(16.0, 2.2)  # 2 m wide inside


def share_kept(before, after, start=START):
    reached = [reachable(grid, start.x_m, start.y_m, RADIUS_M).sum() for grid in (before, after)]
    return reached[1] / reached[0]


def added(before, after):
    """Return which cells were filled; nothing may have been taken away."""
    filled = after.solid & ~before.solid
    assert np.array_equal(after.solid, before.solid | filled)
    assert (after.cell_m, after.origin) == (before.cell_m, before.origin)
    return filled


def middles(cells, grid):
    return (np.argwhere(cells)[:, ::-1] + 0.5) * grid.cell_m


def test_an_obstacle_that_shuts_the_robot_off_is_not_put():
    grid = two_rooms()
    obstacles = Obstacles(grid, START, RADIUS_M, 0.9)
    crate = {"kind": "box", "width_m": 0.4, "depth_m": 0.6}
    assert not obstacles.put([Piece(x_m=DOOR[0], y_m=DOOR[1], **crate)])
    assert obstacles.grid is grid
    assert obstacles.put([Piece(x_m=5.5, y_m=2.5, **crate)])
    assert added(grid, obstacles.grid).sum() == 8 * 12
    assert not obstacles.fill(np.ones_like(grid.solid))
    assert not grid.solid[50, 110]  # the plan that was given is left as it is


def test_where_the_robot_does_not_fit_nothing_is_put():
    obstacles = Obstacles(HALLWAY, Pose(0.2, 0.2, 0.0), RADIUS_M, 0.9)
    assert not obstacles.put([Piece(kind="box", x_m=8.0, y_m=1.0, width_m=0.1, depth_m=0.1)])


def test_free_ways_end_at_walls_and_at_the_limit():
    grid = two_rooms(0.9)
    assert free_way(grid, 3.0, 1.5, (0, 1), 3.0) == pytest.approx(0.45, abs=grid.cell_m)
    assert free_way(grid, 3.0, 1.5, (0, -1), 3.0) == pytest.approx(0.45, abs=grid.cell_m)
    assert free_way(grid, 3.0, 1.5, (1, 0), 2.0) == 2.0
    assert free_way(grid, 3.0, 1.5, (-1, 0), 5.0) == pytest.approx(2.9, abs=grid.cell_m)


def test_nearness_to_no_places_is_none():
    assert not near_any(0.0, 0.0, [], 5.0)
    assert near_any(0.0, 0.0, [(9.0, 9.0), (0.0, 1.0)], 1.1)
    assert not near_any(0.0, 0.0, [(9.0, 9.0), (0.0, 1.0)], 1.0)


def turned(grid):
    """Return a plan with x and y exchanged."""
    return GridMap(grid.cells.T.copy(), grid.cell_m)


@pytest.mark.parametrize("upright", [False, True])
@pytest.mark.parametrize("seed", range(6))
def test_frames_stand_across_hallways_and_are_labelled(seed, upright):
    hallway = turned(HALLWAY) if upright else HALLWAY
    known = [(8.0, 1.1)[:: -1 if upright else 1]]
    grid, doorways = door_frames(hallway, known, 3, START, RADIUS_M, np.random.default_rng(seed))
    assert share_kept(hallway, grid) > 0.95
    filled = added(hallway, grid)
    if upright:
        grid, filled, doorways = turned(grid), filled.T, doorways[:, ::-1]
    assert 1 <= len(doorways) <= 3
    together = np.concatenate([[(8.0, 1.1)], doorways])
    apart = cdist(together, together) + 99.0 * np.eye(len(together))
    assert apart.min() > 1.0
    # Each is a gap: narrower than the hallway, and the hallway goes on behind and ahead of it.
    for x, y in doorways.tolist():
        ways = [free_way(grid, x, y, (0, s), 3.0) for s in (1, -1)]
        assert 0.75 <= sum(ways) <= 1.85
        assert abs(ways[0] - ways[1]) <= 2 * grid.cell_m
        beside = grid.cells[:, int(x / grid.cell_m)] == FREE
        # No slit at the walls; the cell of the middle is counted in both ways.
        assert beside.sum() == round(sum(ways) / grid.cell_m) - 1
        for ahead in (-0.6, 0.6):
            assert sum(free_way(grid, x + ahead, y, (0, s), 3.0) for s in (1, -1)) > 1.9
    # And all that was filled belongs to one of them.
    assert cdist(middles(filled, grid), doorways).min(axis=1).max() < 1.7


def test_a_frame_too_narrow_for_the_robot_is_not_put():
    put = 0
    for seed in range(8):
        rng = np.random.default_rng(seed)
        grid, doorways = door_frames(HALLWAY, [], 3, Pose(8.0, 1.1, 0.0), 0.6, rng)
        there = [standing(plan, 8.0, 1.1, 0.6) for plan in (HALLWAY, grid)]
        assert there[1].any(axis=0).sum() > 0.9 * there[0].any(axis=0).sum()
        put += len(doorways)
    assert put > 0


def test_no_frame_where_it_is_too_wide_or_wanted_none():
    hall = room(9.0, 9.0)
    for grid, count in ((hall, 3), (HALLWAY, 0)):
        made, doorways = door_frames(grid, [], count, START, RADIUS_M, np.random.default_rng(0))
        assert not added(grid, made).any()
        assert doorways.shape == (0, 2)


@pytest.mark.parametrize("seed", range(8))
def test_panels_and_posts_stand_beside_the_jambs(seed):
    plan = two_rooms()
    grid = clutter_jambs(plan, [DOOR] * 8, START, RADIUS_M, np.random.default_rng(seed))
    filled = added(plan, grid)
    assert share_kept(plan, grid) > 0.93
    assert filled.any()  # of 32 corners hardly ever none is taken
    x, y = (middles(filled, grid) - DOOR).T
    assert (np.abs(y) > 0.3).all()  # the way through stays
    assert (np.abs(y) < 0.45 + 0.6 + 0.35).all()
    assert (np.abs(x) < 0.3 + 2.5 + 0.1).all()
    assert standing(grid, START.x_m, START.y_m, RADIUS_M)[30, 90]  # the other room


def test_jambs_follow_the_wall_whichever_way_it_runs():
    plan = two_rooms()
    door = DOOR[::-1]
    start = Pose(START.y_m, START.x_m, 0.0)
    for seed in range(4):
        one = clutter_jambs(plan, [DOOR], START, RADIUS_M, np.random.default_rng(seed))
        other = clutter_jambs(turned(plan), [door], start, RADIUS_M, np.random.default_rng(seed))
        assert np.array_equal(one.cells.T, other.cells)


@pytest.mark.parametrize("seed", range(6))
def test_false_gaps_are_as_wide_as_doorways_and_away_from_labels(seed):
    hall = room(12.0, 12.0)
    start = Pose(6.0, 6.0, 0.0)
    labelled = [(x, y) for x in range(8) for y in range(13)]  # room is left at one side only
    grid = false_gaps(hall, labelled, 1, start, RADIUS_M, np.random.default_rng(seed))
    filled = added(hall, grid)
    assert share_kept(hall, grid, start) > 0.93
    parts, count = ndimage.label(filled, np.ones((3, 3)))
    assert count == 2
    one, other = (middles(parts == part, grid) for part in (1, 2))
    gap = cdist(one, other).min() - grid.cell_m
    assert 0.75 - 0.1 < gap < 1.5 + 0.2
    between = (one.mean(axis=0) + other.mean(axis=0)) / 2
    assert between[0] > 7.5


@pytest.mark.parametrize("seed", range(4))
def test_false_gaps_do_not_shut_a_hallway(seed):
    grid = false_gaps(HALLWAY, [], 4, START, RADIUS_M, np.random.default_rng(seed))
    assert added(HALLWAY, grid).any()
    assert share_kept(HALLWAY, grid) > 0.93


def test_false_gaps_wanted_none_or_without_room_change_nothing():
    narrow = room(6.0, 1.0)  # the disc that looks for room does not fit
    for grid, count in ((narrow, 4), (HALLWAY, 0)):
        made = false_gaps(grid, [], count, Pose(1, 0.5, 0), RADIUS_M, np.random.default_rng(0))
        assert np.array_equal(made.cells, grid.cells)


@pytest.mark.parametrize("seed", range(4))
def test_rough_walls_are_rough_beside_walls_only(seed):
    grid = rough_walls(HALLWAY, START, RADIUS_M, np.random.default_rng(seed))
    filled = added(HALLWAY, grid)
    beside = np.zeros_like(filled)
    beside[2:-2, 2:-2] = True
    beside[3:-3, 3:-3] = False
    assert filled.any()
    assert not (filled & ~beside).any()
    assert filled.sum() / beside.sum() < 0.3
    assert share_kept(HALLWAY, grid) > 0.9


def test_walls_stay_smooth_where_the_robot_just_fits():
    lane, start = room(16.0, 0.75), Pose(1.0, 0.375, 0.0)
    smooth = 0
    for seed in range(4):
        grid = rough_walls(lane, start, RADIUS_M, np.random.default_rng(seed))
        assert share_kept(lane, grid, start) > 0.9
        smooth += not added(lane, grid).any()
    assert smooth > 0


@pytest.mark.parametrize("seed", [0, 5])
def test_a_training_building_is_passable_and_its_doorways_are_free(seed):
    rng = np.random.default_rng(seed)
    drawn = conditions.drawn_conditions(rng)
    made = training_building(drawn, rng)
    grid = made.grid
    assert len(made.doorways_m) >= drawn.building.rooms // 2
    assert not near_any(*made.doorways_m[0], made.doorways_m[1:], 0.5)
    there = reachable(grid, made.start.x_m, made.start.y_m, drawn.robot.radius_m)
    assert there.sum() > 0.6 * (grid.cells == FREE).sum()
    free = [grid.is_free(x, y) for x, y in grid.points_in_grid(made.doorways_m)]
    assert np.mean(free) > 0.8  # furniture may stand in a doorway that is one of two ways


def test_frames_are_labelled_beside_the_generators_doorways():
    more = 0
    for seed in range(3):
        drawn = replace(
            conditions.drawn_conditions(np.random.default_rng(seed)), pieces=0, false_gaps=0
        )
        plain, framed = (
            training_building(replace(drawn, frames=frames), np.random.default_rng(seed))
            for frames in (0, 3)
        )
        known = len(plain.doorways_m)
        assert np.array_equal(framed.doorways_m[:known], plain.doorways_m)
        assert np.array_equal(framed.others_m, plain.others_m)
        more += len(framed.doorways_m) - known
    assert more > 0


def test_a_seed_decides_what_a_building_is_like():
    def made(seed):
        rng = np.random.default_rng(seed)
        drawn = conditions.drawn_conditions(rng)
        return drawn, training_building(drawn, rng)

    (one, first), (again, second), (other, third) = made(2), made(2), made(3)
    assert one == again != other
    assert np.array_equal(first.grid.cells, second.grid.cells)
    assert np.array_equal(first.doorways_m, second.doorways_m)
    assert first.grid.cells.shape != third.grid.cells.shape
