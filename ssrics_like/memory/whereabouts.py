"""Whereabouts: at which landmark the robot believes to have been last, and what it expects where.

The robot knows by path integration where it is relative to the last landmark, and from its
links where other landmarks lie relative to that one. When in doubt it goes on with several
hypotheses, each a landmark and how the robot has come from there, until one is left.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from dataclasses import replace

from ssrics_like.memory.expectation import (
    ANYWHERE,
    FAR,
    PROVEN,
    Case,
    Expected,
    Here,
    Hypothesis,
    Uncertainty,
    cases_anywhere,
    cases_near,
)
from ssrics_like.memory.links import Link, Links
from ssrics_like.poses import Pose

MOST = 300
"""Hypotheses that are gone on with."""
BELOW = 9.0
"""A hypothesis that is so much less probable than the best (logarithm) is given up."""
ELSEWHERE = 0.05
"""Weight of the hypothesis that the robot may be anywhere, beside that of a landmark that begins a
new part of the graph."""
SURE = 0.95
"""So sure a robot that was lost must be of a landmark until its whereabouts are proven: buildings
have rows of doorways that look alike."""
ENOUGH = 3
"""It relies on where it believes to be when so many have fitted."""
SAME_PLACE_M = 1.0
"""What is perceived so near to the place marked last is the same place."""
GIVEN_UP = 6
"""After so many landmarks in a row that it was unsure of, a robot that is lost takes the next one
that it does not know for new: it is somewhere that it has never been."""
_NO_LANDMARKS: Collection[str] = ()


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
        self._here, self._landmarks = ANYWHERE.at, _NO_LANDMARKS
        self._near: list[Case] = []
        self._marked: Pose | None = None
        self._again = False
        self._doubts = 0

    @property
    def known(self) -> Hypothesis | None:
        """Where the robot most probably has been last; None while it is lost."""
        likeliest = self.hypotheses[0] if self.hypotheses else ANYWHERE
        return likeliest if likeliest.landmark is not None and likeliest.met >= ENOUGH else None

    @property
    def proven(self) -> Hypothesis | None:
        """The same, if enough landmarks have fitted to learn something about the graph."""
        known = self.known
        return known if known is not None and known.met >= PROVEN else None

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
        self._marked = None
        self._doubts = 0

    def settled(self, landmark: str | None, share: float) -> bool:
        """Tell whether the robot, if it was lost, knows enough to say which landmark this is.

        Parameters
        ----------
        landmark : str or None
            Which; None for a new one.
        share : float
            How probable that is.
        """
        likeliest = self.hypotheses[0] if self.hypotheses else ANYWHERE
        if landmark is None:
            known = likeliest.landmark is None or likeliest.met >= ENOUGH
            return known or self._doubts >= GIVEN_UP
        case = self._likeliest(landmark)
        met = likeliest.met if case is None else self._met(case)
        return met >= PROVEN or (met > 0 and share >= SURE)

    def expect(self, here: Here, landmarks: Collection[str]) -> Expected:
        """Tell how improbable each landmark is here.

        Parameters
        ----------
        here : Here
            What was perceived.
        landmarks : collection of str
            All there are.
        """
        self._here, self._landmarks = here, landmarks
        self._again = (
            self._marked is not None and self._marked.distance_m(here.place) < SAME_PLACE_M
        )
        if self._again:
            self._look_anew()
        around: dict[str, Mapping[str, Link]] = {}
        total = sum(math.exp(hypothesis.weight) for hypothesis in self.hypotheses)
        odds: dict[str, float] = {}
        anywhere = 0.0
        self._near = []
        for hypothesis in self.hypotheses:
            landmark = hypothesis.landmark
            if landmark is None:
                anywhere += math.exp(hypothesis.weight) / total / max(len(landmarks), 1)
                continue
            if landmark not in around:
                around[landmark] = self._links.seen_from(landmark)
            cases = list(cases_near(hypothesis, around[landmark], here, self._sd))
            self._near += cases
            for case in cases:
                p = math.exp(hypothesis.weight - case.nats) / total
                odds[case.landmark] = odds.get(case.landmark, 0.0) + p
        nats = {name: _nats(p + anywhere) for name, p in odds.items()}
        return Expected(nats, _nats(anywhere))

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
        if case is not None and self._met(case) < PROVEN:
            self.doubt(here, evidence, new)
            self._doubts = 0
            return None
        self._doubts = 0
        self._marked = here.place
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
        self._marked = here.place
        before = self.hypotheses[0] if self.hypotheses else None
        new = Hypothesis(landmark, Link(here.place, 0.0, 0.0), here, 0.0)
        if before is None or before.landmark is None or before.met < ENOUGH:
            elsewhere = replace(ANYWHERE, weight=math.log(ELSEWHERE))
            self.hypotheses = (new,) if before is None else (new, elsewhere)
            return None
        drift = self._sd.since(before, here)
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
            As for `expect`, which must have been called with it.
        evidence : mapping of str to float
            By landmark: logarithm of how probable it is by everything but its place.
        new : float
            The same for a place that is no landmark yet.
        """
        self._doubts += 1
        self._marked = here.place
        if not self.hypotheses:  # before the first landmark there is nothing to be in doubt about
            return
        cases = [case for case in self._near if case.landmark in evidence]
        if any(hypothesis.landmark is None for hypothesis in self.hypotheses):
            lookalikes = {name: nats for name, nats in evidence.items() if name in self._landmarks}
            best = max(lookalikes.values(), default=0.0)
            for name, nats in lookalikes.items():
                if nats > best - BELOW:  # the others would be given up anyway
                    cases += self._from_anywhere(name)
        grown = [
            Hypothesis(
                case.landmark, case.fix, here,
                case.before.weight - case.nats + evidence[case.landmark],
                self._met(case), evidence[case.landmark],
            )
            for case in cases
        ]  # fmt: skip
        grown += [replace(h, weight=h.weight + new, seen=0.0) for h in self.hypotheses]
        grown.sort(key=lambda hypothesis: -hypothesis.weight)
        best = grown[0].weight
        self.hypotheses = tuple(
            replace(h, weight=h.weight - best) for h in grown[:MOST] if h.weight > best - BELOW
        )

    def _from_anywhere(self, landmark: str) -> list[Case]:
        """Return the cases that this is a landmark, and the robot was anywhere before."""
        of = len(self._landmarks)
        return [
            case
            for hypothesis in self.hypotheses if hypothesis.landmark is None
            for case in cases_anywhere(hypothesis, self._here, landmark, of, self._sd)
        ]  # fmt: skip

    def _look_anew(self) -> None:
        """Take back what the place looked like: it is seen again, and counts only once."""
        again = [replace(h, weight=h.weight - h.seen, seen=0.0) for h in self.hypotheses]
        best = max((h.weight for h in again), default=0.0)
        again = [replace(h, weight=h.weight - best) for h in again]
        self.hypotheses = tuple(sorted(again, key=lambda h: -h.weight))

    def _met(self, case: Case) -> int:
        """Return how many landmarks have fitted if this is the case; the same one counts once."""
        same = self._again and case.before.landmark == case.landmark
        return min(case.before.met + (0 if same else 1), PROVEN)

    def _likeliest(self, landmark: str) -> Case | None:
        """Return the likeliest way in which this can be a landmark."""
        cases = [case for case in self._near if case.landmark == landmark]
        if landmark in self._landmarks:
            cases += self._from_anywhere(landmark)
        return max(cases, key=lambda case: case.before.weight - case.nats, default=None)


def _nats(p: float) -> float:
    return min(-math.log(p), FAR) if p > 0.0 else FAR
