"""How the robot drives, and how its odometry errs: by formulas, and never through a wall."""

import itertools
import math

import numpy as np
import pytest
from buildings import (
    CELL_M,
    NO_DRIFT,
    Along,
    distance_to_solid,
    exact_robot,
    line,
    offices,
    room,
    simulated,
)
from hypothesis import given, settings
from hypothesis import strategies as st

from ssrics_like.errors import SettingsError
from ssrics_like.perception.observation import Pose
from ssrics_like.scenarios.modules import load_robot
from ssrics_like.world import motion_kernels
from ssrics_like.world.motion_kernels import ARRIVED, ARRIVED_M, FACED_RAD, ON_THE_WAY
from ssrics_like.world.odometry import Odometry
from ssrics_like.world.reachable import clearance
from ssrics_like.world.robot import OdometryProfile

SPEED, TURN, ACCELERATION, TURN_ACCELERATION = LIMITS = (0.894, 1.7, 0.6, 3.0)
RADIUS_M = 0.27
TICK_S = 0.025
HALL = room(14.0, 6.0)
HALL_CLEARANCE = clearance(HALL).astype(np.float32)
OFFICES = offices()
OFFICES_FIT = np.argwhere(clearance(OFFICES) > RADIUS_M)
NOBODY = np.empty((0, 3))
NOWHERE = np.empty((0, 2))


class Drive:
    """A robot in the hall, moved tick by tick, with what it did at each."""

    def __init__(self, x, y, theta=0.0, speed=0.0):
        self.state = np.array([x, y, theta, speed, 0.0])
        self.at, self.status, self.bumps = 0, ON_THE_WAY, 0
        self.counted = np.zeros(2)
        self.states = [self.state.copy()]

    def go(
        self, seconds, path=NOWHERE, face=math.nan, free_m=math.inf, backing=False, slip=0.0,
        people=NOBODY,
    ):  # fmt: skip
        path = np.array(path, np.float64).reshape(-1, 2)
        for _ in range(round(seconds / TICK_S)):
            measured = np.empty(2)
            self.at, self.status, bumps = motion_kernels.drive(
                self.state, measured, path, self.at, face, free_m, backing, TICK_S, 1, LIMITS,
                (1.0, 1.0, slip), RADIUS_M, HALL_CLEARANCE, CELL_M, people,
            )  # fmt: skip
            self.bumps += bumps
            self.counted += measured
            free_m -= measured[0]
            self.states.append(self.state.copy())
        return self


def test_a_straight_drive_has_the_stated_acceleration_and_top_speed():
    drive = Drive(1.0, 3.0).go(10.0, line((1.0, 3.0), (12.0, 3.0)))
    x, y, theta, speed, turn = np.array(drive.states).T
    t = TICK_S * np.arange(len(x))
    # v = a t up to the limit; it is reached after v / a = 1.49 s.
    expected = np.minimum(ACCELERATION * t, SPEED)
    assert speed == pytest.approx(expected)
    # Way: the sum of the speeds of all ticks, v^2 / 2a + v (t - v / a) but for half a tick's worth.
    assert x - 1.0 == pytest.approx(np.cumsum(speed) * TICK_S)
    closed = SPEED**2 / (2 * ACCELERATION) + SPEED * (10.0 - SPEED / ACCELERATION)
    assert x[-1] - 1.0 == pytest.approx(closed, abs=SPEED * TICK_S)
    assert (y == 3.0).all()
    assert (theta == 0.0).all()
    assert (turn == 0.0).all()


