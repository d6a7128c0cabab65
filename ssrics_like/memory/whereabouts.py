"""Whereabouts: at which landmark the robot believes to have been last, and what it expects where.

The robot knows by path integration where it is relative to the last landmark, and from its
links where other landmarks lie relative to that one. When in doubt it goes on with several
hypotheses, each a landmark and how the robot has come from there, until one is left.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import NamedTuple

from ssrics_like.memory.links import Link, Links
from ssrics_like.poses import Pose

MOST = 300
"""Hypotheses that are gone on with."""
BELOW = 9.0
"""A hypothesis that is so much less probable than the best (logarithm) is given up."""
FAR = 20.0
"""A landmark that much less probable here (logarithm) is as good as excluded; no number beyond."""
TURN_CAP = 3.0
"""A direction, however wrong, counts no more than this: now and then one is mismeasured."""
ELSEWHERE = 0.05
"""Weight of the hypothesis that the robot may be anywhere, beside that of a landmark that begins a
new part of the graph."""
ENOUGH = 3
"""A robot that was lost knows where it is when so many landmarks in a row fit: buildings have rows
of doorways that look alike."""
PROVEN = 8
"""Until so many have fitted, other hypotheses are gone on with, in case that it was a mistake."""
GIVEN_UP = 6
"""After so many landmarks in a row that it was unsure of, a robot that is lost takes the next one
that it does not know for new: it is somewhere that it has never been."""
UNDIRECTED_RAD2 = 10.0
"""Variance of a direction of which nothing is known."""


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
        How many landmarks it has explained since the robot was lost; 3 are enough, and 8 prove it.
    """

    landmark: str | None
    fix: Link
    at: Here
    weight: float
    met: int = PROVEN


_NOWHERE = Pose(0.0, 0.0, 0.0)
ANYWHERE = Hypothesis(None, Link(_NOWHERE, 0.0, 0.0), Here(_NOWHERE, False, 0.0, 0.0), 0.0, 0)
"""The robot may be at any landmark, or at none."""


class _Case(NamedTuple):
    """A hypothesis, and which landmark this would be."""

    landmark: str
    nats: float
    before: Hypothesis
    fix: Link
    link: Link | None  # from the landmark before


