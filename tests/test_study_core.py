"""The pure core of studies: orders, routes, views, places, marks, checks, limits, secrets."""

import hashlib
import itertools
import math
import struct
import tempfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ssrics_like.errors import ResultsError
from ssrics_like.maps import load_choices
from ssrics_like.perception.observation import Pose
from ssrics_like.results.files import csv_text
from ssrics_like.study.events import Response
from ssrics_like.study.export import Answers, passes, tables_of
from ssrics_like.study.frames import (
    COLUMNS,
    NOTHING,
    Frames,
    directions,
    frames_of,
    shown_bearings,
)
from ssrics_like.study.furniture import furniture_of
from ssrics_like.study.importing import Units, imported
from ssrics_like.study.limits import RateLimit
from ssrics_like.study.marks import marks_of
from ssrics_like.study.order import order_of
from ssrics_like.study.participant import Participant
from ssrics_like.study.plan_picture import is_on_picture, on_map, on_picture, picture_of
from ssrics_like.study.replay import Replay, _replay
from ssrics_like.study.tokens import new_id, new_token, same
from ssrics_like.world.grid import AT_ORIGIN, OCCUPIED, UNKNOWN, GridMap
from ssrics_like.world.robot import LaserProfile, RobotProfile

# --- order


def test_the_order_is_that_of_the_stated_digests():
    # sha256("7/p/a") and so on, worked out here by hand.
    digests = {t: hashlib.sha256(f"7/p/{t}".encode()).hexdigest() for t in "abcd"}
    assert order_of("abcd", 7, "p", "random") == tuple(sorted("abcd", key=digests.get))
    assert order_of("abcd", 7, "p", "fixed") == tuple("abcd")


def test_every_order_is_equally_likely():
    orders = [order_of("abc", 1, f"p{i}", "random") for i in range(6000)]
    counts = [orders.count(order) for order in itertools.permutations("abc")]
    # chi squared with 5 degrees of freedom: 20.5 is passed once in a thousand seeds.
    assert sum((count - 1000) ** 2 / 1000 for count in counts) < 20.5


def test_another_seed_gives_other_orders():
    seeds = {order_of("abcdefgh", seed, "p", "random") for seed in range(20)}
    assert len(seeds) == 20


# --- places on the picture


def grid_of(rows=40, columns=60, cell_m=0.05, origin=AT_ORIGIN):
    cells = np.zeros((rows, columns), np.uint8)
    cells[[0, -1]] = cells[:, [0, -1]] = OCCUPIED
    return GridMap(cells, cell_m, origin)


def test_the_pictures_top_left_corner_is_where_the_grids_highest_row_begins():
    assert on_map(grid_of(), 0.0, 0.0) == pytest.approx((0.0, 2.0))
    assert on_map(grid_of(), 3.0, 2.0) == pytest.approx((3.0, 0.0))
    turned = grid_of(origin=Pose(10.0, 20.0, math.pi / 2))
    # One metre right on the picture is one metre up in the map's y.
    assert on_map(turned, 1.0, 2.0) == pytest.approx((10.0, 21.0))


@given(
    st.floats(0, 3), st.floats(0, 2),
    st.tuples(st.floats(-1e3, 1e3), st.floats(-1e3, 1e3), st.floats(-3.2, 3.2)),
)  # fmt: skip
def test_a_place_on_the_picture_and_on_the_map_is_the_same(right, down, origin):
    grid = grid_of(origin=Pose(*origin))
    assert on_picture(grid, *on_map(grid, right, down)) == pytest.approx((right, down), abs=1e-9)
    assert is_on_picture(grid, right, down)


def test_the_picture_has_a_pixel_a_cell_and_its_highest_row_on_top():
    from io import BytesIO

    from PIL import Image

    grid = grid_of()
    grid.cells[-2, 1] = UNKNOWN
    image = Image.open(BytesIO(picture_of(grid))).convert("RGB")
    assert image.size == (60, 40)
    assert image.getpixel((1, 1)) == (0xE4, 0xE8, 0xEC)
    assert image.getpixel((5, 5)) == (255, 255, 255)


def test_furniture_is_small_and_touches_no_wall():
    grid = grid_of(100, 200)
    grid.cells[10:20, 10:20] = OCCUPIED  # a table, half a metre
    grid.cells[50:99, 100] = OCCUPIED  # a wall from the border
    grid.cells[40:42, 20:90] = OCCUPIED  # 3.5 m: too long
    found = furniture_of(grid)
    assert found.sum() == 100
    assert found[10:20, 10:20].all()


# --- replay and frames


def straight(length_m=2.0, theta=0.0, seconds=2.0):
    t = np.linspace(0, seconds, 21)
    poses = np.column_stack([0.5 + length_m * t / seconds, np.full(21, 1.0), np.full(21, theta)])
    return Replay(t, poses, RobotProfile())


