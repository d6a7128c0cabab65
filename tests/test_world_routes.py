"""Scripted legs: waypoints in order, headings, repeats, and what happens where no way leads."""

import math

import numpy as np
import pytest
from buildings import CELL_M, DOOR, exact_robot, offices, room, simulated, two_rooms

from ssrics_like.perception.observation import Pose
from ssrics_like.world.disturbances import Disturbances, DoorChange, Kidnap, SlipSettings
from ssrics_like.world.doors import door_leaf
from ssrics_like.world.exploration import Exploration
from ssrics_like.world.grid import OCCUPIED, GridMap
from ssrics_like.world.motion_kernels import ARRIVED_M, FACED_RAD
from ssrics_like.world.routes import PATIENCE_S, Route, Wait

ROBOT = exact_robot()
OFFICES = offices()


def route(waypoints, repeat=1, grid=OFFICES):
    names = [f"waypoint {i}" for i in range(1, len(waypoints) + 1)]
    return Route(waypoints, names, repeat, grid.solid)


def driven(grid, start, *legs, **more):
    """Drive, and return the simulation and its true poses, shape (scans, 4): x, y, heading, t."""
    drive = simulated(grid, ROBOT, start, list(legs), **more)
    poses = [(drive.pose.x_m, drive.pose.y_m, drive.pose.theta_rad, drive.t_s) for _ in drive]
    return drive, np.array(poses)


def first_at(poses, place, after_s=-1.0):
    """Return the time of the first pose within reach of a place, after a time."""
    near = np.hypot(*(poses[:, :2] - place[:2]).T) <= ARRIVED_M + 0.03
    times = poses[near & (poses[:, 3] > after_s), 3]
    assert len(times), f"never at {place} after {after_s} s"
    return times[0]


CORNERS = [(1.5, 1.0), (7.5, 1.0), (7.5, 5.0), (1.5, 5.0)]


def test_waypoints_are_passed_in_their_order():
    drive, poses = driven(OFFICES, (3.0, 3.0), route(CORNERS))
    assert drive.ended == "end of the route"
    t = -1.0
    for place in CORNERS:
        t = first_at(poses, place, t)
    assert poses[-1, :2] == pytest.approx(CORNERS[-1], abs=ARRIVED_M + 0.03)
    assert drive.navigator.notes == []
    assert drive.bumps == 0
    # It knows the plan: no scan of an office is needed before it drives into it.
    assert poses[-1, 3] < 1.5 * drive.way_m / ROBOT.speed_m_s + 30.0


def test_a_waypoints_heading_is_taken_up_before_the_next():
    headings = [2.0, -1.0, math.pi]
    waypoints = [(*place, face) for place, face in zip(CORNERS, headings, strict=False)]
    _, poses = driven(OFFICES, (3.0, 3.0), route(waypoints))
    t = -1.0
    for x, y, face in waypoints:
        t = first_at(poses, (x, y), t)
        here = (poses[:, 3] >= t) & (np.hypot(poses[:, 0] - x, poses[:, 1] - y) < 0.25)
        off = np.abs(np.angle(np.exp(1j * (poses[here, 2] - face))))
        assert off.min() <= FACED_RAD + 0.02
    assert abs(math.remainder(poses[-1, 2] - math.pi, math.tau)) <= FACED_RAD + 0.02


def test_a_route_is_driven_as_often_as_it_says():
    there_and_back = [(1.0, 3.0), (4.0, 3.0)]
    once, _ = driven(OFFICES, (1.0, 3.0), route(there_and_back))
    drive, poses = driven(OFFICES, (1.0, 3.0), route(there_and_back, repeat=3))
    t = -1.0
    for place in there_and_back * 3:
        t = first_at(poses, place, t)
    # 3 m out, and then there and back two more times: 5 times 3 m, less where it stops short.
    assert drive.way_m == pytest.approx(5 * 3.0, abs=5 * 2 * ARRIVED_M + 0.2)
    assert once.way_m == pytest.approx(3.0, abs=2 * ARRIVED_M + 0.1)


def test_waypoints_may_be_given_twice_and_where_it_stands():
    drive, _ = driven(OFFICES, (1.5, 1.0), route([(1.5, 1.0), (1.5, 1.0), (3.0, 1.0)]))
    assert drive.ended == "end of the route"
    assert drive.pose.x_m == pytest.approx(3.0, abs=ARRIVED_M + 0.03)
    assert drive.navigator.notes == []


def test_a_waypoint_that_no_way_leads_to_is_left_out_with_a_note():
    grid = room(6.0, 3.0, walls=[(4.0, 0.0, 4.1, 3.0)])
    waypoints = [(2.0, 1.5), (5.0, 1.5), (0.5, 0.5), (99.0, 1.5), (2.0, 2.5)]
    drive, poses = driven(grid, (1.0, 1.5), route(waypoints, grid=grid))
    assert drive.ended == "end of the route"
    assert drive.navigator.notes == [
        "waypoint 2 was left out: no way led there for 10 s",
        "waypoint 4 was left out: no way led there for 10 s",
    ]
    t = -1.0
    for place in (waypoints[0], waypoints[2], waypoints[4]):
        t = first_at(poses, place, t)
    assert PATIENCE_S * 2 < poses[-1, 3] < PATIENCE_S * 2 + 25.0


