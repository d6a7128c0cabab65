"""How well a robot knows its ways, and how improbable each landmark is in a place."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from ssrics_like.memory.hypotheses import Here, Hypothesis
from ssrics_like.memory.links import Link
from ssrics_like.poses import Pose

FAR = 20.0
"""A landmark that much less probable here (logarithm) is as good as excluded; no number beyond."""


@dataclass(frozen=True)
class Uncertainty:
    """How well places and ways are known, standard deviations.

    Attributes
    ----------
    place_m, direction_rad : float
        Of where a landmark is perceived from one visit to the next, and in which direction, by its
        jambs alone.
    drift : float
        Of position, per square root of the metres of path.
    swerve_rad, turn_rad : float
        Of heading, per square root of the metres of path and of the radians turned.
    bias : float
        Share by which ways and turns are mismeasured throughout.
    """

    place_m: float
    direction_rad: float
    drift: float
    swerve_rad: float
    turn_rad: float
    bias: float = 0.0

    def since(self, hypothesis: Hypothesis, here: Here) -> Link:
        """Return how uncertain path integration has become since a hypothesis' landmark."""
        way_m = max(here.travelled_m - hypothesis.at.travelled_m, 0.0)
        turned = max(here.turned_rad - hypothesis.at.turned_rad, 0.0)
        variance_rad2 = (
            self.swerve_rad**2 * way_m + self.turn_rad**2 * turned + (self.bias * turned) ** 2
        )
        away_m = min(hypothesis.fix.pose.distance_m(here.place), 0.5 * way_m)
        variance_m2 = (
            self.drift**2 * way_m + (self.bias * way_m) ** 2 + 0.5 * variance_rad2 * away_m**2
        )
        return Link(Pose(0.0, 0.0, 0.0), variance_m2, variance_rad2)


@dataclass(frozen=True)
class Expected:
    """How improbable each landmark is in a place: ``-ln(p / p0)``, `FAR` at most.

    p is the probability density of perceiving it there, p0 that of perceiving it where it is, if
    all were known for certain.

    Attributes
    ----------
    nats : mapping of str to float
        By landmark, of those that are expected somewhere near.
    elsewhere : float
        The same for each of all others.
    """

    nats: Mapping[str, float] = field(default_factory=dict)
    elsewhere: float = FAR

    def __getitem__(self, landmark: str) -> float:
        """Return how improbable a landmark is."""
        return self.nats.get(landmark, self.elsewhere)
