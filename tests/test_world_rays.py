"""The ray caster against a walk from cell to cell, and against formulas."""

import math

import numpy as np
import pytest
from buildings import drawn, room
from hypothesis import example, given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from ssrics_like.world import ray_kernels
from ssrics_like.world.laser import LEAP_MAX, leaps


def naive_ray(solid, px, py, dx, dy, reach):
    """Walk from cell to cell; the boundary in x comes first where a corner is met."""
    rows, columns = solid.shape
    row, column, t = math.floor(py), math.floor(px), 0.0
    while 0 <= row < rows and 0 <= column < columns and not solid[row, column]:
        tx = (column + (dx > 0) - px) * (1.0 / dx) if dx else math.inf
        ty = (row + (dy > 0) - py) * (1.0 / dy) if dy else math.inf
        t = min(tx, ty)
        if tx <= ty:
            column += 1 if dx > 0 else -1
        else:
            row += 1 if dy > 0 else -1
        if t > reach:
            return math.inf
    return t


def naive_scan(solid, cell_m, pose, directions, range_max_m):
    x, y, theta = pose
    cos, sin = math.cos(theta), math.sin(theta)
    return [
        naive_ray(
            solid, x / cell_m, y / cell_m, cos * c - sin * s, sin * c + cos * s,
            range_max_m / cell_m,
        ) * cell_m
        for c, s in directions.tolist()
    ]  # fmt: skip


def directions_of(bearings):
    return np.column_stack([np.cos(bearings), np.sin(bearings)])


AXES_AND_DIAGONALS = np.array(
    [[1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0], [-1, -1], [0, -1], [1, -1]], float
)
AXES_AND_DIAGONALS[1::2] *= math.sqrt(0.5)


def cast(solid, cell_m, pose, directions, range_max_m=math.inf):
    ranges = np.full(len(directions), -1.0)
    ray_kernels.cast_scan(leaps(solid), cell_m, pose, directions, range_max_m, ranges)
    return ranges


@st.composite
def scenes(draw):
    """Maps from crowded to empty, and poses in cells, on their boundaries and corners, outside."""
    rows, columns = draw(st.integers(1, 24)), draw(st.integers(1, 24))
    crowd = draw(st.sampled_from([0.0, 0.02, 0.1, 0.4]))
    seed = draw(st.integers(0, 2**32 - 1))
    solid = np.random.default_rng(seed).uniform(size=(rows, columns)) < crowd
    cell_m = draw(st.sampled_from([1.0, 0.05, 0.1]))
    place = st.one_of(
        st.integers(0, 24).map(float), st.integers(0, 48).map(lambda n: n / 2), st.floats(-1, 25)
    )
    # So small a heading that 1 / its sine overflows is straight ahead.
    any_turn = st.floats(-7, 7).map(lambda a: a if abs(a) > 1e-100 else 0.0)
    turn = st.one_of(st.integers(-8, 8).map(lambda n: n * math.pi / 4), any_turn)
    pose = (draw(place) * cell_m, draw(place) * cell_m, draw(turn))
    reach = draw(st.sampled_from([math.inf, 30.0, 5.0, 0.5]))
    return solid, cell_m, pose, reach * cell_m


FAN = directions_of(np.radians(np.arange(-180, 180, 7.5)))
OPEN_SQUARE = np.zeros((9, 9), bool)


@settings(max_examples=300, deadline=None)
@given(scenes())
@example((OPEN_SQUARE, 1.0, (4.5, 4.5, 0.0), math.inf))  # every diagonal beam meets corners only
@example((OPEN_SQUARE, 1.0, (4.0, 4.0, 0.0), math.inf))
@example((OPEN_SQUARE, 1.0, (9.0, 3.0, math.pi), math.inf))  # on the outer edge, looking in
@example((OPEN_SQUARE, 1.0, (0.0, 0.0, 0.0), 4.0))
def test_leaping_changes_no_bit_of_the_walk_from_cell_to_cell(scene):
    solid, cell_m, pose, reach_m = scene
    for directions in (FAN, AXES_AND_DIAGONALS):
        got = cast(solid, cell_m, pose, directions, reach_m)
        expected = np.array(naive_scan(solid, cell_m, pose, directions, reach_m))
        assert got.tobytes() == expected.tobytes()


