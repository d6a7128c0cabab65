"""What a comparison of people and robots is made with."""

from __future__ import annotations

from dataclasses import dataclass

RADIUS_M = 1.0
BIN_M = 1.0
BIN_LEAST_M = 0.1
"""Nobody marks more closely, and the bins of a building would be too many."""
SEED = 1
RESAMPLES = 2000
CONSENSUS = 0.5
"""A unit is people's consensus if at least this share of them marked it."""


@dataclass(frozen=True, slots=True)
class Settings:
    """What a comparison is made with.

    Attributes
    ----------
    radius_m : float
        How near a mark has to lie to a location, or to the route.
    bin_m : float
        Length of a bin of the route.
    seed : int
        Of the resampling, and of the marks that know nothing.
    resamples : int
        How often participants and runs are drawn anew for an interval.
    """

    radius_m: float = RADIUS_M
    bin_m: float = BIN_M
    seed: int = SEED
    resamples: int = RESAMPLES
