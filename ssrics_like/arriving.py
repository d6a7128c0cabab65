"""What the graph of landmarks learns when the robot comes to one."""

from __future__ import annotations

import math

from ssrics_like.memory import Hypothesis, TopologicalMemory
from ssrics_like.perception.reflex import Reflex


def arrive(
    topological: TopologicalMemory,
    landmark: str,
    reflex: Reflex,
    before: Hypothesis | None,
    *,
    new: bool,
) -> None:
    """Note in the graph that the robot came to a landmark, if it was at another before.

    Parameters
    ----------
    topological : TopologicalMemory
        The graph.
    landmark : str
        Which.
    reflex : Reflex
        Where and when.
    before : Hypothesis or None
        Where the robot came from; None if that is not known.
    new : bool
        Whether it was just declared, which counts as its first visit.
    """
    if before is None or before.landmark is None:
        return
    if before.landmark == landmark:
        topological.confirm(landmark, reflex.t_s)
        return
    start, end = before.at.place, reflex.place
    topological.traverse(
        before.landmark,
        landmark,
        start.distance_m(end),
        math.atan2(end.y_m - start.y_m, end.x_m - start.x_m) - start.theta_rad,
        # Rules may decide about two reflexes in either order; the way between is the same.
        abs(reflex.travelled_m - before.at.travelled_m),
    )
    if not new:
        topological.visit(landmark, reflex.t_s)