def test_a_replay_goes_straight_between_what_is_known():
    replay = straight()
    assert replay.length_s == 2.0
    assert replay.at(0.55).tolist() == pytest.approx([1.05, 1.0, 0.0])
    assert replay.at(np.array([-1.0, 9.0]))[:, 0].tolist() == [0.5, 2.5]


def test_a_turn_across_pi_is_the_short_way():
    replay = _replay([0.0, 1.0], [(0, 0, 3.1), (0, 0, -3.1)], RobotProfile())
    assert replay.at(0.5)[2] == pytest.approx(math.pi)


@pytest.mark.parametrize(
    ("times", "poses"),
    [
        ([0.0, 0.0], [(0, 0, 0)] * 2),
        ([0.0], [(0, 0, 0)]),
        ([0.0, 1.0], [(0, 0, 0), (math.nan, 0, 0)]),
        ([0.0, 4000.0], [(0, 0, 0)] * 2),
    ],
)
def test_a_route_that_cannot_be_replayed_is_told(times, poses):
    with pytest.raises(ResultsError, match="the route"):
        _replay(times, poses, RobotProfile())


def test_columns_are_those_of_a_pinhole_camera():
    bearings = np.arctan2(*directions().T[::-1])
    assert bearings[0] > 0 > bearings[-1]  # the first column is on the left
    across = np.tan(bearings)
    assert np.diff(across) == pytest.approx(np.full(COLUMNS - 1, -2 / COLUMNS))


def test_a_wall_ahead_is_equally_far_along_the_axis_in_every_column():
    # The room is 3 m wide; the robot looks along x at the wall x = 2.95 from x = 0.5 + t.
    grid = grid_of(200, 60)
    replay = replace(straight(), poses=np.add(straight().poses, [0.0, 4.0, 0.0]))
    frames = frames_of(replay, grid)
    assert len(frames) == 41
    assert frames.wall_m[0] == pytest.approx(np.full(COLUMNS, 2.45))
    assert frames.wall_m[20] == pytest.approx(np.full(COLUMNS, 1.45))
    assert frames.along_y.all()
    assert np.isinf(frames.furniture_m).all()
    # Straight ahead (the two middle beams, half a degree aside) the laser reads the same wall.
    middle = frames.fan_m[0, 89:91] * np.cos(frames.bearings_rad[89:91])
    assert middle == pytest.approx([2.45, 2.45])
    # The panel is the place along the wall, modulo a metre: y = 5 + 2.45 tan(bearing).
    across = -(2 * (np.arange(COLUMNS) + 0.5) / COLUMNS - 1)
    assert frames.panel[0] == pytest.approx(np.mod(5 + 2.45 * across, 1.0), abs=1e-9)


def test_a_view_is_the_same_where_the_map_lies_turned():
    plain, turned = grid_of(), grid_of(origin=Pose(3.0, -1.0, 0.7))
    replay = straight()
    moved = np.array(
        [
            (p.x_m, p.y_m, p.theta_rad)
            for p in (turned.pose_in_map(Pose(*row)) for row in replay.poses.tolist())
        ]
    )
    there = frames_of(replace(replay, poses=moved), turned)
    here = frames_of(replay, plain)
    assert there.wall_m == pytest.approx(here.wall_m)
    assert there.fan_m == pytest.approx(here.fan_m)


def test_furniture_stands_before_the_wall():
    grid = grid_of(40, 100)
    grid.cells[18:23, 60:65] = OCCUPIED
    frames = frames_of(straight(), grid)
    middle = COLUMNS // 2
    assert frames.furniture_m[0, middle] == pytest.approx(2.5)
    assert frames.wall_m[0, middle] == pytest.approx(4.45)
    assert np.isinf(frames.furniture_m[0, 0])


def test_packed_frames_are_as_they_are_said_to_be():
    frames = Frames(
        np.array([[1.5, 2.0]]), np.array([[True, False]]), np.array([[0.5, 0.999]]),
        np.array([[np.inf, 0.25]]), np.array([[3.0, np.inf, 1.0]]), np.zeros(3),
    )  # fmt: skip
    expected = struct.pack("<7H2B", 3001, 4000, NOTHING, 250, 300, NOTHING, 100, 128, 255)
    assert frames.packed() == expected


def test_many_beams_are_thinned():
    laser = LaserProfile(beams=720, step_deg=0.25)
    assert len(shown_bearings(laser)) == 180


# --- marks


def response(event, key="k", mark="", x=None, label="", trial="t", pressed="", replay_ms=None):
    return Response(
        "p", trial, "plan", 1, event, mark, x, x, label, pressed, 0.0, replay_ms, 0.0, "", key
    )


def test_marks_are_what_is_left_of_adding_moving_naming_and_deleting():
    kept = [
        response("begin"),
        response("add", "a", x=1.0),
        response("add", "b", x=2.0),
        response("move", "c", "a", x=3.0),
        response("name", "d", "b", label="door"),
        response("delete", "e", "a"),
        response("move", "f", "a", x=9.0),  # of a mark that is gone
        response("press", "g", x=4.0, replay_ms=500.0),
        response("end"),
    ]
    assert [(m.key, m.x_m, m.label, m.replay_ms) for m in marks_of(kept)] == [
        ("b", 2.0, "door", None),
        ("g", 4.0, "", 500.0),
    ]


