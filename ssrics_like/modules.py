"""Joins the production engine to the landmark memories.

Rules see words only. A view or a place is too rich for a word, so it travels
through the rules as a handle: ``view-12`` is that of reflex 12, ``view-of-L3``
that of landmark L3. Handles are looked up here on their way to memory. A place is
compared with where the robot expects its landmarks: see `Whereabouts`.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Collection, Mapping, Sequence
from functools import partial

import numpy as np

from ssrics_like.arriving import arrive
from ssrics_like.decision import Decision
from ssrics_like.errors import EngineError
from ssrics_like.expecting import PLACE_OF, Expecting, Look, here_of
from ssrics_like.memory import (
    Chunk,
    DeclarativeMemory,
    Here,
    Home,
    Listed,
    ListedSimilarity,
    Request,
    Retrieval,
    Sides,
    TopologicalMemory,
    Uncertainty,
    Value,
    View,
    Whereabouts,
)
from ssrics_like.memory.appraisal import Appraisal
from ssrics_like.memory.passing import Passing
from ssrics_like.memory.profile import MemoryProfile
from ssrics_like.memory.surroundings import joined
from ssrics_like.perception.reflex import Reflex
from ssrics_like.poses import Pose
from ssrics_like.productions.interface import BufferChunk, MarkRequest, Recall, SlotTest

CONTINUOUS = ("view", "place")
VIEW_OF = "view-of-"
REMEMBERED = 64  # decided reflexes whose handles rules may still use


class LandmarkModules:
    """Declarative and topological memory behind the engine's two module protocols.

    Parameters
    ----------
    profile : MemoryProfile
        How memory works.
    rng : numpy.random.Generator
        Source of activation noise.
    decided : callable
        Receives every Decision.
    retrieved : callable
        Receives every Retrieval with its time, for the trace.
    look : callable, optional
        Tells what surrounds a place, in the frame of path integration. Views are of what
        surrounds a place, then; of a scan without it.
    """

    def __init__(
        self,
        profile: MemoryProfile,
        rng: np.random.Generator,
        decided: Callable[[Decision], None],
        retrieved: Callable[[float, Retrieval], None],
        *,
        look: Look | None = None,
    ) -> None:
        self.profile = profile
        self._look = look
        self.declarative = DeclarativeMemory(
            profile,
            rng,
            {
                **profile.similarities(surroundings=look is not None),
                "place": ListedSimilarity(self._likeness_of_places),
            },
        )
        self._uncertainty = Uncertainty(
            place_m=profile.place_sigma_m,
            direction_rad=profile.direction_sigma_rad,
            drift=profile.place_drift,
            swerve_rad=profile.swerve_drift_rad,
            turn_rad=profile.turn_drift_rad,
            bias=profile.wheel_bias,
        )
        self.start_from(TopologicalMemory())
        self._decided = decided
        self._retrieved = retrieved
        self._start_s = 0.0
        self._start: Pose | None = None
        self._waiting: dict[str, Reflex] = {}
        self._known: OrderedDict[str, Reflex] = OrderedDict()
        self._recalled: tuple[Retrieval, float] | None = None
        self.carried = 0

    @property
    def undecided(self) -> int:
        """Number of reflexes about which nothing was decided yet."""
        return len(self._waiting)

    def start_from(self, topological: TopologicalMemory, home: Home | None = None) -> None:
        """Begin with a graph; where in it the robot is, it does not know."""
        self.topological = topological
        self.home = home
        self.appraisal = Appraisal(self.declarative, topological, self.profile.lasting_s)
        self.whereabouts = Whereabouts(self._uncertainty, topological.links)
        self._expecting = Expecting(self.whereabouts, topological, self._sides_of)
        self._passing = Passing(topological.links)
        if len(topological):
            self.whereabouts.lose()

    def begin(self, start_s: float) -> None:
        """Set the source's time that is zero in the engine."""
        self._start_s = start_s

    def begin_at(self, start: Pose, *, at_home: bool) -> None:
        """Note where the robot begins, by path integration, and whether that is home."""
        self._start = start
        if at_home:
            assert self.home is not None
            there = self.home.landmark_from(start)
            self.whereabouts.begin(self.home.landmark, there, Here(start, False, 0.0, 0.0))

    def go(self, here: Pose, travelled_m: float) -> None:
        """Note where the robot is by path integration; landmarks passed unseen are missed."""
        for landmark in self._passing.go(here, travelled_m, self.whereabouts.proven):
            self.topological.miss(landmark)

    def admit(self, reflex: Reflex) -> BufferChunk:
        """Register a reflex and return its chunk for the orienting buffer."""
        event = str(reflex.event)
        self._waiting[event] = reflex
        if reflex.carried > self.carried:
            self.carried = reflex.carried
            self.whereabouts.lose()
        slots = {
            "event": event,
            "modality": reflex.modality,
            "sector": reflex.sector,
            "structure": reflex.structure,
            "novelty": f"{reflex.novelty:.6f}",
            "view": f"view-{event}",
            "place": f"place-{event}",
        }
        return BufferChunk("reflex", slots)

    def overwrite(self, chunk: BufferChunk, t_s: float) -> None:
        """Record that a reflex was overwritten, unattended, at engine time `t_s`."""
        self._decide(chunk.slots["event"], t_s, "overwritten", "", "", None)

    def recall(
        self,
        chunk_type: str,
        tests: Sequence[SlotTest],
        t_s: float,
        sources: Mapping[str, Sequence[str]],
    ) -> Recall:
        """Answer a retrieval request (DeclarativeModule).

        Raises
        ------
        EngineError
            The rule asks for a view or place by a word that is no handle.
        """
        slots = tuple((t.slot, self._asked(t.slot, t.value), t.negated) for t in tests)
        looked = tuple(
            (slot, self._looked_at(test.value, value), no)
            for test, (slot, value, no) in zip(tests, slots, strict=True)
        )
        found = self.declarative.retrieve(Request(chunk_type, looked), t_s, sources)
        confidence = self._expecting.confidence(found)
        self._recalled = found, confidence
        self._retrieved(t_s, found)
        name = None if found.chunk is None else found.chunk.name
        measure = partial(
            self.appraisal.measure,
            landmark=name,
            view=next((view for _, view, no in slots if isinstance(view, View) and not no), None),
            now_s=self._start_s + t_s,
        )
        if found.chunk is None:
            return Recall(None, found.latency_s, confidence, measure)
        words = {
            slot: f"{slot}-of-{name}" if isinstance(value, View) else str(value)
            for slot, value in found.chunk.slots.items()
        }
        chunk = BufferChunk(found.chunk.type, words, name)
        return Recall(chunk, found.latency_s, confidence, measure)

    def view_of(self, landmark: str) -> View | None:
        """Return what a landmark is remembered to look like; None where memory holds no view."""
        if landmark not in self.declarative:
            return None
        view = self.declarative[landmark].slots.get("view")
        return view if isinstance(view, View) else None

    def surprise(self, view: str) -> float:
        """Return how surprising a view is among those of all landmarks (DeclarativeModule).

        Raises
        ------
        EngineError
            The word is no view's handle.
        """
        known = self._asked("view", view)
        assert isinstance(known, View)
        return self.appraisal.surprise(known)

    def harvest(self, chunk: BufferChunk, t_s: float) -> None:
        """Take a cleared chunk into declarative memory (DeclarativeModule)."""
        if chunk.name is not None and chunk.name in self.declarative:
            self.declarative.strengthen(chunk.name, t_s)
            return
        name = chunk.name or f"{chunk.chunk_type}-{len(self.declarative)}"
        slots = {slot: self._kept(slot, word, name) for slot, word in chunk.slots.items()}
        self.declarative.add(Chunk(name, chunk.chunk_type, slots), t_s)

    def mark(self, request: MarkRequest) -> BufferChunk | None:
        """Carry out what a rule decided (LandmarkModule).

        Raises
        ------
        EngineError
            The rule decides about no waiting reflex, or recognises no landmark that there is.
        """
        name = request.landmark or ""
        reflex = self._waiting.get(request.event)
        if reflex is None:
            raise EngineError(
                f"decides about event '{request.event}', which is no reflex that waits for a "
                "decision (decided already, or not the event of a reflex)"
            )
        if request.outcome == "recognised" and name not in self.topological:
            raise EngineError(f"recognises '{name}', which is no landmark")
        made = None
        if request.outcome != "dismissed":
            self._passing.marked(reflex.place)
        if request.outcome == "declared":
            name = self.topological.next_id()
            # Where it came from is known only if nobody has carried it since.
            if not len(self.topological) and self._start is not None and not self.carried:
                self.home = Home.behind(name, self._start, here_of(reflex), self._uncertainty)
            made = self._declare(name, reflex)
            self._expecting.at(reflex)
            before = self.whereabouts.find(name, here_of(reflex), *self._evidence)
            arrive(self.topological, name, reflex, before, new=True)
        elif request.outcome == "recognised":
            self._expecting.at(reflex)
            before = self.whereabouts.recognise(name, here_of(reflex), *self._evidence)
            self._see_more(name, reflex)
            arrive(self.topological, name, reflex, before, new=False)
        elif request.outcome == "unsure" and self._recalled is not None:
            self._expecting.at(reflex)
            self.whereabouts.doubt(here_of(reflex), *self._evidence)
        self._decide(
            request.event, request.t_s, request.outcome, name, request.rule, self._recalled
        )
        self._recalled = None
        return made

    def _declare(self, name: str, reflex: Reflex) -> BufferChunk:
        """Add a landmark to the graph; return its chunk for the landmark buffer."""
        self.topological.add_landmark(
            name,
            reflex.pose.x_m,
            reflex.pose.y_m,
            reflex.pose.theta_rad,
            reflex.t_s,
            sector=reflex.sector,
            structure=reflex.structure,
            novelty=reflex.novelty,
        )
        slots = {
            "id": name,
            "sector": reflex.sector,
            "structure": reflex.structure,
            "view": f"view-{reflex.event}",
            "place": f"place-{reflex.event}",
        }
        return BufferChunk("landmark", slots, name)

    def _see_more(self, name: str, reflex: Reflex) -> None:
        """Add to what is remembered of a landmark's surroundings what is seen of them now."""
        here, known = self.whereabouts.proven, self.view_of(name)
        if here is None or here.landmark != name or known is None:
            return
        if self._look is None or not reflex.directed:
            return
        turn_rad = reflex.place.theta_rad - here.fix.pose.theta_rad
        view = joined(known.descriptor, reflex.view, turn_rad)
        if view is not None:
            self.declarative.replace(name, "view", View(known.name, view))

    def _sides_of(self, reflex: Reflex, landmarks: Collection[str]) -> dict[str, Sides]:
        """Tell from which side landmarks would be seen, if a reflex was fired there."""
        if self._look is None:
            return {}
        views = {name: v.descriptor for name in landmarks if (v := self.view_of(name)) is not None}
        if not views:
            return {}
        sides = self.profile.surroundings.sides(reflex.view, np.array(list(views.values())))
        return dict(zip(views, sides, strict=True))

    def _likeness_of_places(self, asked: Value) -> Listed:
        return self._expecting.likeness(asked)

    @property
    def _evidence(self) -> tuple[dict[str, float], float]:
        return self._expecting.noted(None if self._recalled is None else self._recalled[0])

    def _asked(self, slot: str, word: str) -> Value:
        """Look up what a request asks for; only views and places are more than words."""
        if slot not in CONTINUOUS:
            return word
        if slot == "view" and (stored := self._stored_view(word)) is not None:
            return stored
        if slot == "place" and word.startswith(PLACE_OF):  # where a landmark is, no other is
            self._expecting.only(word.removeprefix(PLACE_OF))
            return word
        reflex = self._reflex_of(slot, word)
        if slot == "view":
            return View(word, reflex.view)
        self._expecting.at(reflex)
        return word

    def _looked_at(self, word: str, value: Value) -> Value:
        """Add to a reflex' view what is seen where landmarks are that it may be, astray."""
        reflex = self._waiting.get(word.removeprefix("view-"))
        if self._look is None or reflex is None or not reflex.directed:
            return value
        there = self._expecting.seen_there(reflex, self.view_of, self._look)
        return View(word, reflex.view, there)

    def _kept(self, slot: str, word: str, name: str) -> Value:
        """Return what a chunk of some name keeps in a slot."""
        if slot not in CONTINUOUS:
            return word
        if slot == "view" and (stored := self._stored_view(word)) is not None:
            return stored
        if slot == "place" and word.startswith(PLACE_OF):
            return word
        reflex = self._reflex_of(slot, word)
        return View(word, reflex.view) if slot == "view" else f"{PLACE_OF}{name}"

    def _stored_view(self, word: str) -> View | None:
        """Return the view of a landmark, by its handle."""
        owner = word.removeprefix(VIEW_OF)
        return None if owner == word else self.view_of(owner)

    def _reflex_of(self, slot: str, word: str) -> Reflex:
        """Return the reflex that a handle belongs to."""
        kind, _, event = word.partition("-")
        reflex = self._waiting.get(event) or self._known.get(event)
        if kind != slot or reflex is None:
            raise EngineError(f"slot '{slot}' holds '{word}', which is no {slot} of a reflex")
        return reflex

    def _decide(
        self,
        event: str,
        t_s: float,
        outcome: str,
        landmark: str,
        rule: str,
        recalled: tuple[Retrieval, float] | None,
    ) -> None:
        reflex = self._waiting.pop(event)
        self._known[event] = reflex
        if len(self._known) > REMEMBERED:
            self._known.popitem(last=False)
        best = None if recalled is None else recalled[0].candidates.best
        self._decided(
            Decision(
                event=reflex.event,
                scan=reflex.scan,
                t_s=reflex.t_s,
                # Engine time has its own zero: the sum may round to just before the percept.
                decided_s=max(self._start_s + t_s, reflex.perceived_s),
                pose=reflex.pose,
                true_pose=reflex.true_pose,
                modality=reflex.modality,
                novelty=reflex.novelty,
                sector=reflex.sector,
                structure=reflex.structure,
                decision=outcome,
                landmark=landmark,
                rule=rule,
                activation=None if best is None else best.total,
                confidence=None if recalled is None else recalled[1],
            )
        )
