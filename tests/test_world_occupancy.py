"""The robot's own map: what a scan says of a cell, and that no count is ever lost."""

import math

import numpy as np
import pytest
from buildings import CELL_M, exact_laser, offices, room
from hypothesis import given, settings
from hypothesis import strategies as st

from ssrics_like.perception.observation import LaserScan, Pose
from ssrics_like.world.laser import Laser, leaps
from ssrics_like.world.navigation import Navigator
from ssrics_like.world.occupancy import (
    BERTH_M,
    BLOCKED,
    OPEN,
    SILENT_RUN,
    SQUEEZE,
    SQUEEZE_M,
    TIGHT,
    OccupancyGrid,
)
from ssrics_like.world.occupancy_kernels import HIT, MISS, MOST
from ssrics_like.world.reachable import clearance
from ssrics_like.world.robot import LaserProfile, RobotProfile

RADIUS_M = 0.27
RADII = (RADIUS_M, RADIUS_M + SQUEEZE_M, RADIUS_M + BERTH_M)
ALL_AROUND = exact_laser(360, 360.0)
AHEAD = exact_laser()
NOBODY = np.empty((0, 3))


def mapped(grid, pose, profile=ALL_AROUND, people=NOBODY, own=None):
    """Return the robot's map after one more scan of a laser without faults."""
    own = own or OccupancyGrid(grid.cells.shape, grid.cell_m, RADIUS_M)
    laser = Laser(profile, np.random.default_rng(0))
    scan = laser.scan(leaps(grid.solid), grid.cell_m, pose, people)
    own.take(scan, pose, profile.directions)
    return own


def taken(ranges):
    """Return the map of a field of 12 x 12 m after a scan from (1, 6), and what became known."""
    own = OccupancyGrid((240, 240), CELL_M, RADIUS_M)
    scan = LaserScan(np.array(ranges, float), math.radians(-89.5), math.radians(1.0))
    return own, own.take(scan, Pose(1.0, 6.0, 0.0), AHEAD.directions)


def recounted(evidence, cell_m):
    """Count, for each cell and radius, the occupied cells whose near edge is within the radius.

    The cells around the grid are occupied, too.
    """
    occupied = np.argwhere(np.pad(evidence > 0, 1, constant_values=True)) - 1
    row, column = np.indices(evidence.shape)
    counts = np.zeros((len(RADII), *evidence.shape), int)
    for r, c in occupied:
        edge_m = (np.hypot(row - r, column - c) - 0.5) * cell_m
        for layer, radius_m in enumerate(RADII):
            counts[layer] += edge_m <= radius_m
    return counts


@settings(max_examples=40, deadline=None)
@given(st.floats(0.3, 3.7), st.floats(0.3, 2.7), st.floats(-math.pi, math.pi))
def test_one_exact_scan_of_a_room_frees_all_of_it_and_nothing_else(x, y, theta):
    grid = room(4.0, 3.0)
    dense = exact_laser(1440, 360.0)  # no cell of the corners lies between two beams
    own = mapped(grid, Pose(x, y, theta), dense)
    inner = ~grid.solid
    assert np.array_equal(own.evidence < 0, inner)
    # Each beam ends half a cell inside the wall: at range + 0.5 cells.
    bearings = theta + dense.bearings_rad
    laser = Laser(dense, np.random.default_rng(0))
    far = laser.scan(leaps(grid.solid), CELL_M, Pose(x, y, theta)).ranges_m + 0.5 * CELL_M
    column = np.floor((x + far * np.cos(bearings)) / CELL_M).astype(int)
    row = np.floor((y + far * np.sin(bearings)) / CELL_M).astype(int)
    walls = np.zeros_like(inner)
    walls[row, column] = True
    assert np.array_equal(own.evidence > 0, walls)
    assert not (walls & inner).any()


def test_a_scan_of_180_degrees_says_nothing_of_what_lies_behind():
    grid = room(4.0, 3.0)
    own = mapped(grid, Pose(2.01, 1.51, 0.0), AHEAD)
    ahead = np.arange(80) * CELL_M >= 2.0
    inner = ~grid.solid
    assert (own.evidence[inner & ahead] < 0).all()
    # Beside it the first and last beam look half a degree ahead.
    behind = np.arange(80) * CELL_M < 1.9
    assert (own.evidence[:, behind] == 0).all()