def test_it_arrives_at_the_end_of_a_way_and_takes_up_the_heading():
    for end, face in [((12.0, 3.0), 2.0), ((2.0, 3.0), -3.0), ((5.0, 5.0), math.pi)]:
        drive = Drive(7.0, 3.0, 0.5).go(25.0, line((7.0, 3.0), end), face)
        assert drive.status == ARRIVED
        x, y, theta, speed, turn = drive.state
        # It turns to the heading where it stands, ARRIVED_M from the place at most and what it
        # brakes on: v^2 / 2a is nothing at the speed that is left.
        assert math.dist((x, y), end) <= ARRIVED_M + 0.02
        assert abs(math.remainder(theta - face, math.tau)) <= FACED_RAD + 0.02
        assert (speed, turn) == (0.0, 0.0)
        assert drive.bumps == 0


def test_it_only_turns_where_it_has_no_way_and_only_stands_without_a_heading():
    turned = Drive(3.0, 3.0).go(3.0, face=2.5)
    assert turned.status == ARRIVED
    assert turned.state[:2].tolist() == [3.0, 3.0]
    assert abs(turned.state[2] - 2.5) <= FACED_RAD + 0.02
    assert max(s[4] for s in turned.states) == pytest.approx(TURN)
    # Turn by the shorter side: from 3 to -3 it is 0.28 rad to the left.
    assert all(s[4] >= 0 for s in Drive(3.0, 3.0, 3.0).go(2.0, face=-3.0).states)
    stood = Drive(3.0, 3.0, 1.0).go(1.0)
    assert stood.status == ARRIVED
    assert stood.state.tolist() == [3.0, 3.0, 1.0, 0.0, 0.0]


@settings(max_examples=40, deadline=None)
@given(
    st.lists(st.tuples(st.floats(1.0, 13.0), st.floats(1.0, 5.0)), min_size=1, max_size=5),
    st.floats(-math.pi, math.pi),
)
def test_no_limit_is_ever_exceeded(places, theta):
    points = [(7.0, 3.0), *places]
    path = np.vstack([line(a, b) for a, b in itertools.pairwise(points)])
    states = np.array(Drive(*points[0], theta).go(12.0, path, 0.0).states)
    speed, turn = states[:, 3], states[:, 4]
    slack = 1e-9
    assert 0.0 <= speed.min() <= speed.max() <= SPEED + slack
    assert np.abs(turn).max() <= TURN + slack
    assert np.diff(speed).max() <= ACCELERATION * TICK_S + slack
    assert np.diff(speed).min() >= -2 * ACCELERATION * TICK_S - slack  # brakes are stronger
    assert np.abs(np.diff(turn)).max() <= TURN_ACCELERATION * TICK_S + slack
    moved = np.hypot(*np.diff(states[:, :2], axis=0).T)
    assert moved == pytest.approx(speed[1:] * TICK_S, abs=1e-9)


def test_it_slows_down_for_what_the_laser_sees_ahead():
    drive = Drive(1.0, 3.0).go(9.0, line((1.0, 3.0), (12.0, 3.0)), free_m=2.0)
    x, _, _, speed, _ = np.array(drive.states).T
    # v^2 = 2 a s for the s that is left, at 0.7 of the deceleration; in the end it creeps.
    left = np.maximum(2.0 - (x[:-1] - 1.0), 0.0)
    allowed = np.maximum(np.sqrt(2 * 0.7 * ACCELERATION * left), motion_kernels.CREEP_M_S)
    assert (speed[1:] <= allowed + 1e-9).all()
    assert speed[-1] == pytest.approx(motion_kernels.CREEP_M_S)
    assert 2.9 < x[-1] < 3.3


def test_it_backs_off_straight():
    drive = Drive(5.0, 3.0, 0.7).go(1.0, backing=True)
    x, y, theta, speed, _ = drive.state
    assert theta == 0.7
    assert speed == -motion_kernels.BACKING_M_S
    # Up to full speed it needs 0.2 / (2 * 0.6) s with its strong brakes, then drives 0.2 m/s.
    way = 0.2 * (1.0 - 0.5 * 0.2 / 1.2)
    assert drive.counted[0] == pytest.approx(-way, abs=0.01)
    assert (x, y) == pytest.approx(
        (5.0 + drive.counted[0] * math.cos(0.7), 3.0 + drive.counted[0] * math.sin(0.7))
    )
    against = Drive(0.5, 3.0).go(2.0, backing=True)
    assert against.bumps > 0
    assert against.state[0] >= 0.1 + RADIUS_M


