"""How alike the surroundings of two places are, whichever way one went through them."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ssrics_like.memory.vistas import contradiction, gathered

if TYPE_CHECKING:
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


def both_sides(view: NDArray[np.float32], places: Places, *, exact: bool = True) -> BothSides:
    """Compare a view with places as they are remembered, and with their other sides.

    Parameters
    ----------
    view : ndarray, shape (3 directions,)
        Of one place.
    places : Places
        Others.
    exact : bool, optional
        Whether it is told of different places how far they agree; else only that it is no more
        than `STRANGE`. That takes less time.

    Returns
    -------
    BothSides
    """
    agreeing, turns = _agreement(view, places, exact=exact)
    directions = places.lengths.shape[1]
    vista = view[2 * directions :]
    apart = np.zeros(agreeing.shape)
    for side, turned, found in zip(agreeing, turns, apart, strict=True):
        likely = np.flatnonzero(side > STRANGE)
        found[likely] = contradiction(vista, turned[likely], places.vistas[likely].T)
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
    """Surroundings of many places, made ready to be compared direction by direction.

    Attributes
    ----------
    lengths : ndarray of float32, shape (places, directions)
        Metres; beyond all others where unknown.
    levels : ndarray of uint8, shape (places, directions)
        The same in whole steps, `LEVELS` where unknown.
    vistas : ndarray of float32, shape (places, directions)
        Metres; 0 where nothing was seen.
    """

    lengths: NDArray[np.float32]
    levels: NDArray[np.uint8]
    vistas: NDArray[np.float32]

    def and_these(self, others: Places) -> Places:
        """Return these places and others after them."""
        return Places(
            np.concatenate([self.lengths, others.lengths]),
            np.concatenate([self.levels, others.levels]),
            np.concatenate([self.vistas, others.vistas]),
        )

    def replace(self, row: int, one: Places) -> None:
        """Put another place in a row."""
        self.lengths[row] = one.lengths[0]
        self.levels[row] = one.levels[0]
        self.vistas[row] = one.vistas[0]


def by_direction(places: NDArray[np.float32]) -> Places:
    """Make ready what is remembered of places, shape (n, 3 directions), finite, to be compared."""
    # Compiled code is loaded only where it is needed.
    from ssrics_like.memory.surroundings_bounds import LEVEL_M, LEVELS  # noqa: PLC0415
    from ssrics_like.memory.surroundings_kernels import HIDDEN_M  # noqa: PLC0415

    lengths, unknown, vistas = np.split(places, 3, axis=1)
    known = unknown < UNKNOWN_M
    levels = np.clip(lengths / np.float32(LEVEL_M), 0, LEVELS - 1)
    return Places(
        np.where(known, lengths, np.float32(HIDDEN_M)),
        np.where(known, levels, LEVELS).astype(np.uint8),
        vistas.copy(),
    )


def _agreement(
    view: NDArray[np.float32], places: Places, *, exact: bool = True
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Compare a view with places as they are, and from their other sides.

    Returns
    -------
    agreeing, turns : ndarray, shape (2, n)
        As `agreement` for each of the two; by how many directions the view is turned then.
    """
    # Compiled code is loaded only where it is needed.
    from ssrics_like.memory import surroundings_kernels  # noqa: PLC0415
    from ssrics_like.memory.surroundings_bounds import MOST  # noqa: PLC0415

    n, directions = places.lengths.shape
    if directions > MOST:
        raise ValueError(f"views of {directions} directions: at most {MOST} can be compared")
    lengths = view[:directions].astype(np.float64)
    seen = view[directions : 2 * directions] < UNKNOWN_M
    looked = np.empty((len(AHEAD_M), directions))
    for ahead_m, out in zip(AHEAD_M, looked, strict=True):
        surroundings_kernels.looked_at_from(lengths, ahead_m, REACH_M, out)
    best, turns = np.empty((2, n)), np.empty((2, n), np.int64)
    asides = np.array(sorted(range(-ASIDE, ASIDE + 1), key=abs))
    surroundings_kernels.best_agreements(
        looked.astype(np.float32), seen, asides, places.lengths, places.levels,
        SAME_M, SAME, NEARLY, FEWEST, STRANGE, exact, best, turns,
    )  # fmt: skip
    return np.where(best < 0.0, np.nan, best), turns
