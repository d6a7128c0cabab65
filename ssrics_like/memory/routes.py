"""The shortest route over the arcs of topological memory: which landmark comes after which."""

from __future__ import annotations

import heapq
import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ssrics_like.memory.landmark import Arc


@dataclass(frozen=True)
class Route:
    """A way from landmark to landmark.

    Attributes
    ----------
    landmarks : tuple of str
        From where it begins to where it ends, both included.
    path_m : float
        How long it is, as its arcs are remembered.
    """

    landmarks: tuple[str, ...]
    path_m: float


def paths_between(arcs: Iterable[Arc]) -> dict[str, dict[str, float]]:
    """Return how far it is from each landmark to those joined to it, metres.

    A way can be gone back, so an arc counts in both directions; of two the shorter one counts.
    """
    paths: dict[str, dict[str, float]] = {}
    for arc in arcs:
        for one, other in ((arc.from_id, arc.to_id), (arc.to_id, arc.from_id)):
            known = paths.setdefault(one, {}).get(other, math.inf)
            paths[one][other] = min(known, arc.path_m)
    return paths


def shortest_routes(
    arcs: Iterable[Arc], start: str, passable: Callable[[Arc], bool] = lambda _: True
) -> dict[str, Route]:
    """Return the shortest route from a landmark to each one that can be reached (Dijkstra 1959).

    Parameters
    ----------
    arcs : iterable of Arc
        All there are.
    start : str
        Where the routes begin.
    passable : callable
        Which arcs may be used.

    Returns
    -------
    dict
        By landmark, in order of length; `start` itself comes first. Of two routes of the same
        length the one by the landmark that comes first in the alphabet is taken.
    """
    paths = paths_between(arc for arc in arcs if passable(arc))
    found: dict[str, Route] = {}
    waiting: list[tuple[float, tuple[str, ...]]] = [(0.0, (start,))]
    while waiting:
        path_m, landmarks = heapq.heappop(waiting)
        here = landmarks[-1]
        if here in found:
            continue
        found[here] = Route(landmarks, path_m)
        for neighbour, onward_m in paths.get(here, {}).items():
            if neighbour not in found:
                heapq.heappush(waiting, (path_m + onward_m, (*landmarks, neighbour)))
    return found
