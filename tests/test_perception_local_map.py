"""The local map: what a beam says of the cells that it passes, and how long that is believed."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from ssrics_like.perception.local_map import CELLS, MEMORY_M, REACH_M, LocalMap
from ssrics_like.perception.local_map_kernels import CELL_M, march
from ssrics_like.perception.observation import Pose

ORIGIN = Pose(0.01, 0.01, 0.0)
AHEAD = np.zeros(1)
OCCUPIED, UNKNOWN, FREE = 1, 0, -1


def beam(local, length_m, pose=ORIGIN, travelled_m=0.0, bearing_rad=0.0):
    local.take(pose, np.array([bearing_rad]), np.array([length_m]), travelled_m)


def test_a_beam_frees_what_it_passes_and_fills_where_it_ends():
    local = LocalMap()
    beam(local, 2.0)
    assert local.state(2.01, 0.01, 0.0) == OCCUPIED
    assert [local.state(x, 0.01, 0.0) for x in (0.01, 0.5, 1.9)] == [FREE] * 3
    assert [local.state(x, 0.01, 0.0) for x in (2.1, 3.0)] == [UNKNOWN] * 2
    assert local.state(1.0, 0.1, 0.0) == UNKNOWN


@pytest.mark.parametrize("length_m", [REACH_M, 8.0, math.inf])
def test_a_beam_that_meets_nothing_within_reach_frees_its_way_only(length_m):
    local = LocalMap()
    beam(local, length_m)
    assert local.state(REACH_M - 0.1, 0.01, 0.0) == FREE
    assert not (local.evidence > 0).any()
    assert local.state(REACH_M + 0.2, 0.01, 0.0) == UNKNOWN


@pytest.mark.parametrize("length_m", [math.nan, 0.0, -1.0])
def test_a_beam_without_an_answer_says_nothing(length_m):
    local = LocalMap()
    beam(local, length_m)
    assert not local.evidence.any()


def test_what_was_not_seen_for_so_many_metres_is_unknown_and_forgotten():
    local = LocalMap()
    for _ in range(5):
        beam(local, 2.0)
    assert local.state(2.01, 0.01, MEMORY_M) == OCCUPIED
    assert local.state(2.01, 0.01, MEMORY_M + 0.01) == UNKNOWN
    beam(local, 3.0, travelled_m=MEMORY_M + 0.01)  # one beam through: no trace of what was there
    assert local.state(2.01, 0.01, MEMORY_M + 0.01) == FREE


def test_somebody_who_walked_on_is_gone_after_a_few_scans():
    local = LocalMap()
    for _ in range(100):
        beam(local, 2.0)
    scans = 0
    while local.state(2.01, 0.01, 0.0) == OCCUPIED:
        beam(local, 3.0)
        scans += 1
    assert scans == 9  # evidence of 9 at most, of which each scan takes one


def test_the_cells_repeat_themselves_and_keep_no_ghosts():
    local = LocalMap()
    beam(local, 2.0)
    side_m = CELLS * CELL_M
    assert local.state(2.01 + side_m, 0.01 - side_m, 0.0) == OCCUPIED
    far = Pose(ORIGIN.x_m + side_m, ORIGIN.y_m, 0.0)
    beam(local, 3.0, far, travelled_m=side_m)
    assert local.state(2.01 + side_m, 0.01, side_m) == FREE


def passed(pose, bearing_rad, length_m):
    """Cells on the way of a beam, by very small steps: the twin of the walk from border to border."""
    angle = pose.theta_rad + bearing_rad
    steps = np.arange(0.0, max(length_m - CELL_M / 2, 0.0), 1e-4)
    x, y = pose.x_m + steps * math.cos(angle), pose.y_m + steps * math.sin(angle)
    return set(zip(np.floor(y / CELL_M).astype(int), np.floor(x / CELL_M).astype(int), strict=True))


@settings(max_examples=60, deadline=None)
@given(
    st.floats(-3, 3), st.floats(-3, 3), st.floats(-math.pi, math.pi),
    st.floats(-math.pi, math.pi), st.floats(0.3, REACH_M - 0.01),
)  # fmt: skip
def test_every_cell_on_the_way_is_freed_and_no_other(x, y, heading, bearing, length):
    # Which of two cells a beam takes that runs along their border is a matter of rounding.
    assume(all(abs(v / CELL_M - round(v / CELL_M)) > 1e-3 for v in (x, y)))
    local = LocalMap()
    pose = Pose(x, y, heading)
    beam(local, length, pose, bearing_rad=bearing)
    freed = {(r if r < CELLS // 2 else r - CELLS, c if c < CELLS // 2 else c - CELLS)
             for r, c in np.argwhere(local.evidence < 0).tolist()}  # fmt: skip
    naive = passed(pose, bearing, length)
    end = (
        math.floor((y + length * math.sin(heading + bearing)) / CELL_M),
        math.floor((x + length * math.cos(heading + bearing)) / CELL_M),
    )
    assert local.evidence[end[0] % CELLS, end[1] % CELLS] > 0
    naive.discard(end)
    # Where the way merely touches a corner, rounding decides.
    assert len(freed ^ naive) <= 2
    assert (local.evidence > 0).sum() == 1


def test_marching_stops_at_what_is_met_and_counts_the_unknown():
    local = LocalMap()
    for _ in range(3):
        beam(local, 1.0)
    met, unknown = march(local.evidence, local.seen_m, (0.01, 0.01), (1.0, 0.0), 2.5, -1.0)
    assert met == pytest.approx(1.0, abs=CELL_M)
    assert unknown <= CELL_M  # the cell just before the end is left
    met, unknown = march(local.evidence, local.seen_m, (0.01, 0.01), (0.0, 1.0), 2.5, -1.0)
    assert met == 2.5
    assert unknown == pytest.approx(2.5, abs=CELL_M)


def test_nothing_slips_through_a_slanting_wall():
    local = LocalMap()
    for step in range(60):  # cells that touch at their corners only
        at = 1.0 + step * CELL_M
        local.evidence[int(at / CELL_M), int((3.0 - step * CELL_M) / CELL_M)] = 9
    local.seen_m[:] = 0.0
    for start in np.linspace(0.0, 1.0, 97).tolist():
        met, _ = march(local.evidence, local.seen_m, (start, start), (0.6, 0.8), 4.0, -1.0)
        assert met < 3.0
