"""Frontier exploration sees all that the robot can get to, and always ends."""

import math

import numpy as np
import pytest
from buildings import DOOR, exact_laser, exact_robot, offices, room, simulated, two_rooms

from ssrics_like.maps import load_building
from ssrics_like.scenarios.modules import load_robot
from ssrics_like.world.buildings.furniture import furnish
from ssrics_like.world.buildings.generator import BuildingSettings, generate
from ssrics_like.world.buildings.plan import build
from ssrics_like.world.disturbances import Crowd, Disturbances, DoorChange, SlipSettings
from ssrics_like.world.doors import door_leaf
from ssrics_like.world.exploration import Exploration
from ssrics_like.world.grid import GridMap
from ssrics_like.world.reachable import roomiest

LASERS = {
    180: exact_laser(180, 180.0, noise_m=0.02, mixed=0.05),
    240: exact_laser(682, 240.0, noise_m=0.02, mixed=0.05),
    360: exact_laser(360, 360.0, noise_m=0.02, mixed=0.05),
}
BUILDINGS = {
    "one room": (room(4.0, 3.0), (2.0, 1.5)),
    "two rooms": (two_rooms(), (1.0, 1.5)),
    "narrow corridor": (room(10.0, 1.0), (1.0, 0.5)),
    "round a pillar": (room(6.0, 6.0, walls=[(2.0, 2.0, 4.0, 4.0)]), (1.0, 1.0)),
    "offices": (offices(), (1.5, 1.0)),
}
IN_A_CORNER = (0.5, 0.5, -0.75 * math.pi)  # facing the corner, a hand from both walls
NO_FRONTIER = "no frontier left"


def wobbly(degrees=180, **changes):
    """Make a robot with the usual small faults."""
    laser = LASERS[degrees].model_copy(update=changes)
    return exact_robot(laser, actuation=0.02)


def explored(grid, start, robot=None, seed=0, time_limit_s=600.0, **disturbances):
    leg = Exploration()
    drive = simulated(
        grid, robot or wobbly(), start, [leg], seed, Disturbances(**disturbances), time_limit_s
    )
    for _ in drive:
        pass
    return drive


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("degrees", LASERS)
@pytest.mark.parametrize("name", BUILDINGS)
def test_all_that_can_be_reached_is_seen(name, degrees, seed):
    grid, start = BUILDINGS[name]
    drive = explored(grid, (*start, 2.0 * seed), wobbly(degrees), seed)
    assert drive.ended == NO_FRONTIER
    assert drive.coverage >= 0.99
    assert drive.bumps == 0


@pytest.mark.parametrize("seed", range(3))
def test_it_finds_out_of_a_corner_that_it_faces(seed):
    drive = explored(offices(), IN_A_CORNER, seed=seed)
    assert drive.ended == NO_FRONTIER
    assert drive.coverage >= 0.99


@pytest.mark.parametrize("seed", range(4))
def test_generated_buildings_with_furniture_are_seen(seed):
    plan = generate(np.random.default_rng(seed), BuildingSettings(rooms=4))
    grid = build(plan).grid
    start = roomiest(grid)
    full = furnish(grid, np.random.default_rng(seed), 10, [[start.x_m, start.y_m]], 0.27)
    drive = explored(full, (start.x_m, start.y_m), load_robot("pioneer-dx"), seed, 3600.0)
    assert drive.ended == NO_FRONTIER
    assert drive.coverage >= 0.99


def test_a_room_behind_a_slit_is_looked_into_and_left():
    slit = room(6.0, 3.0, walls=[(4.0, 0.0, 4.1, 1.3), (4.0, 1.6, 4.1, 3.0)])
    for seed in range(3):
        drive = explored(slit, (1.0, 1.5), seed=seed)
        assert drive.ended == NO_FRONTIER
        assert drive.coverage >= 0.99  # of what the body could cover: the near side of the slit
        assert drive.pose.x_m < 4.0 + 0.27
        evidence = drive.navigator.explored.evidence
        assert (evidence[:, 84:] < 0).any()  # it saw something of the pocket, not all
        assert (evidence[4:-4, 84:-4] == 0).any()


def test_a_closed_door_is_a_wall_and_one_that_closes_on_the_way_ends_the_search():
    grid = two_rooms()
    leaf = door_leaf(grid, *DOOR)
    shut = explored(grid, (1.0, 1.5), doors=(DoorChange(0.0, leaf, closed=True),))
    assert (shut.ended, shut.coverage) == (NO_FRONTIER, 1.0)
    assert (shut.navigator.explored.evidence[:, 64:] >= 0).all()
    # Turned away from the door at first, it learns of the other room too late: half is not seen.
    late = explored(grid, (1.0, 1.5, math.pi), doors=(DoorChange(0.5, leaf, closed=True),))
    assert late.ended == NO_FRONTIER
    assert 0.45 < late.coverage < 0.65


def test_somebody_who_stands_in_the_doorway_for_a_while_does_not_end_the_search():
    drive = simulated(
        two_rooms(), exact_robot(), (1.0, 1.5, math.pi), [Exploration()],
        disturbances=Disturbances(crowd=Crowd(1, speed_m_s=0.0)),
    )  # fmt: skip
    for observation in drive:
        drive._people.discs[0, :2] = DOOR if observation.t_s < 5.0 else (0.4, 2.6)
    assert drive.ended == NO_FRONTIER
    assert drive.coverage >= 0.99


@pytest.mark.parametrize("seed", range(10))
def test_people_hide_nothing_for_good(seed):
    drive = explored(offices(), (1.5, 1.0), exact_robot(), seed, crowd=Crowd(2))
    assert drive.ended == NO_FRONTIER
    assert drive.coverage >= 0.99


