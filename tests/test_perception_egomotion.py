"""Egomotion: what does not move tells how the robot moves."""

import itertools
import math

import numpy as np
import pytest
from buildings import Along, exact_laser, exact_robot, line, room, simulated, two_rooms

from ssrics_like.perception.egomotion import Egomotion
from ssrics_like.poses import Pose

FURNITURE = [(2.9, 2.0, 3.1, 4.0), (0.6, 3.2, 1.4, 3.8), (4.4, 0.5, 5.2, 0.9)]
ROUND = [(1.0, 1.0), (3.9, 1.2), (5.2, 1.6), (5.0, 3.2), (3.8, 3.2), (3.8, 1.4), (1.2, 1.6)]


def drive(grid, start, places, laser):
    return list(simulated(grid, exact_robot(laser), start, [Along(places)]))


def mismeasured(observations, way=1.0, turn=1.0):
    """Return what wheels say that are off by these factors: a pose for each observation."""
    poses = [observations[0].true_pose]
    for one, other in itertools.pairwise(observations):
        step = other.true_pose.seen_from(one.true_pose)
        poses.append(poses[-1].onward(Pose(way * step.x_m, way * step.y_m, turn * step.theta_rad)))
    return poses


def corrected(observations, odometry):
    egomotion = Egomotion()
    return [
        egomotion.update(pose, o.scan.bearings_rad, o.scan.ranges_m)
        for o, pose in zip(observations, odometry, strict=True)
    ]


def driven_round(laser=None):
    path = [point for a, b in itertools.pairwise(ROUND) for point in line(a, b)]
    seen = drive(room(6.0, 4.0, walls=FURNITURE), (1.0, 1.0, 0.0), path, laser or exact_laser())
    assert seen[-1].true_pose.distance_m(Pose(*ROUND[-1], 0.0)) < 0.5
    return seen


@pytest.mark.parametrize("way", [0.95, 1.0, 1.05])
@pytest.mark.parametrize("turn", [0.95, 1.0, 1.05])
def test_wheels_that_are_off_are_put_right(way, turn):
    seen = driven_round()
    odometry = mismeasured(seen, way, turn)
    poses = corrected(seen, odometry)
    for pose, o in zip(poses, seen, strict=True):
        assert pose.distance_m(o.true_pose) < 0.15
        assert abs(math.remainder(pose.theta_rad - o.true_pose.theta_rad, math.tau)) < 0.05
    if way != 1.0 and turn != 1.0:
        last = seen[-1].true_pose
        assert odometry[-1].distance_m(last) > 3 * poses[-1].distance_m(last)


@pytest.mark.parametrize(("beams", "degrees"), [(90, 180.0), (360, 360.0), (1080, 270.0)])
def test_any_laser_will_do(beams, degrees):
    seen = driven_round(exact_laser(beams, degrees))
    pose = corrected(seen, mismeasured(seen, 1.05, 0.95))[-1]
    assert pose.distance_m(seen[-1].true_pose) < 0.2


def test_along_a_bare_corridor_odometry_counts():
    grid = room(20.0, 2.0)
    seen = drive(grid, (6.0, 1.0, 0.0), line((6.0, 1.0), (11.0, 1.0)), exact_laser())
    near = [o for o in seen if o.scan.ranges_m.max() > 0.0]
    for o in near:  # the walls at both ends are out of sight
        o.scan.ranges_m[o.scan.ranges_m > 5.0] = np.inf
    pose = corrected(near, mismeasured(near, 1.05))[-1]
    way = near[-1].true_pose.x_m - near[0].true_pose.x_m
    assert pose.x_m - near[0].true_pose.x_m == pytest.approx(1.05 * way, rel=0.01)
    assert pose.y_m == pytest.approx(near[-1].true_pose.y_m, abs=0.03)


def test_where_nothing_is_seen_odometry_counts():
    seen = driven_round()
    for o in seen:
        o.scan.ranges_m[:] = np.nan
    odometry = mismeasured(seen, 1.05, 0.95)
    assert corrected(seen, odometry)[-1].distance_m(odometry[-1]) < 1e-9


def test_who_walks_past_moves_nothing():
    seen = driven_round()
    for n, o in enumerate(seen):  # somebody half a metre wide crosses again and again
        start = (3 * n) % 150
        o.scan.ranges_m[start : start + 30] = 0.9 + 0.1 * np.sin(0.3 * n)
    pose = corrected(seen, mismeasured(seen, 1.02, 1.02))[-1]
    assert pose.distance_m(seen[-1].true_pose) < 0.25


def test_a_pose_that_is_no_number_moves_nothing():
    o = driven_round()[0]
    egomotion = Egomotion()
    here = egomotion.update(o.true_pose, o.scan.bearings_rad, o.scan.ranges_m)
    lost = Pose(math.nan, 0.0, 0.0)
    assert egomotion.update(lost, o.scan.bearings_rad, o.scan.ranges_m) == here


def test_a_robot_that_is_carried_notices_and_one_that_drives_does_not():
    seen = driven_round()
    other = drive(two_rooms(1.0), (1.0, 1.5, 0.0), line((1.0, 1.5), (5.0, 1.5)), exact_laser())
    egomotion = Egomotion()
    for o in seen:
        egomotion.update(o.true_pose, o.scan.bearings_rad, o.scan.ranges_m)
    assert egomotion.carried == 0
    # Set down in another building; wheels count on from where they were.
    last = seen[-1].true_pose
    for o in other[1:]:
        pose = last.onward(o.true_pose.seen_from(other[0].true_pose))
        egomotion.update(pose, o.scan.bearings_rad, o.scan.ranges_m)
    assert egomotion.carried == 1
    assert egomotion.pose.distance_m(pose) < 0.5


def test_a_robot_whose_wheels_slip_while_it_turns_was_not_carried():
    seen = driven_round()
    slips = [0.25 if n in (60, 90) else -0.25 if n == 120 else 0.0 for n in range(1, len(seen))]
    odometry = [seen[0].true_pose]
    for (one, other), slip in zip(itertools.pairwise(seen), slips, strict=True):
        step = other.true_pose.seen_from(one.true_pose)
        odometry.append(odometry[-1].onward(Pose(step.x_m, step.y_m, step.theta_rad + slip)))
    egomotion = Egomotion()
    for o, pose in zip(seen, odometry, strict=True):
        egomotion.update(pose, o.scan.bearings_rad, o.scan.ranges_m)
    assert egomotion.carried == 0
    last = seen[-1].true_pose
    assert egomotion.pose.distance_m(last) < 0.15
    assert abs(math.remainder(egomotion.pose.theta_rad - last.theta_rad, math.tau)) < 0.05


def test_the_frame_begins_as_that_of_odometry():
    grid = two_rooms(1.0)
    seen = drive(grid, (1.0, 1.5, 0.0), line((1.0, 1.5), (2.0, 1.5)), exact_laser())
    offset = Pose(10.0, -3.0, 1.2)
    poses = corrected(seen, [offset.onward(o.true_pose) for o in seen])
    assert poses[0] == offset.onward(seen[0].true_pose)
    assert poses[-1].distance_m(offset.onward(seen[-1].true_pose)) < 0.05
