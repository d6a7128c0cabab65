"""Doors, people, slipping wheels and a kidnap."""

import itertools
import math

import numpy as np
import pytest
from buildings import (
    CELL_M,
    DOOR,
    Along,
    distance_to_solid,
    exact_robot,
    line,
    offices,
    room,
    simulated,
    two_rooms,
)
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import ndimage

from ssrics_like.errors import MapError
from ssrics_like.perception.observation import Pose
from ssrics_like.world.disturbances import (
    Crowd,
    Disturbances,
    DoorChange,
    Kidnap,
    Slip,
    SlipSettings,
)
from ssrics_like.world.doors import door_leaf
from ssrics_like.world.exploration import Exploration
from ssrics_like.world.grid import FREE, OCCUPIED, GridMap
from ssrics_like.world.people import People
from ssrics_like.world.reachable import clearance
from ssrics_like.world.routes import Wait

TWO = two_rooms()
LEAF = door_leaf(TWO, *DOOR)


def parts(free):
    """Count what is connected, across corners too: what a beam or a robot could slip through."""
    return ndimage.label(free, np.ones((3, 3)))[1]


@given(st.floats(2.91, 3.09), st.floats(1.06, 1.94))
@settings(max_examples=40, deadline=None)
def test_a_door_closes_its_doorway_wherever_in_it_the_place_is(x, y):
    leaf = door_leaf(TWO, x, y)
    assert not (leaf & TWO.solid).any()
    assert parts(~TWO.solid) == 1
    assert parts(~(TWO.solid | leaf)) == 2
    rows, columns = np.nonzero(leaf)
    # It fills the 0.9 m in rows 21 to 38, two cells thick; in front of the frame's edge it may
    # reach a cell farther.
    assert set(range(21, 39)) <= set(rows.tolist()) <= set(range(20, 40))
    assert len(np.unique(columns)) <= 2


@pytest.mark.parametrize("turn", [0.0, 0.2, 0.6, math.pi / 4, 1.2])
def test_a_door_in_a_wall_askew_has_no_holes(turn):
    cells = np.full((120, 120), FREE, np.uint8)
    row, column = np.indices(cells.shape)
    x, y = (column - 59.5) * CELL_M, (row - 59.5) * CELL_M
    along = x * math.cos(turn) + y * math.sin(turn)
    aside = y * math.cos(turn) - x * math.sin(turn)
    cells[(np.abs(aside) < 0.1) & (np.abs(along) > 0.45)] = OCCUPIED
    cells[[0, -1]] = OCCUPIED
    cells[:, [0, -1]] = OCCUPIED
    grid = GridMap(cells, CELL_M)
    leaf = door_leaf(grid, 3.0, 3.0)
    assert parts(~grid.solid) == 1
    assert parts(~(grid.solid | leaf)) == 2
    assert np.abs(aside[leaf]).max() < 0.15
    assert np.abs(along[leaf]).max() < 0.45 + 2 * CELL_M


@pytest.mark.parametrize(
    ("place", "said"),
    [
        ((2.95, 0.5), "inside a wall or off the map"),
        ((-1.0, 0.5), "inside a wall or off the map"),
        ((3.0, 99.0), "inside a wall or off the map"),
    ],
)
def test_where_no_doorway_is_no_door_can_be(place, said):
    with pytest.raises(MapError, match=said):
        door_leaf(TWO, *place)


def test_a_hall_is_no_doorway_but_a_wide_gate_is():
    hall = room(9.0, 9.0)
    with pytest.raises(MapError, match="no gap of up to 3 m between walls"):
        door_leaf(hall, 4.5, 4.5)
    gate = room(9.0, 9.0, walls=[(4.4, 0.0, 4.6, 3.1), (4.4, 5.9, 4.6, 9.0)])  # 2.8 m
    leaf = door_leaf(gate, 4.5, 4.5)
    assert parts(~(gate.solid | leaf)) == 2


def walls_over_time(drive):
    """Return when the walls changed, as a list of (time, whether the doorway is closed)."""
    found = []
    for o in drive:
        closed = bool(drive._solid[LEAF].all())
        if not found or found[-1][1] != closed:
            found.append((round(o.t_s, 6), closed))
    return found


