"""A drive: time, frames, randomness, and what was seen."""

import itertools
import math

import numpy as np
import pytest
from buildings import (
    CELL_M,
    NO_DRIFT,
    Along,
    drawn,
    exact_laser,
    exact_robot,
    line,
    offices,
    room,
    simulated,
    two_rooms,
)

from ssrics_like.perception.observation import Pose
from ssrics_like.scenarios.modules import load_robot
from ssrics_like.world.disturbances import Crowd, Disturbances, DoorChange, Kidnap, SlipSettings
from ssrics_like.world.exploration import Exploration
from ssrics_like.world.grid import OCCUPIED, GridMap
from ssrics_like.world.reachable import reachable
from ssrics_like.world.robot import OdometryProfile
from ssrics_like.world.routes import Wait
from ssrics_like.world.simulation import mapped_cell_m, mapped_shape, mapped_solid

OFFICES = offices()
PIONEER = load_robot("pioneer-dx")
EVERYTHING = Disturbances(crowd=Crowd(3), slip=SlipSettings(per_m=0.5))


def row(pose):
    return (pose.x_m, pose.y_m, pose.theta_rad)


def observations(seed, robot=PIONEER, grid=OFFICES, start=(1.5, 1.0), **more):
    drive = simulated(grid, robot, start, [Exploration()], seed, time_limit_s=15.0, **more)
    return list(drive)


def flat(seen):
    """Return all that was sensed as one table."""
    return np.array(
        [[o.index, o.t_s, *row(o.pose), *row(o.true_pose), *o.scan.ranges_m] for o in seen]
    )


def test_the_same_seed_gives_the_same_observations_to_the_bit():
    one, two = (flat(observations(7, disturbances=EVERYTHING)) for _ in range(2))
    assert one.tobytes() == two.tobytes()
    other = flat(observations(8, disturbances=EVERYTHING))
    assert not np.array_equal(one[1][2:8], other[1][2:8])
    assert (one[0][8:] != other[0][8:]).mean() > 0.9


def test_each_source_of_chance_can_be_switched_on_its_own():
    hall = room(12.0, 6.0)
    way = [(2.0, 3.0), (6.0, 4.0), (10.0, 3.0)]
    places = np.vstack([line(a, b) for a, b in itertools.pairwise(way)])

    def driven(**changes):
        robot = PIONEER.model_copy(update=changes)
        return list(simulated(hall, robot, (2.0, 3.0), [Along(places)], 3))

    noisy = driven()
    # Other odometry: the same true path and the same scans.
    for profile in (NO_DRIFT, OdometryProfile(scale=0.1, drift_rad=0.2)):
        other = driven(odometry=profile)
        assert [row(o.true_pose) for o in other] == [row(o.true_pose) for o in noisy]
        assert all(
            np.array_equal(a.scan.ranges_m, b.scan.ranges_m)
            for a, b in zip(noisy, other, strict=True)
        )
        assert row(other[-1].pose) != row(noisy[-1].pose)
    # Another laser: the same path, where the walls are far and nothing depends on a scan.
    other = driven(laser=PIONEER.laser.model_copy(update={"noise_m": 0.05, "dropout": 0.2}))
    assert [row(o.pose) for o in other] == [row(o.pose) for o in noisy]
    # Other wheels: another path.
    exact = driven(actuation=0.0)
    assert row(exact[-1].true_pose) != row(noisy[-1].true_pose)


@pytest.mark.parametrize("origin", [Pose(-12.0, 7.5, 0.0), Pose(30.0, -2.0, 2.2)])
def test_in_a_map_that_lies_elsewhere_it_is_the_same_drive(origin):
    here = observations(4, disturbances=EVERYTHING)
    there = observations(4, grid=GridMap(OFFICES.cells, CELL_M, origin), disturbances=EVERYTHING)
    assert len(here) == len(there)
    cos, sin = math.cos(origin.theta_rad), math.sin(origin.theta_rad)
    for a, b in zip(here, there, strict=True):
        assert np.array_equal(a.scan.ranges_m, b.scan.ranges_m)
        for pose, moved in ((a.true_pose, b.true_pose), (a.pose, b.pose)):
            # Turned by the origin's heading, then shifted.
            expected = (
                origin.x_m + cos * pose.x_m - sin * pose.y_m,
                origin.y_m + sin * pose.x_m + cos * pose.y_m,
            )
            assert (moved.x_m, moved.y_m) == pytest.approx(expected, abs=1e-9)
            off = moved.theta_rad - pose.theta_rad - origin.theta_rad
            assert math.remainder(off, math.tau) == pytest.approx(0.0, abs=1e-9)


