"""What a robot that believes to have been at a landmark expects to perceive where.

A *case* is one landmark that something may be, if a hypothesis about where the robot was is true.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from ssrics_like.memory.hypotheses import Here, Hypothesis
from ssrics_like.memory.links import Link
from ssrics_like.poses import Pose

FAR = 20.0
"""A landmark that much less probable here (logarithm) is as good as excluded; no number beyond."""
TURN_CAP = 3.0
"""A direction, however wrong, counts no more than this: now and then one is mismeasured."""
ASTRAY, ASTRAY_M = 0.05, 0.4
"""So often a landmark is perceived astray, and how far then (standard deviation)."""
UNDIRECTED_RAD2 = 10.0
"""Variance of a direction of which nothing is known."""


@dataclass(frozen=True)
class Uncertainty:
    """How well places and ways are known, standard deviations.

    Attributes
    ----------
    place_m, direction_rad : float
        Of where a landmark is perceived from one visit to the next, and in which direction.
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


class Case(NamedTuple):
    """A hypothesis, and which landmark this would be.

    Attributes
    ----------
    landmark : str
        Which.
    nats : float
        Minus the logarithm of how probable it is to perceive it here.
    before : Hypothesis
        The hypothesis.
    expected : Pose
        Where it lies, as expected before.
    known_m2 : float
        Variance of each coordinate of that, and of where the robot is.
    fix : Link
        The landmark's frame in that of path integration, now that it was perceived here.
    link : Link or None
        The landmark's frame in that of the one before; None if that is not known.
    """

    landmark: str
    nats: float
    before: Hypothesis
    expected: Pose
    known_m2: float
    fix: Link
    link: Link | None


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


def cases_near(
    hypothesis: Hypothesis, around: Mapping[str, Link], here: Here, sd: Uncertainty
) -> Iterator[Case]:
    """Compare where something is perceived with where each landmark is expected.

    Parameters
    ----------
    hypothesis : Hypothesis
        Of a landmark.
    around : mapping of str to Link
        Where others lie, seen from there.
    here : Here
        What was perceived.
    sd : Uncertainty
        How well that is known.

    Yields
    ------
    Case
        Those that are not as good as excluded.
    """
    drift = sd.since(hypothesis, here)
    # Seen from the landmark before; most lie far from there, and are done with quickly.
    seen = here.place.seen_from(hypothesis.fix.pose)
    for name, link in around.items():
        known_m2 = hypothesis.fix.variance_m2_after(link) + drift.variance_m2
        off_m2 = (seen.x_m - link.pose.x_m) ** 2 + (seen.y_m - link.pose.y_m) ** 2
        if off_m2 > 2.0 * FAR * (known_m2 + max(ASTRAY_M, sd.place_m) ** 2):
            continue
        nats = _nats_of_place(off_m2, known_m2, sd.place_m**2)
        if nats > FAR:
            continue
        expected = hypothesis.fix.and_then(link)
        known_rad2 = expected.variance_rad2 + drift.variance_rad2
        turn_rad = turn_gain = 0.0
        fixed_rad2 = known_rad2
        if here.directed:
            variance_rad2 = known_rad2 + sd.direction_rad**2
            # From the other side a doorway is the same, half a turn off.
            turn_rad = math.remainder(here.place.theta_rad - expected.pose.theta_rad, math.pi)
            nats += min(0.5 * turn_rad**2 / variance_rad2, TURN_CAP)
            turn_gain = known_rad2 / variance_rad2
            fixed_rad2 = turn_gain * sd.direction_rad**2
        gain = known_m2 / (known_m2 + sd.place_m**2)
        fix = Link(
            Pose(
                expected.pose.x_m + gain * (here.place.x_m - expected.pose.x_m),
                expected.pose.y_m + gain * (here.place.y_m - expected.pose.y_m),
                math.remainder(expected.pose.theta_rad + turn_gain * turn_rad, math.tau),
            ),
            gain * sd.place_m**2,
            fixed_rad2,
        )
        measured = Link(
            fix.pose.seen_from(hypothesis.fix.pose),
            max(hypothesis.fix.variance_m2 + drift.variance_m2, fix.variance_m2),
            min(hypothesis.fix.variance_rad2 + drift.variance_rad2, fix.variance_rad2),
        ).bounded
        yield Case(name, nats, hypothesis, expected.pose, known_m2, fix, measured)


def _nats_of_place(off_m2: float, known_m2: float, place_m2: float) -> float:
    """Return minus the logarithm of a density, of a place known for certain and hit being 1."""

    def nats(variance_m2: float) -> float:
        return 0.5 * off_m2 / variance_m2 + math.log(variance_m2 / place_m2)

    return -float(
        np.logaddexp(
            math.log(1.0 - ASTRAY) - nats(known_m2 + place_m2),
            math.log(ASTRAY) - nats(known_m2 + max(ASTRAY_M**2, place_m2)),
        )
    )


def cases_anywhere(
    hypothesis: Hypothesis, here: Here, landmark: str, of: int, sd: Uncertainty
) -> Iterator[Case]:
    """Take a landmark for as probable as every other of so many, from either side."""
    sides = (0.0, math.pi) if here.directed else (0.0,)
    nats = math.log(of * len(sides))
    place = here.place
    variance_rad2 = sd.direction_rad**2 if here.directed else UNDIRECTED_RAD2
    for side in sides:
        turned = Pose(place.x_m, place.y_m, math.remainder(place.theta_rad + side, math.tau))
        fix = Link(turned, sd.place_m**2, variance_rad2)
        yield Case(landmark, nats, hypothesis, turned, fix.variance_m2, fix, None)
