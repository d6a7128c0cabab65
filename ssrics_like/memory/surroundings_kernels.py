"""Compiled: how far the surroundings of one place agree with those of many others.

Few places are alike, and most that are not can be told without an exact comparison, by
`surroundings_bounds`. What a bound rules out, the exact comparison does, too: float32 rounds no
smaller sum to more than a greater one.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.compiling import compiled
from ssrics_like.memory.surroundings_bounds import (
    HALVES,
    LANES,
    POINTS,
    QUARTERS,
    TURNS,
    bounds_by_level,
)

if TYPE_CHECKING:
    from numpy.typing import NDArray

HIDDEN_M = 1e6
"""Stands for a length that is unknown: it agrees with no other."""
TOP = 128
"""The top bit of a byte."""


@compiled
def looked_at_from(
    lengths: NDArray[np.float64], ahead_m: float, most_m: float, out: NDArray[np.float64]
) -> None:
    """Tell how far it goes on from a point a little ahead of the place.

    Between two directions the surroundings are taken to be straight.

    Parameters
    ----------
    lengths : ndarray, shape (directions,)
        How far it goes on from the place, first ahead, then counter-clockwise; metres.
    ahead_m : float
        Where the point is.
    most_m : float
        Nothing is longer.
    out : ndarray, shape (directions,)
        Takes the lengths from there.
    """
    n = len(lengths)
    x = np.empty(n)
    y = np.empty(n)
    step = 2.0 * math.pi / n
    for i in range(n):
        x[i] = lengths[i] * math.cos(i * step) - ahead_m
        y[i] = lengths[i] * math.sin(i * step)
    for k in range(n):
        cos, sin = math.cos(k * step), math.sin(k * step)
        nearest = most_m
        for i in range(n):
            j = i + 1 if i + 1 < n else 0
            aside, aside_next = y[i] * cos - x[i] * sin, y[j] * cos - x[j] * sin
            if (aside < 0.0) == (aside_next < 0.0):
                continue  # the edge does not cross this direction, nor its opposite
            along, along_next = x[i] * cos + y[i] * sin, x[j] * cos + y[j] * sin
            distance = along + aside / (aside - aside_next) * (along_next - along)
            if 0.0 < distance < nearest:
                nearest = distance
        out[k] = nearest


@compiled
def best_agreements(
    views: NDArray[np.float32],
    seen: NDArray[np.bool_],
    asides: NDArray[np.int64],
    lengths: NDArray[np.float32],
    levels: NDArray[np.uint8],
    same_m: float,
    same: float,
    nearly: float,
    fewest: int,
    strange: float,
    exact: bool,
    out: NDArray[np.float64],
    turned: NDArray[np.int64],
) -> None:
    """Compare the views of a place with others, from either side, and keep the best for each.

    Parameters
    ----------
    views : ndarray, shape (POINTS, directions)
        Lengths seen from each point, metres; of `MOST` directions at most.
    seen : ndarray, shape (directions,)
        Which of them are known.
    asides : ndarray, shape (TURNS,)
        By how many directions they are turned, -2 to 2; of equally good ones the first counts.
    lengths : ndarray, shape (places, directions)
        The same of other places; `HIDDEN_M` where unknown.
    levels : ndarray, shape (places, directions)
        The same in whole steps, `LEVELS - 1` for all that is longer; `LEVELS` where unknown.
    same_m, same : float
        Two lengths that differ by the former, or by this share of the longer, differ by 1.
    nearly : float
        A direction that differs by that or less agrees wholly, by 1 more not at all.
    fewest : int
        With fewer directions known of both, two are not compared.
    strange, exact : float, bool
        A share up to `strange` may be told too small, if it need not be `exact`.
    out : ndarray, shape (HALVES, places)
        Takes the share of directions that agree; -1 where nothing could be compared.
    turned : ndarray, shape (HALVES, places)
        Takes by how many directions the views are turned then.
    """
    places, directions = lengths.shape
    neutral = math.ceil(QUARTERS * strange)
    bounds = bounds_by_level(views, seen, same_m, same, nearly, neutral)
    # A sum begins so that in the end the top bit of a byte tells whether more may agree than in
    # strange places, or whether enough is compared.
    begin, top = np.empty(HALVES * LANES, np.uint8), np.empty(HALVES * LANES, np.uint8)
    begin[:] = TOP - 1 - math.floor(QUARTERS * strange * directions)
    begin[POINTS::LANES] = TOP - fewest
    top[:] = TOP
    top[POINTS::LANES] = 0
    nothing, more = begin.view(np.uint64)[0], top.view(np.uint64)[0]
    sums = np.empty(TURNS, np.uint64)
    lanes = sums.view(np.uint8).reshape(TURNS, HALVES, LANES)
    twice, twice_per_m = _twice_round(views, seen, same_m, same)
    per_m = np.empty(directions, np.float32)
    most = np.empty(TURNS * POINTS, np.float32)
    none, least = np.float32(1.0 + nearly), np.float32(-1.0 if exact else strange)
    for place in range(places):
        sums[:] = nothing
        for i in range(directions):
            level = levels[place, i]
            for turn in range(TURNS):
                sums[turn] += bounds[level, i + turn]
        told = np.uint64(0)
        for turn in range(TURNS):
            told |= sums[turn]
        alike = exact or told & more != 0
        if alike:
            for i in range(directions):
                per_m[i] = _per_m(lengths[place, i], same_m, same)
        for side in range(HALVES):
            enough = False
            for turn in range(TURNS):
                enough = enough or lanes[turn, side, POINTS] >= TOP
            out[side, place] = 0.0 if enough else -1.0
            turned[side, place] = side * (directions // HALVES)
            if not (alike and enough):
                continue
            for rank in range(TURNS):
                turn = TURNS // 2 - asides[rank]
                compared = int(lanes[turn, side, POINTS]) - int(begin[POINTS])
                unknown = neutral * (directions - compared)
                for point in range(POINTS):
                    quarters = int(lanes[turn, side, point]) - int(begin[0]) - unknown
                    most[rank * POINTS + point] = (
                        np.float32(quarters) / np.float32(QUARTERS * compared)
                        if compared >= fewest
                        else np.float32(-1.0)
                    )
            best, at = np.float32(0.0), len(most)
            while True:  # what may agree most comes first: seldom anything else is left then
                one = int(np.argmax(most))
                if most[one] < best or most[one] <= least:
                    break
                rank, point = divmod(one, POINTS)
                turn = asides[rank] + side * (directions // HALVES)
                compared = int(lanes[TURNS // 2 - asides[rank], side, POINTS]) - int(begin[POINTS])
                share = _agreeing(
                    twice[point], twice_per_m[point], (-turn) % directions,
                    lengths[place], per_m, none,
                ) / np.float32(compared)  # fmt: skip
                most[one] = np.float32(-1.0)
                if share > best or (share == best and one < at):
                    best, at = share, one
                    out[side, place], turned[side, place] = share, turn


@compiled
def _agreeing(
    view: NDArray[np.float32],
    view_per_m: NDArray[np.float32],
    first: int,
    lengths: NDArray[np.float32],
    per_m: NDArray[np.float32],
    none: np.float32,
) -> np.float32:
    """Return in how many directions a view agrees with a place, if its first one is `first`."""
    zero, one = np.float32(0.0), np.float32(1.0)
    agreeing = zero
    for i in range(len(lengths)):
        less = abs(view[first + i] - lengths[i]) * min(view_per_m[first + i], per_m[i])
        agreeing += min(one, max(zero, none - less))
    return agreeing


@compiled
def _per_m(length: np.float32, same_m: float, same: float) -> np.float32:
    """Return by how much a direction of that length agrees less for each metre of difference."""
    return np.float32(1.0) / max(np.float32(same_m), np.float32(same) * length)


@compiled
def _twice_round(
    views: NDArray[np.float32], seen: NDArray[np.bool_], same_m: float, same: float
) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Return views twice round, so that they can be turned, and `_per_m` of them.

    What is not seen is as long as what is unknown of places, but negative: they do not agree.
    """
    points, directions = views.shape
    lengths = np.empty((points, 2 * directions), np.float32)
    per_m = np.empty_like(lengths)
    for point in range(points):
        for i in range(2 * directions):
            j = i % directions
            lengths[point, i] = views[point, j] if seen[j] else np.float32(-HIDDEN_M)
            per_m[point, i] = _per_m(views[point, j], same_m, same)
    return lengths, per_m
