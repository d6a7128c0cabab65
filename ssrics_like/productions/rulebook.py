"""Reads rule sets as users write them: a YAML file, checked before anything runs."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

from ssrics_like import settings
from ssrics_like.errors import RuleError, SettingsError
from ssrics_like.productions import validation
from ssrics_like.productions.rules import EngineParameters, Rule, Rulebook
from ssrics_like.productions.syntax import RuleSyntaxError, parse_rule


class _Strict(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


class _RuleEntry(_Strict):
    name: Annotated[str, Field(pattern=r"^[^\s](.*[^\s])?$")]
    why: str
    rule: str
    utility: float = 0.0


class RuleFile(_Strict):
    """The keys of a rule file, before its rules are taken apart."""

    title: str
    source: str = ""
    chunk_types: dict[str, tuple[str, ...]]
    goal: dict[str, str]
    harvest: tuple[str, ...] = ("retrieval", "imaginal", "landmark")
    parameters: EngineParameters = EngineParameters()
    rules: Annotated[tuple[_RuleEntry, ...], Field(min_length=1)]


def load_rulebook(path: Path) -> Rulebook:
    """Read and check a rule file.

    Raises
    ------
    RuleError
        With one line, ``file:line: rule: problem``, for each thing that is wrong.
    """
    try:
        document = settings.read_document(path)
        entry = settings.validated(RuleFile, document)
    except SettingsError as e:
        raise RuleError(str(e)) from None
    problems: list[tuple[int, str]] = []
    rules = []
    for i, item in enumerate(entry.rules):
        line = document.marks["rules", i].line
        try:
            text = parse_rule(item.rule, document.first_line["rules", i, "rule"])
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
