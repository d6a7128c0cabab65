"""What is benchmarked: every designator, tuned, and whole models."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from ssrics_like.bench.model import ModelDesignator
from ssrics_like.designators import designator_kind, designator_names, make_designator
from ssrics_like.errors import LibraryError, choices, nearest
from ssrics_like.library import find

if TYPE_CHECKING:
    from ssrics_like.designators import Designator

JOINT = "+"
OURS = "human-like+landmark"
REPORT = "report+report"
MODELS = (OURS, REPORT)
"""Perception profile and rule set, entries of the library."""
TRAINED = "boosted-scan"
"""The designator that needs a model which is trained first."""


@dataclass(frozen=True)
class Candidate:
    """Something that marks places.

    Attributes
    ----------
    name : str
        Of a designator, or of a perception profile and a rule set joined by ``+``.
    settings : mapping
        Of a designator.
    """

    name: str
    settings: Mapping[str, Any] = field(default_factory=dict)

    @property
    def is_model(self) -> bool:
        """Whether it is a whole model."""
        return JOINT in self.name

    @property
    def is_ours(self) -> bool:
        """Whether it is a model of this project's own, not the report's."""
        return self.is_model and self.name != REPORT

    @property
    def hindsight(self) -> bool:
        """Whether it sees the whole drive before it decides."""
        return not self.is_model and designator_kind(self.name).hindsight

    @property
    def source(self) -> str:
        """Short citation."""
        if self.is_model:
            return "this project" if self.is_ours else "Kelley & McGhee, the report"
        return designator_kind(self.name).source

    def make(self, seed: int, frame: str) -> Designator:
        """Return a designator for one drive.

        Parameters
        ----------
        seed : int
            Of whatever is random in it.
        frame : str
            Of the poses.
        """
        if self.is_model:
            perception, productions = self.name.split(JOINT, 1)
            return ModelDesignator(perception, productions, seed, frame)
        settings = dict(self.settings)
        if "seed" in designator_kind(self.name).Settings.model_fields:
            settings.setdefault("seed", seed)
        return make_designator(self.name, **settings)


def candidate_names() -> tuple[str, ...]:
    """Return the models and the designators that are benchmarked unless others are chosen."""
    return (*MODELS, *designator_names())


def chosen_names(chosen: Sequence[str] = ()) -> list[str]:
    """Return names of candidates in their usual order, others of the library's models behind.

    Raises
    ------
    LibraryError
        There is no candidate of a name, or no entry that a model consists of.
    """
    known = candidate_names()
    for name in chosen:
        if name in known:
            continue
        if JOINT not in name:
            raise LibraryError(
                f"no candidate '{name}'{nearest(name, known)}; known are {choices(known)}, and "
                "PERCEPTION+PRODUCTIONS of the library"
            )
        for kind, part in zip(("perception", "productions"), name.split(JOINT, 1), strict=True):
            find(kind, part)
    others = [name for name in dict.fromkeys(chosen) if name not in known]
    return [name for name in known if not chosen or name in chosen] + others


def make_candidates(
    names: Sequence[str], settings: Mapping[str, Mapping[str, Any]]
) -> list[Candidate]:
    """Return candidates with what was tuned of them.

    Parameters
    ----------
    names : sequence of str
        From `chosen_names`.
    settings : mapping
        Name of a designator -> its settings; one that is missing keeps its defaults.
    """
    return [Candidate(name, dict(settings.get(name, {}))) for name in names]
