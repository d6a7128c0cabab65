"""Ways over a grid and frontiers on it, against scipy's graph search and labels."""

import itertools
import math

import numpy as np
import pytest
from buildings import CELL_M, offices, room
from hypothesis import example, given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy import ndimage
from scipy.sparse import coo_array
from scipy.sparse.csgraph import dijkstra

from ssrics_like.world import frontier_kernels, way_kernels
from ssrics_like.world.occupancy import BLOCKED, OPEN, SQUEEZE, TIGHT, OccupancyGrid
from ssrics_like.world.reachable import clearance
from ssrics_like.world.way_kernels import ESCAPE, FAR, OUT_OF_BLOCKED

PRICES = [0, BLOCKED, SQUEEZE, TIGHT, OPEN]
NEIGHBOURS = [(r, c) for r in (-1, 0, 1) for c in (-1, 0, 1) if r or c]


def steps_from(costs, start, row, column):
    """Yield where one may go from a cell and what it costs, by the rules in words."""
    escaping = (
        costs[row, column] == BLOCKED
        and abs(row - start[0]) < ESCAPE
        and abs(column - start[1]) < ESCAPE
    )
    for dr, dc in NEIGHBOURS:
        r, c = row + dr, column + dc
        if not (0 <= r < costs.shape[0] and 0 <= c < costs.shape[1]) or costs[r, c] == 0:
            continue
        if costs[r, c] == BLOCKED and not escaping:
            continue  # entered only out of another one that the robot starts in
        price = OUT_OF_BLOCKED if costs[r, c] == BLOCKED else int(costs[r, c])
        yield r, c, (7 if dr and dc else 5) * price


def cheapest(costs, start):
    """Return the cost from the start to each cell by scipy's Dijkstra; infinity where none is."""
    rows, columns = costs.shape
    edges = [
        (row * columns + column, r * columns + c, price)
        for row in range(rows)
        for column in range(columns)
        for r, c, price in steps_from(costs, start, row, column)
    ]
    tails, heads, prices = np.array(edges or [(0, 0, 0)]).T
    graph = coo_array((prices, (tails, heads)), shape=(costs.size, costs.size)).tocsr()
    found = dijkstra(graph, indices=start[0] * columns + start[1])
    return found.reshape(costs.shape)


def spread(costs, start, goals=None, dearest=SQUEEZE):
    goals = np.full(costs.shape, -1, np.int32) if goals is None else goals
    distance, parent = np.empty(costs.shape, np.int32), np.empty(costs.shape, np.int32)
    goal = way_kernels.spread(costs, goals, start, dearest, distance, parent)
    return goal, distance, parent


@st.composite
def cost_grids(draw):
    rows, columns = draw(st.integers(1, 18)), draw(st.integers(1, 18))
    weights = draw(
        st.sampled_from([(1, 1, 1, 1, 6), (3, 0, 1, 1, 5), (0, 6, 1, 1, 2), (1, 4, 0, 0, 5)])
    )
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    chances = np.array(weights) / sum(weights)
    costs = rng.choice(np.array(PRICES, np.uint8), size=(rows, columns), p=chances)
    start = (draw(st.integers(0, rows - 1)), draw(st.integers(0, columns - 1)))
    if draw(st.booleans()):
        costs[start] = BLOCKED
    return costs, start


@settings(max_examples=120, deadline=None)
@given(cost_grids())
@example((np.full((13, 13), BLOCKED, np.uint8), (6, 6)))
def test_costs_of_ways_are_those_of_scipys_dijkstra(case):
    costs, start = case
    goal, distance, _ = spread(costs, start)
    assert goal == -1
    expected = cheapest(costs, start)
    assert np.array_equal(np.where(distance == FAR, np.inf, distance), expected)


@settings(max_examples=120, deadline=None)
@given(cost_grids(), st.integers(0, 2**32 - 1), st.sampled_from([OPEN, TIGHT, SQUEEZE]))
def test_the_cheapest_goal_is_found_and_the_way_there_adds_up(case, seed, dearest):
    costs, start = case
    rng = np.random.default_rng(seed)
    goals = np.where(rng.uniform(size=costs.shape) < 0.1, 7, -1).astype(np.int32)
    goal, _, parent = spread(costs, start, goals, dearest)
    expected = cheapest(costs, start)
    allowed = (goals >= 0) & (costs <= dearest)
    allowed[start] = goals[start] >= 0
    least = expected[allowed].min(initial=np.inf)
    if not np.isfinite(least):
        assert goal == -1
        return
    end = divmod(goal, costs.shape[1])
    assert allowed[end]
    assert expected[end] == least
    way = way_kernels.way_to(parent, goal, 0.5)
    cells = [(int(y / 0.5), int(x / 0.5)) for x, y in way]
    assert [(c + 0.5, r + 0.5) for r, c in cells] == [tuple(p / 0.5) for p in way]
    assert cells[0] == start
    assert cells[-1] == end
    total = 0
    for (row, column), after in itertools.pairwise(cells):
        steps = {(r, c): price for r, c, price in steps_from(costs, start, row, column)}
        total += steps[after]  # a KeyError, were it no allowed step
    assert total == least


