"""The leg ``goto``: a mind says where to; the body gets there by what it knows itself."""

import math

import numpy as np
import pytest
from buildings import DOOR, exact_robot, offices, room, simulated, two_rooms

from ssrics_like.perception.observation import Pose
from ssrics_like.wayfinding import Command
from ssrics_like.world.disturbances import Disturbances, DoorChange, Kidnap
from ssrics_like.world.doors import door_leaf
from ssrics_like.world.leading import PATIENCE_S, SILENCE_S, Lead
from ssrics_like.world.occupancy import OccupancyGrid
from ssrics_like.world.own_map import SIDE_M, OwnMap
from ssrics_like.world.robot import OdometryProfile

ROBOT = exact_robot()
WAIT = Command("wait")


class Mind:
    """Commands one place after another, own frame; keeps what it is told."""

    def __init__(self, *places, near_m=0.3, limit_m=math.inf, then=None):
        self.here = None
        self.carried = 0
        self.told = []
        self.ordered = []
        self._commands = [Command("drive", Pose(*p, 0.0), near_m, limit_m) for p in places]
        self._then = then

    @property
    def command(self):
        return self._commands[0] if self._commands else self._then

    def order(self, errand):
        self.ordered.append(errand)

    def tell(self, event, reason="none"):
        self.told.append((event, reason))
        self._commands = self._commands[1:]


def led(grid, start, mind, robot=ROBOT, *, origin=None, **more):
    """Drive as the mind says; its frame is that of odometry."""
    leg = Lead("L1")
    leg.guide = mind
    drive = simulated(grid, robot, start, [leg], **more)
    ends = []
    for observation in drive:
        mind.here = observation.pose
        if len(mind.told) > len(ends):
            ends.append((drive.pose.x_m, drive.pose.y_m))
        if drive.t_s > 120.0:
            break
    ends += [(drive.pose.x_m, drive.pose.y_m)] * (len(mind.told) - len(ends))
    return drive, np.array(ends)


def test_it_drives_to_a_place_behind_a_wall_that_it_does_not_know():
    mind = Mind((5.0, 0.7))
    drive, ends = led(two_rooms(), (1.0, 0.7), mind)
    assert mind.ordered == ["L1"]
    assert mind.told == [("arrived", "none")]
    assert math.dist(ends[0], (5.0, 0.7)) <= 0.35
    assert drive.bumps == 0
    assert drive.ended == "end of the errand L1"


def test_it_goes_by_its_own_frame_however_that_lies():
    """Odometry that begins elsewhere, turned: the mind's places are in that frame."""

    class Turned(Mind):
        frame = Pose(3.0, -2.0, 2.0)

        @property
        def here(self):
            return None if self._here is None else self.frame.onward(self._here)

        @here.setter
        def here(self, pose):
            self._here = pose

    there = Turned.frame.onward(Pose(5.0, 0.7, 0.0))
    mind = Turned((there.x_m, there.y_m))
    _, ends = led(two_rooms(), (1.0, 0.7), mind)
    assert math.dist(ends[0], (5.0, 0.7)) <= 0.35


def test_where_odometry_errs_it_ends_where_it_believes_to_be():
    off = OdometryProfile(
        scale=0.0, turn_scale=0.0, way_noise_m=0.05, turn_noise_rad=0.05, drift_rad=0.02
    )
    mind = Mind((5.0, 0.7))
    drive, ends = led(two_rooms(), (1.0, 0.7), mind, exact_robot(odometry=off), seed=3)
    assert mind.told == [("arrived", "none")]
    assert mind.here.distance_m(Pose(5.0, 0.7, 0.0)) <= 0.35  # as it believes
    assert math.dist(ends[0], (5.0, 0.7)) > 0.0
    assert drive.bumps == 0


def closed_door(grid=None, at_s=0.0):
    grid = grid or two_rooms()
    return Disturbances(doors=(DoorChange(at_s, door_leaf(grid, *DOOR), closed=True),))


def test_a_closed_door_blocks_the_way_after_some_patience():
    mind = Mind((5.0, 0.7), limit_m=12.0)
    drive, ends = led(two_rooms(), (1.0, 0.7), mind, disturbances=closed_door())
    assert mind.told == [("blocked", "shut")]
    assert ends[0][0] < DOOR[0]
    assert drive.t_s >= PATIENCE_S


def test_a_door_that_opens_in_time_lets_it_pass():
    leaf = door_leaf(two_rooms(), *DOOR)
    doors = (DoorChange(0.0, leaf, closed=True), DoorChange(9.0, leaf, closed=False))
    mind = Mind((5.0, 0.7), limit_m=12.0)
    led(two_rooms(), (1.0, 0.7), mind, disturbances=Disturbances(doors=doors))
    assert mind.told == [("arrived", "none")]


def test_a_way_that_is_longer_than_it_may_be_is_no_way():
    grid = offices()  # from one office to the next, by the corridor
    mind = Mind((7.5, 1.0), limit_m=6.5)
    led(grid, (1.5, 1.0), mind)
    assert mind.told == [("blocked", "shut")]
    mind = Mind((7.5, 1.0), limit_m=20.0)
    led(grid, (1.5, 1.0), mind)
    assert mind.told == [("arrived", "none")]


