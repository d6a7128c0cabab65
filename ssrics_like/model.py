"""The model of the mind: observations in, decisions out.

Every source, a log, a simulated building or a live robot, comes through
`CognitiveModel.observe`, one observation at a time.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ssrics_like.cues import read_cue, read_structure_cue
from ssrics_like.decision import Decision
from ssrics_like.errors import choices
from ssrics_like.library import find_cue
from ssrics_like.memory import (
    DeclarativeMemory,
    Retrieval,
    SavedMemory,
    TopologicalMemory,
    Worth,
)
from ssrics_like.memory.profile import MemoryProfile
from ssrics_like.modules import LandmarkModules
from ssrics_like.perception.observation import Observation
from ssrics_like.perception.profile import PerceptionProfile
from ssrics_like.perception.reflex import PerceptionBuffer, Reflex
from ssrics_like.productions.engine import Engine
from ssrics_like.productions.interface import TraceEvent
from ssrics_like.productions.rules import Rulebook
from ssrics_like.wayfinding import Wayfinder

FRAMES = ("odometry", "corrected", "map")
NO_HOME = "it remembers no home: where a first run began that marked a landmark"
DRIFTS = ("place_drift", "swerve_drift_rad", "turn_drift_rad", "wheel_bias")


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
        Frame of the observations' poses. Only odometry drifts; in the others the memory profile's
        drifts count as 0, and poses are not corrected by matching scans.
    trace : callable, optional
        Receives every TraceEvent; its times are in seconds since the first observation.
    retrieved : callable, optional
        Receives (engine time, Retrieval) for every retrieval, with each candidate's activation.
    remembered : SavedMemory, optional
        What an earlier run left: the model begins with it at the moment of its saving (see
        `SavedMemory.aged`), and numbers landmarks on.
    at_home : bool
        Whether the robot begins where the first run of that memory began; otherwise it may be
        anywhere.

    Attributes
    ----------
    perception : PerceptionBuffer
        What it senses.
    engine : Engine
        Its productions.
    wayfinder : Wayfinder
        Leads a robot that it is joined to.

    Raises
    ------
    LibraryError, CueError
        There is no cue of the name in `perception`; it is damaged.
    ValueError
        `remembered` has views of another length, or positions in another frame; with `at_home`,
        there is none or it knows no home.

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
        remembered: SavedMemory | None = None,
        at_home: bool = False,
    ) -> None:
        if frame not in FRAMES:
            raise ValueError(f"frame is {frame!r}; expected one of {choices(FRAMES)}")
        if frame != "odometry":
            memory = memory.model_copy(update=dict.fromkeys(DRIFTS, 0.0))
            perception = perception.model_copy(update={"egomotion": "odometry"})
        elif perception.egomotion == "laser":
            memory = memory.model_copy(update={"wheel_bias": 0.0})
        memory_seed, utility_seed = np.random.SeedSequence(seed).spawn(2)
        doorways = read_cue(find_cue(perception.doorways)) if perception.doorways else None
        structure = (
            read_structure_cue(find_cue(perception.structure)) if perception.structure else None
        )
        self.perception = PerceptionBuffer(perception, doorways, structure)
        self._decisions: list[Decision] = []
        self._modules = LandmarkModules(
            memory,
            np.random.default_rng(memory_seed),
            self._decisions.append,
            retrieved,
            look=self.perception.view_of if self.perception.looks_round else None,
        )
        self.wayfinder = Wayfinder(
            self._modules,
            self.perception,
            lambda chunk: self.engine.push("way", chunk, self.now_s),
        )
        self.engine = Engine(
            productions,
            self._modules,
            self._modules,
            self.wayfinder,
            seed=int(utility_seed.generate_state(1)[0]),
            trace=trace,
        )
        self._frame = frame
        self._remembered = remembered
        self._at_home = at_home
        self._start_s: float | None = None
        self._previous: Observation | None = None
        if remembered is not None:
            remembered.check_views(perception.view_length)
            remembered.check_frame(frame)
            remembered.recall_into(self._modules.declarative)
            self._modules.start_from(remembered.topological(), remembered.home)
        if at_home and (remembered is None or remembered.home is None):
            raise ValueError(NO_HOME)

    @property
    def declarative(self) -> DeclarativeMemory:
        """The declarative memory."""
        return self._modules.declarative

    @property
    def topological(self) -> TopologicalMemory:
        """The landmarks and the arcs between them."""
        return self._modules.topological

    def worths(self) -> dict[str, Worth]:
        """Return salience, relevance and permanence of every landmark now, by its name."""
        return self._modules.appraisal.worths((self._start_s or 0.0) + self.now_s)

    @property
    def now_s(self) -> float:
        """The model's time: seconds since the first observation."""
        if self._previous is None or self._start_s is None:
            return self.engine.now_s
        return max(self.engine.now_s, self._previous.t_s - self._start_s)

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
            if (known := self._remembered) is not None:  # the graph's times are the source's
                self._modules.start_from(known.topological(observation.t_s), known.home)
        if self._previous is not None and observation.t_s < self._previous.t_s:
            raise ValueError(
                f"observation {observation.index} is at {observation.t_s} s, before "
                f"{self._previous.t_s} s; observations must come in order of time"
            )
        began = self._previous is None
        self._previous = observation
        now_s = observation.t_s - self._start_s
        self.engine.advance(now_s)
        for reflex in self.perception.update(observation):
            self._orient(reflex, now_s)
        here = self.perception.here
        if began and here is not None:
            self._modules.begin_at(here, at_home=self._at_home)
        if here is not None and self.perception.carried == self._modules.carried:
            self._modules.go(here, self.perception.travelled_m)
        self.wayfinder.look(observation.t_s)
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

    def saved_memory(self, run: str) -> SavedMemory:
        """Return what a later run can go on from: all that memory holds now.

        Parameters
        ----------
        run : str
            Names this run among all runs, so that its landmarks are known again when memories
            are merged.

        Returns
        -------
        SavedMemory

        Raises
        ------
        ValueError
            The model began with a memory that has been through a run of this name.
        """
        return SavedMemory.of(
            self.declarative,
            self.topological,
            run=run,
            before=self._remembered,
            now_s=self.now_s,
            start_s=self._start_s or 0.0,
            frame=self._frame,
            home=self._modules.home,
        )

    def _orient(self, reflex: Reflex, now_s: float) -> None:
        """Put a reflex before the productions; one that waited there in vain is lost."""
        overwritten = self.engine.push("orienting", self._modules.admit(reflex), now_s)
        if overwritten is not None:
            self._modules.overwrite(overwritten, now_s)

    def _take(self) -> list[Decision]:
        taken = self._decisions.copy()
        self._decisions.clear()
        return taken
