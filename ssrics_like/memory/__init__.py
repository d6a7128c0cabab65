"""How it remembers: chunks that fade, and a graph of places.

Pure but for `store`: values in, values out.
"""

from ssrics_like.memory.base_level import base_level
from ssrics_like.memory.candidates import CandidateRow, Candidates, Retrieval
from ssrics_like.memory.chunks import Chunk, Place, Request, Value, View
from ssrics_like.memory.declarative import DeclarativeMemory
from ssrics_like.memory.landmark import Arc, Landmark
from ssrics_like.memory.parameters import MemoryParameters
from ssrics_like.memory.similarity import (
    FunctionSimilarity,
    PlaceSimilarity,
    SlotSimilarity,
    TableSimilarity,
    ViewSimilarity,
)
from ssrics_like.memory.store import load_topology, save_topology
from ssrics_like.memory.topological import TopologicalMemory

__all__ = [
    "Arc",
    "CandidateRow",
    "Candidates",
    "Chunk",
    "DeclarativeMemory",
    "FunctionSimilarity",
    "Landmark",
    "MemoryParameters",
    "Place",
    "PlaceSimilarity",
    "Request",
    "Retrieval",
    "SlotSimilarity",
    "TableSimilarity",
    "TopologicalMemory",
    "Value",
    "View",
    "ViewSimilarity",
    "base_level",
    "load_topology",
    "save_topology",
]
