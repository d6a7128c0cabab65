"""Hypotheses: where the robot may be, and how probable that is."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from ssrics_like.memory.links import Link
from ssrics_like.poses import Pose

PROVEN = 8
"""After so many landmarks that fitted, and if nothing else fits, a robot that was lost learns about
the graph again."""
MOST = 300
"""Hypotheses that are gone on with."""
BELOW = 9.0
"""A hypothesis that is so much less probable than the best (logarithm) is given up."""
ALIKE_M, ALIKE_RAD = 0.5, 0.3
"""Two hypotheses that have the landmark before so near, in so much the same direction, are one."""


class Here(NamedTuple):
    """Where something was perceived.

    Attributes
    ----------
    place : Pose
        By path integration.
    directed : bool
        Whether its direction is that of the place, as of a doorway, give or take half a turn.
    travelled_m, turned_rad : float
        Length of the path, and sum of all turns, by then.
    """

    place: Pose
    directed: bool
    travelled_m: float
    turned_rad: float


@dataclass(frozen=True)
class Hypothesis:
    """The robot was at a landmark, and came from there as path integration has it.

    Attributes
    ----------
    landmark : str or None
        None: it may be anywhere.
    fix : Link
        The landmark's frame in that of path integration.
    at : Here
        Where it was perceived then.
    weight : float
        Logarithm of the probability.
    met : int
        How many landmarks it has explained since the robot was lost; `PROVEN` at most.
    """

    landmark: str | None
    fix: Link
    at: Here
    weight: float
    met: int = PROVEN


_NOWHERE = Pose(0.0, 0.0, 0.0)
ANYWHERE = Hypothesis(None, Link(_NOWHERE, 0.0, 0.0), Here(_NOWHERE, False, 0.0, 0.0), 0.0, 0)
"""The robot may be at any landmark, or at none."""


def likely(hypotheses: Iterable[Hypothesis]) -> tuple[Hypothesis, ...]:
    """Return those that are worth going on with.

    Returns
    -------
    tuple of Hypothesis
        The most probable one first, of weight 0. Those that agree are taken together.
    """
    apart: dict[tuple[str | None, Here], list[Hypothesis]] = {}
    for one in sorted(hypotheses, key=_improbability):
        alike = apart.setdefault((one.landmark, one.at), [])
        for i, other in enumerate(alike):
            if _agree(one, other):
                weight = float(np.logaddexp(other.weight, one.weight))
                alike[i] = replace(other, weight=weight)
                break
        else:
            alike.append(one)
    kept = sorted((one for alike in apart.values() for one in alike), key=_improbability)
    best = kept[0].weight
    return tuple(replace(h, weight=h.weight - best) for h in kept[:MOST] if h.weight > best - BELOW)


def _improbability(hypothesis: Hypothesis) -> float:
    return -hypothesis.weight


def _agree(one: Hypothesis, other: Hypothesis) -> bool:
    a, b = one.fix.pose, other.fix.pose
    turn_rad = math.remainder(a.theta_rad - b.theta_rad, math.tau)
    return a.distance_m(b) < ALIKE_M and abs(turn_rad) < ALIKE_RAD