class Whereabouts:
    """What the robot believes about where it is.

    Parameters
    ----------
    uncertainty : Uncertainty
        How well it knows.
    links : Links
        Of the graph; recognising and finding landmarks adds to them.

    Attributes
    ----------
    hypotheses : tuple of Hypothesis
        The most probable one first; none before the first landmark.
    """

    def __init__(self, uncertainty: Uncertainty, links: Links) -> None:
        self.hypotheses: tuple[Hypothesis, ...] = ()
        self._sd = uncertainty
        self._links = links
        self._cases: list[_Case] = []
        self._doubts = 0

    @property
    def known(self) -> Hypothesis | None:
        """Where the robot most probably has been last; None while it is lost."""
        likeliest = self.hypotheses[0] if self.hypotheses else ANYWHERE
        return likeliest if likeliest.landmark is not None and likeliest.met >= ENOUGH else None

    def place_of(self, landmark: str) -> Link | None:
        """Tell where a landmark most probably is, in the frame of path integration.

        Returns
        -------
        Link or None
            None while the robot is lost, or if nothing leads from there to the landmark.
        """
        known = self.known
        if known is None or known.landmark is None:
            return None
        link = self._links.seen_from(known.landmark).get(landmark)
        return None if link is None else known.fix.and_then(link)

    def lose(self) -> None:
        """Give up all hypotheses: the robot may be anywhere."""
        self.hypotheses = (ANYWHERE,)
        self._doubts = 0

    def settled(self, landmark: str | None) -> bool:
        """Tell whether the robot, if it was lost, knows enough to say which landmark this is.

        Parameters
        ----------
        landmark : str or None
            Which; None for a new one.
        """
        likeliest = self.hypotheses[0] if self.hypotheses else ANYWHERE
        if landmark is None:
            known = likeliest.landmark is None or likeliest.met >= ENOUGH
            return known or self._doubts >= GIVEN_UP
        case = self._likeliest(landmark)
        return (likeliest.met if case is None else case.before.met + 1) >= ENOUGH

    def expect(self, here: Here, landmarks: Iterable[str]) -> dict[str, float]:
        """Tell how improbable each landmark is here.

        Parameters
        ----------
        here : Here
            What was perceived.
        landmarks : iterable of str
            All there are; gone through only if the robot may be anywhere.

        Returns
        -------
        dict
            By landmark: ``-ln(p / p0)``, p being the probability density of perceiving it here and
            p0 that of perceiving it where it is, if all were known for certain; none is above 20,
            and a landmark that is not in it counts 20.
        """
        lost = any(hypothesis.landmark is None for hypothesis in self.hypotheses)
        names = list(landmarks) if lost else []
        around: dict[str, dict[str, Link]] = {}
        total = sum(math.exp(hypothesis.weight) for hypothesis in self.hypotheses)
        odds: dict[str, float] = {}
        self._cases = []
        for hypothesis in self.hypotheses:
            landmark = hypothesis.landmark
            if landmark is None:
                cases = self._anywhere(hypothesis, here, names)
            else:
                if landmark not in around:
                    around[landmark] = self._links.seen_from(landmark)
                cases = self._near(hypothesis, around[landmark], here)
            self._cases += cases
            for case in cases:
                p = math.exp(hypothesis.weight - case.nats) / total
                odds[case.landmark] = odds.get(case.landmark, 0.0) + p
        return {name: min(-math.log(p), FAR) for name, p in odds.items() if p > 0.0}

    def recognise(
        self, landmark: str, here: Here, evidence: Mapping[str, float], new: float
    ) -> Hypothesis | None:
        """Be at a landmark that is known; return where the robot came from, if that is known.

        If it came from another one, how the two lie from each other is learned. A robot that was
        lost learns nothing until it is proven that it was right.

        Parameters
        ----------
        landmark : str
            Which.
        here, evidence, new : as for `doubt`
        """
        case = self._likeliest(landmark)
        if case is not None and case.before.met + 1 < PROVEN:
            self.doubt(here, evidence, new)
            self._doubts = 0
            return None
        self._doubts = 0
        if case is None:  # recognised without being expected
            self.hypotheses = (Hypothesis(landmark, Link(here.place, 0.0, 0.0), here, 0.0),)
            return None
        before = case.before
        if before.landmark is not None and before.landmark != landmark and case.link is not None:
            self._links.relate(before.landmark, landmark, case.link)
        self.hypotheses = (Hypothesis(landmark, case.fix, here, 0.0),)
        return before if before.landmark is not None else None

    def find(self, landmark: str, here: Here) -> Hypothesis | None:
        """Be at a new landmark; return where the robot came from, if that is known.

        The new landmark's frame is the place as it is perceived now.
        """
        self._doubts = 0
        before = self.hypotheses[0] if self.hypotheses else None
        new = Hypothesis(landmark, Link(here.place, 0.0, 0.0), here, 0.0)
        if before is None or before.landmark is None or before.met < ENOUGH:
            elsewhere = replace(ANYWHERE, weight=math.log(ELSEWHERE))
            self.hypotheses = (new,) if before is None else (new, elsewhere)
            return None
        drift = self._drift(before, here)
        link = Link(
            here.place.seen_from(before.fix.pose),
            before.fix.variance_m2 + drift.variance_m2,
            before.fix.variance_rad2 + drift.variance_rad2,
        )
        self._links.relate(before.landmark, landmark, link.bounded)
        self.hypotheses = (new,)
        return before

    def doubt(self, here: Here, evidence: Mapping[str, float], new: float) -> None:
        """Be at one of several landmarks, or at a new one: go on with all hypotheses.

        Parameters
        ----------
        here : Here
            As for `expect`, which must have been called.
        evidence : mapping of str to float
            By landmark: logarithm of how probable it is by everything but its place.
        new : float
            The same for a place that is no landmark yet.
        """
        self._doubts += 1
        grown = [
            Hypothesis(
                case.landmark, case.fix, here,
                case.before.weight - case.nats + evidence[case.landmark],
                min(case.before.met + 1, PROVEN),
            )
            for case in self._cases if case.landmark in evidence
        ]  # fmt: skip
        grown += [replace(h, weight=h.weight + new) for h in self.hypotheses]
        grown.sort(key=lambda hypothesis: -hypothesis.weight)
        best = grown[0].weight
        self.hypotheses = tuple(
            replace(h, weight=h.weight - best) for h in grown[:MOST] if h.weight > best - BELOW
        )

    def _likeliest(self, landmark: str) -> _Case | None:
        """Return the likeliest way in which this can be a landmark."""
        cases = (case for case in self._cases if case.landmark == landmark)
        return max(cases, key=lambda case: case.before.weight - case.nats, default=None)

    def _near(self, hypothesis: Hypothesis, around: Mapping[str, Link], here: Here) -> list[_Case]:
        """Compare the place with where each landmark is expected."""
        sd = self._sd
        drift = self._drift(hypothesis, here)
        cases = []
        for name, link in around.items():
            expected = hypothesis.fix.and_then(link)
            known_m2 = expected.variance_m2 + drift.variance_m2
            variance_m2 = known_m2 + sd.place_m**2
            squared = expected.pose.distance_m(here.place) ** 2
            nats = 0.5 * squared / variance_m2 + math.log(variance_m2 / sd.place_m**2)
            if nats > FAR:
                continue
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
            gain = known_m2 / variance_m2
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
            cases.append(_Case(name, nats, hypothesis, fix, measured))
        return cases

    def _anywhere(self, hypothesis: Hypothesis, here: Here, names: list[str]) -> list[_Case]:
        """Take every landmark for equally probable, from either side."""
        sides = (0.0, math.pi) if here.directed else (0.0,)
        nats = math.log(max(len(names), 1) * len(sides))
        return [
            _Case(
                name, nats, hypothesis,
                Link(
                    Pose(
                        here.place.x_m, here.place.y_m,
                        math.remainder(here.place.theta_rad + side, math.tau),
                    ),
                    self._sd.place_m**2,
                    self._sd.direction_rad**2 if here.directed else UNDIRECTED_RAD2,
                ),
                None,
            )
            for name in names for side in sides
        ]  # fmt: skip

    def _drift(self, hypothesis: Hypothesis, here: Here) -> Link:
        """Return how uncertain path integration has become since."""
        sd = self._sd
        way_m = max(here.travelled_m - hypothesis.at.travelled_m, 0.0)
        turned = max(here.turned_rad - hypothesis.at.turned_rad, 0.0)
        variance_rad2 = sd.swerve_rad**2 * way_m + sd.turn_rad**2 * turned + (sd.bias * turned) ** 2
        away_m = min(hypothesis.fix.pose.distance_m(here.place), 0.5 * way_m)
        variance_m2 = sd.drift**2 * way_m + (sd.bias * way_m) ** 2 + 0.5 * variance_rad2 * away_m**2
        return Link(Pose(0.0, 0.0, 0.0), variance_m2, variance_rad2)
