"""What the surroundings of a place look like: on drawn plans whose measures are known."""

import math

import numpy as np
import pytest
from buildings import Along, exact_laser, exact_robot, line, room, simulated, two_rooms

from ssrics_like.perception.conditioning import condition
from ssrics_like.perception.gap import FEATURES, MEASURES
from ssrics_like.perception.observation import Pose
from ssrics_like.perception.surroundings import LAG_M, Surroundings

AT = {name: i for i, name in enumerate(FEATURES)}


def drive(grid, start, places, laser=None, **changes):
    robot = exact_robot(laser or exact_laser(), **changes)
    return list(simulated(grid, robot, start, [Along(places)]))


def described(observations, turned=0.0):
    """Describe a drive; `turned` turns the frame of odometry."""
    surroundings = Surroundings()
    found = []
    c, s = math.cos(turned), math.sin(turned)
    for o in observations:
        pose = Pose(
            c * o.true_pose.x_m - s * o.true_pose.y_m,
            s * o.true_pose.x_m + c * o.true_pose.y_m,
            o.true_pose.theta_rad + turned,
        )
        ranges = condition(o.scan.ranges_m, 8.0, 5).ranges_m
        found += surroundings.update(pose, o.scan.bearings_rad, ranges, o)
    return found


def nearest_place(found, x, y):
    return min(
        found,
        key=lambda d: math.hypot(
            d.place.nearest.true_pose.x_m - x, d.place.nearest.true_pose.y_m - y
        ),
    )


def nearest(found, x, y):
    return nearest_place(found, x, y).measures


def test_every_measure_has_a_name_of_its_own():
    assert len(set(FEATURES)) == len(FEATURES) == 119


@pytest.mark.parametrize("door_m", [0.8, 1.0, 1.4])
def test_a_doorway_is_as_wide_as_it_is_and_its_walls_go_on(door_m):
    grid = two_rooms(door_m)
    found = described(drive(grid, (1.0, 1.5, 0.0), line((1.0, 1.5), (5.0, 1.5))))
    measures = nearest(found, 3.0, 1.5)
    assert measures[AT["width_m"]] == pytest.approx(door_m, abs=0.1)
    assert measures[AT["off_middle_m"]] <= 0.1
    assert measures[AT["oblique_rad"]] <= 0.1
    jamb_to_wall = (3.0 - door_m) / 2 - 0.1
    assert measures[AT["unbroken_wall_m_lesser"]] == pytest.approx(jamb_to_wall, abs=0.2)
    # A metre before and after it the room is 2.8 m wide.
    for name in ("near_wall_m@-1.0", "far_wall_m@-1.0", "near_wall_m@+1.0"):
        assert measures[AT[name]] == pytest.approx(1.4, abs=0.16)


def test_the_middle_of_a_room_is_no_gap():
    found = described(drive(room(8.0, 8.0), (1.5, 4.0, 0.0), line((1.5, 4.0), (6.0, 4.0))))
    measures = nearest(found, 4.0, 4.0)
    assert measures[AT["width_m"]] == 5.0  # 2.5 m to either side, where it stops looking
    assert measures[AT["full_lane@-0.3..+0.3"]] == 0.0


def test_how_obliquely_a_doorway_is_passed_and_the_frame_do_not_matter():
    grid = two_rooms(1.0)
    seen = drive(grid, (1.6, 0.8, 0.4636), line((1.6, 0.8), (4.4, 2.2)))
    for turned in (0.0, 0.7, 2.0):
        measures = nearest(described(seen, turned), 3.0, 1.5)
        assert measures[AT["width_m"]] == pytest.approx(1.0, abs=0.13)
        assert measures[AT["oblique_rad"]] == pytest.approx(0.46, abs=0.18)


def test_a_doorway_lies_in_one_place_whichever_way_it_is_passed():
    grid = two_rooms(1.0)
    for turned in (0.0, 0.7, 2.0):
        there = described(drive(grid, (1.6, 0.8, 0.4636), line((1.6, 0.8), (4.4, 2.2))), turned)
        back = described(drive(grid, (4.4, 1.3, 3.0), line((4.4, 1.3), (1.6, 1.7))), turned)
        c, s = math.cos(turned), math.sin(turned)
        for found, through in ((there, turned), (back, turned + math.pi)):
            gap = nearest_place(found, 3.0, 1.5).gap
            assert gap.x_m == pytest.approx(3.0 * c - 1.5 * s, abs=0.12)
            assert gap.y_m == pytest.approx(3.0 * s + 1.5 * c, abs=0.12)
            assert -math.pi <= gap.theta_rad <= math.pi
            assert abs(math.remainder(gap.theta_rad - through, math.tau)) < 0.18


def after(grid, start, places):
    """Return the surroundings as they are known after a drive."""
    surroundings = Surroundings()
    for o in drive(grid, start, places):
        ranges = condition(o.scan.ranges_m, 8.0, 5).ranges_m
        surroundings.update(o.true_pose, o.scan.bearings_rad, ranges, o)
    return surroundings


