"""Runs a rule set on pyactr; the only place that touches pyactr's internals.

Chunks are pushed in from outside at the moment a reflex fires, so that pyactr
costs nothing between reflexes. Each rule's two sides are built once; pyactr
would parse them anew at every conflict resolution.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from functools import partial
from importlib.metadata import version
from typing import Any

import numpy as np

from ssrics_like.errors import EngineError
from ssrics_like.productions.interface import (
    BufferChunk,
    DeclarativeModule,
    LandmarkModule,
    MarkRequest,
    StepRequest,
    TraceEvent,
    WayModule,
)
from ssrics_like.productions.rules import Rule, Rulebook
from ssrics_like.productions.syntax import Clause
from ssrics_like.productions.tracing import Tracer
from ssrics_like.productions.vocabulary import PUSHED, STEP_SLOTS

# pyactr's source has escapes that newer Pythons warn of, and it warns of interrupted requests,
# which the trace shows; neither is the user's concern.
warnings.filterwarnings("ignore", module=r"pyactr.*")

import pyactr  # noqa: E402
from pyactr import chunks, utilities  # noqa: E402

from ssrics_like.productions import buffers  # noqa: E402

PYACTR_VERSION = "0.3.2"
UNNAMED, PROCEDURAL = "UNKNOWN", "PROCEDURAL"  # how pyactr marks its events
FIRINGS_LIMIT = 1000
"""A rule set that fires so often after its last input is taken to run for ever."""
INSTANT_S = 5e-5
"""Half of pyactr's tick: what lies within it happens at the same moment."""


def probe() -> None:
    """Check that pyactr is the version whose internals this file reads.

    Raises
    ------
    EngineError
        It is another version, or an internal name is missing.
    """
    found = version("pyactr")
    if found != PYACTR_VERSION:
        raise EngineError(
            f"pyactr {found} is installed; ssrics-like needs exactly {PYACTR_VERSION}, "
            f"because the engine builds on its internals (pip install pyactr=={PYACTR_VERSION})"
        )
    model = pyactr.ACTRModel()
    for owner, name in (
        (model, "_ACTRModel__buffers"),
        (pyactr.simulation.Simulation, "__activate__"),
        (pyactr.simulation.Simulation, "__printevent__"),
        (chunks.Chunk, "_chunktypes"),
    ):
        if not hasattr(owner, name):
            raise EngineError(f"pyactr {found} lacks the internal name {name}; reinstall pyactr")


