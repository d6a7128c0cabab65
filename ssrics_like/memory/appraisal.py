"""Reckons what each landmark is worth from what both memories hold."""

from __future__ import annotations

from ssrics_like.memory.chunks import View
from ssrics_like.memory.declarative import DeclarativeMemory
from ssrics_like.memory.landmark import Landmark
from ssrics_like.memory.topological import TopologicalMemory
from ssrics_like.memory.worth import Worth, permanence, relevance, surprise

KIND, VIEW = "landmark", "view"
"""Type of the chunks that stand for landmarks, and their slot that is compared."""


class Appraisal:
    """Salience, relevance and permanence of landmarks, as memory is when it is asked.

    Parameters
    ----------
    declarative : DeclarativeMemory
        Holds their views, in chunks of the type ``landmark`` that are called as they are.
    topological : TopologicalMemory
        Holds how they were gone between, confirmed and missed.
    lasting_s : float
        See `worth.permanence`.
    """

    def __init__(
        self, declarative: DeclarativeMemory, topological: TopologicalMemory, lasting_s: float
    ) -> None:
        self._declarative = declarative
        self._topological = topological
        self._lasting_s = lasting_s

    def surprise(self, view: View) -> float:
        """Return how surprising a view is among those of all landmarks, bits."""
        return surprise(self._declarative.likeness(KIND, VIEW, view))

    def salience(self, landmark: str) -> float | None:
        """Return how surprising a landmark's view is, bits; None if memory holds no view of it."""
        if landmark not in self._declarative:
            return None
        chunk = self._declarative[landmark]
        view = chunk.slots.get(VIEW)
        if chunk.type != KIND or not isinstance(view, View):
            return None
        return surprise(self._declarative.likeness(KIND, VIEW, view, without=landmark))

    def relevance(self, landmark: str) -> float:
        """Return how much a landmark matters for finding ways."""
        return self._relevance(landmark, self._topological.mean_traversals)

    def permanence(self, landmark: str, now_s: float) -> float:
        """Return how probable it is that a landmark is still there; the graph's clock."""
        return self._permanence(self._topological[landmark], now_s)

    def worths(self, now_s: float) -> dict[str, Worth]:
        """Return what every landmark is worth, by its name; `now_s` on the graph's clock."""
        mean = self._topological.mean_traversals
        return {
            node.id: Worth(
                self.salience(node.id),
                self._relevance(node.id, mean),
                self._permanence(node, now_s),
            )
            for node in self._topological.nodes
        }

    def measure(
        self, name: str, landmark: str | None, view: View | None, now_s: float
    ) -> float | None:
        """Return one of the three numbers, as rules ask for them.

        Parameters
        ----------
        name : str
            salience, relevance or permanence.
        landmark : str or None
            What was recalled; None for a failure.
        view : View or None
            What was asked for, if that had a view: after a failure, salience is its surprise.
        now_s : float
            The moment, on the graph's clock.

        Returns
        -------
        float or None
            None where there is no such number.
        """
        if landmark is None:
            return self.surprise(view) if name == "salience" and view is not None else None
        if landmark not in self._topological:
            return None
        if name == "salience":
            return self.salience(landmark)
        return self.relevance(landmark) if name == "relevance" else self.permanence(landmark, now_s)

    def _relevance(self, landmark: str, mean: float) -> float:
        return relevance(tuple(self._topological.traversals(landmark).values()), mean)

    def _permanence(self, node: Landmark, now_s: float) -> float:
        return permanence(
            lasted_s=node.last_visit_s - node.t_s,
            unseen_s=now_s - node.last_visit_s,
            confirmed=node.visits - 1,
            missed=node.missed,
            missed_since=node.missed_since,
            lasting_s=self._lasting_s,
        )
