"""How it remembers: chunks that fade, and a graph of places.

Pure but for `files`, `store` and `saved_file`: values in, values out.
"""

from ssrics_like.memory.base_level import base_level
from ssrics_like.memory.candidates import CandidateRow, Candidates, Retrieval
from ssrics_like.memory.chunks import Chunk, Request, Value, View
from ssrics_like.memory.declarative import DeclarativeMemory
from ssrics_like.memory.expectation import Expected, Uncertainty
from ssrics_like.memory.home import Home
from ssrics_like.memory.hypotheses import Here, Hypothesis
from ssrics_like.memory.landmark import Arc, Landmark
from ssrics_like.memory.links import Link
from ssrics_like.memory.parameters import MemoryParameters
from ssrics_like.memory.routes import Route, shortest_routes
from ssrics_like.memory.saved import PastRun, RememberedChunk, SavedMemory
from ssrics_like.memory.saved_file import load_memory_file, save_memory_file
from ssrics_like.memory.sides import Sides
from ssrics_like.memory.similarity import (
    FunctionSimilarity,
    Listed,
    ListedSimilarity,
    SlotSimilarity,
    TableSimilarity,
    ViewSimilarity,
)
from ssrics_like.memory.store import load_topology, save_topology
from ssrics_like.memory.surroundings_similarity import SurroundingsSimilarity
from ssrics_like.memory.topological import TopologicalMemory
from ssrics_like.memory.whereabouts import Whereabouts
from ssrics_like.memory.worth import Worth

__all__ = [
    "Arc",
    "CandidateRow",
    "Candidates",
    "Chunk",
    "DeclarativeMemory",
    "Expected",
    "FunctionSimilarity",
    "Here",
    "Home",
    "Hypothesis",
    "Landmark",
    "Link",
    "Listed",
    "ListedSimilarity",
    "MemoryParameters",
    "PastRun",
    "RememberedChunk",
    "Request",
    "Retrieval",
    "Route",
    "SavedMemory",
    "Sides",
    "SlotSimilarity",
    "SurroundingsSimilarity",
    "TableSimilarity",
    "TopologicalMemory",
    "Uncertainty",
    "Value",
    "View",
    "ViewSimilarity",
    "Whereabouts",
    "Worth",
    "base_level",
    "load_memory_file",
    "load_topology",
    "save_memory_file",
    "save_topology",
    "shortest_routes",
]
