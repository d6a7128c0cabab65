"""How alike the surroundings of two places are, whichever way one went through them."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ssrics_like.memory.vistas import contradiction, gathered

if TYPE_CHECKING:
    from typing import Any

    from numpy.typing import NDArray

UNKNOWN_M = 1.0
"""A direction of which more is unknown is not compared."""
SAME_M, SAME = 0.35, 0.12
"""Two lengths that differ by the former, or by this share of the longer, if that is more, nearly
agree: 0.7 of wholly. They wholly agree if they differ by 0.7 of that or less, by 1.7 not at all."""
NEARLY = 0.7
ASIDE = 2
"""Directions by which one view may be turned: a doorway's own is known to twenty degrees only."""
AHEAD_M = (-0.3, 0.0, 0.3)
"""How far from the middle one may be looked at: a doorway is deep."""
REACH_M = 6.0
"""Views end there."""
FEWEST = 10
"""Fewer directions to compare say nothing."""
STRANGE = 0.5
"""Share of directions that agree in two places that are different (median of pairs of doorways in
simulated buildings, `benchmarks/bench_views.py`)."""
SIDES = 0.05
"""A place of which the two sides agree to so much looks the same from both."""
ALIKE = 0.6
"""Two views of one place that agree so far tell how one of them is turned."""


def agreement(view: NDArray[np.float32], places: NDArray[np.float32]) -> NDArray[np.float64]:
    """Return the share of directions in which surroundings agree; NaN where too few are known.

    One of them may be looked at from 0.3 m before or behind the middle, be turned by up to twenty
    degrees, and by half a turn. A direction agrees by 1 where two lengths are nearly the same, less
    where they differ more (`SAME_M`).

    Parameters
    ----------
    view : ndarray, shape (3 directions,)
        Of one place.
    places : ndarray, shape (n, 3 directions)
        Of others.

    Returns
    -------
    ndarray, shape (n,), float64
        The best of all ways of looking at it.
    """
    return np.asarray(np.fmax(*_agreement(view, by_direction(places))[0]))


class BothSides(NamedTuple):
    """How a view compares with places from the side from which each is remembered, and the other.

    Attributes
    ----------
    agreeing : ndarray, shape (2, n)
        As `agreement`.
    apart : ndarray, shape (2, n)
        As `vistas.contradiction`; 0 where no more surroundings agree than in different places.
    turned_rad : ndarray, shape (2, n)
        By how much the view is turned aside against what is remembered where they agree best.
    """

    agreeing: NDArray[np.float64]
    apart: NDArray[np.float64]
    turned_rad: NDArray[np.float64]


