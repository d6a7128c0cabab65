"""When the arcs of the topological memory came, which its file does not say."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise

from ssrics_like.memory.landmark import Arc
from ssrics_like.results.records import Reflex


@dataclass(frozen=True, slots=True)
class Came:
    """An arc, and when it came.

    Attributes
    ----------
    from_id, to_id : str
        The landmarks where it begins and ends.
    t_s : float
        Seconds since the start of the run.
    is_known : bool
        Whether the decisions tell; otherwise `t_s` is when both landmarks were there.
    """

    from_id: str
    to_id: str
    t_s: float
    is_known: bool


def came(arcs: Iterable[Arc], reflexes: Sequence[Reflex]) -> list[Came]:
    """Return when each arc came: when its landmarks were first marked one after the other.

    Parameters
    ----------
    arcs : iterable of Arc
        As they are at the end of the run.
    reflexes : sequence of Reflex
        The decisions of the run.

    Returns
    -------
    list of Came
        In order of time. A mark that leaves the landmark open does not count: where the robot was
        after it, the tables do not say.
    """
    marks = [r for r in reflexes if r.decision in ("declared", "recognised") and r.landmark]
    marks.sort(key=lambda r: r.decided_s)
    there: dict[str, float] = {}
    first: dict[tuple[str, str], float] = {}
    for mark in marks:
        there.setdefault(mark.landmark, mark.decided_s)
    for before, mark in pairwise(marks):
        first.setdefault((before.landmark, mark.landmark), mark.decided_s)
    found = []
    for arc in arcs:
        ends = (arc.from_id, arc.to_id)
        known = first.get(ends)
        both = max(there.get(end, 0.0) for end in ends)
        found.append(Came(*ends, both if known is None else known, known is not None))
    return sorted(found, key=lambda arc: (arc.t_s, arc.from_id, arc.to_id))
