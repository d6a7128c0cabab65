"""The model's buffers: pyactr buffers that hand requests to Python modules.

pyactr calls ``retrieve`` on a buffer for ``+buffer>`` and ``test`` for
``?buffer>``; those two are the whole hook. As in ACT-R, a request first clears
the buffer, a cleared chunk goes to declarative memory, and a failure leaves the
module free.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from pyactr import buffers, chunks, goals, utilities

from ssrics_like.productions.interface import (
    BufferChunk,
    DeclarativeModule,
    Recall,
    SlotTest,
)
from ssrics_like.productions.vocabulary import SIDES

Harvest = Callable[[BufferChunk, float], None]


class ChunkTypes:
    """The chunk types of one rule set, as pyactr knows them.

    pyactr keeps one table of types for the whole process, in which rule sets that define a type
    differently would change each other's. So pyactr's name of a type carries its slots.

    Parameters
    ----------
    slots : mapping
        Chunk type -> its slots.
    """

    def __init__(self, slots: Mapping[str, tuple[str, ...]]) -> None:
        self._slots = {name: frozenset(of_type) for name, of_type in slots.items()}
        self._inside = {name: "__".join((name, *sorted(own))) for name, own in self._slots.items()}
        self._outside = {inside: name for name, inside in self._inside.items()}
        for name, own in self._slots.items():
            chunks.chunktype(self._inside[name], " ".join(sorted(own)))

    def __contains__(self, chunk_type: str) -> bool:
        return chunk_type in self._slots

    def build(self, chunk_type: str, slots: Mapping[str, Any]) -> Any:
        """Build a pyactr chunk; one that is not registered, since registered names capture words.

        Values are words, or pyactr's descriptions of what a slot must hold. Slots that the rule
        set does not declare are left out.
        """
        own = self._slots[chunk_type]
        values = {
            slot: value
            if isinstance(value, utilities.VarvalClass)
            else utilities.VarvalClass(values=value, variables=None, negvalues=(), negvariables=())
            for slot, value in slots.items()
            if slot in own
        }
        return chunks.Chunk(self._inside[chunk_type], **values)

    def name_of(self, chunk: Any) -> str:
        """Return the type of a pyactr chunk."""
        return self._outside.get(chunk.typename, str(chunk.typename))

    def read(self, chunk: Any, name: str | None = None) -> BufferChunk:
        """Return a pyactr chunk as plain words, without the slots that have no value."""
        slots = {
            slot: str(value.values)
            for slot, value in chunk
            if isinstance(value, utilities.VarvalClass) and value.values not in (None, "None")
        }
        return BufferChunk(self.name_of(chunk), slots, name)


class _ModuleBuffer(buffers.Buffer):
    """A buffer that harvests on clearing and is free again after a failure."""

    def __init__(self, types: ChunkTypes, harvest: Harvest | None) -> None:
        super().__init__()
        self.types = types
        self._harvest = harvest
        self._name: str | None = None

    @property
    def content(self) -> BufferChunk | None:
        """The chunk that the buffer holds."""
        for chunk in self:
            return self.types.read(chunk, self._name)
        return None

    def put(self, chunk: BufferChunk) -> None:
        """Set the buffer's chunk."""
        super().add(self.types.build(chunk.chunk_type, chunk.slots))
        self._name = chunk.name

    def add(self, elem: Any, time: float = 0.0) -> None:
        """Set the chunk that a request produced (called by pyactr)."""
        super().add(elem)

    def clear(self, time: float = 0.0, harvest: Any = None) -> None:
        """Empty the buffer; its chunk goes to declarative memory (called by pyactr)."""
        content = self.content
        for chunk in tuple(self):
            self.discard(chunk)
        if content is not None and self._harvest is not None:
            self._harvest(content, time)
        self._name = None

    def measure(self, name: str) -> float | None:
        """Return the number that ``?buffer> NAME_above`` compares; None if there is none now."""
        return None

    def test(self, state: str, inquiry: str) -> bool:
        """Answer ``?buffer> state ...``, ``NAME_above x`` and ``NAME_below x``.

        What is not above is below; where there is no number both are wrong.
        """
        name, _, side = state.rpartition("_")
        if side in SIDES:
            value = self.measure(name)
            return value is not None and (value > float(inquiry)) == (side == "above")
        if inquiry == "free":
            return bool(self.state != "busy")
        return bool(self.state == inquiry)

    def test_buffer(self, inquiry: str) -> bool:
        """Answer ``?buffer> buffer ...``."""
        if inquiry == "failure":
            return bool(self.state == "error")
        return (inquiry == "full") == bool(len(self))


class PushedBuffer(_ModuleBuffer):
    """Holds what was put there from outside last.

    Attributes
    ----------
    attended : bool
        Whether a production that tests the buffer has fired since the chunk was put there.
    """

    attended = False

    def put(self, chunk: BufferChunk) -> None:
        """Set the buffer's chunk, which nobody has attended to yet."""
        super().put(chunk)
        self.attended = False


