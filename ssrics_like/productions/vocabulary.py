"""The words that every rule file shares: buffers, queries, perceived slots."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NamedTuple


class Measure(NamedTuple):
    """A number that queries compare: ``NAME_above 0.5`` and ``NAME_below 0.5``.

    Attributes
    ----------
    most : float
        The greatest that it can be; the least is 0.
    slot : str
        The slot of the buffer's chunk that it is taken from; empty if it comes from elsewhere.
    """

    most: float = math.inf
    slot: str = ""


SIDES = ("above", "below")


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
    measures : mapping of str to Measure
        Numbers that queries compare with the one given: of the buffer's chunk, or of the answer
        to what the buffer was last asked.
    """

    role: str
    requests: bool = True
    modifies: bool = False
    measures: Mapping[str, Measure] = field(default_factory=dict)

    @property
    def numeric_queries(self) -> Mapping[str, str]:
        """The queries that compare a number, and which."""
        return {f"{name}_{side}": name for name in self.measures for side in SIDES}


BUFFERS = {
    "g": BufferKind("the goal: what the model is doing", modifies=True),
    "orienting": BufferKind(
        "the reflex chunk that perception fires",
        requests=False,
        measures={"novelty": Measure(1.0, "novelty"), "salience": Measure(slot="view")},
    ),
    "retrieval": BufferKind(
        "the landmark that declarative memory recalls",
        measures={
            "confidence": Measure(1.0),
            "salience": Measure(),
            "relevance": Measure(),
            "permanence": Measure(1.0),
        },
    ),
    "imaginal": BufferKind("a chunk under construction, 0.2 s", modifies=True),
    "landmark": BufferKind("decisions: marks a place, and holds the chunk of a new landmark"),
    "way": BufferKind("leading the way: takes steps, and holds what has come of them"),
}

PUSHED = ("orienting", "way")
"""Buffers that are filled from outside: by perception, and by what happens on the way."""

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

WAY_SLOTS = ("event", "errand", "goal", "at", "next", "reason")
"""Slots of the chunk in the ``way`` buffer: how an errand goes."""

WAY_EVENTS = {
    "ordered": "there is an errand; the robot stands",
    "chosen": "`goal` is the landmark to go to",
    "planned": "`next` is the landmark that comes first on the way to `goal`",
    "driving": "the robot drives to `next`",
    "arrived": "the robot has come to `at`",
    "blocked": "the way to `next` is shut, for the `reason` given",
    "shut": "that is remembered",
    "cut-off": "no way leads to `goal` that is not known to be shut",
    "lost": "the robot does not know where it is",
    "searching": "it looks about for landmarks that it knows",
    "found": "it knows again where it is",
    "nowhere": "it has looked everywhere and knows no better",
    "nothing-left": "no landmark is left to go to; `reason` is left-out where some were skipped",
    "unknown": "there is no landmark of the name in the errand",
    "ended": "the errand is over",
}
"""What can have happened."""

STEP_SLOTS = ("act", "to", "outcome", "reason")
"""Slots of the request that a rule sends to the ``way`` buffer."""

STEP_ACTS = {
    "choose": (),
    "plan": ("to",),
    "drive": ("to",),
    "shut": ("to",),
    "skip": ("to",),
    "search": (),
    "end": ("outcome",),
}
"""What a rule can have the robot do -> the slots that this needs."""

STEP_OUTCOMES = ("reached", "failed")
"""How an errand can end."""

FIXED_TYPES = {
    "reflex": REFLEX_SLOTS,
    "landmark": LANDMARK_SLOTS,
    "mark": MARK_SLOTS,
    "way": WAY_SLOTS,
    "step": STEP_SLOTS,
}