def test_leaps_wider_than_a_byte_holds_change_no_bit_either():
    solid = np.zeros((3, 700), bool)
    solid[1, 650] = True
    wide = np.zeros((600, 600), bool)
    assert leaps(wide).max() == LEAP_MAX == 255
    for map_, pose in ((solid, (3.3, 1.2, 0.0)), (wide, (300.2, 299.7, 0.3))):
        got = cast(map_, 1.0, pose, FAN)
        assert got.tobytes() == np.array(naive_scan(map_, 1.0, pose, FAN, math.inf)).tobytes()


@settings(deadline=None)
@given(arrays(np.bool_, st.tuples(st.integers(1, 12), st.integers(1, 12))))
def test_a_leap_is_the_way_of_a_chess_king_to_the_nearest_solid_cell(solid):
    rows, columns = solid.shape
    walls = [
        (r, c)
        for r in range(-1, rows + 1)
        for c in range(-1, columns + 1)
        if not (0 <= r < rows and 0 <= c < columns) or solid[r, c]
    ]
    expected = [
        [min(max(abs(r - r2), abs(c - c2)) for r2, c2 in walls) for c in range(columns)]
        for r in range(rows)
    ]
    assert leaps(solid).dtype == np.uint8
    assert leaps(solid).tolist() == expected


ROOM = room(7.0, 4.0)  # free from 0.1 to 6.9 and from 0.1 to 3.9


@settings(deadline=None)
@given(st.floats(0.11, 6.89), st.floats(0.11, 3.89), st.floats(-math.pi, math.pi))
def test_in_a_rectangular_room_a_range_is_the_nearer_of_two_walls(x, y, heading):
    bearings = np.radians(np.arange(-89.5, 90.0))
    got = cast(ROOM.solid, ROOM.cell_m, (x, y, heading), directions_of(bearings))
    angles = heading + bearings
    with np.errstate(divide="ignore"):
        # (wall - x) / cos a for the wall that a beam looks to, and alike in y
        to_x = (np.where(np.cos(angles) > 0, 6.9, 0.1) - x) / np.cos(angles)
        to_y = (np.where(np.sin(angles) > 0, 3.9, 0.1) - y) / np.sin(angles)
    assert got == pytest.approx(np.minimum(to_x, to_y), rel=1e-9, abs=1e-9)


def test_a_laser_inside_a_wall_or_off_the_map_sees_nothing_but_wall():
    for pose in [(0.05, 2.0, 0.3), (3.0, 3.95, 1.0), (-1.0, 2.0, 0.0), (3.0, 99.0, 0.0)]:
        assert cast(ROOM.solid, ROOM.cell_m, pose, FAN).tolist() == [0.0] * len(FAN)


def test_a_range_up_to_the_cap_counts_and_one_beyond_is_infinite():
    solid = np.zeros((3, 20), bool)
    solid[:, 12] = True
    ahead = np.array([[1.0, 0.0]])
    for cell_m in (1.0, 0.5):
        pose = (2.5 * cell_m, 1.5 * cell_m, 0.0)
        assert cast(solid, cell_m, pose, ahead, 9.5 * cell_m).tolist() == [9.5 * cell_m]
        assert cast(solid, cell_m, pose, ahead, 9.49 * cell_m).tolist() == [math.inf]
    # The edge of the grid is a wall as any other.
    assert cast(solid, 1.0, (15.5, 1.5, 0.0), ahead, 4.5).tolist() == [4.5]
    assert cast(solid, 1.0, (15.5, 1.5, 0.0), ahead, 4.4).tolist() == [math.inf]


def test_a_ray_through_the_corner_of_four_cells_crosses_in_x_first():
    def blocked_at(row, column):
        solid = np.zeros((3, 3), bool)
        solid[row, column] = True
        return cast(solid, 1.0, (0.5, 0.5, 0.0), AXES_AND_DIAGONALS[1:2])[0]

    half, through = 0.5 * math.sqrt(2), 2.5 * math.sqrt(2)
    assert blocked_at(0, 1) == pytest.approx(half)  # entered on the way, for no length at all
    assert blocked_at(1, 0) == pytest.approx(through)  # passed by
    assert blocked_at(1, 1) == pytest.approx(half)


