"""A study that has been read: its texts, and its trials with what they show."""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ssrics_like.study.replay import Replay
    from ssrics_like.study.settings import StudySettings, TrialSettings
    from ssrics_like.world.building import Building


@dataclass(frozen=True, eq=False)
class Trial:
    """One trial.

    Attributes
    ----------
    settings : TrialSettings
        What the file says.
    practice : bool
        Whether it comes before the study proper, and its marks are not exported.
    building : Building or None
        The map that its marks lie on; None for an attention check by a key.
    replay : Replay or None
        The route of a walk.
    """

    settings: TrialSettings
    practice: bool
    building: Building | None = None
    replay: Replay | None = None

    @property
    def id(self) -> str:
        """Name in the tables."""
        return self.settings.id

    @property
    def kind(self) -> str:
        """Return ``plan``, ``walk`` or ``attention``."""
        return self.settings.kind

    @property
    def is_check(self) -> bool:
        """Whether it tests attention rather than asks for landmarks."""
        return self.kind == "attention" or self.settings.check is not None

    @cached_property
    def map_sha256(self) -> str:
        """Of the floor plan: its cells, their size and origin; empty without a map."""
        if self.building is None:
            return ""
        grid = self.building.grid
        text = f"{grid.cells.shape} {grid.cell_m!r} {grid.origin!r}"
        return hashlib.sha256(text.encode() + grid.cells.tobytes()).hexdigest()


@dataclass(frozen=True, eq=False)
class Study:
    """A study.

    Attributes
    ----------
    path : Path
        Its file.
    settings : StudySettings
        What the file says, with the texts of Markdown files in their place.
    practice, trials : tuple of Trial
        As listed.
    """

    path: Path
    settings: StudySettings
    practice: tuple[Trial, ...]
    trials: tuple[Trial, ...]

    @cached_property
    def by_id(self) -> dict[str, Trial]:
        """Every trial by its name."""
        return {trial.id: trial for trial in (*self.practice, *self.trials)}

    def outline(self) -> dict[str, Any]:
        """Return what must stay the same while answers are collected: trials and their maps."""
        return {
            "seed": self.settings.seed,
            "order": self.settings.order,
            "listed": [trial.id for trial in (*self.practice, *self.trials)],
            "trials": {
                trial.id: {
                    "kind": trial.kind,
                    "practice": trial.practice,
                    "check": _checked(trial),
                    "map": trial.map_sha256,
                    "replay": trial.replay.sha256 if trial.replay else "",
                }
                for trial in (*self.practice, *self.trials)
            },
        }

    def outline_text(self) -> str:
        """Return the outline as JSON with sorted keys."""
        return json.dumps(self.outline(), sort_keys=True)


def _checked(trial: Trial) -> dict[str, Any] | None:
    """Say what a participant must do to pass, in the frame of the map."""
    check = trial.settings.check
    if trial.kind == "attention":
        return {"key": trial.settings.key}
    if check is None or trial.building is None:
        return None
    place = next(p for p in trial.building.locations if p.id == check.location)
    return {"x_m": place.x_m, "y_m": place.y_m, "within_m": check.within_m}