def test_through_doorways_it_sees_into_rooms_but_through_no_wall():
    grid = offices()
    thin = {"free": [], "wall": []}
    rng = np.random.default_rng(4)
    fits = np.argwhere(clearance(grid) > RADIUS_M)
    for row, column in fits[rng.integers(len(fits), size=40)]:
        x, y = (column + rng.random()) * CELL_M, (row + rng.random()) * CELL_M
        own = mapped(grid, Pose(x, y, rng.uniform(-3, 3)))
        thin["wall"].append(np.count_nonzero((own.evidence < 0) & grid.solid))
        thin["free"].append(np.count_nonzero((own.evidence > 0) & ~grid.solid))
    # Beams that graze the edge of a doorway may be off by a cell: of 20,000, no more than a few.
    assert max(thin["wall"]) <= 3
    assert max(thin["free"]) <= 8


def test_it_tells_how_many_cells_became_known():
    grid = room(4.0, 3.0)
    own = OccupancyGrid(grid.cells.shape, CELL_M, RADIUS_M)
    known = 0
    for theta in (0.0, 1.0, 2.5, 2.5):
        pose = Pose(2.0, 1.5, theta)
        scan = Laser(AHEAD, np.random.default_rng(0)).scan(leaps(grid.solid), CELL_M, pose)
        known += own.take(scan, pose, AHEAD.directions)
        assert known == np.count_nonzero(own.evidence)
    assert own.take(scan, pose, AHEAD.directions) == 0


@settings(max_examples=60, deadline=None)
@given(
    st.integers(1, 14), st.integers(1, 14),
    st.lists(
        st.tuples(
            st.integers(0, 13), st.integers(0, 13), st.sampled_from([HIT, -MISS, 2 * MOST, -MOST, 1])
        ),
        max_size=60,
    ),
)  # fmt: skip
def test_evidence_never_returns_to_zero_and_counts_equal_a_recount(rows, columns, changes):
    own = OccupancyGrid((rows, columns), 0.1, RADIUS_M)
    sums = {}
    for row, column, weight in changes:
        if row >= rows or column >= columns:
            continue
        own._add(row, column, weight)
        before = sums.get((row, column), 0)
        after = max(-MOST, min(MOST, before + weight))
        sums[row, column] = after or (1 if weight > 0 else -1)
        assert own.evidence[row, column] == sums[row, column]
    assert np.count_nonzero(own.evidence) == len(sums)
    assert np.array_equal(own._counts, recounted(own.evidence, 0.1))


def test_what_has_come_to_stand_where_it_was_free_can_be_forgotten_and_walls_cannot():
    grid, pose = room(6.0, 4.0), Pose(1.0, 2.0, 0.0)
    own = None
    for _ in range(20):
        own = mapped(grid, pose, own=own)
    walls = own.evidence > 0
    for _ in range(20):
        mapped(grid, pose, people=np.array([[3.0, 2.0, 0.25]]), own=own)
    came = (own.evidence > 0) & ~walls
    assert came.sum() >= 4
    assert own.forget_moved() == came.sum()
    assert np.array_equal(own.evidence > 0, walls)
    assert (own.evidence[came] < 0).all()
    assert np.array_equal(own._counts, recounted(own.evidence, CELL_M))
    assert own.forget_moved() == 0
    # It is taken for free only until it is seen again.
    mapped(grid, pose, people=np.array([[3.0, 2.0, 0.25]]), own=own)
    assert own.evidence[40, 55] > 0


