"""What the engine asks of the modules it is joined to, and what it tells.

The engine knows declarative memory and the marking of landmarks only by these
protocols, so that the modules of the mind do not import one another.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Protocol


@dataclass(frozen=True)
class BufferChunk:
    """A chunk as it stands in a buffer: plain words.

    Attributes
    ----------
    chunk_type : str
        Its type.
    slots : mapping
        Slot -> value; slots without a value are absent.
    name : str or None
        The name of the chunk in declarative memory, where it has one.
    """

    chunk_type: str
    slots: Mapping[str, str]
    name: str | None = None


@dataclass(frozen=True)
class SlotTest:
    """One slot of a retrieval request: the value asked for, or excluded."""

    slot: str
    value: str
    negated: bool = False


def _no_measure(_name: str) -> None:
    """Say that there is no such number."""


@dataclass(frozen=True)
class Recall:
    """What a retrieval gave.

    Attributes
    ----------
    chunk : BufferChunk or None
        None for a failure.
    latency_s : float
        How long it takes.
    confidence : float
        How probable it is that this outcome is right, a failure included.
    measure : callable
        From the name of another number of it (see ``vocabulary.BUFFERS``) to that number; None
        where there is none. Reckoned only when a rule asks.
    """

    chunk: BufferChunk | None
    latency_s: float
    confidence: float = 1.0
    measure: Callable[[str], float | None] = field(default=_no_measure, compare=False)


class DeclarativeModule(Protocol):
    """Declarative memory as the engine sees it."""

    def recall(
        self,
        chunk_type: str,
        tests: Sequence[SlotTest],
        t_s: float,
        sources: Mapping[str, Sequence[str]],
    ) -> Recall:
        """Answer a ``+retrieval>`` request made at `t_s`; `sources` are the buffers' values."""

    def harvest(self, chunk: BufferChunk, t_s: float) -> None:
        """Take in a chunk whose buffer was cleared at `t_s`."""

    def surprise(self, view: str) -> float:
        """Return how surprising a reflex's view is among those in memory, bits."""


@dataclass(frozen=True)
class MarkRequest:
    """A ``+landmark>`` request: what a rule decided about a reflex.

    Attributes
    ----------
    outcome : str
        One of ``vocabulary.OUTCOMES``.
    event : str
        The event slot of the reflex.
    landmark : str or None
        The landmark that was recognised, if the rule names one.
    rule : str
        The production that fired.
    t_s : float
        When it fired.
    """

    outcome: str
    event: str
    landmark: str | None
    rule: str
    t_s: float


class LandmarkModule(Protocol):
    """The module behind the landmark buffer."""

    def mark(self, request: MarkRequest) -> BufferChunk | None:
        """Carry out a decision; the chunk of a new landmark goes into the buffer."""


@dataclass(frozen=True)
class StepRequest:
    """A ``+way>`` request: what a rule has the robot do next.

    Attributes
    ----------
    act : str
        One of ``vocabulary.STEP_ACTS``.
    to : str
        The landmark that it is about; empty where the act needs none.
    outcome, reason : str
        How the errand ended, for the act ``end``.
    rule : str
        The production that fired.
    t_s : float
        When it fired.
    """

    act: str
    to: str
    outcome: str
    reason: str
    rule: str
    t_s: float


class WayModule(Protocol):
    """The module behind the way buffer."""

    def step(self, request: StepRequest) -> BufferChunk:
        """Carry out a step; return what has come of it, or that it has begun."""


@dataclass(frozen=True, slots=True)
class TraceEvent:
    """One event of one module, in ACT-R's vocabulary.

    Attributes
    ----------
    t_s : float
        Engine time, whole tenths of a millisecond.
    module : str
        procedural, goal, orienting, declarative, imaginal or landmark.
    action : str
        production-selected, set-buffer-chunk, start-retrieval and so on.
    name : str
        The production or buffer it is about; empty where there is none.
    chunk : mapping or None
        Slots of the chunk that was set or asked for, with ``isa``.
    """

    t_s: float
    module: str
    action: str
    name: str = ""
    chunk: Mapping[str, str] | None = field(default=None)
