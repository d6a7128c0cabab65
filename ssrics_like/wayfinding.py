"""The way module: leads the robot from landmark to landmark, as the productions decide.

Rules choose what to do; this module knows what that means: which landmark an errand is about,
which one comes next on the shortest way over open arcs, and where that lies from here as the robot
believes. The body that drives there, around what it meets, asks for the `command`, and tells what
has become of it.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import partial
from typing import TYPE_CHECKING, Any

from ssrics_like.errors import EngineError, nearest
from ssrics_like.memory.homing import where_alike
from ssrics_like.memory.routes import Route, shortest_routes
from ssrics_like.productions.interface import BufferChunk, StepRequest
from ssrics_like.productions.vocabulary import WAY_SLOTS

if TYPE_CHECKING:
    from ssrics_like.memory import Arc
    from ssrics_like.modules import LandmarkModules
    from ssrics_like.perception.reflex import PerceptionBuffer
    from ssrics_like.poses import Pose

HOME, ALL = "home", "visit-all"
"""Errands that name no landmark: back to the one that was met first, and to all there are."""
LONGER, SLACK_M = 1.5, 4.0
"""A way that is longer than remembered by this factor and this much besides is another way."""
ROUND, ROUND_SLACK_M = 4.0, 10.0
"""Where no way is remembered, one may be so much longer than the straight line."""
NEAR_M, AT_GOAL_M = 0.6, 0.3
"""So near the robot has come to a landmark on the way, and to the one where the way ends."""
CORRECTIONS = 2
"""So often on the way to one landmark the robot corrects where it believes it to be."""
NONE = "none"


@dataclass(frozen=True)
class Command:
    """What the body is to do now.

    Attributes
    ----------
    what : str
        drive, search or wait.
    to : Pose or None
        Where to drive, in the frame of path integration.
    near_m : float
        How near is near enough, metres.
    limit_m : float
        A longer way does not count, metres.
    """

    what: str
    to: Pose | None = None
    near_m: float = 0.0
    limit_m: float = math.inf


WAIT, SEARCH = Command("wait"), Command("search")


@dataclass(frozen=True)
class Errand:
    """One errand, and how it went.

    Attributes
    ----------
    order : str
        A landmark's name, home or visit-all.
    started_s, ended_s : float
        Source's time; the latter NaN while it lasts.
    goal : str
        The landmark that it led to last; empty before any.
    visited, shut, left_out : tuple of str
        Landmarks come to; ways found shut, as L1-L2; landmarks that no open way led to.
    searches : int
        How often the robot looked about because it was lost.
    outcome, reason : str
        reached or failed, and why; empty while it lasts.
    """

    order: str
    started_s: float
    ended_s: float = math.nan
    goal: str = ""
    visited: tuple[str, ...] = ()
    shut: tuple[str, ...] = ()
    left_out: tuple[str, ...] = ()
    searches: int = 0
    outcome: str = ""
    reason: str = ""

    def as_data(self) -> dict[str, Any]:
        """Return it as plain values, for the manifest."""
        return {
            key: list(value) if isinstance(value, tuple) else value
            for key, value in vars(self).items()
        }


@dataclass
class _Now:
    """Where the robot is on its errand."""

    command: str = "wait"
    at: str = ""
    next: str = ""
    limit_m: float = math.inf
    shut: set[frozenset[str]] = field(default_factory=set)
    sought: set[str] = field(default_factory=set)
    seeking: bool = False
    corrected: int = 0


class Wayfinder:
    """Carries out what rules decide on the way (WayModule), and commands the body (Guide).

    Parameters
    ----------
    modules : LandmarkModules
        The landmarks, and where the robot believes to be.
    perception : PerceptionBuffer
        Where it is by path integration.
    push : callable
        Puts a chunk into the way buffer.

    Attributes
    ----------
    errands : list of Errand
        All so far; the last one may still go on.
    home : str
        The landmark that was met first; empty before.
    """

    def __init__(
        self,
        modules: LandmarkModules,
        perception: PerceptionBuffer,
        push: Callable[[BufferChunk], object],
    ) -> None:
        self.errands: list[Errand] = []
        self.home = ""
        self._modules = modules
        self._perception = perception
        self._push = push
        self._now: _Now | None = None
        self._t_s = 0.0
        self._believed: tuple[object, str, Pose | None] = (None, "", None)

    # What the body asks and tells.

    @property
    def here(self) -> Pose | None:
        """Where the laser is, in the frame of path integration."""
        return self._perception.here

    @property
    def carried(self) -> int:
        """How often the robot has found itself suddenly elsewhere."""
        return self._perception.carried

    @property
    def command(self) -> Command | None:
        """What the body is to do; None without an errand."""
        now = self._now
        if now is None:
            return None
        if now.command == "search":
            return SEARCH
        to = self._place(now.next) if now.command == "drive" else None
        if to is None:
            return WAIT
        near_m = AT_GOAL_M if now.next == self.errands[-1].goal else NEAR_M
        return Command("drive", to, near_m, now.limit_m)

    def order(self, errand: str) -> None:
        """Set the robot an errand: the name of a landmark, home or visit-all."""
        self.errands.append(Errand(errand, self._t_s))
        self._now = _Now(at=self._last_met())
        self._happen("ordered")

    def tell(self, event: str, reason: str = NONE) -> None:
        """Say what has become of a command: arrived, blocked, or nowhere after a search."""
        now = self._now
        if now is None:
            return
        if event == "arrived":
            if self._corrects():
                return
            now.at = now.next
            errand = self.errands[-1]
            self._note(visited=(*errand.visited, now.at))
        self._happen(event, reason)

    def _corrects(self) -> bool:
        """Look where the landmark is that the robot believes to have come to; go on if not here.

        What is a landmark is known when the robot has gone through, and a way may lead by several
        that it does not go through. Until then it is found by what it looks like.
        """
        now, here = self._now, self.here
        assert now is not None
        believed, view = self._place(now.next), self._modules.view_of(now.next)
        if believed is None or here is None or view is None or now.corrected >= CORRECTIONS:
            return False
        if not self._perception.looks_round:
            return False
        look = partial(self._perception.view_of, far=False)
        found = where_alike(view.descriptor, look, believed)
        if found is None:
            return False
        now.corrected += 1
        self._modules.whereabouts.correct(now.next, found)
        command = self.command
        return command is not None and found.distance_m(here) > command.near_m

    def look(self, t_s: float) -> None:
        """Notice, at the source's time, whether the robot has lost or found its way."""
        self._t_s = t_s
        if not self.home:
            self.home = self._last_met()
        now = self._now
        if now is None:
            return
        if now.command == "drive" and self._is_lost():
            self._happen("lost")
        elif now.command == "search" and not self._is_lost():
            now.at = self._last_met()
            self._happen("found")

    # What rules ask for.

    def step(self, request: StepRequest) -> BufferChunk:
        """Carry out a step (WayModule).

        Raises
        ------
        EngineError
            There is no errand, or no landmark of the name.
        """
        if self._now is None:
            raise EngineError(f"asks to {request.act}, but there is no errand")
        if request.to and request.to not in self._modules.topological:
            raise EngineError(f"asks to {request.act} '{request.to}', which is no landmark")
        if request.act == "end":
            return self._end(request.outcome, request.reason or NONE)
        if request.act == "search":
            self._note(searches=self.errands[-1].searches + 1)
            return self._chunk("searching", command="search")
        if request.act == "shut":
            return self._shut(request.to)
        if request.act == "skip":
            self._note(left_out=(*self.errands[-1].left_out, request.to))
        if self._is_lost():
            return self._chunk("lost")
        if request.act == "plan":
            return self._plan(request.to)
        if request.act == "drive":
            return self._drive(request.to)
        return self._choose()

    def _choose(self) -> BufferChunk:
        """Find out which landmark the errand is about."""
        errand = self.errands[-1]
        if errand.order == ALL:
            done = {*errand.visited, *errand.left_out}
            left = [name for name in self._routes() if name not in done]
            left += [name for name in self._modules.topological if name not in {*done, *left}]
            if not left:
                return self._chunk("nothing-left", "left-out" if errand.left_out else NONE)
            goal = left[0]
        else:
            goal = self.home if errand.order == HOME else errand.order
            if goal not in self._modules.topological:
                return self._chunk("unknown", "no-such-landmark")
        self._note(goal=goal)
        return self._chunk("chosen")

    def _plan(self, goal: str) -> BufferChunk:
        """Find the landmark that comes next on the shortest open way.

        Where none is remembered, a way never gone may lead to the goal; it is looked for once.
        """
        now = self._now
        assert now is not None
        if self._place(goal) is None:
            return self._chunk("cut-off", "no-open-way")
        route = self._routes().get(goal)
        now.seeking = False
        if route is not None:
            now.next = route.landmarks[min(1, len(route.landmarks) - 1)]
            if frozenset((now.at, now.next)) not in now.shut:
                return self._chunk("planned")
        if goal in now.sought:
            return self._chunk("cut-off", "no-open-way")
        now.sought.add(goal)
        now.next, now.seeking = goal, True
        return self._chunk("planned")

    def _drive(self, to: str) -> BufferChunk:
        """Set the body going."""
        now = self._now
        assert now is not None
        now.next, now.corrected = to, 0
        route = self._routes().get(to)
        path_m = route.path_m if route is not None else 0.0
        start, here = self._place(now.at), self.here
        away_m = start.distance_m(here) if start is not None and here is not None else 0.0
        now.limit_m = LONGER * (path_m + away_m) + SLACK_M
        there = self._place(to)
        if now.seeking and there is not None and here is not None:
            now.limit_m = ROUND * there.distance_m(here) + ROUND_SLACK_M
        return self._chunk("driving", command="drive")

    def _shut(self, to: str) -> BufferChunk:
        """Remember that the way to a landmark is shut."""
        now, topological = self._now, self._modules.topological
        assert now is not None
        now.shut.add(frozenset((now.at, to)))
        if topological.joins(now.at, to):
            topological.close(now.at, to)
            self._note(shut=(*self.errands[-1].shut, f"{now.at}-{to}"))
        return self._chunk("shut")

    def _end(self, outcome: str, reason: str) -> BufferChunk:
        said = "" if reason == NONE else reason
        if said == "no-such-landmark":
            hint = nearest(self.errands[-1].order, self._modules.topological)
            said = f"{said}{hint}"
        self._note(ended_s=self._t_s, outcome=outcome, reason=said)
        chunk = self._chunk("ended")
        self._now = None
        return chunk

    # What is known.

    def _routes(self) -> dict[str, Route]:
        """Return the shortest open routes; where nothing is open, what was shut long ago may be."""
        now, topological = self._now, self._modules.topological
        assert now is not None
        shut = now.shut

        def is_open(arc: Arc) -> bool:
            return not arc.closed

        def may_be_open(arc: Arc) -> bool:
            return frozenset((arc.from_id, arc.to_id)) not in shut

        arcs = topological.arcs
        routes = shortest_routes(arcs, now.at, is_open)
        for name, route in shortest_routes(arcs, now.at, may_be_open).items():
            routes.setdefault(name, route)
        return routes

    def _place(self, landmark: str) -> Pose | None:
        """Return where a landmark is believed to be, in the frame of path integration."""
        whereabouts = self._modules.whereabouts
        asked = whereabouts.hypotheses, landmark
        if self._believed[:2] != asked:
            link = whereabouts.place_of(landmark)
            self._believed = (*asked, None if link is None else link.pose)
        return self._believed[2]

    def _is_lost(self) -> bool:
        elsewhere = self._perception.carried > self._modules.carried
        return elsewhere or self._modules.whereabouts.known is None

    def _last_met(self) -> str:
        known = self._modules.whereabouts.known
        return "" if known is None or known.landmark is None else known.landmark

    # What is said.

    def _happen(self, event: str, reason: str = NONE) -> None:
        """Put what has happened before the productions; the body waits."""
        self._push(self._chunk(event, reason))

    def _chunk(self, event: str, reason: str = NONE, command: str = "wait") -> BufferChunk:
        """Return the chunk for the way buffer; the body is to do as `command` says from now."""
        now = self._now
        assert now is not None
        now.command = command
        errand = self.errands[-1]
        words = (event, errand.order, errand.goal, now.at, now.next, reason)
        return BufferChunk("way", {k: v or NONE for k, v in zip(WAY_SLOTS, words, strict=True)})

    def _note(self, **changed: object) -> None:
        self.errands[-1] = replace(self.errands[-1], **changed)  # type: ignore[arg-type]