class Engine:
    """A rule set at work.

    Parameters
    ----------
    rulebook : Rulebook
        The rules, their chunk types and the first goal.
    memory : DeclarativeModule
        Answers ``+retrieval>`` and takes in cleared chunks.
    landmarks : LandmarkModule
        Answers ``+landmark>``.
    way : WayModule, optional
        Answers ``+way>``; without it a rule that asks raises EngineError.
    seed : int
        For utility noise.
    trace : callable
        Receives every TraceEvent as it happens.
    stock : mapping, optional
        Parity mode: pyactr's own declarative memory, goal buffers and rule parser, with these
        model parameters of pyactr. `memory` is then not asked.

    Raises
    ------
    EngineError
        Another version of pyactr is installed.
    """

    def __init__(
        self,
        rulebook: Rulebook,
        memory: DeclarativeModule,
        landmarks: LandmarkModule,
        way: WayModule | None = None,
        *,
        seed: int = 0,
        trace: Callable[[TraceEvent], None] = lambda _: None,
        stock: Mapping[str, Any] | None = None,
    ) -> None:
        probe()
        self.rulebook = rulebook
        self.firings = 0
        self._rules = {rule.name: rule for rule in rulebook.rules}
        self._random = np.random.RandomState(seed).get_state()
        self._noisy = rulebook.parameters.utility_noise > 0
        self._fired = ""
        self._types = buffers.ChunkTypes(rulebook.chunk_types)
        model = pyactr.ACTRModel(
            subsymbolic=True,
            rule_firing=rulebook.parameters.rule_firing,
            utility_noise=rulebook.parameters.utility_noise,
            **(stock or {}),
        )
        self._buffers = self._wire(model, memory, landmarks, way, is_stock=stock is not None)
        for rule in rulebook.rules:
            if stock is None:
                model.productions.update({rule.name: _compiled(rule, self._types)})
            else:
                text = "\n".join(line.partition("#")[0] for line in rule.source.splitlines())
                model.productionstring(name=rule.name, string=text, utility=rule.utility)
        self._simulation = model.simulation(gui=False, trace=False)
        self._environment = self._simulation._Simulation__simulation  # noqa: SLF001 - no public way
        self._used_rules = model.productions.used_rulenames
        self._tracer = Tracer(self._rules, self._content, trace)
        self._simulation.__printevent__ = self._note
        self._tracer.emit(0.0, "goal", "set-buffer-chunk", "g")

    def _wire(
        self,
        model: Any,
        memory: DeclarativeModule,
        landmarks: LandmarkModule,
        way: WayModule | None,
        *,
        is_stock: bool,
    ) -> dict[str, Any]:
        """Put the model's buffers in place and the first goal into its buffer."""
        kept, types = self.rulebook.harvest, self._types
        delay = self.rulebook.parameters.imaginal_delay

        def harvest(buffer: str) -> Callable[[BufferChunk, float], None] | None:
            return memory.harvest if buffer in kept else None

        made: dict[str, Any] = {
            "orienting": buffers.OrientingBuffer(types, harvest("orienting"), memory.surprise),
            "landmark": buffers.AskedBuffer(
                types,
                harvest("landmark"),
                lambda slots, t_s: landmarks.mark(
                    MarkRequest(
                        slots["outcome"], slots["event"], slots.get("landmark"), self._fired, t_s
                    )
                ),
            ),
            "way": buffers.AskedBuffer(types, harvest("way"), partial(self._step, way)),
        }
        if is_stock:
            for name, slots_of_type in self.rulebook.chunk_types.items():
                chunks.chunktype(name, " ".join(slots_of_type))
            made["g"], made["retrieval"] = model.goal, model.retrieval
            made["imaginal"] = model.set_goal("imaginal", delay)
        else:
            made["g"] = buffers.ImaginalBuffer(types, harvest("g"), 0.0)
            made["imaginal"] = buffers.ImaginalBuffer(types, harvest("imaginal"), delay)
            made["retrieval"] = buffers.RetrievalBuffer(
                types, harvest("retrieval"), memory, self._sources
            )
            model.retrievals["retrieval"] = made["retrieval"]
            model.goals.update(g=made["g"], imaginal=made["imaginal"])
        model._ACTRModel__buffers.update(made)  # noqa: SLF001 - no public method takes a buffer
        slots = {slot: word for slot, word in self.rulebook.goal.items() if slot != "isa"}
        made["g"].add(types.build(self.rulebook.goal["isa"], slots))
        return made

    @property
    def now_s(self) -> float:
        """Engine time in seconds."""
        return float(self._simulation.show_time())

    @property
    def idle(self) -> bool:
        """Whether nothing is left to happen until the next push."""
        return bool(self._environment.peek() == float("inf"))

    def push(self, buffer: str, chunk: BufferChunk, t_s: float) -> BufferChunk | None:
        """Put a chunk into a perceptual buffer at a time and wake the productions.

        Parameters
        ----------
        buffer : str
            ``orienting`` or ``way``.
        chunk : BufferChunk
            The chunk.
        t_s : float
            Engine time, not before `now_s`.

        Returns
        -------
        BufferChunk or None
            The unattended chunk that this one overwrote.
        """
        self._run(t_s)
        holder = self._buffers[buffer]
        overwritten: BufferChunk | None = None if holder.attended else holder.content
        holder.put(chunk)
        event = utilities.Event(self.now_s, buffer, "PUSHED")
        self._simulation.__printevent__(event)
        self._simulation.__activate__(event)
        return overwritten

    def waiting(self, buffer: str) -> BufferChunk | None:
        """Return the chunk that a buffer holds."""
        return self._content(buffer)

    def advance(self, t_s: float) -> None:
        """Let happen all that happens up to `t_s`; costs next to nothing when idle."""
        if self._environment.peek() <= t_s:
            self._run(t_s)

    def settle(self) -> None:
        """Run until nothing is left to happen, however long a retrieval takes.

        Raises
        ------
        EngineError
            The rules go on firing without any input.
        """
        limit = self.firings + FIRINGS_LIMIT
        with self._at_work():
            while not self.idle:
                self._environment.step()
                if self.firings > limit:
                    raise EngineError(
                        f"the rules fired {FIRINGS_LIMIT} times since the last input and go on; "
                        "a rule must change what it tests"
                    )
        self._tracer.flush()

    def _run(self, t_s: float) -> None:
        """Let happen all that happens up to a time, and set the clock to it.

        Not by simulation.run(until): some versions of simpy leave its stop event queued, after
        which the model never looks idle; and it stops in the middle of an instant, where a rule
        may have fired whose actions are still to come.
        """
        until = round(t_s, 4)  # pyactr's clock has tenths of a millisecond
        with self._at_work():
            if until > self.now_s:
                arrival = self._environment.timeout(until - self._environment.now)
                while not arrival.processed:
                    self._environment.step()
            while self._environment.peek() <= until + INSTANT_S:
                self._environment.step()

    @contextmanager
    def _at_work(self) -> Iterator[None]:
        """Let pyactr work: with this model's random stream, naming the rule in errors."""
        with self._own_random():
            try:
                yield
            except (utilities.ACTRError, EngineError) as e:
                raise EngineError(f"{self.rulebook.path}: rule '{self._fired}': {e}") from e
        self._used_rules.clear()  # a record for utility learning that would grow without end

    @contextmanager
    def _own_random(self) -> Iterator[None]:
        """Give pyactr, which draws from numpy's global generator, this model's own stream."""
        if not self._noisy:
            yield
            return
        outside = np.random.get_state()  # noqa: NPY002
        np.random.set_state(self._random)  # noqa: NPY002
        try:
            yield
        finally:
            self._random = np.random.get_state()  # noqa: NPY002
            np.random.set_state(outside)  # noqa: NPY002

    def _note(self, event: Any) -> None:
        """Receive each event of pyactr, in place of its printing."""
        self._simulation.current_event = event
        if event.action == UNNAMED:
            return
        if event.proc == PROCEDURAL and event.action.startswith("RULE FIRED: "):
            self._fired = event.action.removeprefix("RULE FIRED: ")
            self.firings += 1
            tests = self._rules[self._fired].text.tests
            for buffer in PUSHED:
                if any(test.sign == "=" and test.buffer == buffer for test in tests):
                    self._buffers[buffer].attended = True
        self._tracer.translate(float(event.time), event.proc, event.action)

    def _content(self, buffer: str) -> BufferChunk | None:
        holder = self._buffers.get(buffer)
        for chunk in holder if holder is not None else ():
            return self._types.read(chunk)
        return None

    def _step(
        self, way: WayModule | None, slots: Mapping[str, str], t_s: float
    ) -> BufferChunk | None:
        """Have the robot do what a rule asks for."""
        if way is None:
            raise EngineError("asks for a way, but nothing that could go there is joined to it")
        act, to, outcome, reason = (slots.get(slot, "") for slot in STEP_SLOTS)
        return way.step(StepRequest(act, to, outcome, reason, self._fired, t_s))

    def _sources(self) -> dict[str, tuple[str, ...]]:
        """Return the values in the goal and imaginal chunks: sources of spreading activation."""
        found = {}
        for buffer in ("g", "imaginal"):
            content = self._content(buffer)
            if content is not None:
                found[buffer] = tuple(content.slots.values())
        return found