def test_a_door_closes_and_opens_at_its_times_and_the_laser_sees_it():
    changes = (DoorChange(1.0, LEAF, closed=True), DoorChange(2.5, LEAF, closed=False))
    drive = simulated(
        TWO, exact_robot(), (1.0, 1.5), [Wait(4.0)], disturbances=Disturbances(doors=changes)
    )
    ahead = {round(o.t_s, 6): o.scan.ranges_m[89] for o in drive}
    for t_s, range_m in ahead.items():
        # The nearest beam is half a degree off; the leaf's near side is at 2.95, the far wall at 5.9.
        wall_m = 2.95 if 1.0 <= t_s < 2.5 else 5.9
        assert range_m == pytest.approx((wall_m - 1.0) / math.cos(math.radians(0.5)))
    # In whatever order they are told.
    again = simulated(
        TWO, exact_robot(), (1.0, 1.5), [Wait(4.0)], disturbances=Disturbances(doors=changes[::-1])
    )
    assert walls_over_time(again) == [(0.0, False), (1.0, True), (2.5, False)]


def test_a_door_that_is_closed_at_the_start_is_so_from_the_first_scan():
    drive = simulated(
        TWO, exact_robot(), (1.0, 1.5), [Wait(1.0)],
        disturbances=Disturbances(doors=(DoorChange(0.0, LEAF, closed=True),)),
    )  # fmt: skip
    first = next(iter(drive))
    assert first.scan.ranges_m.max() < 2.5
    # What is behind it does not count as reachable.
    assert drive._reachable[:, 1].max() * CELL_M < 3.0


def test_a_door_waits_for_whoever_stands_in_it():
    # The robot stands in the doorway for 2 s and then drives off.
    drive = simulated(
        TWO, exact_robot(), (*DOOR, 0.0), [Wait(2.0), Along(line(DOOR, (5.0, 1.5)))],
        disturbances=Disturbances(doors=(DoorChange(0.5, LEAF, closed=True),)),
    )  # fmt: skip
    (_, before), (closed_s, after) = walls_over_time(drive)
    assert (before, after) == (False, True)
    # It goes when its body is out of it: 0.27 + half a leaf + a cell on, at 0.6 m/s^2.
    assert closed_s == pytest.approx(2.0 + math.sqrt(2 * 0.37 / 0.6), abs=0.3)
    # So it is with people.
    crowd = Crowd(1, speed_m_s=0.0)
    drive = simulated(
        TWO, exact_robot(), (1.0, 1.5), [Wait(3.0)],
        disturbances=Disturbances(doors=(DoorChange(0.5, LEAF, closed=True),), crowd=crowd),
    )  # fmt: skip
    closed = []
    for o in drive:
        drive._people.discs[0, :2] = DOOR if o.t_s < 1.95 else (5.0, 2.0)
        closed.append(bool(drive._solid[LEAF].all()))
    assert closed == [False] * 21 + [True] * 10


def walk(grid, seed, people=4, seconds=60.0, robot=(1.0, 1.0), speed_m_s=1.1, radius_m=0.22):
    """Return where people were, shape (steps, people, 3), every 0.1 s."""
    crowd = People(people, speed_m_s, radius_m, np.random.default_rng(seed))
    body = Pose(*robot, 0.0)
    crowd.enter(clearance(grid).astype(np.float32), grid.cell_m, body)
    places = [crowd.discs.copy()]
    for _ in range(round(seconds / 0.1)):
        crowd.walk(0.1, body, 0.27)
        places.append(crowd.discs.copy())
    return np.array(places)


OFFICES = offices()


@pytest.mark.parametrize("seed", range(3))
def test_people_walk_no_faster_than_stated_and_through_no_wall(seed):
    places = walk(OFFICES, seed)
    assert (places[:, :, 2] == 0.22).all()
    steps = np.hypot(*np.diff(places[:, :, :2], axis=0).transpose(2, 0, 1))
    assert steps.max() <= 1.1 * 0.1 + 1e-9
    # They are on their way most of the time, and get about.
    assert np.median(steps) > 0.09
    assert np.ptp(places[:, :, 0], axis=0).min() > 1.0
    for x, y, radius in places[::7].reshape(-1, 3):
        assert distance_to_solid(OFFICES, x, y) >= radius - 0.75 * CELL_M


def test_people_start_where_the_robot_is_not_and_in_its_part_of_the_building():
    shut = GridMap((TWO.solid | LEAF).astype(np.uint8), CELL_M)
    room_m = clearance(shut).astype(np.float32)
    for seed in range(100):
        crowd = People(2, 1.1, 0.22, np.random.default_rng(seed))
        crowd.enter(room_m, CELL_M, Pose(0.6, 1.5, 0.0))
        for x, y, radius in crowd.discs:
            assert math.dist((x, y), (0.6, 1.5)) > radius + 0.27
            assert x < DOOR[0]