@pytest.mark.parametrize("seed", range(10))
@pytest.mark.parametrize("width_m", [0.6, 0.65])
def test_a_lane_that_the_body_just_fits_into_is_looked_into(width_m, seed):
    grid = room(6.0, 6.0, walls=[(0.0, 0.0, 3.0, 3.6), (3.0, 2.0, 5.9 - width_m, 4.9)])
    drive = explored(grid, (1.0, 4.8, 0.5 * seed), exact_robot(exact_laser(360, 360.0)), seed)
    assert drive.ended == NO_FRONTIER
    assert drive.coverage >= 0.99


@pytest.mark.parametrize("seed", range(3))
def test_a_short_sighted_laser_sees_all_too_and_through_no_wall(seed):
    # Two halls of 10 x 10 m, a wall of half a metre and a gate between them; it sees 4 m.
    halls = room(20.5, 10.0, walls=[(10.0, 0.0, 10.5, 4.5), (10.0, 5.5, 10.5, 10.0)])
    drive = explored(halls, (5.0, 5.0), wobbly(240, range_max_m=4.0), seed)
    assert drive.ended == NO_FRONTIER
    assert drive.coverage >= 0.99
    seen = drive.navigator.explored.evidence < 0
    assert (seen & halls.solid).sum() <= 10  # where beams graze an edge


def test_a_plan_without_outer_walls_ends_at_its_edge():
    field = GridMap(np.zeros((60, 120), np.uint8), 0.05)
    for seed in range(3):
        drive = explored(field, (1.0, 1.5), seed=seed)
        assert drive.ended == NO_FRONTIER
        assert drive.coverage >= 0.99
        assert drive.bumps == 0


def test_the_time_limit_is_said_as_such():
    drive = explored(offices(), (1.5, 1.0), time_limit_s=5.0)
    assert drive.ended == "time limit of 5 s"
    assert drive.t_s == pytest.approx(5.0)
    assert 0.1 < drive.coverage < 0.9


@pytest.mark.parametrize("seed", range(3))
def test_it_ends_whatever_happens_on_the_way(seed):
    grid = furnish(offices(), np.random.default_rng(seed), 6, [[1.5, 1.0], [2.5, 2.1]], 0.27)
    leaf = door_leaf(offices(), 2.45, 2.15)
    drive = explored(
        grid, (1.5, 1.0), wobbly(180, dropout=0.2, mixed=0.3), seed,
        crowd=Crowd(3), slip=SlipSettings(per_m=0.3, share=0.8),
        doors=(DoorChange(4.0, leaf, closed=True), DoorChange(30.0, leaf, closed=False)),
    )  # fmt: skip
    assert drive.ended == NO_FRONTIER
    assert drive.t_s < 400.0


def test_wheels_that_slip_all_the_time_and_lost_beams_leave_nothing_unseen():
    drive = explored(
        offices(), (1.5, 1.0), wobbly(180, dropout=0.3), slip=SlipSettings(per_m=100.0, share=0.5)
    )
    assert drive.ended == NO_FRONTIER
    assert drive.coverage >= 0.99


@pytest.mark.parametrize("rate_hz", [5.0, 80.0])
@pytest.mark.parametrize("speed_m_s", [0.3, 2.0])
def test_other_scan_rates_and_speeds_see_all_too(rate_hz, speed_m_s):
    laser = LASERS[180].model_copy(update={"rate_hz": rate_hz})
    drive = explored(offices(), (1.5, 1.0), exact_robot(laser, speed_m_s=speed_m_s))
    assert drive.ended == NO_FRONTIER
    assert drive.coverage >= 0.99


@pytest.mark.parametrize("cell_m", [0.02, 0.1, 0.15])
def test_plans_with_finer_and_coarser_cells_are_seen_too(cell_m):
    # At 2 and 15 cm it maps in cells of another size than the plan's.
    grid = room(6.0, 3.0, cell_m, walls=[(2.85, 0.0, 3.15, 0.9), (2.85, 2.1, 3.15, 3.0)])
    drive = explored(grid, (1.0, 1.5))
    assert drive.ended == NO_FRONTIER
    assert drive.coverage >= 0.99


@pytest.mark.parametrize("name", ["Freiburg52_scan", "lab_ipa"])
def test_real_plans_with_their_furniture_are_seen(data_dir, name):
    grid = load_building(data_dir / "maps" / name / "map_furnished.yaml").grid
    start = roomiest(grid)
    drive = explored(grid, (start.x_m, start.y_m), load_robot("pioneer-dx"), 0, 3600.0)
    assert drive.ended == NO_FRONTIER
    assert drive.coverage >= 0.99


@pytest.mark.parametrize("faults", [{}, {"dropout": 0.3}])
def test_what_counts_as_seen_was_within_the_lasers_range(faults):
    # A hall much larger than the laser's 2 m: its beams mostly come back empty.
    grid = room(9.0, 7.0, walls=[(4.0, 3.0, 5.0, 4.0)])
    laser = exact_laser(682, 240.0, range_max_m=2.0, **faults)
    leg = Exploration()
    drive = simulated(grid, exact_robot(laser), (1.0, 1.0), [leg], 1, None, 900.0)
    rows, columns = grid.cells.shape
    y, x = (np.indices((rows, columns)) + 0.5) * grid.cell_m
    near = np.zeros((rows, columns), bool)
    for observation in drive:
        pose = observation.true_pose
        near |= np.hypot(x - pose.x_m, y - pose.y_m) < laser.range_max_m + grid.cell_m
    known = drive.navigator.explored.evidence != 0
    assert not (known & ~near).any()
    assert drive.ended == NO_FRONTIER
    assert drive.coverage >= 0.99
