"""The simulated laser: its geometry, and faults as they are stated."""

import math

import numpy as np
import pytest
from buildings import exact_laser, room

from ssrics_like.perception.observation import Pose
from ssrics_like.scenarios.modules import load_robot
from ssrics_like.world.laser import Laser, leaps

ROOM = room(6.0, 6.0)  # free from 0.1 to 5.9
LEAP = leaps(ROOM.solid)
MIDDLE = Pose(3.0, 3.0, 0.4)
NOBODY = np.empty((0, 3))


def scans(profile, count=1, seed=1, pose=MIDDLE, people=NOBODY):
    laser = Laser(profile, np.random.default_rng(seed))
    return np.array([laser.scan(LEAP, ROOM.cell_m, pose, people).ranges_m for _ in range(count)])


def to_the_walls(pose, bearings):
    angles = pose.theta_rad + bearings
    x, y = np.cos(angles), np.sin(angles)
    with np.errstate(divide="ignore"):
        to_x = (np.where(x > 0, 5.9, 0.1) - pose.x_m) / x
        to_y = (np.where(y > 0, 5.9, 0.1) - pose.y_m) / y
    return np.minimum(to_x, to_y)


@pytest.mark.parametrize(
    ("name", "beams", "first_deg", "last_deg"),
    [
        ("pioneer-dx", 180, -89.5, 89.5),
        ("pioneer-dx-360", 360, -180.0, 179.0),
        ("pioneer-dx-urg", 682, -119.7, 119.7),
    ],
)
def test_the_shipped_lasers_look_where_they_say(name, beams, first_deg, last_deg):
    profile = load_robot(name).laser
    assert profile.beams == len(profile.bearings_rad) == beams
    ends = np.degrees(profile.bearings_rad[[0, -1]])
    assert ends == pytest.approx([first_deg, last_deg], abs=0.1)
    exact = profile.model_copy(update={"noise_m": 0.0, "dropout": 0.0, "mixed": 0.0})
    scan = Laser(exact, np.random.default_rng(0)).scan(LEAP, ROOM.cell_m, MIDDLE)
    bearings = scan.bearings_rad
    assert bearings == pytest.approx(profile.bearings_rad)
    expected = to_the_walls(MIDDLE, bearings)
    expected[expected > profile.range_max_m] = math.inf
    assert scan.ranges_m == pytest.approx(expected, rel=1e-9)


def test_without_faults_every_scan_is_exact_and_draws_nothing():
    profile = exact_laser()
    got = scans(profile, 2)
    assert got[0].tolist() == got[1].tolist()
    assert got[0] == pytest.approx(to_the_walls(MIDDLE, profile.bearings_rad), rel=1e-9)
    rng = np.random.default_rng(1)
    Laser(profile, rng).scan(LEAP, ROOM.cell_m, MIDDLE)
    assert rng.bit_generator.state == np.random.default_rng(1).bit_generator.state


def test_noise_has_mean_zero_and_the_stated_standard_deviation():
    sigma, profile = 0.03, exact_laser(noise_m=0.03)
    got = scans(profile, 200)
    errors = got - to_the_walls(MIDDLE, profile.bearings_rad)
    n = errors.size  # 36,000
    # Standard errors: of a mean sigma / sqrt(n), of a standard deviation sigma / sqrt(2 n).
    assert errors.mean() == pytest.approx(0.0, abs=5 * sigma / math.sqrt(n))
    assert errors.std() == pytest.approx(sigma, abs=5 * sigma / math.sqrt(2 * n))
    # Gaussian: erf(1 / sqrt 2) = 68.3 % lie within one standard deviation.
    within = math.erf(math.sqrt(0.5))
    assert np.mean(np.abs(errors) < sigma) == pytest.approx(within, abs=5 * 0.5 / math.sqrt(n))
    # Neighbouring beams, and a beam from scan to scan, err independently.
    for a, b in ((errors[:, 1:], errors[:, :-1]), (errors[1:], errors[:-1])):
        assert abs(np.corrcoef(a.ravel(), b.ravel())[0, 1]) < 5 / math.sqrt(n)