def test_blocked_cells_are_left_but_never_entered():
    costs = np.full((3, 30), OPEN, np.uint8)
    costs[:, 10:13] = BLOCKED
    _, distance, _ = spread(costs, (1, 4))
    assert (distance[:, 10:] == FAR).all()
    _, distance, _ = spread(costs, (1, 11))
    assert (distance < FAR).all()  # out of it, to both sides
    assert distance[1, 13] == 5 * OUT_OF_BLOCKED + 5
    wide = np.full((1, 30), BLOCKED, np.uint8)
    wide[0, -1] = OPEN
    _, distance, _ = spread(wide, (0, 0))
    # A few cells out, no farther: it is no way through a wall.
    assert np.flatnonzero(distance[0] < FAR).tolist() == list(range(ESCAPE + 1))


def test_the_start_is_a_goal_whatever_its_cell_costs():
    costs = np.full((3, 3), OPEN, np.uint8)
    for price in (0, BLOCKED, SQUEEZE, OPEN):
        costs[1, 1] = price
        goals = np.full((3, 3), -1, np.int32)
        goals[1, 1] = 0
        goal, _, parent = spread(costs, (1, 1), goals, OPEN)
        assert goal == 4
        assert way_kernels.way_to(parent, goal, 1.0).tolist() == [[1.5, 1.5]]


def planned(grid, radius_m=0.27):
    own = OccupancyGrid(grid.cells.shape, grid.cell_m, radius_m)
    own.know(grid.solid)
    return own


OFFICES = planned(offices())
COSTS = OFFICES.costs()
STANDING = np.argwhere((COSTS > 0) & (COSTS != BLOCKED))


def way_between(start, end, costs=COSTS):
    goals = np.full(costs.shape, -1, np.int32)
    goals[tuple(end)] = 0
    goal, _, parent = spread(costs, tuple(int(v) for v in start), goals)
    assert goal >= 0
    return way_kernels.way_to(parent, goal, CELL_M)


@settings(max_examples=60, deadline=None)
@given(st.integers(0, len(STANDING) - 1), st.integers(0, len(STANDING) - 1))
def test_a_straightened_way_keeps_its_ends_its_places_and_off_the_walls(a, b):
    way = way_between(STANDING[a], STANDING[b])
    straight = way_kernels.straightened(COSTS, way, CELL_M)
    assert straight.shape == way.shape
    assert straight[[0, -1]].tolist() == way[[0, -1]].tolist()
    assert OFFICES.is_open(straight, 0)

    def length(places):
        return np.hypot(*np.diff(places, axis=0).T).sum()

    assert length(straight) <= length(way) + 1e-9
    if len(way) > 1:  # places stay a cell apart, no farther than a diagonal
        assert np.hypot(*np.diff(straight, axis=0).T).max() <= math.sqrt(2) * CELL_M + 1e-9
    moved = straight[np.abs(straight - way).max(axis=1) > 1e-9]
    # Where it was pulled straight it keeps clear: the line is looked at every half cell, so that
    # at most the corner of a cell nearer to the wall is cut.
    cells = np.floor(moved / CELL_M).astype(int)
    prices = COSTS[cells[:, 1], cells[:, 0]]
    assert set(prices.tolist()) <= {OPEN, TIGHT}
    assert (prices == TIGHT).sum() <= 0.1 * len(prices) + 1


def test_across_an_empty_hall_the_way_is_a_straight_line():
    costs = planned(room(8.0, 6.0)).costs()
    straight = way_kernels.straightened(costs, way_between((20, 20), (90, 140), costs), CELL_M)
    x, y = straight.T
    # y = 1.025 + slope * (x - 1.025) through the middles of the first and last cell
    assert y == pytest.approx(1.025 + 70 / 120 * (x - 1.025))


def test_ways_lead_through_the_middle_of_a_doorway_and_around_what_is_near():
    way = way_between((20, 20), (100, 160))  # from the lower left office to the upper right one
    near = clearance(offices())[tuple(np.floor(way[:, ::-1] / CELL_M).astype(int).T)]
    # The doorways are 0.9 m wide: in their middle there are 0.45 m to either side, less half a
    # cell; nowhere is it nearer, and most of the way it keeps its berth.
    assert near.min() >= 0.4
    assert np.mean(near > 0.5) > 0.8