def test_people_for_whom_there_is_no_room_are_refused():
    crowd = People(1, 1.1, 1.6, np.random.default_rng(0))
    with pytest.raises(MapError, match=r"people of radius 1\.6 m fit nowhere"):
        crowd.enter(clearance(TWO).astype(np.float32), CELL_M, Pose(1.0, 1.5, 0.0))


@pytest.mark.parametrize("seed", range(3))
def test_people_stop_before_the_robot_and_turn_elsewhere(seed):
    places = walk(TWO, seed, robot=DOOR, people=3, seconds=120.0)
    gaps = np.hypot(*(places[:, :, :2] - DOOR).transpose(2, 0, 1)) - 0.22 - 0.27
    # Nobody comes nearer than 0.3 m who is not there already, and nobody goes nearer still.
    for gap in gaps.T:
        assert (np.diff(np.minimum(gap, 0.3)) >= -1e-9).all()
    # The robot stands in the only doorway, so they stay in their rooms, and walk about there.
    assert (np.sign(places[:, :, 0] - 3.0) == np.sign(places[0, :, 0] - 3.0)).all()
    late = places[-300:, :, :2]
    assert np.hypot(*np.ptp(late, axis=0).T).min() > 0.5


def test_the_same_seed_sends_people_the_same_ways():
    assert np.array_equal(walk(OFFICES, 5, seconds=10.0), walk(OFFICES, 5, seconds=10.0))
    assert not np.array_equal(walk(OFFICES, 5, seconds=10.0), walk(OFFICES, 6, seconds=10.0))


def test_nobody_walks_through_a_door_that_has_closed():
    crowd = People(6, 1.1, 0.22, np.random.default_rng(2))
    body = Pose(0.6, 0.6, 0.0)
    crowd.enter(clearance(TWO).astype(np.float32), CELL_M, body)
    shut = GridMap((TWO.solid | LEAF).astype(np.uint8), CELL_M)
    while np.abs(crowd.discs[:, 0] - DOOR[0]).min() < 0.5:  # out of the doorway
        crowd.walk(0.1, body, 0.27)
    sides = np.sign(crowd.discs[:, 0] - DOOR[0])
    assert len(set(sides)) == 2
    crowd.enter(clearance(shut).astype(np.float32), CELL_M, body)
    for _ in range(300):
        before = crowd.discs.copy()
        crowd.walk(0.1, body, 0.27)
        assert np.array_equal(np.sign(crowd.discs[:, 0] - DOOR[0]), sides)
    assert not np.array_equal(before, crowd.discs)


def test_people_are_seen_by_the_laser_and_stop_the_robot():
    crowd = Crowd(1, speed_m_s=0.0, radius_m=0.3)
    way = line((1.0, 1.5), (5.0, 1.5))
    drive = simulated(
        room(6.0, 3.0), exact_robot(), (1.0, 1.5), [Along(way)],
        disturbances=Disturbances(crowd=crowd), time_limit_s=12.0,
    )  # fmt: skip
    drive._people.discs[0, :2] = (3.5, 1.5)
    seen = [(o.scan.ranges_m[89], drive.pose.x_m) for o in drive]
    assert seen[0][0] == pytest.approx(2.2, abs=2e-3)
    assert drive.ended == "time limit of 12 s"
    # Up to the person, and no farther than half a cell more.
    touching = 3.5 - 0.3 - 0.27
    assert touching - 0.05 < max(x for _, x in seen) <= touching + 0.5 * CELL_M
    assert drive.bumps > 0


def slipping(settings, seed=0, step_m=0.01, way_m=4000.0):
    slip = Slip(settings, np.random.default_rng(seed))
    return np.array([slip.advance(step_m) for _ in range(round(way_m / step_m))])


def test_slip_comes_in_stretches_of_the_stated_length_and_frequency():
    lost = slipping(SlipSettings(per_m=0.5, length_m=0.4, share=0.7))
    assert set(np.unique(lost)) == {0.0, 0.7}
    begins = np.flatnonzero(np.diff(lost) > 0)
    ends = np.flatnonzero(np.diff(lost) < 0)
    ends = ends[ends > begins[0]]
    lengths = (ends - begins[: len(ends)]) * 0.01
    assert lengths == pytest.approx(0.4, abs=0.011)
    # Between two stretches there are 1 / per_m = 2 m on average, exponential: the standard error
    # of the mean of n gaps is 2 / sqrt(n).
    gaps = (begins[1:] - ends[: len(begins) - 1]) * 0.01
    assert gaps.mean() == pytest.approx(2.0, abs=5 * 2.0 / math.sqrt(len(gaps)))
    assert gaps.std() == pytest.approx(2.0, rel=0.15)
    # So a share of 0.4 / (2 + 0.4) of the way is slippery.
    assert np.mean(lost > 0) == pytest.approx(0.4 / 2.4, abs=0.02)


