"""Reads rule sets as users write them: a YAML file, checked before anything runs."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

from ssrics_like import library, settings
from ssrics_like.errors import LibraryError, RuleError, SettingsError
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
    extends: Annotated[str, Field(min_length=1)] | None = None
    chunk_types: dict[str, tuple[str, ...]] = {}
    goal: dict[str, str] | None = None
    harvest: tuple[str, ...] | None = None
    parameters: EngineParameters | None = None
    rules: Annotated[tuple[_RuleEntry, ...], Field(min_length=1)]


HARVEST = ("retrieval", "imaginal", "landmark")
"""Buffers that are harvested where a file says nothing."""


def load_rulebook(path: Path) -> Rulebook:
    """Read and check a rule file, and the ones that it extends.

    Raises
    ------
    RuleError
        With one line, ``file:line: rule: problem``, for each thing that is wrong.
    """
    return _load(path, ())


def _load(path: Path, extending: tuple[Path, ...]) -> Rulebook:
    """Read a rule file that the files in `extending`, one after the other, extend."""
    try:
        document = settings.read_document(path)
        entry = settings.validated(RuleFile, document)
    except SettingsError as e:
        raise RuleError(str(e)) from None
    line_of = {str(key): mark.line for (key, *rest), mark in document.marks.items() if not rest}
    base = None
    if entry.extends is not None:
        where = f"{path}:{line_of['extends']}: extends"
        base = _extended(entry.extends, where, (*extending, path))
    for key in ("chunk_types", "goal"):
        if base is None and not getattr(entry, key):
            raise RuleError(f"{path}:1: {key}: is missing")
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
    own = Rulebook(
        path=path,
        title=entry.title,
        source=entry.source,
        chunk_types=entry.chunk_types,
        goal=entry.goal or {},
        harvest=HARVEST if entry.harvest is None else entry.harvest,
        parameters=entry.parameters or EngineParameters(),
        rules=tuple(rules),
    )
    book = own if base is None else _joined(base, own, entry, line_of["extends"])
    problems += validation.problems(book, line_of, complete=not problems)
    if problems:
        problems.sort(key=lambda problem: problem[0])
        raise RuleError("\n".join(f"{path}:{line}: {text}" for line, text in problems))
    return book


def _extended(name: str, where: str, extending: tuple[Path, ...]) -> Rulebook:
    """Read the rule set that a file extends: a library entry, or a path from that file."""
    is_path = "/" in name or name.endswith(library.SUFFIXES)
    try:
        path = library.find("productions", extending[-1].parent / name if is_path else name)
    except LibraryError as e:
        raise RuleError(f"{where}: {e}") from None
    if any(path.samefile(other) for other in extending):
        raise RuleError(f"{where}: {name} extends this file in turn")
    return _load(path, extending)


def _joined(base: Rulebook, own: Rulebook, entry: RuleFile, line: int) -> Rulebook:
    """Add a file's rules to those that it extends; what else it says replaces what they say."""
    return replace(
        own,
        chunk_types={**base.chunk_types, **own.chunk_types},
        goal=entry.goal or base.goal,
        harvest=base.harvest if entry.harvest is None else own.harvest,
        parameters=entry.parameters or base.parameters,
        rules=(*(replace(rule, line=line) for rule in base.rules), *own.rules),
    )