def naive_frontiers(evidence, tried, tries, least):
    """Label free cells that border on unknown ones, by scipy; return those of the larger sets."""
    unknown = np.pad(evidence == 0, 1)
    beside = unknown[:-2, 1:-1] | unknown[2:, 1:-1] | unknown[1:-1, :-2] | unknown[1:-1, 2:]
    edge = (evidence < 0) & beside & (tried < tries)
    parts, count = ndimage.label(edge, np.ones((3, 3)))
    sizes = np.bincount(parts.ravel(), minlength=count + 1)[1:]
    large = np.isin(parts, 1 + np.flatnonzero(sizes >= least))
    return large, int(np.count_nonzero(sizes >= least))


def steps_through_free(evidence, source, most):
    """Return the steps of a chess king from a set of cells through free ones, -1 beyond most."""
    steps = np.where(source, 0, -1)
    for n in range(1, most + 1):
        ring = ndimage.binary_dilation(steps >= 0, np.ones((3, 3))) & (steps < 0) & (evidence < 0)
        steps[ring] = n
    return steps


@st.composite
def maps_half_seen(draw):
    shape = draw(st.tuples(st.integers(1, 20), st.integers(1, 20)))
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    smooth = ndimage.gaussian_filter(rng.normal(size=shape), draw(st.sampled_from([0.0, 1.0, 2.0])))
    seen = smooth > np.quantile(smooth, draw(st.sampled_from([0.0, 0.3, 0.7, 1.0])))
    evidence = np.where(seen, np.where(rng.uniform(size=shape) < 0.15, 8, -6), 0).astype(np.int8)
    tried = rng.choice(3, size=shape, p=[0.8, 0.1, 0.1]).astype(np.uint8)
    return evidence, tried


@settings(max_examples=150, deadline=None)
@given(maps_half_seen(), st.integers(1, 3), st.integers(1, 8), st.integers(0, 6))
def test_frontiers_are_those_of_scipys_labels(case, tries, least, peek):
    evidence, tried = case
    goals = np.empty(evidence.shape, np.int32)
    count = frontier_kernels.frontier_goals(evidence, tried, tries, least, peek, goals)
    frontier, expected = naive_frontiers(evidence, tried, tries, least)
    assert count == expected
    steps = steps_through_free(evidence, frontier, peek)
    assert np.array_equal(goals >= 0, steps >= 0)
    own = np.arange(evidence.size).reshape(evidence.shape)
    assert np.array_equal(goals[frontier], own[frontier])
    for goal in np.unique(goals[goals >= 0]):
        # Each cell looks at a frontier cell that none is nearer than.
        source = own == goal
        assert frontier[source].all()
        away = steps_through_free(evidence, source, peek)
        assert np.array_equal(away[goals == goal], steps[goals == goal])


def test_what_was_tried_counts_around_the_frontier_cell_only():
    evidence = np.zeros((20, 20), np.int8)
    evidence[:, :10] = -6
    tried = np.zeros((20, 20), np.uint8)
    for n in (1, 2):
        frontier_kernels.set_aside(evidence, tried, 10, 9, 3)
        assert tried[7:14, 9].tolist() == [n] * 7
        assert tried.sum() == 7 * n
    tried[10, 9] = 200
    frontier_kernels.set_aside(evidence, tried, 10, 9, 3)
    assert tried[10, 9] == 200  # it never wraps round


def test_the_heading_at_a_frontier_is_towards_the_middle_of_the_unknown():
    evidence = np.full((21, 21), -6, np.int8)
    evidence[:, 15:] = 0
    # Unknown cells within 4 of (10, 14) lie symmetrically to its right: straight along x.
    assert frontier_kernels.facing(evidence, (10, 8), (10, 14), 4) == pytest.approx(0.0)
    assert frontier_kernels.facing(evidence, (10, 20), (10, 14), 4) == pytest.approx(math.pi)
    evidence[:] = -6
    evidence[14, 10] = 0
    # One unknown cell: atan2(14 - 4, 10 - 0).
    assert frontier_kernels.facing(evidence, (4, 0), (13, 10), 4) == pytest.approx(math.pi / 4)
    evidence[:] = -6
    assert math.isnan(frontier_kernels.facing(evidence, (4, 0), (13, 10), 4))


@given(arrays(np.int8, (6, 6), elements=st.sampled_from([-6, 0, 8])))
def test_a_cell_borders_on_the_unknown_by_its_four_sides(evidence):
    for row in range(6):
        for column in range(6):
            beside = [
                evidence[r, c]
                for r, c in [
                    (row - 1, column),
                    (row + 1, column),
                    (row, column - 1),
                    (row, column + 1),
                ]
                if 0 <= r < 6 and 0 <= c < 6
            ]
            assert frontier_kernels.borders_unknown(evidence, row, column) == (0 in beside)
