"""The wide map and the layout of a place: on drawn hallways whose lengths are known."""

import math

import numpy as np
import pytest
from buildings import Along, exact_laser, exact_robot, line, room, simulated

from ssrics_like.perception.conditioning import condition
from ssrics_like.perception.gap import FEATURES
from ssrics_like.perception.layout import LAYOUT, REVISION, layout_measures
from ssrics_like.perception.layout_kernels import walls_along
from ssrics_like.perception.local_map import LocalMap
from ssrics_like.perception.local_map_kernels import FREE, OCCUPIED, UNKNOWN, cell_state
from ssrics_like.perception.observation import Pose
from ssrics_like.perception.surroundings import Surroundings
from ssrics_like.perception.wide_map import SCALE, WideMap

AT = {name: i for i, name in enumerate(LAYOUT)}
AROUND = np.radians(np.arange(-180.0, 180.0))


def hallways(*boxes):
    """Make hallways in a solid block, 16 x 12 m: boxes (x0, y0, x1, y1) of free floor."""
    grid = room(16.0, 12.0, walls=[(0.0, 0.0, 16.0, 12.0)])
    for box in boxes:
        x0, y0, x1, y1 = (round(edge / grid.cell_m) for edge in box)
        grid.cells[y0:y1, x0:x1] = 0
    return type(grid)(grid.cells, grid.cell_m)


def described(grid, places, turned=0.0, wide=True):
    """Drive to the last place and describe the way; `turned` turns the frame of odometry."""
    start = (*places[0], math.atan2(*(places[1] - places[0])[::-1]))
    surroundings, found = Surroundings(wide=wide, layout=wide), []
    c, s = math.cos(turned), math.sin(turned)
    for o in simulated(grid, exact_robot(exact_laser()), start, [Along(places)]):
        x, y, heading = o.true_pose.x_m, o.true_pose.y_m, o.true_pose.theta_rad
        ranges = condition(o.scan.ranges_m, 8.0, 5).ranges_m
        pose = Pose(c * x - s * y, s * x + c * y, heading + turned)
        found += surroundings.update(pose, o.scan.bearings_rad, ranges, (x, y))
    return found


def layout_at(found, x, y):
    nearest = min(found, key=lambda d: math.dist(d.place.nearest, (x, y)))
    return dict(zip(LAYOUT, nearest.layout, strict=True))


def test_every_measure_has_a_name_of_its_own():
    assert len(set(LAYOUT)) == len(LAYOUT) == 85
    assert not set(LAYOUT) & set(FEATURES)


def test_a_wide_map_is_a_local_map_of_half_the_size():
    """Coordinates that are halved exactly give the same cells, at twice the distance."""
    rng = np.random.default_rng(3)
    wide, half = WideMap(), LocalMap()
    for step in range(40):
        ranges = rng.uniform(0.5, 9.0, len(AROUND))
        x, y, heading, here_m = 0.2 * step, 0.05 * step, 0.1 * step, 0.2 * step
        wide.take(Pose(x, y, heading), AROUND, ranges, here_m)
        half.take(Pose(x / 2, y / 2, heading), AROUND, ranges / 2, here_m / 2)
    assert np.array_equal(wide.scaled.evidence, half.evidence)
    assert (half.evidence > 0).any()
    for x, y in rng.uniform(-8.0, 16.0, (200, 2)):
        assert wide.state(x, y, here_m) == half.state(x / 2, y / 2, here_m / 2)


def test_it_reaches_8_m_in_cells_of_10_cm_and_remembers_10_m_of_path():
    wide = WideMap()
    ranges = np.full(3, 8.0)
    ranges[1] = 7.86
    wide.take(Pose(0.0, 0.0, 0.0), np.array([-0.5, 0.0, 0.5]), ranges, 0.0)
    assert wide.state(7.81, 0.01, 0.0) == wide.state(7.89, 0.09, 0.0) == OCCUPIED
    assert wide.state(7.91, 0.01, 0.0) == UNKNOWN
    assert wide.state(6.0, 0.01, 0.0) == FREE
    far = 7.9 * np.array([math.cos(0.5), math.sin(0.5)])
    assert wide.state(*far, 0.0) == FREE  # nothing stands at the end of the reach
    assert wide.state(7.85, 0.05, 10.0) == OCCUPIED
    assert wide.state(7.85, 0.05, 10.1) == UNKNOWN