def both_sides(view: NDArray[np.float32], places: Places) -> BothSides:
    """Compare a view with places as they are remembered, and with their other sides.

    Parameters
    ----------
    view : ndarray, shape (3 directions,)
        Of one place.
    places : Places
        Others.

    Returns
    -------
    BothSides
    """
    agreeing, turns = _agreement(view, places)
    vista = view[2 * len(places.lengths) :]
    apart = np.zeros(agreeing.shape)
    for side, turned, found in zip(agreeing, turns, apart, strict=True):
        likely = np.flatnonzero(side > STRANGE)
        found[likely] = contradiction(vista, turned[likely], places.vistas[:, likely])
    directions = len(places.lengths)
    aside = turns - np.array([[0], [directions // 2]])
    return BothSides(agreeing, apart, aside * (2.0 * np.pi / directions))


def joined(
    remembered: NDArray[np.float32], seen: NDArray[np.float32], turn_rad: float
) -> NDArray[np.float32] | None:
    """Add to what is remembered of a place what is seen of it now.

    Parameters
    ----------
    remembered, seen : ndarray, shape (3 directions,)
        Views of one place.
    turn_rad : float
        By how much the frame in which it is seen is turned against the one remembered, nearly.

    Returns
    -------
    ndarray, shape (3 directions,), or None
        The view remembered; the one seen, where less of that is unknown; and the ends of both in
        the distance, those seen last. The one seen, if nothing was remembered. None if nothing is
        added, or they look too different to tell how exactly one is turned to the other.
    """
    lengths, unknown, vista = remembered.reshape(3, -1)
    if (unknown >= UNKNOWN_M).all():  # in the frame of the doorway, as all others are
        return seen if math.cos(turn_rad) >= 0.0 else _from_the_other_side(seen)
    agreeing, turns = _agreement(seen, by_direction(remembered[np.newaxis]))
    as_it_is, half_a_turn_aside = np.nan_to_num(agreeing[:, 0], nan=0.0).tolist()
    half = int(half_a_turn_aside > as_it_is)
    if abs(half_a_turn_aside - as_it_is) < SIDES:  # it looks the same from both sides
        half = int(math.cos(turn_rad) < 0.0)
    if not agreeing[half, 0] >= ALIKE:
        return None
    lengths_seen, unknown_seen, vista_seen = np.roll(seen.reshape(3, -1), turns[half, 0], axis=1)
    better = unknown_seen < unknown
    view = np.concatenate([
        np.where(better, lengths_seen, lengths),
        np.where(better, unknown_seen, unknown),
        gathered(vista, vista_seen),
    ])  # fmt: skip
    return None if np.array_equal(view, remembered) else view


def _from_the_other_side(view: NDArray[np.float32]) -> NDArray[np.float32]:
    sides = view.reshape(3, 2, -1)
    return np.ascontiguousarray(sides[:, ::-1]).ravel()


class Places(NamedTuple):
    """Surroundings of many places, by direction, shape (directions, places).

    Attributes
    ----------
    lengths : ndarray of float32
        Metres; infinite where unknown.
    per_m : ndarray of float32
        By how much a direction agrees less for each metre of difference.
    known : ndarray of float32
        1 for known, else 0.
    vistas : ndarray of float32
        Metres; 0 where nothing was seen.
    """

    lengths: NDArray[np.float32]
    per_m: NDArray[np.float32]
    known: NDArray[np.float32]
    vistas: NDArray[np.float32]


def by_direction(places: NDArray[np.float32]) -> Places:
    """Make ready what is remembered of places, shape (n, 3 directions), to be compared."""
    lengths, unknown, vistas = np.split(places.T, 3)
    known = unknown < UNKNOWN_M
    return Places(
        np.ascontiguousarray(np.where(known, lengths, np.float32(np.inf))),
        np.ascontiguousarray(_per_m(lengths)),
        np.ascontiguousarray(known, np.float32),
        np.ascontiguousarray(vistas),
    )


def _per_m(lengths: NDArray[np.floating[Any]]) -> NDArray[np.float32]:
    return np.asarray(1.0 / np.maximum(SAME_M, SAME * lengths), np.float32)


def _agreement(
    view: NDArray[np.float32], places: Places
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Compare a view with places as they are, and from their other sides.

    Returns
    -------
    agreeing, turns : ndarray, shape (2, n)
        As `agreement` for each of the two; by how many directions the view is turned then.
    """
    # Compiled code is loaded only where it is needed.
    from ssrics_like.memory import surroundings_kernels  # noqa: PLC0415

    directions = len(places.lengths)
    lengths = view[:directions].astype(np.float64)
    seen = view[directions : 2 * directions] < UNKNOWN_M
    looked = np.empty((len(AHEAD_M), directions))
    for ahead_m, out in zip(AHEAD_M, looked, strict=True):
        surroundings_kernels.looked_at_from(lengths, ahead_m, REACH_M, out)
    best = np.empty((2, places.lengths.shape[1]))
    turns = np.empty(best.shape, np.int64)
    for half, (shares, turned) in enumerate(zip(best, turns, strict=True)):
        asides = half * directions // 2 + np.array(sorted(range(-ASIDE, ASIDE + 1), key=abs))
        views = np.array([np.roll(looked, turn, axis=1) for turn in asides], np.float32)
        surroundings_kernels.best_agreements(
            views, _per_m(views), np.array([np.roll(seen, turn) for turn in asides]),
            *places[:3], NEARLY, FEWEST, shares, turned,
        )  # fmt: skip
        turned[:] = asides[turned]
    return np.where(best < 0.0, np.nan, best), turns