def test_counts_equal_a_recount_after_a_drive_with_faults():
    grid = room(6.0, 4.0, walls=[(2.0, 1.0, 2.3, 1.4), (4.0, 2.5, 4.1, 4.0)])
    profile = exact_laser(noise_m=0.05, dropout=0.1, mixed=0.5)
    laser, leap = Laser(profile, np.random.default_rng(1)), leaps(grid.solid)
    rng = np.random.default_rng(2)
    own = OccupancyGrid(grid.cells.shape, CELL_M, RADIUS_M)
    for _ in range(60):
        pose = Pose(rng.uniform(0.4, 5.6), rng.uniform(0.4, 3.6), rng.uniform(-3, 3))
        person = np.array([[rng.uniform(0.4, 5.6), rng.uniform(0.4, 3.6), 0.2]])
        own.take(laser.scan(leap, CELL_M, pose, person), pose, profile.directions)
    own.meet(3.0, 2.0)
    assert np.count_nonzero(own.evidence > 0) > 300
    assert np.array_equal(own._counts, recounted(own.evidence, CELL_M))


def test_costs_rise_towards_what_is_occupied():
    own = OccupancyGrid((60, 60), CELL_M, RADIUS_M)
    solid = np.zeros((60, 60), bool)
    solid[30, 30] = True
    own.know(solid)
    own.evidence[:, :5] = 0
    costs = own.costs()
    # From the middle of a cell to the near edge of the occupied one: its distance less half a cell.
    # What lies around the grid is occupied, too.
    row, column = np.indices(solid.shape)
    outside = np.min([row + 1, column + 1, 60 - row, 60 - column], axis=0)
    edge_m = (np.minimum(np.hypot(row - 30, column - 30), outside) - 0.5) * CELL_M
    expected = np.select([edge_m <= r for r in RADII], [BLOCKED, SQUEEZE, TIGHT], OPEN)
    expected[30, 30] = 0
    expected[:, :5] = 0  # never seen
    assert np.array_equal(costs, expected)


def test_a_way_is_open_until_something_stands_on_it_and_may_lead_out_of_what_it_touches():
    own = OccupancyGrid((60, 60), CELL_M, RADIUS_M)
    own.know(np.zeros((60, 60), bool))
    way = np.column_stack([np.arange(0.5, 2.5, 0.05), np.full(40, 1.5)])
    assert own.is_open(way, 0)
    own.meet(1.0, 1.5)
    assert not own.is_open(way, 0)
    assert own.is_open(way, 12)  # from 1.1 m on it leads out only
    assert own.is_open(np.empty((0, 2)), 0)


def test_what_the_bumper_met_is_solid_where_something_was_seen_before():
    own = OccupancyGrid((60, 60), CELL_M, RADIUS_M)
    own.meet(1.0, 1.5)
    own.meet(-4.0, 99.0)
    assert not own.evidence.any()
    own.know(np.zeros((60, 60), bool))
    own.meet(1.0, 1.5)
    assert own.evidence[30, 20] == MOST
    assert np.count_nonzero(own.evidence > 0) == 1


def test_beams_without_an_answer_and_lost_ones_say_nothing():
    own, new = taken([math.nan] * 180)
    assert new == 0
    assert not own.evidence.any()
    wall = 3.0 / np.cos(AHEAD.bearings_rad)
    whole, _ = taken(wall)
    for answer in (math.nan, math.inf):
        gap = wall.copy()
        gap[88:92] = answer  # four lost beams are fewer than a silent run
        own, _ = taken(gap)
        # What it says is a part of what all beams say.
        known = own.evidence != 0
        assert np.array_equal(np.sign(own.evidence[known]), np.sign(whole.evidence[known]))
        # Straight ahead, where the lost beams are farther apart than a cell, nothing is known.
        assert own.evidence[120, 20 + 50] == 0
        assert whole.evidence[120, 20 + 50] < 0
        assert own.evidence[120, 20 + 60] == 0
        assert whole.evidence[120, 20 + 60] > 0


@pytest.mark.parametrize(("run", "is_free"), [(SILENT_RUN - 1, False), (SILENT_RUN, True)])
def test_only_a_long_run_of_silent_beams_means_free(run, is_free):
    wall = 2.0 / np.cos(AHEAD.bearings_rad)
    wall[88 : 88 + run] = math.inf
    own, _ = taken(wall)
    row, column = 120, 20 + 100  # 5 m ahead, behind the wall
    assert (own.evidence[row, column] < 0) == is_free
    assert (own.evidence > 0)[:, :50].sum() == 0
    assert own.evidence[120 + 20, 20 + 40] > 0  # beside the run there is the wall