ALONG = (1.0, 5.0, 15.0, 7.0)  # a hallway 2 m wide along x, its middle at y = 6
T = (ALONG, (7.0, 7.0, 9.0, 11.0))  # and a branch to the left, 2 m wide, its middle at x = 8
L = ((1.0, 5.0, 9.0, 7.0), (7.0, 7.0, 9.0, 11.0))  # a hallway that turns left at x = 8


def naive_way(wide, start, direction, here_m):
    """Go on in steps of 5 cm until a cell is occupied; corners of cells are left out."""
    cells = wide.scaled.evidence, wide.scaled.seen_m
    for step in range(161):
        x, y = (a + 0.05 * step * d for a, d in zip(start, direction, strict=True))
        row, column = (math.floor(v / 0.1) for v in (y, x))
        if cell_state(*cells, row, column, WideMap.oldest(here_m)) == OCCUPIED:
            return 0.05 * step
    return 8.0


@pytest.mark.parametrize("walls", [0.0, 0.2, 0.7, -0.6])
def test_walls_are_found_whichever_way_one_looks_at_them(walls):
    """A room of 6 x 4 m around the origin, turned: seen from its middle in any direction."""
    cos, sin = np.abs(np.cos(AROUND)), np.abs(np.sin(AROUND))
    ranges = np.minimum(3.0 / np.maximum(cos, 1e-9), 2.0 / np.maximum(sin, 1e-9))
    wide = WideMap()
    wide.take(Pose(0.0, 0.0, walls), AROUND, ranges, 0.0)
    for heading in np.linspace(-3.0, 3.0, 13):
        cells = wide.scaled.evidence, wide.scaled.seen_m
        found = walls_along(*cells, (0.0, 0.0, heading), WideMap.oldest(0.0))
        assert abs(found - heading) <= math.pi / 4 + 1e-9
        assert abs(math.remainder(found - walls, math.pi / 2)) <= math.radians(3.0)


def test_where_nothing_stands_the_walls_are_said_to_run_along_the_way():
    empty = WideMap().scaled
    assert walls_along(empty.evidence, empty.seen_m, (0.0, 0.0, 0.4), -1.0) == 0.4
    measures = dict(zip(LAYOUT, layout_measures(WideMap(), (0.0, 0.0, 0.4), 0.0), strict=True))
    assert measures["walls_ahead_strip_m"] == 8.0
    assert measures["walls_lesser_unknown_m@+0.0"] == pytest.approx(8.0, abs=0.06)


def test_lanes_are_as_long_as_one_goes():
    rng = np.random.default_rng(5)
    wide = WideMap()
    wide.take(Pose(0.05, 0.05, 0.0), AROUND, rng.uniform(1.0, 7.0, len(AROUND)), 0.0)
    ahead = walls_along(
        wide.scaled.evidence, wide.scaled.seen_m, (0.025, 0.025, 0.0), WideMap.oldest(0.0)
    )
    measures = dict(zip(LAYOUT, layout_measures(wide, (0.05, 0.05, 0.0), 0.0), strict=True))

    def way(angle, off, along):
        start = 0.05 + off * math.cos(along), 0.05 + off * math.sin(along)
        return naive_way(wide, start, (math.cos(angle), math.sin(angle)), 0.0)

    offs = np.arange(-6, 7) * 0.3
    left, right = (
        [way(ahead + turn, off, ahead) for off in offs] for turn in (np.pi / 2, -np.pi / 2)
    )
    lesser, greater = sorted((left, right), key=sum)
    towards = math.pi / 2 if greater == left else -math.pi / 2
    expected = {f"walls_lesser_m@{o:+.1f}": v for o, v in zip(offs, lesser, strict=True)}
    expected |= {f"walls_greater_m@{o:+.1f}": v for o, v in zip(offs, greater, strict=True)}
    for o in offs[3:-3]:
        expected[f"walls_ahead_m@{o:+.1f}"] = way(ahead, o, ahead + towards)
        expected[f"walls_behind_m@{o:+.1f}"] = way(ahead + math.pi, o, ahead + towards)
    expected = {name.replace("-0.0", "+0.0"): value for name, value in expected.items()}
    for name, value in expected.items():
        assert measures[name] <= value + 0.01  # a slanting way does not slip between two cells
    same = [abs(measures[name] - value) < 0.01 for name, value in expected.items()]
    assert np.mean(same) > 0.9
    strips = [min(greater[i : i + 4]) for i in range(10)]
    assert measures["walls_greater_strip_m"] == pytest.approx(max(strips), abs=0.3)


