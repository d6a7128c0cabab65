"""Whereabouts: at which landmark the robot believes to have been last, and what it expects where.

The robot knows by path integration where it is relative to the last landmark, and from its
links where other landmarks lie relative to that one. When in doubt it goes on with several
hypotheses, each a landmark and how the robot has come from there, until one is left.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Collection, Iterable, Mapping
from dataclasses import replace

from ssrics_like.memory.cases import Case, cases_anywhere, cases_near
from ssrics_like.memory.expectation import FAR, Expected, Uncertainty
from ssrics_like.memory.hypotheses import ANYWHERE, BELOW, PROVEN, Here, Hypothesis, likely
from ssrics_like.memory.links import Link, Links
from ssrics_like.memory.sides import SidesOf, unseen
from ssrics_like.poses import Pose

ELSEWHERE = 0.05
"""Weight of the hypothesis that the robot may be anywhere, beside that of a landmark that begins a
new part of the graph, or of being where it is said to begin."""
SURE = (0.97, 0.97, 0.93, 0.9)
"""So sure a robot that was lost must be of a landmark until its whereabouts are proven, if it is
the first that fits, the second, the third, or a later one: buildings have rows of doorways that
look alike."""
PROOF = 6.0
"""Nothing else fits if it is so much less probable (logarithm)."""
ENOUGH = 3
"""The robot relies on where it believes to be when so many landmarks have fitted."""
SAME_PLACE_M = 1.0
"""What is perceived so near to the place marked last is the same place."""
BESIDE_M, DOORWAY_M = 0.3, 0.85
"""What is perceived so far from where a landmark is known to lie, at least and at most, may be that
landmark, perceived astray: two doorways do not lie nearer to each other than they are wide. Where
it lies must be known to the former (standard deviation)."""
GIVEN_UP = 6
"""After so many landmarks in a row that it was unsure of, a robot that is lost takes the next one
that it does not know for new: it is somewhere that it has never been."""
_Several = tuple[Hypothesis, ...]
_NO_LANDMARKS: Collection[str] = ()
_NO_EVIDENCE: Mapping[str, float] = {}


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
    again : bool
        Whether what is perceived now is the place that was marked last.
    """

    def __init__(self, uncertainty: Uncertainty, links: Links) -> None:
        self.hypotheses: _Several = ()
        self.again = False
        self._sd = uncertainty
        self._links = links
        self._here, self._landmarks = ANYWHERE.at, _NO_LANDMARKS
        self._near: list[Case] = []
        self._sides_of: SidesOf = unseen
        self._doubts = 0
        self._marked: Pose | None = None
        # What is perceived is compared with `_from`. In the place marked last those are the
        # hypotheses from before that mark: it counts once, however often the robot turns in it.
        self._from: _Several = ()
        self._before_mark: _Several = ()

    @property
    def known(self) -> Hypothesis | None:
        """Where the robot most probably has been last; None while it is lost."""
        likeliest = self.hypotheses[0] if self.hypotheses else ANYWHERE
        return likeliest if likeliest.landmark is not None and likeliest.met >= ENOUGH else None

    @property
    def proven(self) -> Hypothesis | None:
        """The same, if enough landmarks have fitted to learn something about the graph."""
        known = self.known
        if known is None or known.met < PROVEN:
            return None
        return known if _outweighs(known, self.hypotheses) else None

    @property
    def in_doubt(self) -> bool:
        """Whether the robot did not know for certain where it was before what is perceived now."""
        return len(self._from) > 1 or (len(self._from) == 1 and self._from[0].landmark is None)

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

    def correct(self, landmark: str, place: Pose) -> None:
        """Believe that a landmark lies elsewhere than path integration has it, and all others too.

        Parameters
        ----------
        landmark : str
            Which; where the robot is must be known, and a way from there to it.
        place : Pose
            Where it is, in the frame of path integration.
        """
        known, believed = self.known, self.place_of(landmark)
        assert known is not None
        assert believed is not None
        x_m = known.fix.pose.x_m + place.x_m - believed.pose.x_m
        y_m = known.fix.pose.y_m + place.y_m - believed.pose.y_m
        fix = known.fix._replace(pose=Pose(x_m, y_m, known.fix.pose.theta_rad))
        self._from = self.hypotheses = (replace(known, fix=fix), *self.hypotheses[1:])

    def lose(self) -> None:
        """Give up all hypotheses: the robot may be anywhere."""
        self._from = self.hypotheses = (ANYWHERE,)
        self._marked = None
        self._doubts = 0

    def begin(self, landmark: str, fix: Link, here: Here) -> None:
        """Begin near a landmark, as is likely, or anywhere.

        Parameters
        ----------
        landmark : str
            Which.
        fix : Link
            Where it lies, in the frame of path integration.
        here : Here
            Where the robot begins.
        """
        self.lose()
        elsewhere = replace(ANYWHERE, weight=math.log(ELSEWHERE))
        self._from = self.hypotheses = (Hypothesis(landmark, fix, here, 0.0), elsewhere)

    def settled(self, landmark: str | None, share: float) -> bool:
        """Tell whether the robot, if it was lost, knows enough to say which landmark this is.

        Parameters
        ----------
        landmark : str or None
            Which; None for a new one.
        share : float
            How probable that is.
        """
        likeliest = self._from[0] if self._from else ANYWHERE
        if landmark is None:
            known = likeliest.landmark is None or likeliest.met >= ENOUGH
            return known or self._doubts >= GIVEN_UP
        case = self._likeliest(landmark)
        met = likeliest.met if case is None else self._met(case)
        return met >= PROVEN or (met > 0 and share >= SURE[min(met, len(SURE)) - 1])

    def expect(
        self, here: Here, landmarks: Collection[str], sides_of: SidesOf = unseen
    ) -> Expected:
        """Tell how improbable each landmark is here.

        Parameters
        ----------
        here : Here
            What was perceived.
        landmarks : collection of str
            All there are.
        sides_of : callable
            Tells from which side each of them would be seen.
        """
        self._here, self._landmarks, self._sides_of = here, landmarks, sides_of
        self.again = self._marked is not None and self._marked.distance_m(here.place) < SAME_PLACE_M
        self._from = self._before_mark if self.again else self.hypotheses
        self._near = cases_near(
            self._from, functools.cache(self._links.seen_from), here, self._sd, sides_of
        )
        total = sum(math.exp(hypothesis.weight) for hypothesis in self._from)
        odds: dict[str, float] = {}
        for case in self._near:
            p = math.exp(case.before.weight - case.nats) / total
            odds[case.landmark] = odds.get(case.landmark, 0.0) + p
        lost = sum(math.exp(h.weight) for h in self._from if h.landmark is None)
        lost = lost / total if total else 0.0
        anywhere = lost / max(len(landmarks), 1)
        nats = {name: _nats(p + anywhere) for name, p in odds.items()}
        return Expected(nats, _nats(anywhere))

    def astray(self) -> dict[str, Pose]:
        """Tell which landmarks this may be if it is perceived astray, and where they lie.

        Returns
        -------
        dict of str to Pose
            In the frame of path integration; `expect` must have been called. None while the robot
            is lost, or does not know well enough where they are.
        """
        likeliest = self._from[0] if self._from else ANYWHERE
        if likeliest.landmark is None or likeliest.met < ENOUGH:
            return {}
        return {
            case.landmark: case.expected
            for case in self._near
            if case.before is likeliest
            and case.known_m2 < BESIDE_M**2
            and BESIDE_M < case.expected.distance_m(self._here.place) < DOORWAY_M
        }

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
        if case is not None and not self._proven_by(case):
            self.doubt(here, evidence, new)
            self._doubts = 0
            return None
        if case is None:  # recognised without being expected
            self._be_at(here, Hypothesis(landmark, Link(here.place, 0.0, 0.0), here, 0.0))
            return None
        before = case.before
        if before.landmark is not None and before.landmark != landmark:
            self._links.relate(before.landmark, landmark, case.link(self._sd.since(before, here)))
        self._be_at(here, Hypothesis(landmark, case.fix, here, 0.0))
        return before if before.landmark is not None else None

    def find(
        self,
        landmark: str,
        here: Here,
        evidence: Mapping[str, float] = _NO_EVIDENCE,
        new: float = 0.0,
    ) -> Hypothesis | None:
        """Be at a new landmark; return where the robot came from, if that is known.

        The new landmark's frame is the place as it is perceived now.

        Parameters
        ----------
        landmark : str
            Its name.
        here, evidence, new : as for `doubt`
        """
        before = self._from[0] if self._from else None
        found = Hypothesis(landmark, Link(here.place, 0.0, 0.0), here, 0.0)
        if before is None or before.landmark is None or before.met < ENOUGH:
            elsewhere = replace(ANYWHERE, weight=math.log(ELSEWHERE))
            self._be_at(here, *((found,) if before is None else (found, elsewhere)))
            return None
        drift = self._sd.since(before, here)
        link = Link(
            here.place.seen_from(before.fix.pose),
            before.fix.variance_m2 + drift.variance_m2,
            before.fix.variance_rad2 + drift.variance_rad2,
        )
        self._links.relate(before.landmark, landmark, link.bounded)
        found = replace(found, weight=before.weight, met=before.met)
        others = self._from[1:]
        rivals = self._grown(here, evidence, new, without=before)
        self._be_at(here, *likely([replace(found, weight=found.weight + new), *rivals]))
        self._before_mark = (found, *others)
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
        self._marked, self._before_mark = here.place, self._from
        if not self._from:  # before the first landmark there is nothing to be in doubt about
            return
        self._from = self.hypotheses = likely(self._grown(here, evidence, new))

    def _grown(
        self,
        here: Here,
        evidence: Mapping[str, float],
        new: float,
        *,
        without: Hypothesis | None = None,
    ) -> list[Hypothesis]:
        """Return what the hypotheses but one become, if a place is each landmark or a new one."""
        before = [h for h in self._from if h is not without]
        cases = [
            case for case in self._near
            if case.before is not without and case.landmark in evidence
        ]  # fmt: skip
        if any(hypothesis.landmark is None for hypothesis in before):
            lookalikes = {name: nats for name, nats in evidence.items() if name in self._landmarks}
            best = max(lookalikes.values(), default=0.0)
            # The others would be given up anyway.
            cases += self._from_anywhere([n for n, v in lookalikes.items() if v > best - BELOW])
        grown = [
            Hypothesis(
                case.landmark, case.fix, here,
                case.before.weight - case.nats + evidence[case.landmark], self._met(case),
            )
            for case in cases
        ]  # fmt: skip
        return grown + [replace(h, weight=h.weight + new) for h in before]

    def _be_at(self, here: Here, *hypotheses: Hypothesis) -> None:
        """Believe this of a place."""
        self._doubts = 0
        self._marked = here.place
        self._from = self._before_mark = self.hypotheses = hypotheses

    def _proven_by(self, case: Case) -> bool:
        """Tell whether this case is beyond doubt: enough has fitted, and nothing else does."""
        return self._met(case) >= PROVEN and _outweighs(case.before, self._from)

    def _from_anywhere(self, landmarks: Collection[str]) -> list[Case]:
        """Return the cases that this is one of these landmarks, the robot having been anywhere."""
        of = len(self._landmarks)
        return cases_anywhere(self._from, self._here, landmarks, of, self._sd, self._sides_of)

    @staticmethod
    def _met(case: Case) -> int:
        """Return how many landmarks have fitted if this is the case."""
        return min(case.before.met + 1, PROVEN)

    def _likeliest(self, landmark: str) -> Case | None:
        """Return the likeliest way in which this can be a landmark."""
        cases = [case for case in self._near if case.landmark == landmark]
        if landmark in self._landmarks:
            cases += self._from_anywhere([landmark])
        return max(cases, key=lambda case: case.before.weight - case.nats, default=None)


def _outweighs(one: Hypothesis, hypotheses: Iterable[Hypothesis]) -> bool:
    return all(other.weight < one.weight - PROOF for other in hypotheses if other is not one)


def _nats(p: float) -> float:
    return min(-math.log(p), FAR) if p > 0.0 else FAR