def test_far_readings_free_the_way_to_them_but_mark_nothing():
    own, _ = taken(np.full(180, 9.0))  # beyond the reach of the map, 8 m
    assert (own.evidence > 0).sum() == 0
    row, column = np.nonzero(own.evidence)
    far_m = np.hypot((column + 0.5) * CELL_M - 1.0, (row + 0.5) * CELL_M - 6.0)
    assert far_m.max() == pytest.approx(8.0, abs=CELL_M)
    # No gaps between beams that are 14 cm apart out there.
    row, column = np.indices(own.evidence.shape)
    y, x = (row + 0.5) * CELL_M - 6.0, (column + 0.5) * CELL_M - 1.0
    between = (np.hypot(x, y) < 7.8) & (np.abs(np.arctan2(y, x)) < math.radians(89))
    assert (own.evidence[between] < 0).all()
    assert (own.evidence[x < -CELL_M] == 0).all()


def test_a_person_who_walks_away_fades_from_the_map():
    grid, pose = room(6.0, 4.0), Pose(1.0, 2.0, 0.0)
    own = mapped(grid, pose)
    person = np.array([[3.0, 2.0, 0.25]])
    for _ in range(20):
        mapped(grid, pose, people=person, own=own)
    there = np.argwhere((own.evidence > 0) & ~grid.solid)
    assert len(there) >= 4
    assert own.evidence[40, 55] == MOST  # the near side, at 2.75 m
    assert own.costs()[40, 50] == BLOCKED
    scans = 0
    while (own.evidence[tuple(there.T)] > 0).any():
        mapped(grid, pose, own=own)
        scans += 1
    # Each beam that passes takes MISS from at most MOST: that many scans at most.
    assert 0 < scans <= math.ceil(MOST / MISS)
    assert own.costs()[40, 50] == OPEN


def test_a_known_plan_is_believed_until_scans_say_otherwise():
    grid = room(6.0, 4.0)
    own = OccupancyGrid(grid.cells.shape, CELL_M, RADIUS_M)
    own.know(grid.solid)
    assert np.array_equal(own.evidence, np.where(grid.solid, MOST, -MOST))
    assert np.array_equal(own._counts, recounted(own.evidence, CELL_M))
    changed = room(6.0, 4.0, walls=[(3.0, 1.0, 3.2, 3.0)])
    pose = Pose(1.0, 2.0, 0.0)
    scans = 0
    while own.costs()[40, 58] == OPEN:
        mapped(changed, pose, own=own)
        scans += 1
    # HIT for each beam that ends there, from -MOST to above 0.
    assert 0 < scans <= MOST // HIT + 1
    for _ in range(MOST):
        mapped(grid, pose, own=own)
    assert (own.evidence[~grid.solid] < 0).all()


def test_a_short_sighted_laser_maps_no_farther_than_it_sees():
    # A wall lies 5.5 m ahead, the laser sees 4 m: no beam returns, and nothing beyond is known.
    own = OccupancyGrid((240, 240), CELL_M, RADIUS_M, reach_m=4.0)
    scan = LaserScan(np.full(180, np.inf), math.radians(-89.5), math.radians(1.0))
    own.take(scan, Pose(1.0, 6.0, 0.0), AHEAD.directions)
    row, column = np.nonzero(own.evidence)
    far_m = np.hypot((column + 0.5) * CELL_M - 1.0, (row + 0.5) * CELL_M - 6.0)
    assert 3.9 < far_m.max() < 4.0 + 2 * CELL_M


@pytest.mark.parametrize(("dropout", "least"), [(0.0, 5), (0.01, 5), (0.05, 7), (0.5, 30)])
def test_the_more_beams_are_lost_the_longer_a_run_must_be_to_mean_nothing(dropout, least):
    # The chance of such a run, dropout to its power, is one in a thousand million at most.
    laser = LaserProfile(dropout=dropout)
    navigator = Navigator([], RobotProfile(laser=laser), (10, 10), CELL_M)
    assert navigator.explored._silent_run == least