@pytest.mark.parametrize("share", [0.0, 0.25, 1.0])
def test_slipping_wheels_count_a_way_that_the_robot_does_not_go(share):
    drive = Drive(1.0, 3.0).go(4.0, line((1.0, 3.0), (12.0, 3.0)), slip=share)
    # True way = (1 - share) * counted way.
    assert drive.counted[0] > 2.0
    assert drive.state[0] - 1.0 == pytest.approx((1.0 - share) * drive.counted[0])


def test_against_a_wall_the_wheels_stop_and_count_nothing():
    drive = Drive(12.5, 3.0).go(5.0, line((12.5, 3.0), (20.0, 3.0)))
    assert drive.bumps > 0
    # The wall begins at 13.9 m; the body touches it, but for a tick's way.
    assert 13.9 - RADIUS_M - 0.05 < drive.state[0] <= 13.9 - RADIUS_M
    assert drive.counted[0] == pytest.approx(drive.state[0] - 12.5)


def test_people_are_solid_too():
    drive = Drive(3.0, 3.0).go(
        8.0, line((3.0, 3.0), (9.0, 3.0)), people=np.array([[6.0, 3.0, 0.2]])
    )
    assert drive.bumps > 0
    assert 5.7 - RADIUS_M < drive.state[0] <= 5.8 - RADIUS_M


def test_out_of_a_tight_spot_it_may_go_but_not_farther_in():
    nearer, away = Drive(0.3, 3.0, math.pi), Drive(0.3, 3.0)  # the body sticks 7 cm into the wall
    nearer.go(1.0, line((0.3, 3.0), (0.2, 3.0)))
    assert nearer.state[0] == 0.3
    away.go(2.0, line((0.3, 3.0), (2.0, 3.0)))
    assert away.state[0] > 0.6
    assert away.bumps == 0


@st.composite
def rambles(draw, width_m, height_m):
    """Ways from corner to corner of a polygon that knows of no walls."""
    place = st.tuples(st.floats(0.0, width_m), st.floats(0.0, height_m))
    return draw(st.lists(place, min_size=1, max_size=5)), draw(st.integers(0, 1000))


def nearest_to_walls(grid, start, places, seed):
    points = [start[:2], *places]
    way = np.vstack([line(a, b) for a, b in itertools.pairwise(points)])
    robot = exact_robot(actuation=0.2)
    drive = simulated(grid, robot, start, [Along(way)], seed, time_limit_s=20.0)
    return min(distance_to_solid(grid, drive.pose.x_m, drive.pose.y_m) for _ in drive)


@settings(max_examples=30, deadline=None)
@given(rambles(14.0, 6.0))
def test_along_straight_walls_the_body_stays_off_but_for_half_a_cell(ramble):
    assert nearest_to_walls(HALL, (7.0, 3.0), *ramble) >= RADIUS_M - 0.5 * CELL_M - 1e-6


@settings(max_examples=30, deadline=None)
@given(rambles(9.0, 6.0), st.integers(0, len(OFFICES_FIT) - 1))
def test_no_way_leads_through_a_wall_or_a_corner(ramble, at):
    row, column = OFFICES_FIT[at]
    start = ((column + 0.5) * CELL_M, (row + 0.5) * CELL_M)
    # Off a corner, clearance is too large by up to a fifth of a cell (`reachable.clearance`), and
    # between the middles of cells by a hair more.
    assert nearest_to_walls(OFFICES, start, *ramble) >= RADIUS_M - 0.75 * CELL_M