class OrientingBuffer(PushedBuffer):
    """Holds the reflex that perception fired last.

    Parameters
    ----------
    types : ChunkTypes
        Of the rule set.
    harvest : callable or None
        Takes cleared chunks.
    surprise : callable
        From the handle of a view to how surprising it is, bits.
    """

    def __init__(
        self, types: ChunkTypes, harvest: Harvest | None, surprise: Callable[[str], float]
    ) -> None:
        super().__init__(types, harvest)
        self._surprise = surprise

    def measure(self, name: str) -> float | None:
        """Return a number of the reflex; an empty buffer has none."""
        content = self.content
        if content is None:
            return None
        if name == "salience":
            return self._surprise(content.slots["view"])
        return float(content.slots[name])


class RetrievalBuffer(_ModuleBuffer):
    """Asks declarative memory."""

    def __init__(
        self,
        types: ChunkTypes,
        harvest: Harvest | None,
        module: DeclarativeModule,
        sources: Callable[[], Mapping[str, tuple[str, ...]]],
    ) -> None:
        super().__init__(types, harvest)
        self._module = module
        self._sources = sources
        self._recall: Recall | None = None

    def measure(self, name: str) -> float | None:
        """Return a number of the last answer; before any there is none."""
        if self._recall is None or self.state == "busy":
            return None
        return self._recall.confidence if name == "confidence" else self._recall.measure(name)

    def retrieve(
        self,
        time: float,
        otherchunk: Any,
        actrvariables: Any,
        buffers: Any,
        extra_tests: Any,
        model_parameters: Any,
    ) -> tuple[Any, float]:
        """Start a retrieval (called by pyactr)."""
        self.clear(time)
        tests = []
        for slot, value in otherchunk.removeunused():
            bound = utilities.check_bound_vars(actrvariables, value, negative_impossible=False)
            if bound.values is not None:
                tests.append(SlotTest(slot, str(bound.values)))
            tests += [SlotTest(slot, str(word), negated=True) for word in bound.negvalues]
        asked = self.types.name_of(otherchunk)
        result = self._module.recall(asked, tests, time, self._sources())
        self._recall = result
        if result.chunk is None:
            return None, result.latency_s
        self._name = result.chunk.name
        return self.types.build(result.chunk.chunk_type, result.chunk.slots), result.latency_s


class AskedBuffer(PushedBuffer):
    """Sends requests to a module, and holds the chunk that it answers with.

    A chunk of a type that the rule set does not know, or none, leaves the buffer empty.

    Parameters
    ----------
    types : ChunkTypes
        Of the rule set.
    harvest : callable or None
        Takes cleared chunks.
    ask : callable
        From the slots of a request and its time to the answer.
    """

    def __init__(
        self,
        types: ChunkTypes,
        harvest: Harvest | None,
        ask: Callable[[Mapping[str, str], float], BufferChunk | None],
    ) -> None:
        super().__init__(types, harvest)
        self._ask = ask

    def retrieve(
        self,
        time: float,
        otherchunk: Any,
        actrvariables: Any,
        buffers: Any,
        extra_tests: Any,
        model_parameters: Any,
    ) -> tuple[Any, float]:
        """Carry a request out (called by pyactr)."""
        self.clear(time)
        slots = {
            slot: str(utilities.check_bound_vars(actrvariables, value).values)
            for slot, value in otherchunk.removeunused()
        }
        made = self._ask(slots, time)
        if made is None or made.chunk_type not in self.types:
            return None, 0.0
        self._name = made.name
        return self.types.build(made.chunk_type, made.slots), 0.0


class ImaginalBuffer(goals.Goal):
    """Builds a chunk over a delay; with none, the goal. Harvests into the project's own memory."""

    def __init__(self, types: ChunkTypes, harvest: Harvest | None, delay: float) -> None:
        super().__init__(delay=delay)
        self.types = types
        self._harvest = harvest

    @property
    def content(self) -> BufferChunk | None:
        """The chunk that the buffer holds."""
        for chunk in self:
            return self.types.read(chunk)
        return None

    def clear(self, time: float = 0.0, harvest: Any = None) -> None:
        """Empty the buffer; its chunk goes to declarative memory (called by pyactr)."""
        content = self.content
        for chunk in tuple(self):
            self.discard(chunk)
        if content is not None and self._harvest is not None:
            self._harvest(content, time)

    def test(self, state: str, inquiry: str) -> bool:
        """Answer ``?buffer> state ...``."""
        return bool(self.state == inquiry)

    def test_buffer(self, inquiry: str) -> bool:
        """Answer ``?buffer> buffer ...``; building a chunk cannot fail."""
        return inquiry in ("full", "empty") and (inquiry == "full") == bool(len(self))