def test_no_slip_is_none_and_backing_counts_as_a_way_too():
    assert not slipping(SlipSettings(), way_m=50.0).any()
    one_way = slipping(SlipSettings(per_m=1.0), seed=4, way_m=20.0)
    slip = Slip(SlipSettings(per_m=1.0), np.random.default_rng(4))
    back = [slip.advance(-0.01) for _ in range(2000)]
    assert one_way.tolist() == back
    assert any(back)


@pytest.mark.parametrize("share", [0.4, 1.0])
def test_odometry_counts_the_way_that_slip_has_lost(share):
    slippery = Disturbances(slip=SlipSettings(per_m=1e6, length_m=100.0, share=share))
    drive = simulated(
        room(12.0, 3.0), exact_robot(), (1.0, 1.5), [Along(line((1.0, 1.5), (11.0, 1.5)))],
        disturbances=slippery, time_limit_s=8.0,
    )  # fmt: skip
    seen = list(drive)
    counted = [o.pose.x_m - 1.0 for o in seen]
    true = [o.true_pose.x_m - 1.0 for o in seen]
    # True way = (1 - share) * counted way, from the second scan on: slip begins with the way.
    assert counted[-1] > 3.0
    for (c0, t0), (c1, t1) in itertools.pairwise(zip(counted[1:], true[1:], strict=True)):
        assert t1 - t0 == pytest.approx((1 - share) * (c1 - c0), abs=1e-9)
    assert drive.way_m == pytest.approx(true[-1])


def test_a_kidnap_moves_the_robot_but_not_its_odometry():
    to = Pose(7.5, 5.0, 2.0)
    drive = simulated(
        OFFICES, exact_robot(), (1.0, 3.0, 0.0), [Along(line((1.0, 3.0), (4.0, 3.0)))],
        disturbances=Disturbances(kidnaps=(Kidnap(1.5, to),)), time_limit_s=1.55,
    )  # fmt: skip
    seen = {round(o.t_s, 6): o for o in drive}
    before, after = seen[1.4], seen[1.5]
    assert (after.true_pose.x_m, after.true_pose.y_m, after.true_pose.theta_rad) == (7.5, 5.0, 2.0)
    # Of the odometry's point of view it just drove on for a tenth of a second.
    assert math.dist(
        (before.pose.x_m, before.pose.y_m), (after.pose.x_m, after.pose.y_m)
    ) == pytest.approx(0.6 * 1.45 * 0.1, abs=0.01)
    assert after.pose.y_m == pytest.approx(3.0)
    # What it is carried counts for no way: a t^2 / 2 after 1.5 s.
    assert drive.way_m == pytest.approx(0.5 * 0.6 * 1.5**2, abs=0.02)


def test_carried_into_another_room_it_explores_that_one_too():
    parted = room(6.0, 3.0, walls=[(2.9, 0.0, 3.1, 3.0)])
    drive = simulated(
        parted, exact_robot(), (1.5, 1.5, math.pi), [Exploration()],
        disturbances=Disturbances(kidnaps=(Kidnap(0.5, Pose(4.5, 1.5, 0.0)),)),
    )  # fmt: skip
    for _ in drive:
        pass
    assert drive.ended == "no frontier left"
    evidence = drive.navigator.explored.evidence
    assert (evidence[2:-2, 62:-2] < 0).mean() > 0.99


def test_being_carried_off_is_no_try_at_the_frontier_that_it_drove_to():
    leg = Exploration()
    drive = simulated(
        OFFICES, exact_robot(), (1.5, 1.0), [leg],
        disturbances=Disturbances(kidnaps=(Kidnap(5.0, Pose(7.5, 5.0, 0.0)),)),
    )  # fmt: skip
    tries = {round(o.t_s, 6): leg.set_aside for o in drive}
    assert tries[4.9] == tries[5.5]
    assert drive.ended == "no frontier left"
    assert drive.coverage >= 0.99


def test_a_door_whose_time_to_open_comes_while_it_waits_stays_open():
    leaf = door_leaf(two_rooms(), *DOOR)
    changes = (DoorChange(1.0, leaf, closed=True), DoorChange(2.0, leaf, closed=False))
    drive = simulated(
        two_rooms(), exact_robot(), (*DOOR, 0.0),
        [Wait(4.0), Along(line(DOOR, (5.0, 1.5))), Wait(1.0)],
        disturbances=Disturbances(doors=changes),
    )  # fmt: skip
    for _ in drive:
        pass
    assert not drive._solid[leaf].any()