def test_near_a_place_that_something_stands_on_is_near_enough():
    grid = room(6.0, 3.0, walls=[(4.3, 1.2, 4.7, 1.8)])
    mind = Mind((4.5, 1.5), limit_m=20.0)
    _, ends = led(grid, (1.0, 1.5), mind)
    assert mind.told == [("arrived", "none")]
    assert math.dist(ends[0], (4.5, 1.5)) <= 0.8


def test_one_command_follows_another():
    mind = Mind((5.0, 0.7), (1.0, 2.2), (5.0, 2.2))
    _, ends = led(two_rooms(), (1.0, 0.7), mind)
    assert mind.told == [("arrived", "none")] * 3
    for end, place in zip(ends, [(5.0, 0.7), (1.0, 2.2), (5.0, 2.2)], strict=True):
        assert math.dist(end, place) <= 0.35


def test_it_looks_about_where_the_mind_is_lost():
    class Lost(Mind):
        @property
        def command(self):
            return None if self.told else Command("search")

    mind = Lost()
    drive, _ = led(offices(), (3.0, 3.0), mind)
    assert mind.told == [("nowhere", "lost")]  # every room was looked into
    assert drive.coverage > 0.99


def test_it_stands_while_it_is_to_wait_and_gives_up_on_silent_rules():
    mind = Mind(then=WAIT)
    drive, _ = led(two_rooms(), (1.0, 0.7), mind)
    assert drive.way_m < 0.01
    assert drive.t_s == pytest.approx(SILENCE_S, abs=1.0)
    assert "no rule answered" in drive.navigator.notes[0]


def test_one_that_was_carried_begins_a_map_of_its_own_anew():
    class Noticing(Mind):
        @property
        def carried(self):
            return int(self.here is not None and self.t_s() >= 2.0)

        @carried.setter
        def carried(self, value):
            pass

    mind = Noticing((9.0, 0.0), limit_m=40.0)
    grid = two_rooms()
    leg = Lead("L1")
    leg.guide = mind
    there = Disturbances(kidnaps=(Kidnap(2.0, Pose(4.5, 2.2, 0.0)),))
    drive = simulated(grid, ROBOT, (1.0, 0.7), [leg], disturbances=there)
    mind.t_s = lambda: drive.t_s
    for observation in drive:
        mind.here = observation.pose
        if drive.t_s > 4.0:
            break
    known = leg._map.explored.evidence
    assert (known != 0).any()
    assert leg._map.within(mind.here).distance_m(Pose(SIDE_M / 2, SIDE_M / 2, 0.0)) < 2.0


def test_a_leg_without_anybody_who_leads_is_a_bug():
    with pytest.raises(RuntimeError, match="nobody leads"):
        list(simulated(two_rooms(), ROBOT, (1.0, 0.7), [Lead("L1")]))


def test_a_shifted_grid_knows_what_a_new_one_that_had_seen_the_same_would_know():
    rng = np.random.default_rng(0)
    shape, rows, columns = (40, 30), 7, -5
    grid = OccupancyGrid(shape, 0.1, 0.2)
    for row, column in rng.integers(0, shape, (200, 2)).tolist():
        grid._add(row, column, int(rng.choice([-4, 6])))
    evidence = grid.evidence.copy()
    grid.shift(rows, columns)
    other = OccupancyGrid(shape, 0.1, 0.2)
    for row, column in np.argwhere(evidence).tolist():
        there = row - rows, column - columns
        if 0 <= there[0] < shape[0] and 0 <= there[1] < shape[1]:
            other._add(*there, int(evidence[row, column]))
    np.testing.assert_array_equal(grid.evidence, other.evidence)
    np.testing.assert_array_equal(grid.costs(2), other.costs(2))


def test_a_window_follows_the_robot_and_forgets_what_is_far():
    own = OwnMap(ROBOT, 0.1, Pose(0.0, 0.0, 0.0))
    grid = room(6.0, 3.0)
    drive = simulated(grid, ROBOT, (1.0, 1.5), [])
    scan = next(iter(drive)).scan
    assert not own.take(Pose(0.0, 0.0, 0.0), Pose(0.0, 0.0, 0.0), scan)
    wall = own.within(Pose(4.9, 0.0, 0.0))
    row, column = int(wall.y_m / 0.1), int((wall.x_m + 0.05) / 0.1)
    assert (own.explored.evidence[row - 1 : row + 2, column - 1 : column + 2] > 0).any()
    there = Pose(12.0, 0.0, 0.0)
    assert own.take(there, there, scan)
    centre = own.within(there)
    assert (centre.x_m, centre.y_m) == pytest.approx((SIDE_M / 2, SIDE_M / 2), abs=0.1)
    wall = own.within(Pose(4.9, 0.0, 0.0))
    row, column = int(wall.y_m / 0.1), int((wall.x_m + 0.05) / 0.1)
    assert (own.explored.evidence[row - 1 : row + 2, column - 1 : column + 2] > 0).any()
