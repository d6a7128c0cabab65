"""What the model decided about one reflex."""

from __future__ import annotations

from dataclasses import dataclass

from ssrics_like.perception.observation import Pose


@dataclass(frozen=True, slots=True)
class Decision:
    """One row of decisions.csv.

    Attributes
    ----------
    event : int
        0-based number of the reflex.
    scan : int
        0-based index of the observation that was perceived.
    t_s, decided_s : float
        When it was perceived (where `pose` belongs), and when the rule fired.
    pose, true_pose : Pose
        In the source's frame; the true one only in simulation.
    modality, sector, structure : str
        What was perceived.
    novelty : float
        1 - boredom quotient of the interval.
    decision : str
        declared, recognised, unsure, dismissed or overwritten.
    landmark : str
        The landmark that was declared or recognised, else empty.
    rule : str
        The production that decided; empty where none did.
    activation : float or None
        Of the landmark recalled, or of the best candidate that was not; None without a candidate.
    confidence : float or None
        How probable it is that memory's answer is right; None where memory was not asked.
    """

    event: int
    scan: int
    t_s: float
    decided_s: float
    pose: Pose
    true_pose: Pose | None
    modality: str
    novelty: float
    sector: str
    structure: str
    decision: str
    landmark: str
    rule: str
    activation: float | None
    confidence: float | None
