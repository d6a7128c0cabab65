"""What the report knows of a results folder."""

from __future__ import annotations

from dataclasses import dataclass

from ssrics_like.comparison import FolderScores
from ssrics_like.memory.landmark import Arc
from ssrics_like.report.pictures import Pictures
from ssrics_like.results.records import Records, Run
from ssrics_like.world.building import Building


@dataclass(frozen=True, eq=False)
class Results(Records):
    """A results folder as read.

    Attributes
    ----------
    folder, manifest, runs
        As of `Records`.
    pictures : Pictures
        Of the first run, which the report shows in detail.
    arcs : tuple of Arc
        Of the first run's topological memory.
    building : Building or None
        The building that was driven through; None for a log.
    scores : FolderScores or None
        How well its locations were found; None where there are none.
    """

    pictures: Pictures
    arcs: tuple[Arc, ...]
    building: Building | None = None
    scores: FolderScores | None = None

    @property
    def shown(self) -> Run:
        """The run that is shown in detail."""
        return self.runs[0]