def test_odometry_begins_at_the_true_pose():
    first = observations(0, grid=two_rooms(origin=Pose(3.0, 4.0, 1.0)), start=(1.0, 1.5, 0.7))[0]
    assert row(first.pose) == pytest.approx(row(first.true_pose), abs=1e-12)
    assert first.true_pose.theta_rad == pytest.approx(1.7)


@pytest.mark.parametrize("rate_hz", [5.0, 12.5, 80.0])
def test_the_scan_rate_sets_the_times(rate_hz):
    robot = exact_robot(exact_laser(rate_hz=rate_hz))
    seen = list(simulated(OFFICES, robot, (1.0, 3.0), [Along(line((1.0, 3.0), (4.0, 3.0)))]))
    assert [o.index for o in seen] == list(range(len(seen)))
    assert [o.t_s for o in seen] == pytest.approx(np.arange(len(seen)) / rate_hz)
    # The drive takes as long whatever the rate: 3 m at up to 0.894 m/s, speeding up and braking.
    assert 3.0 / 0.894 < seen[-1].t_s < 3.0 / 0.894 + 3.0


def test_poses_are_those_of_the_laser():
    robot = exact_robot(exact_laser(x_m=0.2))
    drive = simulated(OFFICES, robot, (1.0, 3.0, 0.5), [Along(line((1.0, 3.0), (4.0, 3.0)))])
    for o in drive:
        body = drive.pose
        ahead = (
            body.x_m + 0.2 * math.cos(body.theta_rad),
            body.y_m + 0.2 * math.sin(body.theta_rad),
        )
        assert (o.true_pose.x_m, o.true_pose.y_m) == pytest.approx(ahead)
        assert (o.pose.x_m, o.pose.y_m) == pytest.approx(ahead, abs=5e-3)


def test_the_path_is_as_long_as_the_steps_of_the_body():
    drive = simulated(OFFICES, PIONEER, (1.5, 1.0), [Exploration()], 1)
    places = np.array([row(drive.pose)[:2] for _ in drive])
    assert drive.way_m == pytest.approx(np.hypot(*np.diff(places, axis=0).T).sum())
    assert drive.t_s == pytest.approx((len(places) - 1) / 10.0)


def test_without_a_journey_there_is_one_scan():
    drive = simulated(OFFICES, PIONEER, (1.5, 1.0), [])
    assert len(list(drive)) == 1
    assert drive.ended == "end of an empty journey"


@pytest.mark.parametrize("limit_s", [0.05, 0.1, 0.3, 0.7, 1.5, 2.0, 3.33])
def test_no_scan_is_later_than_the_time_limit(limit_s):
    drive = simulated(OFFICES, PIONEER, (1.5, 1.0), [Wait(100.0)], time_limit_s=limit_s)
    times = [o.t_s for o in drive]
    assert times == pytest.approx(np.arange(0.0, limit_s + 1e-9, 0.1))
    assert drive.ended == f"time limit of {limit_s:g} s"


def test_running_against_a_wall_is_counted_and_noted_on_the_map():
    # It looks behind only: all it learns of the wall ahead is that it ran against it.
    robot = exact_robot(exact_laser(31, first_bearing_deg=165.0, step_deg=1.0))
    drive = simulated(
        room(6.0, 3.0), robot, (3.0, 1.5), [Along(line((3.0, 1.5), (7.0, 1.5)))], time_limit_s=9.0
    )
    drive.navigator.explored.know(np.zeros((60, 120), bool))
    for _ in drive:
        pass
    assert drive.bumps >= 2
    occupied = np.argwhere(drive.navigator.explored.evidence > 0)
    occupied = occupied[occupied[:, 1] > 60]
    assert set(occupied[:, 1]) == {118}  # the first column of the wall, at 5.9 m
    assert np.abs((occupied[:, 0] + 0.5) * CELL_M - 1.5).max() < 0.3


