"""Layouts: arcs made to agree by least squares, and each component laid where it was declared."""

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from saved_memories import memory
from scipy.optimize import least_squares

from ssrics_like.memory import Arc, Landmark
from ssrics_like.memory.layout import layout_of, relaxed_layout
from ssrics_like.poses import Pose

ORIGIN = Pose(0.0, 0.0, 0.0)
SQUARE = [Pose(0, 0, 0), Pose(4, 0, math.pi / 2), Pose(4, 4, math.pi), Pose(0, 4, -math.pi / 2)]


def landmark(number, pose=ORIGIN):
    return Landmark(f"L{number}", pose.x_m, pose.y_m, pose.theta_rad, 0.0, 0.0, 1)


def arc(one, other, step, sd_m=0.2, sd_rad=0.05):
    """An arc whose geometry is `step`."""
    pose = (step.x_m, step.y_m, step.theta_rad)
    return Arc(f"L{one}", f"L{other}", 1, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, *pose, sd_m, sd_rad)


def exact(poses, one, other, *sds):
    """An arc that tells the truth."""
    return arc(one, other, poses[other].seen_from(poses[one]), *sds)


def moved(pose, by):
    return by.onward(pose)


def assert_same(one, other, within=1e-6):
    assert one.distance_m(other) < within
    assert abs(math.remainder(one.theta_rad - other.theta_rad, math.tau)) < within


def between(layout, one, other):
    return layout[f"L{other}"].pose.seen_from(layout[f"L{one}"].pose)


def test_of_nothing_there_is_no_layout():
    assert relaxed_layout([], []) == {}


def test_a_single_landmark_stays_where_it_was_declared():
    pose = Pose(3.3, -1.7, 2.5)
    assert relaxed_layout([landmark(1, pose)], []) == {"L1": (pose, 0)}


def test_a_square_is_recovered_where_it_was_declared():
    arcs = [exact(SQUARE, k, (k + 1) % 4) for k in range(4)]
    there = Pose(10.0, -20.0, 1.0)
    layout = relaxed_layout([landmark(k, moved(p, there)) for k, p in enumerate(SQUARE)], arcs)
    for k, pose in enumerate(SQUARE):
        assert_same(layout[f"L{k}"].pose, moved(pose, there), 1e-9)


def test_declared_positions_tell_only_where_the_whole_lies():
    """They are drawn together to half the size here, which an arc does not believe."""
    arcs = [exact(SQUARE, k, (k + 1) % 4) for k in range(4)]
    declared = [landmark(k, Pose(p.x_m / 2, p.y_m / 2, 0.3)) for k, p in enumerate(SQUARE)]
    layout = relaxed_layout(declared, arcs)
    for k, pose in enumerate(SQUARE):
        assert_same(layout[f"L{k}"].pose, Pose(pose.x_m - 1.0, pose.y_m - 1.0, pose.theta_rad))


def test_a_closing_error_is_spread_by_variance():
    """On a line: of the error e the link k takes e v_k / (v_1 + v_2 + v_3)."""
    steps, sds = (1.0, 1.0, 2.3), (0.1, 0.2, 0.3)
    ends = [(0, 1), (1, 2), (0, 2)]
    arcs = [arc(*e, Pose(x, 0, 0), sd) for e, x, sd in zip(ends, steps, sds, strict=True)]
    layout = relaxed_layout([landmark(k, Pose(k, 0, 0)) for k in range(3)], arcs)
    v = np.square(sds)
    share = (steps[2] - steps[0] - steps[1]) * v / v.sum()
    assert_same(between(layout, 0, 1), Pose(1.0 + share[0], 0, 0), 1e-9)
    assert_same(between(layout, 1, 2), Pose(1.0 + share[1], 0, 0), 1e-9)
    assert_same(between(layout, 0, 2), Pose(2.3 - share[2], 0, 0), 1e-9)


def test_so_is_an_error_of_direction_on_a_whole_turn():
    sds, error = (0.1, 0.2, 0.3, 0.4), 0.1
    turns = [math.pi / 2] * 3 + [math.pi / 2 + error]
    arcs = [
        arc(k, (k + 1) % 4, Pose(0, 0, turn), 0.1, sd)
        for k, (turn, sd) in enumerate(zip(turns, sds, strict=True))
    ]
    layout = relaxed_layout([landmark(k, Pose(k, 0, 0)) for k in range(4)], arcs)
    v = np.square(sds)
    for k in range(3):
        assert_same(between(layout, k, k + 1), Pose(0, 0, math.pi / 2 - error * v[k] / v.sum()))


