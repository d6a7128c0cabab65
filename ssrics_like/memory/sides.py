"""From which side a landmark would be seen, and how turned, if it is what is seen."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from typing import NamedTuple, TypeAlias


class Side(NamedTuple):
    """What a landmark would look like from one side.

    Attributes
    ----------
    nats : float
        Logarithm of how probable it is to be seen from there, that of the more probable side being
        0.
    turn_rad : float or None
        By how much the direction perceived is turned against that of the landmark, as what is
        seen has it; None if it does not say.
    """

    nats: float = 0.0
    turn_rad: float | None = None


class Sides(NamedTuple):
    """What a landmark would look like from the side from which it was declared, and the other."""

    ahead: Side = Side()
    behind: Side = Side()


EITHER = Sides()
"""Those of a landmark of which nothing is known."""
SidesOf: TypeAlias = Callable[[Collection[str]], Mapping[str, Sides]]
"""Tells of landmarks what each would look like; leaves out those of which that is not known."""


def unseen(_landmarks: Collection[str]) -> Mapping[str, Sides]:
    """Say nothing of any landmark."""
    return {}
