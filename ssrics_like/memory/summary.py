"""What a saved memory holds, landmark by landmark."""

from __future__ import annotations

from dataclasses import dataclass

from ssrics_like.memory.declarative import DeclarativeMemory
from ssrics_like.memory.parameters import MemoryParameters
from ssrics_like.memory.saved import SavedMemory


@dataclass(frozen=True)
class LandmarkSummary:
    """One landmark at the moment of saving, or some time later.

    Attributes
    ----------
    landmark, structure, origin : str
        Its name, what it looks like (empty where that is not known), and where it was declared.
    visits : int
        How often the robot came to it.
    references : int
        How often its chunk was used; 0 where declarative memory holds none.
    activation : float or None
        Base level; None where declarative memory holds no such chunk.
    last_seen_ago_s : float
        Time since the last visit, seconds.
    degree : int
        Number of other landmarks joined to it.
    """

    landmark: str
    structure: str
    visits: int
    references: int
    activation: float | None
    last_seen_ago_s: float
    degree: int
    origin: str


def summarised(memory: SavedMemory, parameters: MemoryParameters) -> list[LandmarkSummary]:
    """Return what a memory holds, in the order in which landmarks were marked.

    Parameters
    ----------
    memory : SavedMemory
        As of the moment of interest (see `SavedMemory.aged`).
    parameters : MemoryParameters
        How it forgets; noise plays no part.
    """
    declarative = DeclarativeMemory(parameters.model_copy(update={"activation_noise": 0.0}))
    memory.recall_into(declarative)
    levels = dict(zip(declarative.names, declarative.activations(0.0).tolist(), strict=True))
    uses = {each.chunk.name: len(each.ages_s) for each in memory.chunks}
    topological = memory.topological()
    return [
        LandmarkSummary(
            landmark=node.id,
            structure=str(node.labels.get("structure", "")),
            visits=node.visits,
            references=uses.get(node.id, 0),
            activation=levels.get(node.id),
            last_seen_ago_s=-node.last_visit_s,
            degree=topological.degree(node.id),
            origin=memory.origins[node.id],
        )
        for node in topological.nodes
    ]