@given(
    st.lists(
        st.tuples(
            st.sampled_from(["add", "move", "name", "delete"]),
            st.sampled_from("abcd"), st.floats(0, 9), st.text(max_size=3),
        )
    )
)  # fmt: skip
def test_marks_agree_with_a_plain_notebook(steps):
    notebook = {}
    kept = []
    for i, (event, mark, x, label) in enumerate(steps):
        if event == "add":
            key = f"{mark}{i}"
            notebook[key] = (x, "")
            kept.append(response("add", key, x=x))
            continue
        target = next((k for k in notebook if k.startswith(mark)), "none")
        kept.append(response(event, f"r{i}", target, x if event == "move" else None, label))
        if target in notebook:
            if event == "delete":
                del notebook[target]
            elif event == "move":
                notebook[target] = (x, notebook[target][1])
            else:
                notebook[target] = (notebook[target][0], label)
    assert {m.key: (m.x_m, m.label) for m in marks_of(kept)} == notebook


def test_a_check_is_passed_near_the_place_or_with_the_last_key():
    near = {"kind": "plan", "check": {"x_m": 1.0, "y_m": 1.0, "within_m": 0.5}}
    assert passes(near, [response("add", x=1.3)])
    assert not passes(near, [response("add", x=1.4)])  # 0.57 m away
    key = {"kind": "attention", "check": {"key": "k"}}
    assert passes(key, [response("press", pressed="a"), response("press", pressed="k")])
    assert not passes(key, [response("press", pressed="k"), response("press", pressed="a")])
    assert not passes(key, [])


# --- limits and secrets


def test_a_rate_limit_lets_a_burst_through_and_then_so_many_a_second():
    time = [0.0]
    limit = RateLimit(2.0, 3.0, lambda: time[0])
    assert [limit.allows("a") for _ in range(4)] == [True, True, True, False]
    assert limit.allows("b")  # others are not concerned
    time[0] = 0.5
    assert [limit.allows("a") for _ in range(2)] == [True, False]
    time[0] = 100.0
    assert [limit.allows("a") for _ in range(4)] == [True, True, True, False]


def test_secrets_differ_and_are_compared_whole():
    assert len({new_token() for _ in range(1000)}) == 1000
    assert len({new_id() for _ in range(1000)}) == 1000
    token = new_token()
    assert same(token, token)
    assert not same(token[:-1], token)
    assert not same("ü\ud800", token)


# --- tables

LABELS = st.text(st.characters(exclude_categories=("Cc", "Cs")), max_size=20)


@given(st.lists(st.tuples(st.floats(-1e4, 1e4), LABELS, st.floats(0, 1e6)), min_size=1, max_size=5))
def test_exported_choices_are_read_back_by_whoever_compares_them(marks):
    kept = [
        response("press", f"k{i}", x=x, label=label, replay_ms=ms)
        for i, (x, label, ms) in enumerate(marks)
    ]
    person = Participant(1, "p", ("t",), 2, 0.0, "", "")
    trials = {"t": {"kind": "walk", "practice": False, "check": None, "map": "m"}}
    table = tables_of(Answers(trials, [person], kept))["choices.csv"]
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "choices.csv"
        path.write_text(table, encoding="utf-8", newline="")
        found = load_choices(path)
    assert [c.landmark for c in found] == [f"t-{i}" for i in range(1, len(marks) + 1)]
    for choice, (x, label, ms) in zip(found, marks, strict=True):
        assert (choice.participant, choice.label) == ("p", label.strip())
        assert choice.x_m == pytest.approx(x, abs=1e-6)
        assert choice.t_s == pytest.approx(ms / 1000, abs=1e-6)


NUMBERS = st.floats(-1e5, 1e5).map(lambda x: round(x, 3))


@given(
    st.lists(st.tuples(st.sampled_from("ab"), NUMBERS, NUMBERS, LABELS), min_size=1, max_size=6),
    st.floats(0.01, 100), st.floats(-100, -0.01), NUMBERS, NUMBERS,
)  # fmt: skip
def test_an_imported_table_has_the_places_that_the_formula_gives(rows, sx, sy, ox, oy):
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "raw.csv"
        path.write_text(csv_text(("who", "u", "v", "name"), rows), encoding="utf-8", newline="")
        columns = {"participant": "who", "x_m": "u", "y_m": "v", "label": "name"}
        text = imported(path, columns, Units(sx, sy, ox, oy))
        path.write_text(text, encoding="utf-8", newline="")
        found = load_choices(path)
    for choice, (who, u, v, label) in zip(found, rows, strict=True):
        assert (choice.participant, choice.label) == (who, label.strip())
        assert (choice.x_m, choice.y_m) == pytest.approx((u * sx + ox, v * sy + oy), abs=1e-5)