def test_a_square_that_does_not_close_takes_the_error_equally():
    """Where directions are far better known than positions, each of four equals takes a quarter."""
    arcs = [exact(SQUARE, k, (k + 1) % 4, 1.0, 0.005) for k in range(3)]
    last = SQUARE[0].seen_from(SQUARE[3])
    arcs.append(arc(3, 0, Pose(last.x_m + 0.2, last.y_m, last.theta_rad), 1.0, 0.005))
    layout = relaxed_layout([landmark(k, p) for k, p in enumerate(SQUARE)], arcs)
    # The last side, driven down the y axis, was measured 0.2 m too long.
    for k, dy in enumerate((0.0, 0.05, 0.1, 0.15)):
        seen = between(layout, 0, k)
        assert (seen.x_m, seen.y_m) == pytest.approx((SQUARE[k].x_m, SQUARE[k].y_m + dy), abs=1e-3)


def test_there_and_back_count_once():
    there = [arc(0, 1, Pose(1.0, 0, 0)), arc(1, 2, Pose(1.0, 0, 0)), arc(0, 2, Pose(2.3, 0, 0))]
    back = arc(1, 0, Pose(-1.0, 0, 0))
    landmarks = [landmark(k, Pose(k, 0, 0)) for k in range(3)]
    assert relaxed_layout(landmarks, [*there, back]) == relaxed_layout(landmarks, there)


def test_components_lie_apart_each_where_it_was_declared():
    poses = [*SQUARE, Pose(20, 20, 1), Pose(22, 20, 0), Pose(-9, 0, 2)]
    arcs = [exact(poses, 0, 1), exact(poses, 5, 4), exact(poses, 2, 3), exact(poses, 3, 1)]
    layout = relaxed_layout([landmark(k, pose) for k, pose in enumerate(poses)], arcs)
    assert list(layout) == [f"L{k}" for k in range(7)]
    assert [placed.component for placed in layout.values()] == [0, 0, 0, 0, 1, 1, 2]
    for placed, pose in zip(layout.values(), poses, strict=True):
        assert_same(placed.pose, pose)


def test_an_arc_that_was_not_measured_joins_nothing():
    poses = [Pose(0, 0, 0), Pose(1, 0, 0)]
    layout = relaxed_layout(
        [landmark(k, pose) for k, pose in enumerate(poses)],
        [arc(0, 1, Pose(5, 0, 0), 0.0, 0.0), arc(0, 0, Pose(1, 0, 0))],
    )
    assert layout == {"L0": (poses[0], 0), "L1": (poses[1], 1)}


def test_an_arc_from_nowhere_is_refused():
    with pytest.raises(KeyError, match="arc from 'L0' to 'L9' joins no landmarks"):
        relaxed_layout([landmark(0)], [arc(0, 9, Pose(1, 0, 0))])


def test_what_a_later_run_declared_in_its_own_frame_does_not_move_the_picture():
    poses = [*SQUARE, Pose(8, 0, 0), Pose(8, 4, 0)]
    arcs = [exact(poses, *ends) for ends in [(0, 1), (1, 2), (2, 3), (1, 4), (4, 5), (5, 2)]]
    other = Pose(-30, 5, 2.0)
    seen = [*SQUARE, *(pose.seen_from(other) for pose in poses[4:])]
    landmarks = [landmark(k, pose) for k, pose in enumerate(seen)]
    runs = {f"L{k}": "first" if k < 4 else "second" for k in range(6)}
    for k, placed in enumerate(relaxed_layout(landmarks, arcs, runs).values()):
        assert_same(placed.pose, poses[k])
    in_one = relaxed_layout(landmarks, arcs)
    assert in_one["L0"].pose.distance_m(poses[0]) > 1.0


def test_of_a_saved_memory_each_run_has_a_frame_but_not_on_a_map():
    steps = [arc(1, 2, Pose(2, 0, 0)), arc(2, 3, Pose(2, 0, 0))]
    origins = {"L1": "a/L1", "L2": "a/L2", "L3": "b/L1"}
    saved = memory(1, 2, 3, arcs=tuple(steps), origins=origins)
    bent = replace(saved.landmarks[2], y_m=5.0)
    saved = replace(saved, landmarks=(*saved.landmarks[:2], bent))
    ours = layout_of(saved)
    for each in saved.landmarks[:2]:
        assert_same(ours[each.id].pose, Pose(each.x_m, each.y_m, 0.0))
    assert layout_of(replace(saved, frame="map")) == relaxed_layout(saved.landmarks, saved.arcs)
    assert layout_of(replace(saved, frame="map"))["L1"].pose.theta_rad > 0.1


METRES = st.floats(-20.0, 20.0)
POSES = st.builds(Pose, METRES, METRES, st.floats(-math.pi, math.pi))


