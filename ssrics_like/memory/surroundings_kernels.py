"""Compiled: how far the surroundings of one place agree with those of many others."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.compiling import compiled

if TYPE_CHECKING:
    from numpy.typing import NDArray

BLOCK = 1024
"""Places that are compared at once."""


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
    views_per_m: NDArray[np.float32],
    seen: NDArray[np.bool_],
    lengths: NDArray[np.float32],
    per_m: NDArray[np.float32],
    known: NDArray[np.float32],
    nearly: float,
    fewest: float,
    out: NDArray[np.float64],
    turned: NDArray[np.int64],
) -> None:
    """Compare each view of a place with all others, and keep the best for each.

    Parameters
    ----------
    views, views_per_m : ndarray, shape (turns, points, directions)
        Lengths in metres; by how much a direction agrees less for each metre of difference.
    seen : ndarray, shape (turns, directions)
        Which of them are known.
    lengths, per_m, known : ndarray, shape (directions, places)
        The same of other places; 1 for known, else 0. What is not known has an infinite length.
    nearly : float
        A direction that differs by that much less than nothing agrees wholly, by 1 more not at all.
    fewest : float
        With fewer directions known of both, two are not compared.
    out : ndarray, shape (places,)
        Takes the share of directions that agree; -1 where nothing could be compared.
    turned : ndarray, shape (places,)
        Takes the turn, an index, with which they do.
    """
    directions, places = lengths.shape
    none, zero, one = np.float32(1.0 + nearly), np.float32(0.0), np.float32(1.0)
    agreeing, compared = np.empty(BLOCK, np.float32), np.empty(BLOCK, np.float32)
    best = np.empty(BLOCK, np.float32)
    out[:] = -1.0
    turned[:] = 0
    for first in range(0, places, BLOCK):  # a block's sums stay in the nearest cache
        block = min(BLOCK, places - first)
        for turn in range(len(views)):
            compared[:] = zero
            best[:] = -one
            for i in range(directions):
                if seen[turn, i]:
                    also = known[i, first : first + block]
                    for k in range(block):
                        compared[k] += also[k]
            for point in range(views.shape[1]):
                agreeing[:] = zero
                for i in range(directions):
                    if not seen[turn, i]:
                        continue
                    length, at_most = views[turn, point, i], views_per_m[turn, point, i]
                    others, rates = (
                        lengths[i, first : first + block],
                        per_m[i, first : first + block],
                    )
                    for k in range(block):  # innermost, so that it is done for several at once
                        less = abs(length - others[k]) * min(at_most, rates[k])
                        agreeing[k] += min(one, max(zero, none - less))
                for k in range(block):
                    if compared[k] >= fewest:
                        best[k] = max(best[k], agreeing[k] / compared[k])
            for k in range(block):
                if best[k] > out[first + k]:
                    out[first + k] = best[k]
                    turned[first + k] = turn
