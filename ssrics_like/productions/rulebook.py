"""Rule sets as users write them: a YAML file, read and checked before anything runs."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

from ssrics_like import settings
from ssrics_like.errors import RuleError, SettingsError
from ssrics_like.productions import validation
from ssrics_like.productions.syntax import RuleSyntaxError, RuleText, parse_rule


class _Strict(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid")


class EngineParameters(_Strict):
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

    rule_firing: Annotated[float, Field(gt=0)] = 0.05
    utility_noise: Annotated[float, Field(ge=0)] = 0.0
    imaginal_delay: Annotated[float, Field(ge=0)] = 0.2


class _RuleEntry(_Strict):
    name: str
    why: str
    rule: str
    utility: float = 0.0


class _RuleFile(_Strict):
    title: str
    source: str = ""
    chunk_types: dict[str, tuple[str, ...]]
    goal: dict[str, str]
    harvest: tuple[str, ...] = ("retrieval", "imaginal", "landmark")
    parameters: EngineParameters = EngineParameters()
    rules: Annotated[tuple[_RuleEntry, ...], Field(min_length=1)]


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


def load_rulebook(path: Path) -> Rulebook:
    """Read and check a rule file.

    Raises
    ------
    RuleError
        With one line, ``file:line: rule: problem``, for each thing that is wrong.
    """
    try:
        document = settings.read_document(path)
        entry = settings.validated(_RuleFile, document)
    except SettingsError as e:
        raise RuleError(str(e)) from None
    problems: list[tuple[int, str]] = []
    rules = []
    for i, item in enumerate(entry.rules):
        line = document.marks["rules", i].line
        try:
            text = parse_rule(item.rule, _text_line(document, i))
        except RuleSyntaxError as e:
            problems.append((e.line, f"rule '{item.name}': {e}"))
            continue
        rules.append(Rule(item.name, item.why, text, item.rule, item.utility, line))
    book = Rulebook(
        path=path,
        title=entry.title,
        source=entry.source,
        chunk_types=entry.chunk_types,
        goal=entry.goal,
        harvest=entry.harvest,
        parameters=entry.parameters,
        rules=tuple(rules),
    )
    key_line = {str(key): mark.line for (key, *rest), mark in document.marks.items() if not rest}
    problems += validation.problems(book, key_line, complete=not problems)
    if problems:
        problems.sort(key=lambda problem: problem[0])
        raise RuleError("\n".join(f"{path}:{line}: {text}" for line, text in problems))
    return book


def _text_line(document: settings.Document, index: int) -> int:
    """Return the line on which a rule's text begins: below ``rule: |``, or beside ``rule:``."""
    line = document.marks["rules", index, "rule"].line
    written = document.path.read_text(encoding="utf-8").splitlines()[line - 1]
    return line + 1 if re.search(r"rule:\s*[|>][-+\d]*\s*(#.*)?$", written) else line
