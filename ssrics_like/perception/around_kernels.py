"""The compiled inner loops that tell a gap in a wall from a gap between two things.

A doorway is the way between two spaces: who does not go through it has a long way round or none,
and its jambs belong to walls that go on. Between a shelf and a chair one can as well go round the
chair. Both are asked of the local map within 3 m.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.compiling import compiled
from ssrics_like.perception.frame_kernels import framed
from ssrics_like.perception.local_map_kernels import CELL_M, FREE, OCCUPIED, UNKNOWN, cell_state

if TYPE_CHECKING:
    from numpy.typing import NDArray

HALF = 60  # cells from the middle to the edge of the window, 3 m
SIDE = 2 * HALF + 1
BESIDE_M = 0.3  # ways round begin and end so far from the gap
ROUND_M = 8.0  # a way round that is longer is none
ROUND = round(ROUND_M / CELL_M)
JAMB = 3  # what is nearer to a jamb than so many cells belongs to it
JOINED = 2  # cells that are no farther apart belong together: beams leave gaps in a wall


@compiled
def around(
    evidence: NDArray[np.int8],
    seen_m: NDArray[np.float64],
    middle: tuple[float, float],
    left: tuple[float, float],
    width_m: float,
    oldest_m: float,
    out: NDArray[np.float64],
    at: int,
) -> int:
    """Measure the ways round a gap, and how far what its jambs belong to reaches.

    Parameters
    ----------
    evidence, seen_m : ndarray, shape (cells, cells)
        The local map.
    middle, left : tuple of float
        The gap's frame; see `ssrics_like.perception.frame_kernels.framed`.
    width_m : float
        From jamb to jamb.
    oldest_m : float
        What was seen before counts as unknown.
    out : ndarray, shape (features,)
        Filled from `at` on.

    Returns
    -------
    int
        Where the next measure goes.
    """
    corner = (
        math.floor(middle[1] / CELL_M) - HALF,
        math.floor(middle[0] / CELL_M) - HALF,
    )
    states = _window(evidence, seen_m, corner, oldest_m)
    queue = np.empty(SIDE * SIDE, np.int32)
    blocked = _blocked(states)
    goal = np.zeros((SIDE, SIDE), np.bool_)
    gone = np.empty((SIDE, SIDE), np.int16)
    start = np.zeros((SIDE, SIDE), np.bool_)
    _draw(start, corner, middle, left, width_m, BESIDE_M)
    _draw(goal, corner, middle, left, width_m, -BESIDE_M)
    _draw(blocked, corner, middle, left, width_m + 2.0 * CELL_M, 0.0)
    for unknown_too in (False, True):
        out[at] = _way_round(states, blocked, start, goal, unknown_too, gone, queue) * CELL_M
        at += 1
    sides = np.zeros((2, 3))
    for side in range(2):
        sign = 1.0 if side == 0 else -1.0
        _reach_of_jamb(states, corner, middle, left, sign, width_m, queue, sides[side])
    for measure in range(3):
        out[at] = min(sides[0, measure], sides[1, measure])
        out[at + 1] = max(sides[0, measure], sides[1, measure])
        at += 2
    return at


@compiled
def _window(
    evidence: NDArray[np.int8],
    seen_m: NDArray[np.float64],
    corner: tuple[int, int],
    oldest_m: float,
) -> NDArray[np.int8]:
    """Return the states of the cells around the gap."""
    states = np.empty((SIDE, SIDE), np.int8)
    for row in range(SIDE):
        for column in range(SIDE):
            states[row, column] = cell_state(
                evidence, seen_m, corner[0] + row, corner[1] + column, oldest_m
            )
    return states


@compiled
def _blocked(states: NDArray[np.int8]) -> NDArray[np.bool_]:
    """Return the cells that are occupied or touch one that is: nobody slips through a wall."""
    blocked = np.zeros((SIDE, SIDE), np.bool_)
    for row in range(SIDE):
        for column in range(SIDE):
            if states[row, column] == OCCUPIED:
                blocked[row, column] = True
                blocked[max(row - 1, 0), column] = blocked[min(row + 1, SIDE - 1), column] = True
                blocked[row, max(column - 1, 0)] = blocked[row, min(column + 1, SIDE - 1)] = True
    return blocked


@compiled
def _draw(
    cells: NDArray[np.bool_],
    corner: tuple[int, int],
    middle: tuple[float, float],
    left: tuple[float, float],
    width_m: float,
    ahead_m: float,
) -> None:
    """Set the cells of a line along the gap, so far ahead of it."""
    steps = max(math.ceil(width_m / CELL_M) * 4, 1)
    for step in range(steps + 1):
        x, y = framed(middle, left, ahead_m, width_m * (step / steps - 0.5))
        row, column = math.floor(y / CELL_M) - corner[0], math.floor(x / CELL_M) - corner[1]
        if 0 <= row < SIDE and 0 <= column < SIDE:
            cells[row, column] = True


@compiled
def _way_round(
    states: NDArray[np.int8],
    blocked: NDArray[np.bool_],
    start: NDArray[np.bool_],
    goal: NDArray[np.bool_],
    unknown_too: bool,
    gone: NDArray[np.int16],
    queue: NDArray[np.int32],
) -> int:
    """Return how many steps, from cell to neighbouring cell, the shortest way takes.

    `ROUND` if there is none. It leads over free cells, and over unknown ones if `unknown_too`.
    """
    gone[:] = -1
    length = 0
    for row in range(SIDE):
        for column in range(SIDE):
            if start[row, column] and not blocked[row, column] and states[row, column] == FREE:
                gone[row, column] = 0
                queue[length] = row * SIDE + column
                length += 1
    first = 0
    while first < length:
        row, column = queue[first] // SIDE, queue[first] % SIDE
        first += 1
        steps = gone[row, column]
        if goal[row, column]:
            return int(steps)
        if steps >= ROUND:
            break
        for turn in range(4):
            to_row = row + (turn == 0) - (turn == 1)
            to_column = column + (turn == 2) - (turn == 3)  # noqa: PLR2004 - four neighbours
            if not (0 <= to_row < SIDE and 0 <= to_column < SIDE):
                continue
            if gone[to_row, to_column] >= 0 or blocked[to_row, to_column]:
                continue
            if states[to_row, to_column] == UNKNOWN and not unknown_too:
                continue
            gone[to_row, to_column] = steps + 1
            queue[length] = to_row * SIDE + to_column
            length += 1
    return ROUND


@compiled
def _reach_of_jamb(
    states: NDArray[np.int8],
    corner: tuple[int, int],
    middle: tuple[float, float],
    left: tuple[float, float],
    sign: float,
    width_m: float,
    queue: NDArray[np.int32],
    out: NDArray[np.float64],
) -> None:
    """Follow what a jamb belongs to, from occupied cell to occupied cell.

    Filled are metres that it reaches aside from the jamb, its length along the way, and how long
    a line as many cells would make.
    """
    x, y = framed(middle, left, 0.0, sign * 0.5 * (width_m + CELL_M))
    jamb_row, jamb_column = math.floor(y / CELL_M) - corner[0], math.floor(x / CELL_M) - corner[1]
    taken = np.zeros((SIDE, SIDE), np.bool_)
    length = _take(states, taken, queue, 0, jamb_row, jamb_column, JAMB)
    first = 0
    aside = ahead = behind = 0.0
    while first < length:
        row, column = queue[first] // SIDE, queue[first] % SIDE
        first += 1
        dx, dy = (column - jamb_column) * CELL_M, (row - jamb_row) * CELL_M
        aside = max(aside, sign * (dx * left[0] + dy * left[1]))
        along = dx * left[1] - dy * left[0]
        ahead, behind = max(ahead, along), min(behind, along)
        length = _take(states, taken, queue, length, row, column, JOINED)
    out[0], out[1], out[2] = aside, ahead - behind, length * CELL_M


@compiled
def _take(
    states: NDArray[np.int8],
    taken: NDArray[np.bool_],
    queue: NDArray[np.int32],
    length: int,
    row: int,
    column: int,
    within: int,
) -> int:
    """Append the occupied cells around one that were not taken yet; return the queue's length."""
    for near_row in range(max(row - within, 0), min(row + within + 1, SIDE)):
        for near_column in range(max(column - within, 0), min(column + within + 1, SIDE)):
            if states[near_row, near_column] == OCCUPIED and not taken[near_row, near_column]:
                taken[near_row, near_column] = True
                queue[length] = near_row * SIDE + near_column
                length += 1
    return length
