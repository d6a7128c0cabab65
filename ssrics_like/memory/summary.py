"""What a saved memory holds, landmark by landmark."""

from __future__ import annotations

from dataclasses import dataclass

from ssrics_like.memory.appraisal import Appraisal
from ssrics_like.memory.declarative import DeclarativeMemory
from ssrics_like.memory.profile import MemoryProfile
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
    salience : float or None
        How surprising its view is, bits; None where declarative memory holds none.
    relevance, permanence : float
        How much it matters for finding ways; how probable it is that it is still there.
    """

    landmark: str
    structure: str
    visits: int
    references: int
    activation: float | None
    last_seen_ago_s: float
    degree: int
    salience: float | None
    relevance: float
    permanence: float
    origin: str


def summarised(
    memory: SavedMemory, profile: MemoryProfile, *, surroundings: bool
) -> list[LandmarkSummary]:
    """Return what a memory holds, in the order in which landmarks were marked.

    Parameters
    ----------
    memory : SavedMemory
        As of the moment of interest (see `SavedMemory.aged`).
    profile : MemoryProfile
        How it forgets and compares; noise plays no part.
    surroundings : bool
        Whether its views are of what surrounds a place, and not scans.
    """
    declarative = DeclarativeMemory(
        profile.model_copy(update={"activation_noise": 0.0}),
        similarities=profile.similarities(surroundings=surroundings),
    )
    memory.recall_into(declarative)
    levels = dict(zip(declarative.names, declarative.activations(0.0).tolist(), strict=True))
    uses = {each.chunk.name: len(each.ages_s) for each in memory.chunks}
    topological = memory.topological()
    worths = Appraisal(declarative, topological, profile.lasting_s).worths(0.0)
    return [
        LandmarkSummary(
            landmark=node.id,
            structure=str(node.labels.get("structure", "")),
            visits=node.visits,
            references=uses.get(node.id, 0),
            activation=levels.get(node.id),
            last_seen_ago_s=-node.last_visit_s,
            degree=topological.degree(node.id),
            **worths[node.id]._asdict(),
            origin=memory.origins[node.id],
        )
        for node in topological.nodes
    ]
