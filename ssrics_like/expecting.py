"""What the model expects where a reflex was fired, and how sure it is of what memory answers."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from functools import partial
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from ssrics_like.memory import (
    Expected,
    Here,
    Hypothesis,
    Listed,
    Retrieval,
    Sides,
    TopologicalMemory,
    Value,
    View,
    Whereabouts,
)
from ssrics_like.perception.reflex import Reflex
from ssrics_like.poses import Pose

Look: TypeAlias = Callable[[Pose], NDArray[np.float32]]
"""Tells what surrounds a place, in the frame of path integration; shape (108,)."""
PLACE_OF = "place-of-"
UNSETTLED = 0.5  # a robot that is lost is not more confident than this


def here_of(reflex: Reflex) -> Here:
    """Return where a reflex was fired."""
    return Here(reflex.place, reflex.directed, reflex.travelled_m, reflex.turned_rad)


class Expecting:
    """Which landmark is expected where, reckoned once for each reflex.

    Parameters
    ----------
    whereabouts : Whereabouts
        Where the robot believes to be.
    landmarks : TopologicalMemory
        All there are.
    sides_of : callable
        Tells of a reflex from which side each of some landmarks would be seen.
    """

    def __init__(
        self,
        whereabouts: Whereabouts,
        landmarks: TopologicalMemory,
        sides_of: Callable[[Reflex, Collection[str]], Mapping[str, Sides]],
    ) -> None:
        self._sides_of = sides_of
        self._whereabouts = whereabouts
        self._landmarks = landmarks
        self._expected = Expected()
        self._looks: list[dict[str, float]] = []
        self._asked_for: tuple[int, tuple[Hypothesis, ...]] | None = None

    def at(self, reflex: Reflex) -> None:
        """Expect what is where a reflex was fired."""
        asked = reflex.event, self._whereabouts.hypotheses
        if self._asked_for != asked:  # rules ask, and decide, about the same place
            self._asked_for = asked
            self._expected = self._whereabouts.expect(
                here_of(reflex), self._landmarks, partial(self._sides_of, reflex)
            )

    def seen_there(
        self, reflex: Reflex, view_of: Callable[[str], View | None], look: Look
    ) -> dict[str, NDArray[np.float32]]:
        """Look again where landmarks are known to be that were perceived beside it, if at all.

        A doorway that is entered askew is perceived up to a metre beside where it was, and what
        surrounds that place is not what is remembered. Where the landmark is, it is.

        Returns
        -------
        dict of str to ndarray, shape (108,), float32
            By the names of their views: what surrounds these places now.
        """
        self.at(reflex)
        return {
            view.name: look(place)
            for landmark, place in self._whereabouts.astray().items()
            if (view := view_of(landmark)) is not None
        }

    def only(self, landmark: str) -> None:
        """Expect one landmark: where it is, no other is."""
        self._asked_for = None
        self._expected = Expected({landmark: 0.0})

    def likeness(self, asked: Value) -> Listed:
        """Return the similarity of landmarks' places to the place of which that was reckoned."""
        del asked
        near: dict[Value, float] = {
            f"{PLACE_OF}{name}": -nats for name, nats in self._expected.nats.items()
        }
        return Listed(near, -self._expected.elsewhere)

    def noted(self, recalled: Retrieval | None) -> tuple[dict[str, float], float]:
        """Return what else but its place speaks for each landmark, and for none of them.

        It is kept, for it counts as well when the same place is perceived again.
        """
        if recalled is None:
            return {}, 0.0
        found = recalled.candidates
        names = [str(name) for name in found.names]
        looks = [*self._earlier, dict(zip(names, found.by_context.tolist(), strict=True))]
        context = _mean(names, looks)
        self._looks = looks
        evidence = {name: context[i] + self._expected[name] for i, name in enumerate(names)}
        return evidence, found.threshold_by_context

    def confidence(self, recalled: Retrieval) -> float:
        """Return how probable it is that what was recalled, or that nothing was, is right.

        That a landmark is familiar does not count for a robot in doubt: how often it was met says
        nothing of where the robot has come since, and would count again at every landmark.
        """
        name = None if recalled.chunk is None else recalled.chunk.name
        in_doubt = self._whereabouts.in_doubt
        share = self._share_by_context(recalled) if in_doubt else recalled.share
        return share if self._whereabouts.settled(name, share) else min(share, UNSETTLED)

    def _share_by_context(self, recalled: Retrieval) -> float:
        found = recalled.candidates
        context = found.by_context
        if earlier := self._earlier:
            names = [str(name) for name in found.names]
            now = dict(zip(names, context.tolist(), strict=True))
            context = np.array(_mean(names, [*earlier, now]))
        return recalled.share_of(context, found.threshold_by_context)

    @property
    def _earlier(self) -> list[dict[str, float]]:
        """What a robot in doubt has seen before of the place that it perceives again now."""
        here = self._whereabouts
        return self._looks if here.again and here.in_doubt else []


def _mean(names: list[str], looks: list[dict[str, float]]) -> list[float]:
    """Average what several looks at one place say: it counts once, however often one looks.

    A landmark that was none at first counts as the last look says.
    """
    last = looks[-1]
    return [sum(look.get(name, last[name]) for look in looks) / len(looks) for name in names]