def test_unknown_cells_stop_a_beam_as_walls_do():
    grid = drawn("?...?")
    assert cast(grid.solid, 1.0, (2.5, 0.5, 0.0), AXES_AND_DIAGONALS[[0, 4]]).tolist() == [1.5, 1.5]


@settings(deadline=None)
@given(
    st.floats(0.05, 2.0), st.floats(0.01, 9.0), st.floats(-math.pi, math.pi),
    st.floats(-math.pi, math.pi), st.floats(0.5, 12.0),
)  # fmt: skip
def test_a_person_shortens_a_beam_to_the_nearer_cut_of_line_and_circle(
    radius, gap, towards, heading, wall_m
):
    far = radius + gap
    pose = (3.0, -2.0, heading)
    disc = [3.0 + far * math.cos(towards), -2.0 + far * math.sin(towards), radius]
    bearings = np.radians(np.arange(-180.0, 180.0, 3.0))
    ranges = np.full(len(bearings), wall_m)
    ray_kernels.cast_discs(pose, directions_of(bearings), np.array([disc]), ranges)
    for bearing, got in zip(bearings, ranges, strict=True):
        # Law of cosines: r^2 = D^2 + t^2 - 2 D t cos(phi), its smaller root t if it has one.
        phi = heading + bearing - towards
        room_left = radius**2 - (far * math.sin(phi)) ** 2
        if abs(room_left) < 1e-6:
            continue  # a tangent: rounding decides
        hit = room_left > 0 and math.cos(phi) > 0
        t = far * math.cos(phi) - math.sqrt(room_left) if hit else math.inf
        assert got == pytest.approx(min(t, wall_m), abs=1e-6)


def test_of_two_people_the_nearer_is_seen_and_inside_one_nothing_else():
    ahead = np.array([[1.0, 0.0]])
    ranges = np.array([math.inf])
    two = np.array([[5.0, 0.0, 0.5], [3.0, 0.0, 0.25]])
    ray_kernels.cast_discs((0.0, 0.0, 0.0), ahead, two, ranges)
    assert ranges.tolist() == [2.75]
    ray_kernels.cast_discs((4.8, 0.0, 0.0), ahead, two, ranges)
    assert ranges.tolist() == [0.0]


@settings(deadline=None)
@given(
    st.lists(st.one_of(st.just(math.inf), st.floats(0.1, 10.0)), min_size=1, max_size=40),
    st.floats(0.0, 1.0), st.floats(0.05, 3.0), st.integers(0, 2**32 - 1),
)  # fmt: skip
def test_a_mixed_beam_ends_between_its_edge_and_what_lies_behind(ranges, probability, jump, seed):
    before = np.array(ranges)
    after = before.copy()
    chances, where = np.random.default_rng(seed).random((2, len(before)))
    ray_kernels.mix_edges(after, chances, where, probability, jump)
    for k, (old, new) in enumerate(zip(before, after, strict=True)):
        near = [r for r in before[max(k - 1, 0) : k + 2] if math.isfinite(r)]
        behind = max(near, default=old)
        if math.isfinite(old) and behind - old > jump and chances[k] < probability:
            assert new == old + where[k] * (behind - old)
            assert old <= new <= behind + 1e-12
        else:
            assert new == old


def test_beams_mix_at_edges_only_and_as_often_as_stated():
    edge = np.where(np.arange(20_000) % 4 < 2, 1.0, 3.0)  # half of all beams, each at an edge
    mixed = edge.copy()
    chances, where = np.random.default_rng(3).random((2, len(edge)))
    ray_kernels.mix_edges(mixed, chances, where, 0.1, 0.3)
    changed = mixed != edge
    assert not changed[edge == 3.0].any()
    # A share of 0.1 of n = 10,000: its standard error is sqrt(0.1 * 0.9 / n) = 0.003.
    assert changed.sum() / (edge == 1.0).sum() == pytest.approx(0.1, abs=5 * 0.003)
    # Uniform between 1 and 3 m: the mean is 2, its standard error 2 / sqrt(12 n).
    n = changed.sum()
    assert mixed[changed].mean() == pytest.approx(2.0, abs=5 * 2 / math.sqrt(12 * n))