@pytest.mark.parametrize("through_rad", [-0.8, -0.4, 0.0, 0.4, 0.8])
@pytest.mark.parametrize("way", [line((2.6, 1.5), (3.4, 1.5)), line((2.6, 1.3), (3.4, 1.7))])
def test_the_frame_of_a_doorway_hangs_neither_on_the_way_nor_on_how_well_it_is_known(
    way, through_rad
):
    surroundings = after(two_rooms(1.0), (1.0, 1.5, 0.0), line((1.0, 1.5), (4.5, 1.5)))
    found = surroundings.doorway_on(way, through_rad)
    assert found.middle.distance_m(Pose(3.0, 1.5, 0.0)) < 0.08
    assert abs(found.middle.theta_rad) < 0.1
    assert found.width_m == pytest.approx(1.0, abs=0.1)


def test_one_place_in_a_doorway_tells_where_it_is():
    surroundings = after(two_rooms(1.0), (1.0, 1.5, 0.0), line((1.0, 1.5), (4.5, 1.5)))
    found = surroundings.doorway_on(np.array([[3.0, 1.6]]), 0.0)
    assert found.middle.distance_m(Pose(3.0, 1.5, 0.0)) < 0.08


@pytest.mark.parametrize("walls", [[], [(3.9, 0.0, 4.1, 3.5)]])
def test_without_something_on_both_sides_of_the_way_there_is_no_doorway(walls):
    surroundings = after(room(8.0, 8.0, walls=walls), (2.0, 4.0, 0.0), line((2.0, 4.0), (6.0, 4.0)))
    assert surroundings.doorway_on(line((3.6, 4.0), (4.4, 4.0)), 0.0) is None


def test_a_way_through_a_wall_tells_nothing():
    surroundings = after(two_rooms(1.0), (1.0, 1.5, 0.0), line((1.0, 1.5), (4.5, 1.5)))
    assert surroundings.doorway_on(np.array([[2.92, 0.8]]), 0.0) is None


def test_a_mirror_image_looks_the_same():
    walls = [(2.9, 0.0, 3.1, 1.0), (2.9, 2.0, 3.1, 4.0), (3.1, 2.0, 4.5, 2.1)]
    grid = room(6.0, 4.0, walls=walls)
    mirrored = room(6.0, 4.0, walls=[(x0, 4.0 - y1, x1, 4.0 - y0) for x0, y0, x1, y1 in walls])
    one = nearest(described(drive(grid, (1.0, 1.5, 0.0), line((1.0, 1.5), (5.0, 1.5)))), 3.0, 1.5)
    other = nearest(
        described(drive(mirrored, (1.0, 2.5, 0.0), line((1.0, 2.5), (5.0, 2.5)))), 3.0, 2.5
    )
    # Cells are cut differently on the two sides: a cell or two, or what depends on one.
    close = np.isclose(one, other, atol=0.16)
    assert close.mean() > 0.93, [FEATURES[i] for i in np.flatnonzero(~close)]


@pytest.mark.parametrize("rate_hz", [2.5, 5.0, 40.0])
def test_neither_scan_rate_nor_speed_changes_where_places_lie(rate_hz):
    path = line((1.0, 1.5), (5.0, 1.5))
    usual = described(drive(two_rooms(), (1.0, 1.5, 0.0), path))
    laser = exact_laser(rate_hz=rate_hz)
    other = described(drive(two_rooms(), (1.0, 1.5, 0.0), path, laser, speed_m_s=0.4))
    ours = nearest(usual, 3.0, 1.5)
    theirs = nearest(other, 3.0, 1.5)
    assert theirs[AT["width_m"]] == pytest.approx(ours[AT["width_m"]], abs=0.1)
    count = min(len(usual), len(other))
    assert count >= (4.0 - LAG_M - 0.2) / 0.1 - 3
    for one, two in zip(usual[:count], other[:count], strict=True):
        assert one.place.at_m == pytest.approx(two.place.at_m)
        assert one.place.x_m == pytest.approx(two.place.x_m, abs=0.02)


def test_measures_that_come_out_otherwise_are_another_version():
    """A cue trained on other measures must not be read: raise `MEASURES`, and train it anew."""
    things = [
        (2.9, 0.0, 3.1, 1.0),
        (2.9, 2.0, 3.1, 3.0),
        (1.8, 2.2, 2.2, 2.6),
        (4.0, 0.4, 4.6, 0.7),
    ]
    grid = room(6.0, 3.0, walls=things)
    found = described(drive(grid, (1.0, 1.5, 0.0), line((1.0, 1.5), (5.0, 1.5))), turned=0.3)
    total = sum(float(one.measures.sum()) for one in found)
    assert (MEASURES, len(found)) == (2, 34)
    assert total == pytest.approx(5758.0, abs=3.0)  # a few cells, should sines be rounded otherwise