def test_what_lies_straight_ahead_is_how_far_the_body_can_go():
    bearings = np.radians(np.arange(-89.5, 90.0))
    directions = np.column_stack([np.cos(bearings), np.sin(bearings)])

    def free(ranges, laser_x_m=0.0):
        return motion_kernels.free_ahead(ranges, directions, laser_x_m, 0.3)

    # A wall across at d: the beam nearest to straight ahead meets it d away, the body's front
    # touches it d - 0.3 on.
    assert free(2.0 / np.cos(bearings)) == pytest.approx(1.7, abs=1e-3)
    assert free(2.0 / np.cos(bearings), 0.1) == pytest.approx(1.8, abs=1e-3)
    # Walls beside it are in nobody's way, and what has no return is none.
    assert free(0.31 / np.maximum(np.abs(np.sin(bearings)), 1e-3)) == math.inf
    assert free(np.full(180, math.inf)) == math.inf
    assert free(np.full(180, math.nan)) == math.inf
    # A post at (1, 0.2): the disc of radius 0.3 touches it 1 - sqrt(0.3^2 - 0.2^2) on.
    post = np.full(180, math.inf)
    nearest = int(np.argmin(np.abs(bearings - math.atan2(0.2, 1.0))))
    post[nearest] = 1.0 / math.cos(bearings[nearest])
    aside = math.tan(bearings[nearest])
    assert free(post) == pytest.approx(1.0 - math.sqrt(0.3**2 - aside**2))


def travelled(profile, steps, seeds):
    """Return the final estimates, shape (seeds, 3), after steps of (way, turn)."""
    ends = []
    for seed in range(seeds):
        odometry = Odometry(profile, Pose(0.0, 0.0, 0.0), np.random.default_rng(seed))
        for way_m, turn_rad in steps:
            pose = odometry.advance(way_m, turn_rad)
        ends.append((pose.x_m, pose.y_m, pose.theta_rad))
    return np.array(ends)


def only(**changes):
    return OdometryProfile(**{**NO_DRIFT.model_dump(), **changes})


RUNS = 800
SPREAD = 5 / math.sqrt(2 * RUNS)  # five standard errors of a standard deviation, as a share of it


def test_odometry_without_errors_is_the_true_pose():
    drive = simulated(
        OFFICES, exact_robot(), (1.0, 1.0), [Along(line((1.0, 1.0), (3.5, 1.8)), 2.0)]
    )
    poses = [(o.pose, o.true_pose) for o in drive]
    assert len(poses) > 30
    for pose, true in poses:
        # Within a scan it adds one straight stretch, the body moves in four: they differ little.
        assert (pose.x_m, pose.y_m) == pytest.approx((true.x_m, true.y_m), abs=2e-3)
        assert math.remainder(pose.theta_rad - true.theta_rad, math.tau) == pytest.approx(
            0.0, abs=1e-9
        )


def test_random_errors_of_the_way_grow_with_its_square_root():
    ends = travelled(only(way_noise_m=0.05), [(0.1, 0.0)] * 40, RUNS)
    # Variance after n metres: way_noise_m^2 n, whatever the steps.
    sigma = 0.05 * math.sqrt(4.0)
    assert ends[:, 0].std() == pytest.approx(sigma, rel=SPREAD)
    assert ends[:, 0].mean() == pytest.approx(4.0, abs=5 * sigma / math.sqrt(RUNS))
    assert (ends[:, 1:] == 0.0).all()


def test_the_heading_drifts_with_the_square_root_of_the_way():
    steps, step_m, drift = 40, 0.1, 0.01
    ends = travelled(only(drift_rad=drift), [(step_m, 0.0)] * steps, RUNS)
    assert ends[:, 2].std() == pytest.approx(drift * math.sqrt(4.0), rel=SPREAD)
    # Aside: y = sum of way times heading; an error made in step j turns all later steps and half
    # of its own. Var y = drift^2 s^3 sum (m + 1/2)^2, about drift^2 n^3 / 3 after n metres.
    var = drift**2 * step_m**3 * sum((m + 0.5) ** 2 for m in range(steps))
    assert var == pytest.approx(drift**2 * 4.0**3 / 3, rel=1e-3)
    assert ends[:, 1].std() == pytest.approx(math.sqrt(var), rel=SPREAD)