@st.composite
def graphs(draw):
    """Poses, and pairs that join all of them and some once more."""
    poses = draw(st.lists(POSES, min_size=2, max_size=12))
    ends = [(draw(st.integers(0, k - 1)), k) for k in range(1, len(poses))]
    more = st.tuples(*[st.integers(0, len(poses) - 1)] * 2).filter(lambda pair: pair[0] != pair[1])
    return poses, ends + draw(st.lists(more, max_size=12))


@given(graphs(), st.lists(POSES, min_size=12, max_size=12), st.data())
def test_exact_arcs_are_recovered_wherever_landmarks_were_declared(graph, declared, data):
    poses, ends = graph
    sds = st.tuples(st.floats(0.02, 2.0), st.floats(0.005, 0.5))
    arcs = [exact(poses, *pair, *data.draw(sds)) for pair in ends]
    landmarks = [landmark(k, pose) for k, pose in enumerate(declared[: len(poses)])]
    layout = relaxed_layout(landmarks, arcs)
    for one, other in itertools.combinations(range(len(poses)), 2):
        assert_same(between(layout, one, other), poses[other].seen_from(poses[one]))


def noisy(seed, count=30, more=40):
    """Landmarks as drift has them, and arcs that do not quite agree."""
    rng = np.random.default_rng(seed)
    poses = [Pose(*rng.uniform(-20, 20, 2), rng.uniform(-3, 3)) for _ in range(count)]
    ends = [(int(rng.integers(k)), k) for k in range(1, count)]
    ends += [pair for pair in map(tuple, rng.integers(0, count, (more, 2))) if pair[0] != pair[1]]
    known = {}
    for one, other in ends:
        if (other, one) not in known:
            off = Pose(*rng.normal(0.0, (0.2, 0.2, 0.05)))
            step = poses[other].seen_from(poses[one])
            step = Pose(step.x_m + off.x_m, step.y_m + off.y_m, step.theta_rad + off.theta_rad)
            known.setdefault((one, other), arc(one, other, step, *rng.uniform((0.1, 0.02), 0.3)))
    landmarks = [landmark(k, Pose(p.x_m + k / 20, p.y_m, p.theta_rad)) for k, p in enumerate(poses)]
    return landmarks, list(known.values())


def misfits(poses, arcs):
    """By how many standard deviations each number of each arc is missed, one by one."""
    for each in arcs:
        i, j = poses[each.from_id], poses[each.to_id]
        dx, dy = j.x_m - i.x_m, j.y_m - i.y_m
        cos, sin = math.cos(i.theta_rad), math.sin(i.theta_rad)
        yield (cos * dx + sin * dy - each.x_m) / each.position_sd_m
        yield (-sin * dx + cos * dy - each.y_m) / each.position_sd_m
        turn = j.theta_rad - i.theta_rad - each.theta_rad
        yield math.remainder(turn, math.tau) / each.direction_sd_rad


@settings(deadline=None, max_examples=10)
@given(st.integers(0, 1000))
def test_no_layout_contradicts_the_arcs_less(seed):
    """Beginning there, scipy's least squares, by the sum spelt out, find no better one."""
    landmarks, arcs = noisy(seed, 8, 8)

    def cost_of(numbers):
        rows = np.reshape(numbers, (-1, 3)).tolist()
        poses = {each.id: Pose(*row) for each, row in zip(landmarks, rows, strict=True)}
        return list(misfits(poses, arcs))

    poses = [placed.pose for placed in relaxed_layout(landmarks, arcs).values()]
    ours = np.array([(p.x_m, p.y_m, p.theta_rad) for p in poses]).ravel()
    theirs = least_squares(cost_of, ours, xtol=1e-12, ftol=1e-12)
    assert np.sum(np.square(cost_of(ours))) == pytest.approx(2 * theirs.cost, rel=1e-7)


def test_it_lies_nearest_to_where_landmarks_were_declared():
    landmarks, arcs = noisy(3)
    layout = relaxed_layout(landmarks, arcs)

    def distance(by):
        return sum(
            by.onward(layout[each.id].pose).distance_m(Pose(each.x_m, each.y_m, 0.0)) ** 2
            for each in landmarks
        )

    for axis, step in itertools.product(range(3), (1e-3, -1e-3)):
        assert distance(Pose(*np.eye(3)[axis] * step)) > distance(ORIGIN)


def test_equal_memories_give_equal_layouts():
    assert relaxed_layout(*noisy(1)) == relaxed_layout(*noisy(1))


def test_the_order_of_arcs_is_seen_in_no_file():
    landmarks, arcs = noisy(1)
    one, other = relaxed_layout(landmarks, arcs), relaxed_layout(landmarks, arcs[::-1])
    for name, placed in one.items():
        assert_same(placed.pose, other[name].pose, 1e-8)
