"""Where a participant stands in a study."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Participant:
    """Where a participant stands.

    Attributes
    ----------
    number : int
        Row in the database; shown to nobody.
    name : str
        The id in the tables.
    trials : tuple of str
        Ids of all steps' trials, in the order of this participant.
    position : int
        Which step is next: 0 for the instructions, then the trials.
    replay_ms : float
        How far the replay of this step has got.
    began, finished : str
        ISO 8601, UTC; the latter empty before the end.
    """

    number: int
    name: str
    trials: tuple[str, ...]
    position: int
    replay_ms: float
    began: str
    finished: str

    @property
    def is_done(self) -> bool:
        """Whether all steps are done."""
        return self.position > len(self.trials)

    @property
    def trial(self) -> str | None:
        """Id of the trial that is next; None at the instructions and at the end."""
        at = self.position - 1
        return self.trials[at] if 0 <= at < len(self.trials) else None