def _compiled(rule: Rule, types: buffers.ChunkTypes) -> dict[str, Any]:
    """Build pyactr's form of a rule: a generator of its two sides, built only once."""
    left = {
        f"{c.sign}{c.buffer}": _query(c) if c.sign == "?" else _chunk(c, types)
        for c in rule.text.tests
    }
    right = {
        f"{c.sign}{c.buffer}": None if c.sign == "~" else _chunk(c, types, filled=False)
        for c in rule.text.actions
    }

    def sides() -> Iterator[dict[str, Any]]:
        yield left
        yield right

    return {"rule": sides, "utility": rule.utility, "reward": None}


def _query(clause: Clause) -> dict[str, str]:
    return {pair.slot: pair.word for pair in clause.pairs}


def _chunk(clause: Clause, types: buffers.ChunkTypes, *, filled: bool = True) -> Any:
    """Build the chunk of one side of a clause.

    In a test (`filled`), a variable matches only a slot that has a value, as in ACT-R; pyactr
    alone would bind it to nothing.
    """
    parts: dict[str, dict[str, Any]] = {}
    for pair in clause.pairs:
        part = parts.setdefault(
            pair.slot, {"values": None, "variables": None, "negvalues": (), "negvariables": ()}
        )
        kind = "variables" if pair.variable else "values"
        # pyactr binds a variable of each tested buffer's own name to its whole chunk.
        word = f"variable-{pair.word}" if pair.variable else pair.word
        if pair.negated:
            part[f"neg{kind}"] += (word,)
        else:
            part[kind] = word
        if filled and pair.variable:
            part["negvalues"] += ("None",)
    slots = {slot: utilities.VarvalClass(**part) for slot, part in parts.items()}
    assert clause.chunk_type is not None  # the rulebook's validation has seen to it
    return types.build(clause.chunk_type, slots)
