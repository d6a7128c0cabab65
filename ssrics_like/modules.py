"""Joins the production engine to the landmark memories.

Rules see words only. A view or a place is too rich for a word, so it travels
through the rules as a handle, ``view-12`` for that of reflex 12, and is looked
up here on its way to declarative memory.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Mapping, Sequence

import numpy as np

from ssrics_like.decision import Decision
from ssrics_like.errors import EngineError
from ssrics_like.memory import (
    Chunk,
    DeclarativeMemory,
    Place,
    PlaceSimilarity,
    Request,
    Retrieval,
    TableSimilarity,
    TopologicalMemory,
    View,
    ViewSimilarity,
)
from ssrics_like.memory.profile import MemoryProfile
from ssrics_like.perception.reflex import Reflex
from ssrics_like.productions.interface import BufferChunk, MarkRequest, Recall, SlotTest

CONTINUOUS = ("view", "place")
SECTORS = ("left", "front", "right")


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
    """

    def __init__(
        self,
        profile: MemoryProfile,
        rng: np.random.Generator,
        decided: Callable[[Decision], None],
        retrieved: Callable[[float, Retrieval], None],
    ) -> None:
        self.profile = profile
        self.declarative = DeclarativeMemory(
            profile,
            rng,
            {
                "sector": TableSimilarity(
                    dict.fromkeys(itertools.combinations(SECTORS, 2), profile.sector_difference)
                ),
                "view": ViewSimilarity(profile.view_difference),
                "place": PlaceSimilarity(profile.place_sigma_m, profile.place_drift),
            },
        )
        self.topological = TopologicalMemory()
        self.last: str | None = None
        self._decided = decided
        self._retrieved = retrieved
        self._start_s = 0.0
        self._travelled_m = 0.0
        self._reflexes: dict[str, tuple[Reflex, float]] = {}
        self._made: dict[str, tuple[Reflex, float]] = {}
        self._left: tuple[Reflex, float] | None = None
        self._recalled: Retrieval | None = None

    @property
    def undecided(self) -> int:
        """Number of reflexes about which nothing was decided yet."""
        return len(self._reflexes)

    def begin(self, start_s: float) -> None:
        """Set the source's time that is zero in the engine."""
        self._start_s = start_s

    def travel(self, distance_m: float) -> None:
        """Count the distance the robot went since the last call."""
        self._travelled_m += distance_m

    def admit(self, reflex: Reflex) -> BufferChunk:
        """Register a reflex and return its chunk for the orienting buffer."""
        event = str(reflex.event)
        self._reflexes[event] = (reflex, self._travelled_m)
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
        self._decide(chunk.slots["event"], t_s, "overwritten", "", "", asked=False)

    def recall(
        self,
        chunk_type: str,
        tests: Sequence[SlotTest],
        t_s: float,
        sources: Mapping[str, Sequence[str]],
    ) -> Recall:
        """Answer a retrieval request (DeclarativeModule)."""
        slots = tuple((t.slot, self._value(t.slot, t.value), t.negated) for t in tests)
        found = self.declarative.retrieve(Request(chunk_type, slots), t_s, sources)
        self._recalled = found
        self._retrieved(t_s, found)
        if found.chunk is None:
            return Recall(None, found.latency_s)
        words = {slot: _word(value) for slot, value in found.chunk.slots.items()}
        return Recall(BufferChunk(found.chunk.type, words, found.chunk.name), found.latency_s)

    def harvest(self, chunk: BufferChunk, t_s: float) -> None:
        """Take a cleared chunk into declarative memory (DeclarativeModule)."""
        if chunk.name is not None and chunk.name in self.declarative:
            self.declarative.strengthen(chunk.name, t_s)
            return
        seen = self._made.get(chunk.name or "")
        slots = {slot: self._value(slot, word, seen) for slot, word in chunk.slots.items()}
        name = chunk.name or f"{chunk.chunk_type}-{len(self.declarative)}"
        self.declarative.add(Chunk(name, chunk.chunk_type, slots), t_s)
        self._made.pop(name, None)

    def mark(self, request: MarkRequest) -> BufferChunk | None:
        """Carry out what a rule decided (LandmarkModule).

        Raises
        ------
        EngineError
            The rule decides about no waiting reflex, or recognises no landmark that there is.
        """
        name = request.landmark or ""
        if request.event not in self._reflexes:
            raise EngineError(
                f"rule '{request.rule}' decides about event '{request.event}', which is no reflex "
                "that waits for a decision (decided already, or not the event of a reflex)"
            )
        if request.outcome == "recognised" and name not in self.topological:
            raise EngineError(f"rule '{request.rule}' recognises '{name}', which is no landmark")
        reflex, travelled_m = self._reflexes[request.event]
        made = None
        if request.outcome == "declared":
            name = f"L{len(self.topological) + 1}"
            self.topological.add_landmark(
                name,
                reflex.pose.x_m,
                reflex.pose.y_m,
                reflex.pose.theta_rad,
                reflex.t_s,
                sector=reflex.sector,
                structure=reflex.structure,
                salience=reflex.novelty,
            )
            self._made[name] = (reflex, travelled_m)
            slots = {
                "id": name,
                "sector": reflex.sector,
                "structure": reflex.structure,
                "view": f"view-{request.event}",
                "place": f"place-{request.event}",
            }
            made = BufferChunk("landmark", slots, name)
        if request.outcome in ("declared", "recognised"):
            self._arrive(name, reflex, travelled_m, new=request.outcome == "declared")
        self._decide(request.event, request.t_s, request.outcome, name, request.rule)
        return made

    def _arrive(self, name: str, reflex: Reflex, travelled_m: float, *, new: bool) -> None:
        """Note in the topological memory that the robot came to a landmark."""
        if self.last is not None and self._left is not None and self.last != name:
            before, travelled_before_m = self._left
            dx = reflex.pose.x_m - before.pose.x_m
            dy = reflex.pose.y_m - before.pose.y_m
            self.topological.traverse(
                self.last,
                name,
                math.hypot(dx, dy),
                math.atan2(dy, dx) - before.pose.theta_rad,
                max(travelled_m - travelled_before_m, math.hypot(dx, dy)),
            )
        if not new and self.last != name:
            self.topological.visit(name, reflex.t_s)
            if name in self.declarative and "place" in self.declarative[name].slots:
                # The landmark stays where it was marked first: to move it with every recognition
                # would let it creep after the robot. Only its uncertainty starts anew.
                place = self.declarative[name].slots["place"]
                if isinstance(place, Place):
                    renewed = Place(place.x_m, place.y_m, travelled_m)
                    self.declarative.replace(name, "place", renewed)
        self.last = name
        self._left = (reflex, travelled_m)

    def _value(
        self, slot: str, word: str, seen: tuple[Reflex, float] | None = None
    ) -> str | View | Place:
        """Look a handle up: the view or place of a reflex that is `seen` or still to be decided."""
        if slot not in CONTINUOUS:
            return word
        reflex, travelled_m = seen or self._reflexes[word.partition("-")[2]]
        if slot == "view":
            return View(word, reflex.view)
        return Place(reflex.pose.x_m, reflex.pose.y_m, travelled_m)

    def _decide(
        self, event: str, t_s: float, outcome: str, landmark: str, rule: str, *, asked: bool = True
    ) -> None:
        reflex, _ = self._reflexes.pop(event)
        activation, confidence = self._certainty(outcome) if asked else (None, None)
        if asked:
            self._recalled = None
        self._decided(
            Decision(
                event=reflex.event,
                scan=reflex.scan,
                t_s=reflex.t_s,
                decided_s=self._start_s + t_s,
                pose=reflex.pose,
                true_pose=reflex.true_pose,
                modality=reflex.modality,
                novelty=reflex.novelty,
                sector=reflex.sector,
                structure=reflex.structure,
                decision=outcome,
                landmark=landmark,
                rule=rule,
                activation=activation,
                confidence=confidence,
            )
        )

    def _certainty(self, outcome: str) -> tuple[float | None, float | None]:
        """Return the activation that decided, and the probability of the same outcome.

        ACT-R's recall probability, 1 / (1 + exp(-(A - tau) / s)), with the activation before noise.
        """
        found = self._recalled
        if found is None:
            return None, None
        best = found.candidates.best
        if best is None:
            return None, 1.0
        noiseless = best.total - best.noise
        scale = self.profile.activation_noise
        distance = noiseless - self.profile.retrieval_threshold
        recall = float(distance >= 0) if scale == 0 else _logistic(distance / scale)
        return best.total, recall if outcome == "recognised" else 1.0 - recall


def _word(value: object) -> str:
    """Put a slot's value into a word that rules can carry."""
    if isinstance(value, Place):
        return f"x{value.x_m:.2f}y{value.y_m:.2f}"
    return value.name if isinstance(value, View) else str(value)


def _logistic(x: float) -> float:
    return 1.0 / (1.0 + math.exp(-x)) if x >= 0 else math.exp(x) / (1.0 + math.exp(x))