def test_noise_never_makes_a_range_negative():
    at_the_wall = Pose(0.1001, 3.0, math.pi)
    got = scans(exact_laser(noise_m=0.5), 20, pose=at_the_wall)
    assert got.min() == 0.0


def test_beams_drop_out_with_the_stated_probability_each_on_its_own():
    share, profile = 0.07, exact_laser(dropout=0.07)
    lost = np.isinf(scans(profile, 200))
    error = math.sqrt(share * (1 - share) / lost.size)
    assert lost.mean() == pytest.approx(share, abs=5 * error)
    both = np.mean(lost[:, 1:] & lost[:, :-1])
    assert both == pytest.approx(share**2, abs=5 * share / math.sqrt(lost.size))
    kept = scans(profile)[0]
    exact = to_the_walls(MIDDLE, profile.bearings_rad)
    assert kept[np.isfinite(kept)] == pytest.approx(exact[np.isfinite(kept)])
    assert np.isinf(scans(exact_laser(dropout=1.0))).all()


def test_edges_of_people_mix_with_the_wall_behind():
    person = np.array([[3.0 + 1.5 * math.cos(0.4), 3.0 + 1.5 * math.sin(0.4), 0.25]])
    sharp = scans(exact_laser(), people=person)[0]
    blurred = scans(exact_laser(mixed=1.0), people=person)[0]
    (changed,) = np.nonzero(sharp != blurred)
    edges = np.abs(np.diff(sharp)) > 0.3
    near_ones = [k + (sharp[k + 1] < sharp[k]) for k in np.flatnonzero(edges)]
    assert changed.tolist() == sorted(near_ones)
    assert len(changed) == 2
    # Behind is the farther neighbour: the mixture lies between.
    for k in changed:
        assert sharp[k] < blurred[k] < max(sharp[k - 1], sharp[k + 1])


def test_people_beyond_the_cap_are_not_seen():
    person = np.array([[3.0 + 2.0 * math.cos(0.4), 3.0 + 2.0 * math.sin(0.4), 0.25]])
    got = scans(exact_laser(range_max_m=1.7), people=person)[0]
    assert np.isinf(got).all()
    got = scans(exact_laser(range_max_m=1.8), people=person)[0]
    # The middle of a disc with D = 2, r = 0.25 is 1.75 m away, its edges sqrt(D^2 - r^2) = 1.98.
    assert 1.75 <= got[np.isfinite(got)].min() < 1.752
    assert got[np.isfinite(got)].max() <= 1.8


def test_the_same_seed_gives_the_same_faults_and_another_others():
    profile = exact_laser(noise_m=0.02, dropout=0.05, mixed=0.5)
    assert scans(profile, 3).tolist() == scans(profile, 3).tolist()
    assert scans(profile, 3).tolist() != scans(profile, 3, seed=2).tolist()
    first, second = scans(profile, 2)
    assert (first != second).mean() > 0.9


def test_a_laser_ahead_of_the_centre_sees_from_there():
    laser = Laser(exact_laser(x_m=0.25), np.random.default_rng(0))
    # It turns with the body: 0.25 m along its heading.
    assert laser.pose_at(Pose(1.0, 2.0, 0.0)) == Pose(1.25, 2.0, 0.0)
    at = laser.pose_at(Pose(1.0, 2.0, math.pi / 2))
    assert (at.x_m, at.y_m, at.theta_rad) == pytest.approx((1.0, 2.25, math.pi / 2))
    behind = Laser(exact_laser(x_m=-0.1), np.random.default_rng(0)).pose_at(Pose(0.0, 0.0, 1.0))
    assert (behind.x_m, behind.y_m) == pytest.approx((-0.1 * math.cos(1), -0.1 * math.sin(1)))
