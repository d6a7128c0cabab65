"""What the model knows how to do: rule sets, and the engine that runs them on pyactr.

pyactr is imported by `engine` and `buffers` only, so that rule files can be read
and checked without it.
"""

from ssrics_like.productions.interface import BufferChunk, TraceEvent
from ssrics_like.productions.rulebook import load_rulebook
from ssrics_like.productions.rules import EngineParameters, Rule, Rulebook

__all__ = [
    "BufferChunk",
    "EngineParameters",
    "Rule",
    "Rulebook",
    "TraceEvent",
    "load_rulebook",
]
