"""Turns pyactr's events into a trace in ACT-R's vocabulary and order.

Two things differ between them. pyactr names only the buffer that an action
touched, where ACT-R lists what a production read and did; that is known from
the rule itself. And pyactr resolves conflicts once more before a module that was
asked has begun to work; ACT-R does so once, after it. The extra resolutions
select nothing and are left out.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

from ssrics_like.productions.interface import BufferChunk, TraceEvent

if TYPE_CHECKING:
    from ssrics_like.productions.rules import Rule

MODULES = {"g": "goal", "retrieval": "declarative"}
"""Buffer -> the module behind it, where the names differ."""

_RESOLUTION = "conflict-resolution"


class Tracer:
    """Translates events and hands them on.

    Parameters
    ----------
    rules : mapping
        Name -> rule.
    content : callable
        Returns the chunk that a buffer holds now.
    sink : callable
        Receives the trace.
    """

    def __init__(
        self,
        rules: Mapping[str, Rule],
        content: Callable[[str], BufferChunk | None],
        sink: Callable[[TraceEvent], None],
    ) -> None:
        self._rules = rules
        self._content = content
        self._sink = sink
        self._held: TraceEvent | None = None
        self._asked: list[tuple[str, str]] = []

    def translate(self, t_s: float, process: str, action: str) -> None:
        """Take one event of pyactr: its time, process (a buffer or PROCEDURAL) and text."""
        if action == "MODIFIED":
            self.emit(t_s, "procedural", "mod-buffer-chunk", process)
            return
        # A production changes buffers first; what it asks and clears follows.
        for what, buffer in self._asked:
            self.emit(t_s, "procedural", what, buffer)
        self._asked = []
        if process == "PROCEDURAL":
            self._procedural(t_s, action)
        elif action == "PUSHED":
            self.emit(t_s, MODULES.get(process, process), "set-buffer-chunk", process)
        elif action.startswith("CREATED A CHUNK"):
            self.emit(t_s, MODULES.get(process, process), "set-buffer-chunk-from-spec", process)
        elif process == "retrieval":
            self._declarative(t_s, action)
        elif action.startswith("RETRIEVED") and self._content(process) is not None:
            self.emit(t_s, process, "set-buffer-chunk", process)

    def emit(self, t_s: float, module: str, action: str, name: str = "") -> None:
        """Hand on one event, with the buffer's chunk where the event sets one."""
        chunk = None
        if action.startswith("set-buffer-chunk") or action == "mod-buffer-chunk":
            content = self._content(name)
            if content is not None:
                chunk = {"isa": content.chunk_type, **content.slots}
        if self._held is not None and self._held.t_s < t_s:
            self.flush()
        self._sink(TraceEvent(t_s, module, action, name, chunk))

    def flush(self) -> None:
        """Hand on the conflict resolution that is held back."""
        if self._held is not None:
            self._sink(self._held)
            self._held = None

    def _procedural(self, t_s: float, action: str) -> None:
        if action == "CONFLICT RESOLUTION":
            if self._held is not None and self._held.t_s < t_s:
                self.flush()
            self._held = TraceEvent(t_s, "procedural", _RESOLUTION)
            return
        if action == "NO RULE FOUND":
            return
        what, _, name = action.partition(": ")
        rule = self._rules.get(name)
        if what == "RULE SELECTED" and rule is not None:
            self.flush()
            self.emit(t_s, "procedural", "production-selected", name)
            for clause in rule.text.tests:
                read = "query-buffer-action" if clause.sign == "?" else "buffer-read-action"
                self.emit(t_s, "procedural", read, clause.buffer)
        elif what == "RULE FIRED" and rule is not None:
            self.emit(t_s, "procedural", "production-fired", name)
            asked = [c.buffer for c in rule.text.actions if c.sign == "+"]
            cleared = [c.buffer for c in rule.text.actions if c.sign == "~"]
            self._asked = [("module-request", buffer) for buffer in asked]
            self._asked += [("clear-buffer", buffer) for buffer in (*cleared, *asked)]
        elif what == "RULE STOPPED FROM FIRING":
            self.emit(t_s, "procedural", "production-stopped", name)

    def _declarative(self, t_s: float, action: str) -> None:
        if action == "START RETRIEVAL":
            self.emit(t_s, "declarative", "start-retrieval")
        elif action == "RETRIEVED: None":
            self.emit(t_s, "declarative", "retrieval-failure")
        elif action.startswith("RETRIEVED"):
            self.emit(t_s, "declarative", "retrieved-chunk")
            self.emit(t_s, "declarative", "set-buffer-chunk", "retrieval")