def test_a_waypoint_in_a_wall_is_left_out_too():
    drive, _ = driven(OFFICES, (3.0, 3.0), route([(4.45, 1.0), (1.5, 1.0)]))
    assert drive.navigator.notes == ["waypoint 1 was left out: no way led there for 10 s"]
    assert drive.pose.x_m == pytest.approx(1.5, abs=ARRIVED_M + 0.03)


def through_the_door(closes_s, opens_s, time_limit_s=120.0):
    grid = two_rooms()
    leaf = door_leaf(grid, *DOOR)
    changes = [DoorChange(closes_s, leaf, closed=True)]
    if opens_s is not None:
        changes.append(DoorChange(opens_s, leaf, closed=False))
    return driven(
        grid, (0.6, 1.5), route([(5.0, 1.5)], grid=grid), time_limit_s=time_limit_s,
        disturbances=Disturbances(doors=tuple(changes)),
    )  # fmt: skip


def test_it_waits_before_a_door_that_closes_and_drives_on_when_it_opens():
    free, _ = through_the_door(100.0, None)
    assert free.t_s < 10.0
    drive, poses = through_the_door(0.5, 9.0)
    assert drive.ended == "end of the route"
    assert drive.navigator.notes == []
    before = poses[poses[:, 3] < 9.0]
    assert before[:, 0].max() < 2.9
    assert drive.pose.x_m == pytest.approx(5.0, abs=ARRIVED_M + 0.03)
    # Having noticed that it is shut, it looks every second whether it is open again.
    assert drive.t_s < 9.0 + 1.0 + free.t_s + 3.0


def test_before_a_door_that_stays_shut_it_gives_up_after_its_patience():
    drive, _ = through_the_door(0.5, None)
    assert drive.navigator.notes == ["waypoint 1 was left out: no way led there for 10 s"]
    assert drive.ended == "end of the route"
    assert drive.pose.x_m < 2.9
    assert PATIENCE_S < drive.t_s < PATIENCE_S + 10.0


def test_it_goes_round_what_the_plan_does_not_show():
    plan = room(8.0, 4.0)
    crate = room(8.0, 4.0, walls=[(3.5, 1.2, 4.5, 2.8)])
    drive, poses = driven(crate, (1.0, 2.0), route([(7.0, 2.0)], grid=plan))
    assert drive.ended == "end of the route"
    assert drive.navigator.notes == []
    assert drive.pose.x_m == pytest.approx(7.0, abs=ARRIVED_M + 0.03)
    beside = (poses[:, 0] > 3.5) & (poses[:, 0] < 4.5)
    assert np.abs(poses[beside, 1] - 2.0).min() > 0.8 + 0.27 - 0.75 * CELL_M


def test_a_waypoint_that_it_gets_no_nearer_to_is_left_out():
    spinning = Disturbances(slip=SlipSettings(per_m=1e6, length_m=1e6, share=1.0))
    drive, _ = driven(OFFICES, (1.5, 1.0), route([(3.0, 1.0)]), disturbances=spinning)
    assert drive.ended == "end of the route"
    assert drive.navigator.notes == [
        "waypoint 1 was left out: the robot got stuck 4 times on its way"
    ]
    assert drive.way_m < 0.1


def test_on_a_plan_without_outer_walls_it_keeps_off_the_edge():
    field = GridMap(np.zeros((60, 160), np.uint8), CELL_M)
    field.cells[16:, 70:80] = OCCUPIED  # 0.8 m are left to pass at the edge
    drive, poses = driven(field, (1.0, 1.5), route([(7.0, 1.5)], grid=field))
    assert drive.ended == "end of the route"
    assert drive.navigator.notes == []
    assert drive.bumps == 0
    assert poses[:, 1].min() >= 0.27
    assert drive.t_s < 25.0


def test_waiting_takes_its_time_and_moves_nothing():
    drive, poses = driven(OFFICES, (1.5, 1.0, 0.3), Wait(2.0))
    assert drive.ended == "end of the wait"
    assert poses[-1, 3] == pytest.approx(2.0)
    assert (poses[:, :3] == [1.5, 1.0, 0.3]).all()


def test_legs_follow_each_other_in_their_order():
    drive, poses = driven(
        OFFICES, (1.5, 1.0), Wait(1.0), route([(3.0, 1.0)]), Wait(1.5), Exploration(),
        route([(7.5, 1.0)]),
    )  # fmt: skip
    assert drive.ended == "end of the route"
    assert drive.coverage >= 0.99
    assert (poses[poses[:, 3] < 1.0, :2] == [1.5, 1.0]).all()
    at = first_at(poses, (3.0, 1.0))
    # Then it stands for 1.5 s, where it arrived and braked.
    stands = poses[(poses[:, 3] > at + 1.0) & (poses[:, 3] < at + 1.5)]
    assert np.ptp(stands[:, 0]) < 0.01
    assert drive.pose.x_m == pytest.approx(7.5, abs=ARRIVED_M + 0.03)


def test_carried_off_on_the_way_it_still_goes_to_its_waypoint():
    carried = Disturbances(kidnaps=(Kidnap(2.0, Pose(7.5, 5.0, 0.0)),))
    drive, poses = driven(OFFICES, (1.5, 1.0), route([(7.5, 1.0)]), disturbances=carried)
    assert first_at(poses, (7.5, 5.0)) == pytest.approx(2.0)
    assert drive.ended == "end of the route"
    assert drive.pose.y_m == pytest.approx(1.0, abs=ARRIVED_M + 0.03)
