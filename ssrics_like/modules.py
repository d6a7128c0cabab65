"""Joins the production engine to the landmark memories.

Rules see words only. A view or a place is too rich for a word, so it travels
through the rules as a handle: ``view-12`` is that of reflex 12, ``view-of-L3``
that of landmark L3. Handles are looked up here on their way to memory.
"""

from __future__ import annotations

import itertools
import math
from collections import OrderedDict
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
        self._decided = decided
        self._retrieved = retrieved
        self._start_s = 0.0
        self._waiting: dict[str, Reflex] = {}
        self._known: OrderedDict[str, Reflex] = OrderedDict()
        self._last: tuple[str, Reflex] | None = None
        self._recalled: Retrieval | None = None

    @property
    def undecided(self) -> int:
        """Number of reflexes about which nothing was decided yet."""
        return len(self._waiting)

    def begin(self, start_s: float) -> None:
        """Set the source's time that is zero in the engine."""
        self._start_s = start_s

    def admit(self, reflex: Reflex) -> BufferChunk:
        """Register a reflex and return its chunk for the orienting buffer."""
        event = str(reflex.event)
        self._waiting[event] = reflex
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
        slots = tuple((t.slot, self._value(t.slot, t.value), t.negated) for t in tests)
        found = self.declarative.retrieve(Request(chunk_type, slots), t_s, sources)
        self._recalled = found
        self._retrieved(t_s, found)
        if found.chunk is None:
            return Recall(None, found.latency_s)
        name = found.chunk.name
        words = {
            slot: f"{slot}-of-{name}" if isinstance(value, View | Place) else str(value)
            for slot, value in found.chunk.slots.items()
        }
        return Recall(BufferChunk(found.chunk.type, words, name), found.latency_s)

    def harvest(self, chunk: BufferChunk, t_s: float) -> None:
        """Take a cleared chunk into declarative memory (DeclarativeModule)."""
        if chunk.name is not None and chunk.name in self.declarative:
            self.declarative.strengthen(chunk.name, t_s)
            return
        slots = {slot: self._value(slot, word) for slot, word in chunk.slots.items()}
        name = chunk.name or f"{chunk.chunk_type}-{len(self.declarative)}"
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
        if request.outcome == "declared":
            name = f"L{len(self.topological) + 1}"
            made = self._declare(name, reflex)
        if request.outcome in ("declared", "recognised"):
            self._arrive(name, reflex, new=made is not None)
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
            salience=reflex.novelty,
        )
        slots = {
            "id": name,
            "sector": reflex.sector,
            "structure": reflex.structure,
            "view": f"view-{reflex.event}",
            "place": f"place-{reflex.event}",
        }
        return BufferChunk("landmark", slots, name)

    def _arrive(self, name: str, reflex: Reflex, *, new: bool) -> None:
        """Note in the memories that the robot came to a landmark, if it was at another before."""
        if self._last is not None and self._last[0] != name:
            left, before = self._last
            dx = reflex.pose.x_m - before.pose.x_m
            dy = reflex.pose.y_m - before.pose.y_m
            self.topological.traverse(
                left,
                name,
                math.hypot(dx, dy),
                math.atan2(dy, dx) - before.pose.theta_rad,
                # Rules may decide about two reflexes in either order; the way between is the same.
                abs(reflex.travelled_m - before.travelled_m),
            )
            if not new:
                self.topological.visit(name, reflex.t_s)
                self._relocate(name, reflex)
        self._last = (name, reflex)

    def _relocate(self, name: str, reflex: Reflex) -> None:
        """Move a landmark's place towards where odometry has it now.

        By the ratio of variances (a Kalman gain): all the way after long travel, when odometry has
        drifted by more than a mark scatters; not at all without drift. So a landmark follows the
        drift, and does not creep after the robot.
        """
        place = self.declarative[name].slots.get("place") if name in self.declarative else None
        if not isinstance(place, Place):
            return
        drift = (self.profile.place_drift * (reflex.travelled_m - place.travelled_m)) ** 2
        gain = drift / (drift + self.profile.place_sigma_m**2)
        here = Place(
            place.x_m + gain * (reflex.pose.x_m - place.x_m),
            place.y_m + gain * (reflex.pose.y_m - place.y_m),
            reflex.travelled_m,
        )
        self.declarative.replace(name, "place", here)

    def _value(self, slot: str, word: str) -> str | View | Place:
        """Look a handle up; other slots hold plain words."""
        if slot not in CONTINUOUS:
            return word
        kind, _, rest = word.partition("-")
        owner = rest.removeprefix("of-")
        if kind == slot and owner != rest and owner in self.declarative:
            stored = self.declarative[owner].slots.get(slot)
            if isinstance(stored, View | Place):
                return stored
        reflex = self._waiting.get(rest) or self._known.get(rest)
        if kind != slot or reflex is None:
            raise EngineError(f"slot '{slot}' holds '{word}', which is no {slot} of a reflex")
        if slot == "view":
            return View(word, reflex.view)
        return Place(reflex.pose.x_m, reflex.pose.y_m, reflex.travelled_m)

    def _decide(
        self,
        event: str,
        t_s: float,
        outcome: str,
        landmark: str,
        rule: str,
        recalled: Retrieval | None,
    ) -> None:
        reflex = self._waiting.pop(event)
        self._known[event] = reflex
        if len(self._known) > REMEMBERED:
            self._known.popitem(last=False)
        activation, confidence = self._certainty(recalled)
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
                activation=activation,
                confidence=confidence,
            )
        )

    def _certainty(self, recalled: Retrieval | None) -> tuple[float | None, float | None]:
        """Return the best activation, and how probable this retrieval's outcome was.

        Every candidate i passes the threshold with ACT-R's recall probability
        p_i = 1 / (1 + exp(-(A_i - tau) / s)), A_i before noise; a failure has the probability
        prod(1 - p_i), a success the rest. Without noise either is certain.
        """
        if recalled is None:
            return None, None
        found = recalled.candidates
        best = found.best
        if best is None or self.profile.activation_noise == 0:
            return best.total if best else None, 1.0
        above = (found.total - found.noise - found.threshold) / self.profile.activation_noise
        failure = float(np.exp(-np.logaddexp(0.0, above).sum()))
        return best.total, failure if recalled.chunk is None else 1.0 - failure
