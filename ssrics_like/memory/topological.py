"""Topological memory: a labelled graph of landmarks and the ways between them.

After Warren, Rothman, Schnapp & Ericson (2017), "Wormholes in virtual space: From
cognitive maps to cognitive graphs", Cognition 166: places are nodes; an arc carries a
rough distance and direction, known from going there. Nothing makes the arcs agree with
one another or with one map, and nothing here does.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import Any

import networkx as nx

from ssrics_like.errors import nearest
from ssrics_like.memory.landmark import (
    Arc,
    Label,
    Landmark,
    checked_labels,
    finite,
    length,
    number_of,
)
from ssrics_like.memory.links import Link, Links
from ssrics_like.memory.statistics import RunningDirection, RunningMean, wrapped
from ssrics_like.poses import Pose


class TopologicalMemory:
    """Landmarks and the arcs between them.

    Consecutive landmarks are joined by :meth:`traverse`, whose measurements update the
    arc's running estimates. Two different ways between the same two landmarks share one
    arc, and show in its spread.

    Attributes
    ----------
    links : Links
        How landmarks lie from one another; `Whereabouts` learns them.
    """

    def __init__(self) -> None:
        self._graph: Any = nx.DiGraph()
        self._gone = 0  # traversals of all open ways
        self.links = Links()

    def __len__(self) -> int:
        return len(self._graph)

    def __contains__(self, landmark: object) -> bool:
        return landmark in self._graph

    def __getitem__(self, landmark: str) -> Landmark:
        if landmark not in self._graph:
            hint = nearest(landmark, self._graph)
            raise KeyError(f"no landmark '{landmark}' in topological memory{hint}")
        node: Landmark = self._graph.nodes[landmark]["landmark"]
        return node

    @property
    def nodes(self) -> tuple[Landmark, ...]:
        """All landmarks, in the order in which they were marked."""
        return tuple(self[landmark] for landmark in self._graph)

    @property
    def arcs(self) -> tuple[Arc, ...]:
        """All arcs, by the order of their first landmark, then of their making."""
        return tuple(self.arc(*ends) for ends in self._graph.edges)

    def arc(self, from_id: str, to_id: str) -> Arc:
        """Return the arc from one landmark to another.

        Raises
        ------
        KeyError
            If it was never traversed.
        """
        if not self._graph.has_edge(from_id, to_id):
            raise KeyError(f"no arc from '{from_id}' to '{to_id}' in topological memory")
        estimates = self._graph.edges[from_id, to_id]
        distance, bearing, path = (estimates[k] for k in ("distance", "bearing", "path"))
        return Arc(
            from_id,
            to_id,
            distance.n,
            distance.mean,
            distance.deviation,
            bearing.mean_rad,
            bearing.deviation,
            path.mean,
            path.deviation,
            **self._geometry(from_id, to_id),
            closed=estimates["closed"],
        )

    def _geometry(self, from_id: str, to_id: str) -> dict[str, float]:
        link = self.links.between(from_id, to_id)
        if link is None:
            return {}
        return {
            "x_m": link.pose.x_m,
            "y_m": link.pose.y_m,
            "theta_rad": link.pose.theta_rad,
            "position_sd_m": math.sqrt(link.variance_m2),
            "direction_sd_rad": math.sqrt(link.variance_rad2),
        }

    def __iter__(self) -> Iterator[str]:
        """Go through the names of all landmarks, in the order in which they were marked."""
        return iter(self._graph)

    def next_id(self) -> str:
        """Return the name of the next landmark: L and a number above every one there is."""
        return f"L{max(map(number_of, self._graph), default=0) + 1}"

    def degree(self, landmark: str) -> int:
        """Count the other landmarks joined to this one by an arc either way."""
        self[landmark]
        neighbours = {*self._graph.predecessors(landmark), *self._graph.successors(landmark)}
        return len(neighbours - {landmark})

    def traversals(self, landmark: str) -> dict[str, int]:
        """Count how often each open way at a landmark was gone, there and back together.

        Returns
        -------
        dict of str to int
            By the landmark at its other end; a way that is shut is left out.
        """
        self[landmark]
        others = dict.fromkeys([*self._graph.succ[landmark], *self._graph.pred[landmark]])
        gone = {other: self._gone_between(landmark, other) for other in others}
        return {other: n for other, n in gone.items() if n > 0}

    @property
    def mean_traversals(self) -> float:
        """How often the open ways at a landmark were gone, on the average; 0 without any."""
        return 2.0 * self._gone / len(self) if len(self) else 0.0

    def _gone_between(self, one: str, other: str) -> int:
        """Count traversals of the way between two landmarks; 0 if it is shut, or leads nowhere."""
        ways = [self._graph.edges[ends] for ends in self._both_ways(one, other)]
        if one == other or any(way["closed"] for way in ways):
            return 0
        return sum(way["distance"].n for way in ways)

    def add_landmark(
        self,
        id: str,  # noqa: A002  the contract's name for it, in files as well
        x_m: float,
        y_m: float,
        theta_rad: float,
        t_s: float,
        **labels: Label | None,
    ) -> Landmark:
        """Add a landmark, with its first visit.

        Parameters
        ----------
        id : str
            Unique name: printable, not empty.
        x_m, y_m, theta_rad : float
            Where it is, metres and radians.
        t_s : float
            When, seconds.
        **labels : str, int, float, bool or None
            What is known of it. A label that is None or empty text is left out.

        Returns
        -------
        Landmark

        Raises
        ------
        ValueError
            For a name that is taken or not printable, a number that is not finite, or a
            label that is reserved or not printable.
        """
        if not (isinstance(id, str) and id and id.isprintable()):
            raise ValueError(f"landmark name {id!r}; expected printable text, not empty")
        if id in self._graph:
            raise ValueError(f"landmark '{id}' is in topological memory already")
        name = str(id)
        t = finite("t_s", t_s)
        landmark = Landmark(
            id=name,
            x_m=finite("x_m", x_m),
            y_m=finite("y_m", y_m),
            theta_rad=wrapped(finite("theta_rad", theta_rad)),
            t_s=t,
            last_visit_s=t,
            visits=1,
            labels=checked_labels(labels),
        )
        self._graph.add_node(name, landmark=landmark)
        return landmark

    def visit(
        self,
        id: str,  # noqa: A002  as in add_landmark
        t_s: float,
        **labels: Label | None,
    ) -> Landmark:
        """Count one more visit; labels given replace those of the same name.

        Raises
        ------
        KeyError
            If there is no such landmark.
        ValueError
            As for :meth:`add_landmark`.
        """
        labelled = {**self[id].labels, **checked_labels(labels)}
        seen = self.confirm(id, t_s)
        visited = replace(seen, visits=seen.visits + 1, labels=labelled)
        self._graph.nodes[id]["landmark"] = visited
        return visited

    def confirm(self, id: str, t_s: float) -> Landmark:  # noqa: A002  as in add_landmark
        """Note that a landmark is still there, though the robot came from nowhere else.

        Opportunities missed before lie before the last sight of it now.

        Raises
        ------
        KeyError
            If there is no such landmark.
        ValueError
            If the time is not finite.
        """
        known = self[id]
        seen = replace(
            known,
            # Rules may decide about two reflexes in either order.
            last_visit_s=max(known.last_visit_s, finite("t_s", t_s)),
            missed=known.missed + known.missed_since,
            missed_since=0,
        )
        self._graph.nodes[id]["landmark"] = seen
        return seen

    def miss(self, id: str) -> Landmark:  # noqa: A002  as in add_landmark
        """Count one opportunity at which a landmark was expected and not marked.

        Raises
        ------
        KeyError
            If there is no such landmark.
        """
        known = self[id]
        missed = replace(known, missed_since=known.missed_since + 1)
        self._graph.nodes[id]["landmark"] = missed
        return missed

    def traverse(
        self, from_id: str, to_id: str, distance_m: float, bearing_rad: float, path_m: float
    ) -> Arc:
        """Note that the robot went from one landmark straight to the next; that way is open.

        Parameters
        ----------
        from_id, to_id : str
            Consecutive landmarks.
        distance_m : float
            Straight distance between them as odometry has it.
        bearing_rad : float
            Direction of the destination relative to the robot's heading when it left,
            positive to the left; any whole turns are dropped.
        path_m : float
            Length of the path driven.

        Returns
        -------
        Arc
            With its estimates brought up to date.

        Raises
        ------
        KeyError
            If there is no such landmark.
        ValueError
            For a number that is not finite, or a negative length.
        """
        for landmark in (from_id, to_id):
            self[landmark]
        values = {
            "distance": length("distance_m", distance_m),
            "bearing": wrapped(finite("bearing_rad", bearing_rad)),
            "path": length("path_m", path_m),
        }
        gone = self._gone_between(from_id, to_id)
        if not self._graph.has_edge(from_id, to_id):
            self._graph.add_edge(
                from_id,
                to_id,
                distance=RunningMean(),
                bearing=RunningDirection(),
                path=RunningMean(),
                closed=0,
            )
        for ends in self._both_ways(from_id, to_id):
            self._graph.edges[ends]["closed"] = 0
        estimates = self._graph.edges[from_id, to_id]
        estimates.update({key: estimates[key].with_value(value) for key, value in values.items()})
        self._gone += self._gone_between(from_id, to_id) - gone
        return self.arc(from_id, to_id)

    def joins(self, one: str, other: str) -> bool:
        """Tell whether there is an arc between two landmarks, either way."""
        return bool(self._both_ways(one, other))

    def close(self, one: str, other: str) -> None:
        """Note that the way between two landmarks was found shut; it stays so until it is gone.

        Raises
        ------
        KeyError
            If there is no arc between them, either way.
        """
        arcs = self._both_ways(one, other)
        if not arcs:
            raise KeyError(f"no arc between '{one}' and '{other}' in topological memory")
        self._gone -= self._gone_between(one, other)
        for ends in arcs:
            self._graph.edges[ends]["closed"] += 1

    def _both_ways(self, one: str, other: str) -> list[tuple[str, str]]:
        """Return the ends of the arcs between two landmarks."""
        return [e for e in ((one, other), (other, one)) if self._graph.has_edge(*e)]

    @classmethod
    def restored(cls, landmarks: Iterable[Landmark], arcs: Iterable[Arc]) -> TopologicalMemory:
        """Build a memory from what another one reported; estimates go on from there.

        Raises
        ------
        KeyError
            If an arc begins or ends at no landmark.
        """
        memory = cls()
        for landmark in landmarks:
            memory._graph.add_node(landmark.id, landmark=landmark)
        for arc in arcs:
            n = arc.traversals
            ends = arc.from_id, arc.to_id
            for end in ends:
                memory[end]
            gone = memory._gone_between(*ends)
            memory._graph.add_edge(
                *ends,
                distance=RunningMean.of(n, arc.distance_m, arc.distance_sd_m),
                bearing=RunningDirection.of(n, arc.bearing_rad, arc.bearing_sd_rad),
                path=RunningMean.of(n, arc.path_m, arc.path_sd_m),
                closed=arc.closed,
            )
            memory._gone += memory._gone_between(*ends) - gone
            if ends[0] == ends[1] or arc.position_sd_m <= 0.0:
                continue
            if memory.links.between(*ends) is None:
                pose = Pose(arc.x_m, arc.y_m, arc.theta_rad)
                variances = arc.position_sd_m**2, arc.direction_sd_rad**2
                memory.links.relate(*ends, Link(pose, *variances).bounded)
        return memory