def test_random_errors_of_turns_grow_with_the_square_root_of_all_turning():
    ends = travelled(only(turn_noise_rad=0.03), [(0.0, 0.1), (0.0, -0.1)] * 20, RUNS)
    assert ends[:, 2].std() == pytest.approx(0.03 * math.sqrt(4.0), rel=SPREAD)
    assert (ends[:, :2] == 0.0).all()


def test_systematic_errors_are_one_factor_for_a_whole_run():
    ends = travelled(only(scale=0.02, turn_scale=0.05), [(0.1, 0.0)] * 10 + [(0.0, 0.1)] * 10, RUNS)
    assert ends[:, 0].std() == pytest.approx(0.02 * 1.0, rel=SPREAD)
    assert ends[:, 2].std() == pytest.approx(0.05 * 1.0, rel=SPREAD)
    # Twice the way, twice the error: the same factor, not another draw.
    twice = travelled(only(scale=0.02), [(0.1, 0.0)] * 20, 20)
    once = travelled(only(scale=0.02), [(0.1, 0.0)] * 10, 20)
    assert twice[:, 0] == pytest.approx(2 * once[:, 0])
    # Backwards it errs alike.
    back = travelled(only(scale=0.02), [(0.1, 0.0), (-0.1, 0.0)], 20)
    assert back[:, 0] == pytest.approx(0.0)


def test_the_wheels_miss_commands_by_the_stated_share_and_odometry_counts_what_they_did():
    robot = exact_robot(actuation=0.1, laser=None)
    drive = simulated(HALL, robot, (1.0, 3.0), [Along(line((1.0, 3.0), (12.5, 3.0)))])
    seen = list(drive)
    xs = np.array([o.true_pose.x_m for o in seen])
    odometry = np.array([o.pose.x_m for o in seen])
    assert odometry == pytest.approx(xs, abs=2e-3)
    cruising = np.diff(xs)[20:-30] / 0.1  # m/s, without starting and stopping
    assert len(cruising) > 80
    # Each scan's way is SPEED * (1 + 0.1 z); the heading wavers, which costs little.
    assert cruising.mean() == pytest.approx(SPEED, abs=5 * 0.1 * SPEED / math.sqrt(len(cruising)))
    assert cruising.std() == pytest.approx(0.1 * SPEED, rel=5 / math.sqrt(2 * len(cruising)))


def test_the_reports_robot_is_shipped():
    robot = load_robot("pioneer-dx")
    assert robot.speed_m_s == pytest.approx(2 * 1609.344 / 3600, abs=1e-3)  # 2 miles an hour
    assert robot.laser.beams == 180
    assert robot.radius_m > math.hypot(0.455, 0.381) / 2 - 0.03


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("radius_m: 0\n", "radius_m: 0: expected greater than or equal to 0.01"),
        ("speed_m_s: -1\n", "speed_m_s: -1: expected greater than 0"),
        ("lazer: {beams: 4}\n", "unknown key 'lazer'; did you mean 'laser'?"),
        ("laser: {beans: 4}\n", "unknown key 'laser.beans'; did you mean 'beams'?"),
        ("laser: {dropout: 1.5}\n", "laser.dropout: 1.5: expected less than or equal to 1"),
        ("laser: {rate_hz: .inf}\n", "laser.rate_hz: inf: expected a finite number"),
        ("odometry: {scale: yes}\n", "odometry.scale: True where a number was expected"),
    ],
)
def test_a_wrong_robot_file_says_where(tmp_path, text, said):
    path = tmp_path / "robot.yaml"
    path.write_text("title: mine\n" + text)
    with pytest.raises(SettingsError) as caught:
        load_robot(path)
    assert str(caught.value).startswith(f"{path}:2:")
    assert said in str(caught.value)
