"""A rule set as data: what a rule file holds once it is read."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

from ssrics_like.productions.syntax import RuleText


class EngineParameters(BaseModel):
    """Parameters of the procedural and imaginal modules, with ACT-R's defaults.

    Attributes
    ----------
    rule_firing : float
        Seconds from the selection of a rule to its firing (``:dat``).
    utility_noise : float
        Scale s of the logistic noise on utilities (``:egs``); 0 switches it off.
    imaginal_delay : float
        Seconds to build a chunk in the imaginal buffer (``:imaginal-delay``).
    """

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True, allow_inf_nan=False)

    rule_firing: Annotated[float, Field(ge=0.001)] = 0.05
    utility_noise: Annotated[float, Field(ge=0)] = 0.0
    imaginal_delay: Annotated[float, Field(ge=0)] = 0.2


@dataclass(frozen=True)
class Rule:
    """One production.

    Attributes
    ----------
    name, why : str
        Its name, and the line that a modeller reads in the trace.
    text : RuleText
        Both sides, taken apart.
    source : str
        The rule as written.
    utility : float
        Utility in conflict resolution; among equals the first in the file wins.
    line : int
        Line of the file on which the entry begins.
    """

    name: str
    why: str
    text: RuleText
    source: str
    utility: float
    line: int


@dataclass(frozen=True)
class Rulebook:
    """A checked rule set.

    Attributes
    ----------
    path : Path
        The file it was read from.
    title, source : str
        What it is, and where it comes from.
    chunk_types : dict
        Name -> slots.
    goal : dict
        Slots of the first goal chunk, with ``isa``.
    harvest : tuple of str
        Buffers whose chunks enter declarative memory when they are cleared.
    parameters : EngineParameters
        Of the procedural and imaginal modules.
    rules : tuple of Rule
        In the order of the file.
    """

    path: Path
    title: str
    source: str
    chunk_types: dict[str, tuple[str, ...]]
    goal: dict[str, str]
    harvest: tuple[str, ...]
    parameters: EngineParameters
    rules: tuple[Rule, ...]

    @property
    def leads(self) -> bool:
        """Whether any rule attends to the way buffer."""
        return any(clause.buffer == "way" for rule in self.rules for clause in rule.text.tests)