def test_coverage_is_the_share_of_what_the_body_could_cover():
    # It stands in the middle and looks to the right: it has seen what lies there and no more.
    grid = room(4.0, 3.0)
    drive = simulated(grid, exact_robot(), (2.0, 1.5), [Wait(0.1)])
    assert drive.coverage == 0.0
    for _ in drive:
        pass
    within = reachable(grid, 2.0, 1.5, 0.27)
    right = np.arange(80)[None, :] * CELL_M >= 2.0
    assert drive.coverage == pytest.approx(np.sum(within & right) / within.sum(), abs=1 / 76)
    # Corners that no disc gets into count for nothing: interior 3.8 x 2.8 m, less 4 (1 - pi/4) r^2.
    assert within.sum() * CELL_M**2 == pytest.approx(
        3.8 * 2.8 - 4 * (1 - math.pi / 4) * 0.27**2, abs=0.02
    )


def test_coverage_on_a_map_of_a_few_cells():
    grid = drawn(
        """
        #########
        #...#...#
        #.......#
        #...#...#
        #########
        """,
        cell_m=0.1,
    )
    # A disc of 4 cm gets into all 19 cells. From the middle of the left room, looking right, it
    # sees its own column, the one to the right, the doorway, and what it can through that.
    robot = exact_robot(exact_laser(1800, 180.0), radius_m=0.04)
    drive = simulated(grid, robot, (0.25, 0.25), [Wait(0.0)])
    for _ in drive:
        pass
    assert len(drive._reachable) == 19
    known = drive.navigator.explored.evidence != 0
    assert known[1:4, 1:4].tolist() == [[False, True, True]] * 3
    assert known[2, 4:8].all()
    assert drive.coverage == np.count_nonzero(known & ~grid.solid) / 19


def test_what_did_not_happen_any_more_is_counted():
    leaf = np.zeros((120, 180), bool)
    changes = (DoorChange(0.5, leaf, closed=True), DoorChange(5.0, leaf, closed=False))
    kidnaps = (Kidnap(3.0, Pose(1.5, 1.0, 0.0)),)
    for wait_s, left in ((0.2, 3), (1.0, 2), (4.0, 1), (6.0, 0)):
        happenings = Disturbances(doors=changes, kidnaps=kidnaps)
        drive = simulated(
            OFFICES, exact_robot(), (1.5, 1.0), [Wait(wait_s)], disturbances=happenings
        )
        for _ in drive:
            pass
        assert drive.outstanding == left


def test_progress_grows_with_what_is_known_up_to_about_one():
    drive = simulated(OFFICES, PIONEER, (1.5, 1.0), [Exploration()], 1)
    shares = [drive.progress for _ in drive]
    assert shares[0] == 0.0
    assert all(a <= b for a, b in itertools.pairwise(shares))
    assert 0.95 < shares[-1] < 1.3  # walls are known too


@pytest.mark.parametrize(
    ("cell_m", "mapped_m"), [(0.02, 0.05), (0.04, 0.04), (0.05, 0.05), (0.1, 0.1), (0.2, 0.05)]
)
def test_plans_are_mapped_in_their_own_cells_unless_these_are_fine_or_coarse(cell_m, mapped_m):
    assert mapped_cell_m(GridMap(np.zeros((3, 3), np.uint8), cell_m)) == mapped_m


@pytest.mark.parametrize("cell_m", [0.01, 0.015, 0.02, 0.025, 0.03, 0.035, 0.2])
def test_a_mapped_cell_is_solid_where_any_part_of_it_is(cell_m):
    rng = np.random.default_rng(1)
    cells = np.where(rng.uniform(size=(23, 31)) < 0.03, OCCUPIED, 0).astype(np.uint8)
    grid = GridMap(cells, cell_m)
    to_m = mapped_cell_m(grid)
    solid = mapped_solid(grid, to_m)
    assert solid.shape == mapped_shape(grid, to_m)
    rows, columns = mapped_shape(grid, to_m)
    assert (rows, columns) == (
        math.ceil(23 * cell_m / to_m - 1e-9),
        math.ceil(31 * cell_m / to_m - 1e-9),
    )
    missing = 0
    for r, c in np.argwhere(grid.solid):
        # Any mapped cell that shares some area with it; edges within a hair are shared by none.
        low_r, high_r = int((r * cell_m + 1e-9) / to_m), int(((r + 1) * cell_m - 1e-9) / to_m)
        low_c, high_c = int((c * cell_m + 1e-9) / to_m), int(((c + 1) * cell_m - 1e-9) / to_m)
        missing += np.count_nonzero(~solid[low_r : high_r + 1, low_c : high_c + 1])
    assert missing == 0