@pytest.mark.parametrize("turned", [0.0, 0.9])
def test_a_drawn_t_goes_on_ahead_behind_and_to_one_side(turned):
    """From its mouth's middle 5 m to the end of the branch, 1 m to the wall opposite."""
    here = layout_at(described(hallways(*T), line((2.0, 6.0), (12.0, 6.0)), turned), 8.0, 6.0)
    assert here["walls_oblique_rad"] < 0.1
    assert here["walls_lesser_strip_m"] == pytest.approx(1.0, abs=0.2)
    assert here["walls_greater_strip_m"] > 3.0
    assert here["walls_ahead_strip_m"] > 6.0
    assert here["walls_behind_strip_m"] > 5.5
    # The branch is 2 m wide: to either side of it the hallway's wall is met.
    assert here["walls_greater_m@+0.0"] > 3.0
    for aside in ("-1.5", "+1.5"):
        assert here[f"walls_greater_m@{aside}"] == pytest.approx(1.0, abs=0.2)


@pytest.mark.parametrize("turned", [0.0, 0.9])
def test_a_drawn_l_goes_on_behind_and_to_one_side(turned):
    way = np.concatenate([line((2.0, 6.0), (8.0, 6.0)), line((8.0, 6.0), (8.0, 9.5))])
    here = layout_at(described(hallways(*L), way, turned), 8.0, 6.0)
    short, long = ("behind", "greater", "ahead", "lesser"), None
    reach = {side: here[f"walls_{side}_strip_m"] for side in short}
    long = sorted(reach, key=reach.__getitem__)[2:]
    assert sum(value < 1.4 for value in reach.values()) == 2
    assert "greater" in long  # an L has one arm to a side, whichever way it is looked at
    assert ("ahead" in long) != ("behind" in long)
    assert all(reach[side] > 3.0 for side in long)


def test_a_drawn_hallway_goes_on_ahead_and_behind_only():
    here = layout_at(described(hallways(ALONG), line((2.0, 6.0), (12.0, 6.0))), 8.0, 6.0)
    for side in ("lesser", "greater"):
        assert here[f"walls_{side}_strip_m"] == pytest.approx(1.0, abs=0.2)
    assert here["walls_ahead_strip_m"] > 6.0
    assert here["walls_behind_strip_m"] > 6.0


def test_a_mirror_image_has_the_same_layout():
    one, other = (
        layout_at(described(hallways(ALONG, box), line((2.0, 6.0), (12.0, 6.0))), 8.0, 6.0)
        for box in ((7.0, 7.0, 9.0, 11.0), (7.0, 1.0, 9.0, 5.0))
    )
    # Cells are cut differently on the two sides.
    close = [abs(one[name] - other[name]) <= 0.21 for name in LAYOUT]
    assert np.mean(close) > 0.9, [n for n, c in zip(LAYOUT, close, strict=True) if not c]


def test_the_gap_is_measured_as_without_a_wide_map():
    grid = hallways(ALONG, (7.0, 7.0, 9.0, 11.0))
    way = line((2.0, 6.0), (12.0, 6.0))
    narrow, wide = described(grid, way, wide=False), described(grid, way)
    assert len(narrow) == len(wide) > 80
    for one, other in zip(narrow, wide, strict=True):
        assert np.array_equal(one.measures, other.measures)
        assert (len(one.layout), len(other.layout)) == (0, len(LAYOUT))


def test_a_robot_that_is_carried_away_begins_a_new_map():
    surroundings, found = Surroundings(wide=True, layout=True), []
    for x in (*np.arange(0.0, 2.0, 0.1), *np.arange(50.0, 51.0, 0.1)):
        reading = 1.0 if x < 50.0 else 3.0
        ranges = np.full(len(AROUND), reading)
        found += surroundings.update(Pose(x, 0.0, 0.0), AROUND, ranges, x)
    assert found[-1].place.nearest > 50.0
    layout = dict(zip(LAYOUT, found[-1].layout, strict=True))
    assert layout["walls_lesser_m@+0.0"] == pytest.approx(3.0, abs=0.3)


def test_a_layout_that_comes_out_otherwise_is_another_revision():
    """A cue trained on other measures must not be read: raise `REVISION`, and train it anew."""
    grid = hallways(ALONG, (7.0, 7.0, 9.0, 11.0), (3.0, 4.0, 3.6, 5.0))
    found = described(grid, line((2.0, 6.0), (12.0, 6.0)), turned=0.3)
    total = sum(float(one.layout.sum()) for one in found)
    assert (REVISION, SCALE) == (1, 2.0)
    assert total == pytest.approx(
        16234.1, abs=10.0
    )  # a few cells, should sines be rounded otherwise
