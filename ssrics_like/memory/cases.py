"""What a robot that believes to have been at a landmark expects to perceive where.

A *case* is one landmark that something may be, if a hypothesis about where the robot was is true.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from typing import NamedTuple

from ssrics_like.memory.expectation import FAR, Uncertainty
from ssrics_like.memory.hypotheses import Here, Hypothesis
from ssrics_like.memory.links import Link
from ssrics_like.memory.measurement import ASTRAY_M, measured
from ssrics_like.memory.sides import EITHER, Side, Sides, SidesOf
from ssrics_like.poses import Pose

TURNED_RAD = 0.1
"""How exactly a view tells how the robot is turned (standard deviation); the jambs alone tell it
less exactly, by `Uncertainty.direction_rad`."""
UNDIRECTED_RAD2 = 10.0
"""Variance of a direction of which nothing is known."""


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
    onward : Link or None
        Where it was expected, seen from the one before; None if that is not known.
    turned_rad : float
        By how much the frame of the one before is turned against what was believed.
    """

    landmark: str
    nats: float
    before: Hypothesis
    expected: Pose
    known_m2: float
    fix: Link
    onward: Link | None = None
    turned_rad: float = 0.0

    def link(self, drift: Link) -> Link:
        """Return where the landmark lies, seen from the one before, as it was perceived now.

        Parameters
        ----------
        drift : Link
            How far path integration has gone astray since.
        """
        before, fix = self.before.fix, self.fix
        at = before.pose
        turned = Pose(at.x_m, at.y_m, at.theta_rad + self.turned_rad)
        return Link(
            fix.pose.seen_from(turned),
            max(before.variance_m2 + drift.variance_m2, fix.variance_m2),
            min(before.variance_rad2 + drift.variance_rad2, fix.variance_rad2),
        ).bounded


def cases_near(
    hypotheses: Iterable[Hypothesis],
    around: Callable[[str], Mapping[str, Link]],
    here: Here,
    sd: Uncertainty,
    sides_of: SidesOf,
) -> list[Case]:
    """Compare where something is perceived with where each landmark is expected.

    Parameters
    ----------
    hypotheses : iterable of Hypothesis
        Of a landmark, or of none; the latter expect nothing.
    around : callable
        Tells of a landmark where others lie, seen from there.
    here : Here
        What was perceived.
    sd : Uncertainty
        How well that is known.
    sides_of : callable
        Tells of landmarks from which side each would be seen.

    Returns
    -------
    list of Case
        Those that are not as good as excluded.
    """
    found = [
        case
        for hypothesis in hypotheses if hypothesis.landmark is not None
        for case in _by_place(hypothesis, around(hypothesis.landmark), here, sd)
    ]  # fmt: skip
    if not here.directed:
        return found
    sides = sides_of(dict.fromkeys(case.landmark for case in found))
    return [_by_direction(case, here, sd, sides.get(case.landmark, EITHER)) for case in found]


def _by_place(
    hypothesis: Hypothesis, around: Mapping[str, Link], here: Here, sd: Uncertainty
) -> Iterator[Case]:
    """Yield what there may be by its place alone."""
    before, drift = hypothesis.fix, sd.since(hypothesis, here)
    # Seen from the landmark before; most lie far from there, and are done with quickly.
    seen = here.place.seen_from(before.pose)
    for name, link in around.items():
        known_m2 = before.variance_m2_after(link) + drift.variance_m2
        off_m2 = (seen.x_m - link.pose.x_m) ** 2 + (seen.y_m - link.pose.y_m) ** 2
        if off_m2 > 2.0 * FAR * (known_m2 + max(ASTRAY_M, sd.place_m) ** 2):
            continue
        nats, fix, turned_rad = measured(before, link, drift, here.place, sd.place_m)
        if nats < FAR:
            expected = before.pose.onward(link.pose)
            yield Case(name, nats, hypothesis, expected, known_m2, fix, link, turned_rad)


def _by_direction(case: Case, here: Here, sd: Uncertainty, seen: Sides) -> Case:
    """Return the same, given its direction and from which side it looks like what is seen.

    From the other side a doorway is the same, half a turn off. Both sides count for how probable it
    is; where it lies, and how it is turned, is told by the more probable one.
    """
    assert case.onward is not None
    before, drift, place = case.before.fix, sd.since(case.before, here), here.place
    found = []
    for half_rad, side in zip((0.0, math.pi), seen, strict=True):
        theta_rad = place.theta_rad + half_rad - (side.turn_rad or 0.0)
        at = Pose(place.x_m, place.y_m, theta_rad)
        if_so = measured(before, case.onward, drift, at, sd.place_m, _told_rad(side, sd))
        found.append(if_so._replace(nats=if_so.nats - side.nats))
    one, other = sorted(found, key=lambda side: side.nats)
    nats = one.nats - math.log1p(math.exp(one.nats - other.nats))
    return case._replace(nats=nats, fix=one.fix, turned_rad=one.turned_rad)


def _told_rad(side: Side, sd: Uncertainty) -> float:
    """Return how exactly a direction is perceived from a side (standard deviation)."""
    by_jambs = sd.direction_rad
    return by_jambs if side.turn_rad is None else min(TURNED_RAD, by_jambs)


def cases_anywhere(
    hypotheses: Iterable[Hypothesis],
    here: Here,
    landmarks: Collection[str],
    of: int,
    sd: Uncertainty,
    sides_of: SidesOf,
) -> list[Case]:
    """Take some landmarks for as probable as every other of so many, from either side.

    Parameters
    ----------
    hypotheses : iterable of Hypothesis
        Those of none count.
    here, sd, sides_of : as for `cases_near`
    landmarks : collection of str
        Which.
    of : int
        How many there are.
    """
    lost = [hypothesis for hypothesis in hypotheses if hypothesis.landmark is None]
    if not lost:
        return []
    seen = sides_of(landmarks) if here.directed else {}
    halves = (0.0, math.pi) if here.directed else (0.0,)
    x_m, y_m, theta_rad = here.place.x_m, here.place.y_m, here.place.theta_rad
    found = []
    for name in landmarks:
        for half_rad, side in zip(halves, seen.get(name, EITHER), strict=False):
            turned_rad = math.remainder(theta_rad + half_rad - (side.turn_rad or 0.0), math.tau)
            sd_rad = _told_rad(side, sd)
            variance_rad2 = sd_rad**2 if here.directed else UNDIRECTED_RAD2
            fix = Link(Pose(x_m, y_m, turned_rad), sd.place_m**2, variance_rad2)
            nats = math.log(of * len(halves)) - side.nats
            found += [Case(name, nats, h, fix.pose, fix.variance_m2, fix) for h in lost]
    return found
