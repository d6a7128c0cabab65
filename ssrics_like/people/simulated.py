"""Participants who mark by signal detection: data of which the truth is known.

References
----------
Green and Swets (1966), "Signal detection theory and psychophysics"; Macmillan and Creelman (2005),
"Detection theory: a user's guide".
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ssrics_like.comparison.matching import points
from ssrics_like.world.choices import Choice


@dataclass(frozen=True, slots=True)
class Participants:
    """How participants choose.

    Attributes
    ----------
    count : int
        How many.
    sensitivity : float
        d': how far the evidence at a target lies above that elsewhere, in standard deviations.
    criterion : float
        A place is marked where the evidence is greater; measured from the mean elsewhere.
    noise_m : float
        Standard deviation of a mark about its place, along either axis, metres.
    shared : float
        Share of the variance of the evidence that all participants have in common, 0 to 1: what
        makes one doorway more striking than the next, to everybody.
    """

    count: int
    sensitivity: float
    criterion: float
    noise_m: float
    shared: float

    @property
    def bias(self) -> float:
        """The criterion c of `ssrics_like.people.hits`, measured from halfway: criterion - d'/2."""
        return self.criterion - self.sensitivity / 2.0


def shared_evidence(places: int, generator: np.random.Generator) -> NDArray[np.float64]:
    """Draw what all participants have in common at each place, standard normal."""
    return generator.standard_normal(places)


def decisions(
    who: Participants,
    is_target: ArrayLike,
    common: ArrayLike,
    generator: np.random.Generator,
) -> NDArray[np.bool_]:
    """Let each participant stand at each place, and mark it or not.

    The evidence is d' at a target and 0 elsewhere, plus sqrt(shared) times what is common at the
    place, plus sqrt(1 - shared) times a normal deviate of the participant's own.

    Parameters
    ----------
    who : Participants
        How they choose.
    is_target : array_like of bool, shape (places,)
        Which places are targets.
    common : array_like, shape (places,)
        From `shared_evidence`.
    generator : numpy.random.Generator
        Source of the participants' own evidence.

    Returns
    -------
    ndarray of bool, shape (count, places)
    """
    target = np.asarray(is_target, bool)
    own = generator.standard_normal((who.count, len(target)))
    evidence = (
        who.sensitivity * target
        + np.sqrt(who.shared) * np.asarray(common, np.float64)
        + np.sqrt(1.0 - who.shared) * own
    )
    return np.asarray(evidence > who.criterion)


def simulated_choices(
    who: Participants,
    targets: ArrayLike,
    others: ArrayLike,
    generator: np.random.Generator,
) -> tuple[Choice, ...]:
    """Let participants choose among places.

    Parameters
    ----------
    who : Participants
        How they choose.
    targets, others : array_like, shape (n, 2)
        Places that are targets, and places that are not, metres.
    generator : numpy.random.Generator
        Source of all evidence and of the placement noise.

    Returns
    -------
    tuple of Choice
        Participant by participant, P01, P02, ...; a participant who marked nothing has none.
    """
    places = np.vstack([points(targets), points(others)])
    is_target = np.arange(len(places)) < len(points(targets))
    marked = decisions(who, is_target, shared_evidence(len(places), generator), generator)
    away_m = who.noise_m * generator.standard_normal((*marked.shape, 2))
    width = max(2, len(str(who.count)))
    found = []
    for person, row in enumerate(marked):
        for number, place in enumerate(np.flatnonzero(row).tolist(), 1):
            x_m, y_m = (places[place] + away_m[person, place]).tolist()
            found.append(Choice(f"P{person + 1:0{width}d}", f"m{number}", x_m, y_m))
    return tuple(found)
