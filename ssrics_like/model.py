"""The model of the mind: observations in, decisions out.

Every source, a log, a simulated building or a live robot, comes through
`CognitiveModel.observe`, one observation at a time.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ssrics_like.cues import read_cue
from ssrics_like.decision import Decision
from ssrics_like.errors import choices
from ssrics_like.library import find_cue
from ssrics_like.memory import DeclarativeMemory, Retrieval, TopologicalMemory
from ssrics_like.memory.profile import MemoryProfile
from ssrics_like.modules import LandmarkModules
from ssrics_like.perception.observation import Observation
from ssrics_like.perception.profile import PerceptionProfile
from ssrics_like.perception.reflex import PerceptionBuffer, Reflex
from ssrics_like.productions.engine import Engine
from ssrics_like.productions.interface import TraceEvent
from ssrics_like.productions.rules import Rulebook

FRAMES = ("odometry", "corrected", "map")


class CognitiveModel:
    """A perception buffer, a rule set and two memories, joined.

    Parameters
    ----------
    perception : PerceptionProfile
        How the model senses.
    productions : Rulebook
        What it knows how to do.
    memory : MemoryProfile
        How it remembers.
    seed : int
        Seed of activation noise and utility noise.
    frame : {"odometry", "corrected", "map"}
        Frame of the observations' poses. Only odometry drifts; in the others a place stays as
        certain as it was, whatever the memory profile's `place_drift`.
    trace : callable, optional
        Receives every TraceEvent; its times are in seconds since the first observation.
    retrieved : callable, optional
        Receives (engine time, Retrieval) for every retrieval, with each candidate's activation.

    Raises
    ------
    LibraryError, CueError
        There is no cue of the name in `perception`; it is damaged.

    Examples
    --------
    >>> from ssrics_like import CognitiveModel, load_memory, load_perception, load_productions
    >>> model = CognitiveModel(
    ...     load_perception("report"), load_productions("report"), load_memory("act-r"))
    >>> model.decisions_pending
    0
    """

    def __init__(
        self,
        perception: PerceptionProfile,
        productions: Rulebook,
        memory: MemoryProfile,
        *,
        seed: int = 0,
        frame: str = "odometry",
        trace: Callable[[TraceEvent], None] = lambda _: None,
        retrieved: Callable[[float, Retrieval], None] = lambda _time, _retrieval: None,
    ) -> None:
        if frame not in FRAMES:
            raise ValueError(f"frame is {frame!r}; expected one of {choices(FRAMES)}")
        if frame != "odometry":
            memory = memory.model_copy(update={"place_drift": 0.0})
        memory_seed, utility_seed = np.random.SeedSequence(seed).spawn(2)
        doorways = read_cue(find_cue(perception.doorways)) if perception.doorways else None
        self.perception = PerceptionBuffer(perception, doorways)
        self._decisions: list[Decision] = []
        self._modules = LandmarkModules(
            memory, np.random.default_rng(memory_seed), self._decisions.append, retrieved
        )
        self.engine = Engine(
            productions,
            self._modules,
            self._modules,
            seed=int(utility_seed.generate_state(1)[0]),
            trace=trace,
        )
        self._start_s: float | None = None
        self._previous: Observation | None = None

    @property
    def declarative(self) -> DeclarativeMemory:
        """The declarative memory."""
        return self._modules.declarative

    @property
    def topological(self) -> TopologicalMemory:
        """The landmarks and the arcs between them."""
        return self._modules.topological

    @property
    def decisions_pending(self) -> int:
        """Number of reflexes that were fired but not decided yet."""
        return self._modules.undecided

    def observe(self, observation: Observation) -> list[Decision]:
        """Take one observation and return what was decided up to now.

        Parameters
        ----------
        observation : Observation
            The next record of the source; its time must not fall.

        Returns
        -------
        list of Decision
            In the order of deciding. A decision comes later than what it is about: perception
            waits for a peak of novelty to pass, and a retrieval takes time.

        Raises
        ------
        ValueError
            The observation is older than the one before it.
        """
        if self._start_s is None:
            self._start_s = observation.t_s
            self._modules.begin(observation.t_s)
        if self._previous is not None and observation.t_s < self._previous.t_s:
            raise ValueError(
                f"observation {observation.index} is at {observation.t_s} s, before "
                f"{self._previous.t_s} s; observations must come in order of time"
            )
        self._previous = observation
        now_s = observation.t_s - self._start_s
        self.engine.advance(now_s)
        for reflex in self.perception.update(observation):
            self._orient(reflex, now_s)
        return self._take()

    def finish(self) -> list[Decision]:
        """End the run: report what perception still holds back and settle the productions.

        Returns
        -------
        list of Decision
            The last decisions.
        """
        if self._previous is not None and self._start_s is not None:
            now_s = self._previous.t_s - self._start_s
            for reflex in self.perception.flush():
                self.engine.settle()
                self._orient(reflex, max(now_s, self.engine.now_s))
        self.engine.settle()
        return self._take()

    def _orient(self, reflex: Reflex, now_s: float) -> None:
        """Put a reflex before the productions; one that waited there in vain is lost."""
        overwritten = self.engine.push("orienting", self._modules.admit(reflex), now_s)
        if overwritten is not None:
            self._modules.overwrite(overwritten, now_s)

    def _take(self) -> list[Decision]:
        taken = self._decisions.copy()
        self._decisions.clear()
        return taken
