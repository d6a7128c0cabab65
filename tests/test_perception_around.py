"""Ways round a gap, and what its jambs belong to: on drawn local maps, against closed forms."""

import math

import numpy as np
import pytest
from scipy import ndimage, sparse
from scipy.sparse.csgraph import shortest_path

from ssrics_like.perception.around_kernels import BESIDE_M, HALF, ROUND_M, around
from ssrics_like.perception.local_map import CELLS
from ssrics_like.perception.local_map_kernels import CELL_M

MIDDLE_M = CELL_M * (CELLS // 2 + 0.5)
NAMES = (
    "round_m", "round_unknown_m", "aside_lesser", "aside_greater", "along_lesser",
    "along_greater", "cells_lesser", "cells_greater",
)  # fmt: skip


class Drawn:
    """A local map around the middle of a gap that is passed in the direction of x."""

    def __init__(self):
        self.evidence = np.full((CELLS, CELLS), -6, np.int8)
        self.seen_m = np.zeros((CELLS, CELLS))

    def _part(self, x0, y0, x1, y1):
        to = [round((MIDDLE_M + v - CELL_M / 2) / CELL_M) for v in (x0, y0, x1, y1)]
        return slice(to[1], to[3]), slice(to[0], to[2])

    def fill(self, *box):
        self.evidence[self._part(*box)] = 9
        return self

    def forget(self, *box):
        self.seen_m[self._part(*box)] = -math.inf
        return self

    def measures(self, width_m=1.0, left=(0.0, 1.0)):
        out = np.empty(len(NAMES))
        middle = (MIDDLE_M, MIDDLE_M)
        assert around(self.evidence, self.seen_m, middle, left, width_m, -5.0, out, 0) == len(NAMES)
        return dict(zip(NAMES, out.tolist(), strict=True))


def posts():
    return Drawn().fill(-0.15, 0.5, 0.15, 0.8).fill(-0.15, -0.8, 0.15, -0.5)


def wall(half_m=3.2):
    return Drawn().fill(-0.05, 0.5, 0.1, half_m).fill(-0.05, -half_m, 0.1, -0.5)


def test_the_way_round_a_post_leads_round_it_and_not_between_the_two():
    measures = posts().measures()
    # From beside one post a cell and a half clear of it, past it, and back.
    expected = 2 * BESIDE_M + 2 * (0.8 - 0.5 + 1.5 * CELL_M)
    assert measures["round_m"] == pytest.approx(expected, abs=2 * CELL_M)
    assert measures["round_unknown_m"] == measures["round_m"]


def test_there_is_no_way_round_a_doorway():
    measures = wall().measures()
    assert measures["round_m"] == measures["round_unknown_m"] == ROUND_M


def test_where_a_wall_ends_in_what_is_unknown_there_may_be_a_way_but_none_is_known():
    drawn = wall(2.0).forget(-3.2, 2.0, 3.2, 3.2).forget(-3.2, -3.2, 3.2, -2.0)
    measures = drawn.measures()
    assert measures["round_m"] == ROUND_M
    assert measures["round_unknown_m"] == pytest.approx(0.6 + 2 * (2.0 - 0.5 + 0.075), abs=0.1)


def test_nobody_slips_through_a_wall_that_the_beams_left_holes_in():
    drawn = wall()
    for at in (0.8, -1.2):  # two cells wide
        drawn.evidence[drawn._part(-0.05, at, 0.1, at + 2 * CELL_M)] = -6
    assert drawn.measures()["round_m"] == ROUND_M


def test_what_a_jamb_belongs_to_reaches_as_far_as_it_does():
    measures = wall(1.7).fill(-0.15, -0.8, 0.15, -0.5).measures()
    assert measures["aside_greater"] == pytest.approx(1.2, abs=0.1)
    assert posts().measures()["aside_greater"] == pytest.approx(0.3, abs=0.1)
    assert posts().measures()["along_lesser"] == pytest.approx(0.3, abs=0.1)
    assert posts().measures()["cells_lesser"] == pytest.approx(6 * 6 * CELL_M)


def test_things_two_cells_apart_are_one_and_three_cells_apart_are_two():
    joined = posts().fill(-0.15, 0.8 + CELL_M, 0.15, 1.2)
    apart = posts().fill(-0.15, 0.8 + 3 * CELL_M, 0.15, 1.2)
    assert joined.measures()["aside_greater"] == pytest.approx(0.7, abs=0.1)
    assert apart.measures()["aside_greater"] == pytest.approx(0.3, abs=0.1)


def test_without_jambs_nothing_reaches_and_one_can_go_beside():
    measures = Drawn().measures(width_m=5.0)
    assert measures["cells_greater"] == measures["aside_greater"] == 0.0
    assert measures["round_m"] < 1.0


def test_what_is_occupied_on_both_sides_has_no_way():
    assert Drawn().fill(-3.2, -3.2, 3.2, 3.2).measures()["round_m"] == ROUND_M


@pytest.mark.parametrize("seed", range(20))
def test_the_naive_twin_finds_the_same_way(seed):
    rng = np.random.default_rng(seed)
    drawn = Drawn()
    for _ in range(60):
        x, y = rng.uniform(-2.9, 2.9, 2)
        if abs(y) > 0.5:
            drawn.fill(x, y, x + rng.uniform(0.1, 0.6), y + rng.uniform(0.1, 0.6))
    drawn.seen_m[rng.random(drawn.seen_m.shape) < 0.1] = -math.inf
    measures = drawn.measures()
    for name, unknown_too in (("round_m", False), ("round_unknown_m", True)):
        assert measures[name] == pytest.approx(naive(drawn, unknown_too))


def naive(drawn, unknown_too):
    """Ask scipy for the shortest path between any cells of the two lines."""
    middle = CELLS // 2
    window = slice(middle - HALF, middle + HALF + 1)
    known = drawn.seen_m[window, window] >= -5.0
    occupied = known & (drawn.evidence[window, window] > 0)
    plus = ndimage.generate_binary_structure(2, 1)
    passable = ~ndimage.binary_dilation(occupied, plus) & (known | unknown_too)
    beside = round(BESIDE_M / CELL_M)
    half = math.ceil(0.5 / CELL_M)
    passable[HALF - half - 1 : HALF + half + 2, HALF] = False
    number = np.arange(passable.size).reshape(passable.shape)
    edges = []
    for one, other in ((number[1:], number[:-1]), (number[:, 1:], number[:, :-1])):
        both = passable.ravel()[one] & passable.ravel()[other]
        edges.append((one[both], other[both]))
    i, j = (np.concatenate([pair[k].ravel() for pair in edges]) for k in (0, 1))
    graph = sparse.coo_matrix((np.ones(len(i)), (i, j)), (number.size, number.size)).tocsr()
    line = slice(HALF - half, HALF + half + 1)
    free = passable & known
    starts = number[line, HALF + beside][free[line, HALF + beside]]
    goals = number[line, HALF - beside][passable[line, HALF - beside]]
    if not len(starts) or not len(goals):
        return ROUND_M
    steps = shortest_path(graph, directed=False, unweighted=True, indices=starts)[:, goals].min()
    return min(steps * CELL_M, ROUND_M)
