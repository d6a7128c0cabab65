"""Tells what kind a file is and checks it as that kind."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from pydantic import BaseModel

from ssrics_like import settings
from ssrics_like.errors import SettingsError, choices, nearest
from ssrics_like.library import SUFFIXES
from ssrics_like.memory.profile import MemoryProfile
from ssrics_like.perception.profile import PerceptionProfile
from ssrics_like.productions.rulebook import RuleFile, load_rulebook
from ssrics_like.results.checking import check_results
from ssrics_like.scenarios.schema import Scenario, load_scenario, resolve
from ssrics_like.sources import open_log


def check_file(path: Path, progress: Callable[[float], None] = lambda _: None) -> str:
    """Check one file or results folder and say in a line what it is.

    Parameters
    ----------
    path : Path
        The file.
    progress : callable
        Called now and then with the share of a log that has been read.

    Raises
    ------
    SettingsError, RuleError, LibraryError, SourceError, ResultsError
        What is wrong with it.
    """
    if path.is_dir():
        manifest = check_results(path)
        return f"results of {len(manifest['runs'])} run(s), frame {manifest['frame']}"
    if path.suffix in SUFFIXES:
        kind = _kind(path)
        return f"{kind}, {YAML_KINDS[kind](path)}"
    return _log(path, progress)


def _kind(path: Path) -> str:
    """Tell a YAML file's kind: the one that knows most of its keys."""
    keys = set(settings.read_document(path).data)
    known = {
        "rule set": {"rules", "chunk_types", "goal", "harvest"},
        "scenario": set(Scenario.model_fields) - {"title"},
        "perception profile": set(PerceptionProfile.model_fields) - {"title", "source"},
        "memory profile": set(MemoryProfile.model_fields) - {"title", "source"},
    }
    best = max(known, key=lambda kind: len(known[kind] & keys))
    if not known[best] & keys:
        raise SettingsError(f"{path}: none of its keys is known; expected a {choices(KINDS)}")
    return best


def _rules(path: Path) -> str:
    book = load_rulebook(path)
    return f"'{book.title}', {len(book.rules)} rules"


def _scenario(path: Path) -> str:
    resolved = resolve(load_scenario(path), path.parent)
    open_log(resolved.log, format=resolved.scenario.source.format)
    return f"'{resolved.scenario.title}', {resolved.scenario.runs} run(s) of {resolved.log.name}"


def _profile(kind: type[PerceptionProfile | MemoryProfile]) -> Callable[[Path], str]:
    def check(path: Path) -> str:
        return f"'{settings.validated(kind, settings.read_document(path)).title}'"

    return check


def _log(path: Path, progress: Callable[[float], None]) -> str:
    source = open_log(path)
    scans = 0
    for scans, _ in enumerate(source, 1):
        if scans % PROGRESS_EVERY == 0:
            progress(source.progress)
    said = "; ".join(source.report.warnings())
    what = f"{source.format} log, {scans} scans, frame {source.frame}"
    return f"{what}; {said}" if said else what


def json_schema(kind: str) -> dict[str, Any]:
    """Return the JSON Schema of a kind of YAML file.

    Raises
    ------
    SettingsError
        There is no such kind.
    """
    models: dict[str, type[BaseModel]] = {
        "scenario": Scenario,
        "perception": PerceptionProfile,
        "memory": MemoryProfile,
        "productions": RuleFile,
    }
    if kind not in models:
        raise SettingsError(
            f"no schema of '{kind}'{nearest(kind, models)}; there are {choices(models)}"
        )
    return models[kind].model_json_schema()


YAML_KINDS: dict[str, Callable[[Path], str]] = {
    "rule set": _rules,
    "scenario": _scenario,
    "perception profile": _profile(PerceptionProfile),
    "memory profile": _profile(MemoryProfile),
}
KINDS = (*YAML_KINDS, "log", "results folder")
PROGRESS_EVERY = 256  # scans
