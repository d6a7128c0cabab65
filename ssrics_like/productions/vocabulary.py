"""The words that every rule file shares: buffers, queries, perceived slots."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class BufferKind:
    """What rules may do with a buffer.

    Attributes
    ----------
    role : str
        One line for documentation and error messages.
    requests : bool
        Whether ``+buffer>`` is allowed.
    modifies : bool
        Whether ``=buffer>`` is allowed on the right side.
    numeric_queries : tuple of str
        Queries that compare a number: the value in the buffer's chunk, or of what the buffer was
        last asked, against the one given.
    """

    role: str
    requests: bool = True
    modifies: bool = False
    numeric_queries: tuple[str, ...] = ()


BUFFERS = {
    "g": BufferKind("the goal: what the model is doing", modifies=True),
    "orienting": BufferKind(
        "the reflex chunk that perception fires",
        requests=False,
        numeric_queries=("novelty_above", "novelty_below"),
    ),
    "retrieval": BufferKind(
        "the landmark that declarative memory recalls",
        numeric_queries=("confidence_above", "confidence_below"),
    ),
    "imaginal": BufferKind("a chunk under construction, 0.2 s", modifies=True),
    "landmark": BufferKind("decisions: marks a place, and holds the chunk of a new landmark"),
}

QUERIES = {
    "state": ("free", "busy", "error"),
    "buffer": ("full", "empty", "failure"),
}

REFLEX_SLOTS = ("event", "modality", "sector", "structure", "novelty", "view", "place")
"""Slots that perception fills in a ``reflex`` chunk; `view` and `place` are continuous."""

LANDMARK_SLOTS = ("id", "sector", "structure", "view", "place")
"""Slots of the chunk that stands for a declared landmark."""

MARK_SLOTS = ("outcome", "event", "landmark")
"""Slots of the request that a rule sends to the ``landmark`` buffer."""

OUTCOMES = ("declared", "recognised", "unsure", "dismissed")
"""What a rule can decide about a reflex."""

FIXED_TYPES = {"reflex": REFLEX_SLOTS, "landmark": LANDMARK_SLOTS, "mark": MARK_SLOTS}
