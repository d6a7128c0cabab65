"""What stood in which buffer from when to when, worked out from a trace."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from ssrics_like.report.words import seen_text

PRODUCTIONS = "productions"
GOAL = "g"

FULL, BUSY, FAILED, FIRED, STOPPED = "full", "busy", "failed", "fired", "stopped"


@dataclass(frozen=True)
class Span:
    """A stretch of time in one lane.

    Attributes
    ----------
    lane : str
        A buffer, or ``productions``.
    start_s, end_s : float
        Source time as in the trace; `end_s` is infinite for what lasts.
    kind : str
        ``full``: the buffer holds a chunk; ``busy``: its module works on a request; ``failed``:
        it worked and brought nothing; ``fired`` or ``stopped``: a production.
    label : str
        The chunk or production.
    """

    lane: str
    start_s: float
    end_s: float
    kind: str
    label: str


class _Lane:
    """One buffer's story: what is in it now, and the spans that are over."""

    def __init__(self, name: str, spans: list[Span]) -> None:
        self.name = name
        self._spans = spans
        self._open: tuple[float, str, str] | None = None

    def begin(self, t_s: float, kind: str, label: str) -> None:
        self.end(t_s)
        self._open = (t_s, kind, label)

    def end(self, t_s: float, *, kind: str | None = None) -> None:
        if self._open is not None:
            start_s, was, label = self._open
            if t_s > start_s:
                self._spans.append(Span(self.name, start_s, t_s, kind or was, label))
            self._open = None


def spans_of(events: Iterable[Mapping[str, Any]]) -> list[Span]:
    """Work out the spans of every lane.

    Parameters
    ----------
    events : iterable of mapping
        Events of a trace in order: t_s, module, action, name and perhaps chunk.

    Returns
    -------
    list of Span
        In the order in which they end.
    """
    spans: list[Span] = []
    lanes: dict[str, _Lane] = {}

    def lane(name: str) -> _Lane:
        return lanes.setdefault(name, _Lane(name, spans))

    for event in events:
        t_s, action, name = float(event["t_s"]), str(event["action"]), str(event["name"])
        chunk = event.get("chunk")
        if action.startswith("set-buffer-chunk") or action == "mod-buffer-chunk":
            slots = {str(k): str(v) for k, v in (chunk or {}).items() if k != "isa"}
            lane(name).begin(t_s, FULL, _name(name, slots))
        elif action == "clear-buffer":
            lane(name).end(t_s)
        elif action == "start-retrieval":
            lane("retrieval").begin(t_s, BUSY, "recalling")
        elif action == "retrieval-failure":
            lane("retrieval").end(t_s, kind=FAILED)
        elif action == "production-selected":
            lane(PRODUCTIONS).begin(t_s, FIRED, name)
        elif action == "production-fired":
            lane(PRODUCTIONS).end(t_s)
        elif action == "production-stopped":
            lane(PRODUCTIONS).end(t_s, kind=STOPPED)
    for buffer in lanes.values():
        buffer.end(float("inf"))
    return spans


def _name(buffer: str, slots: Mapping[str, str]) -> str:
    """Return the words that tell one chunk from another in its buffer."""
    if buffer == GOAL:
        return slots.get("state") or " ".join(slots.values())
    if buffer == "orienting":
        return seen_text(slots.get("sector", ""), slots.get("structure", ""))
    return slots.get("id") or " ".join(slots.values())
