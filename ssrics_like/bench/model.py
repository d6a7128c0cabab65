"""The whole model as a designator: its marks are what it declares or recognises."""

from __future__ import annotations

from bisect import bisect_right
from typing import TYPE_CHECKING

from ssrics_like.designators import Mark
from ssrics_like.model import CognitiveModel
from ssrics_like.results.records import MARKS
from ssrics_like.scenarios.modules import load_memory, load_perception, load_productions

if TYPE_CHECKING:
    from ssrics_like.decision import Decision
    from ssrics_like.perception.observation import Observation

MEMORY = "act-r"


class ModelDesignator:
    """Marks the places that a model calls landmarks, for the first time or again.

    A mark is decided at the newest observation that there was when the production fired. Its
    strength is the novelty.

    Parameters
    ----------
    perception, productions : str
        Entries of the library.
    seed : int
        Of the model's noise.
    frame : str
        Of the observations' poses.

    Raises
    ------
    LibraryError, SettingsError, RuleError, CueError
        An entry is not there or wrong.
    """

    def __init__(self, perception: str, productions: str, seed: int, frame: str) -> None:
        self._model = CognitiveModel(
            load_perception(perception),
            load_productions(productions),
            load_memory(MEMORY),
            seed=seed,
            frame=frame,
        )
        self._times_s: list[float] = []
        self._indices: list[int] = []

    def update(self, observation: Observation) -> list[Mark]:
        """Take the next observation; see `Designator`."""
        self._times_s.append(observation.t_s)
        self._indices.append(observation.index)
        return self._marks(self._model.observe(observation))

    def flush(self) -> list[Mark]:
        """End the drive; see `Designator`."""
        return self._marks(self._model.finish())

    def _marks(self, decisions: list[Decision]) -> list[Mark]:
        return [
            Mark(decision.scan, max(self._newest(decision.decided_s), decision.scan),
                 decision.novelty)
            for decision in decisions
            if decision.decision in MARKS
        ]  # fmt: skip

    def _newest(self, t_s: float) -> int:
        return self._indices[max(bisect_right(self._times_s, t_s) - 1, 0)]
