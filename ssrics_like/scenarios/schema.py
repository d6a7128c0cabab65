"""What a scenario file may say: data only; the runner carries it out."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from ssrics_like import library, settings
from ssrics_like.errors import LibraryError, SettingsError, choices, nearest
from ssrics_like.memory.profile import MemoryProfile
from ssrics_like.perception.profile import PerceptionProfile
from ssrics_like.productions.rulebook import load_rulebook
from ssrics_like.productions.rules import EngineParameters, Rulebook


class _Strict(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid", strict=True)


class LogSettings(_Strict):
    """A robot's log as the source of observations.

    Attributes
    ----------
    log : str
        Path, relative to the scenario file.
    format : str
        A log format, or ``auto``: recognised by content.
    strict : bool
        Whether a malformed line stops the run; else it is counted and reported.
    fallback_rate_hz : float
        Scan rate that is assumed where the log's times are unusable.
    frame : str or None
        Frame of the poses, where the log does not tell.
    """

    log: str
    format: str = "auto"
    strict: bool = False
    fallback_rate_hz: Annotated[float, Field(ge=0.001, le=100_000)] = 10.0
    frame: Literal["map", "odometry", "corrected"] | None = None


class Scenario(_Strict):
    """An experiment: a source, the three modules of the mind, how often.

    Attributes
    ----------
    title : str
        Shown in the report.
    source : LogSettings
        Where the observations come from.
    perception, productions, memory : str
        Library entries, or paths relative to the scenario file.
    runs : int
        Number of runs; they differ in their noise.
    seed : int
        Run k uses the k-th seed spawned from it.
    set : dict
        Single values of the modules to override, as after ``--set``: ``memory.decay: 0.3``.
    """

    title: str = ""
    source: LogSettings
    perception: str = "human-like"
    productions: str = "landmark"
    memory: str = "act-r"
    runs: Annotated[int, Field(ge=1)] = 1
    seed: Annotated[int, Field(ge=0)] = 2006
    set: dict[str, Any] = {}


@dataclass(frozen=True)
class Resolved:
    """A scenario with its files read and overrides applied: all that a run needs."""

    scenario: Scenario
    log: Path
    perception: PerceptionProfile
    productions: Rulebook
    memory: MemoryProfile

    def as_data(self) -> dict[str, Any]:
        """Return everything that decides the results, as plain values for the manifest."""
        book = self.productions
        return {
            "title": self.scenario.title,
            "source": {**self.scenario.source.model_dump(), "log": self.log.name},
            "perception": {"name": self.scenario.perception, **self.perception.model_dump()},
            "productions": {
                "name": self.scenario.productions,
                "title": book.title,
                "parameters": book.parameters.model_dump(),
                "chunk_types": {name: list(slots) for name, slots in book.chunk_types.items()},
                "goal": book.goal,
                "harvest": list(book.harvest),
                "rules": {
                    rule.name: {"why": rule.why, "utility": rule.utility, "rule": rule.source}
                    for rule in book.rules
                },
            },
            "memory": {"name": self.scenario.memory, **self.memory.model_dump()},
            "set": self.scenario.set,
            "runs": self.scenario.runs,
            "seed": self.scenario.seed,
        }


def load_scenario(path: Path) -> Scenario:
    """Read and check a scenario file.

    Raises
    ------
    SettingsError
        With one line for each thing that is wrong.
    """
    document = settings.read_document(path)
    scenario = settings.validated(Scenario, document)
    problems = []
    for module in MODULES:
        try:
            library.find(module, _at(path.parent, getattr(scenario, module)))
        except LibraryError as e:
            problems.append(f"{document.where((module,))}: {module}: {e}")
    if not (path.parent / scenario.source.log).is_file():
        where = document.where(("source", "log"))
        problems.append(f"{where}: source.log: {path.parent / scenario.source.log}: no such file")
    if problems:
        raise SettingsError("\n".join(problems))
    return scenario


def make_scenario(data: dict[str, Any]) -> Scenario:
    """Make a scenario from command-line values.

    Raises
    ------
    SettingsError
        With one line for each value that does not fit.
    """
    try:
        return Scenario.model_validate(data)
    except ValidationError as e:
        lines = [text for _, text in settings.explain(Scenario, e, data)]
        raise SettingsError("\n".join(lines)) from None


def load_perception(name: str | Path) -> PerceptionProfile:
    """Read a perception profile: a library entry, or a path.

    Raises
    ------
    LibraryError, SettingsError
        There is none of this name; it is wrong.
    """
    document = settings.read_document(library.find("perception", name))
    return settings.validated(PerceptionProfile, document)


def load_memory(name: str | Path) -> MemoryProfile:
    """Read a memory profile: a library entry, or a path.

    Raises
    ------
    LibraryError, SettingsError
        There is none of this name; it is wrong.
    """
    return settings.validated(MemoryProfile, settings.read_document(library.find("memory", name)))


def load_productions(name: str | Path) -> Rulebook:
    """Read a rule set: a library entry, or a path.

    Raises
    ------
    LibraryError, RuleError
        There is none of this name; it is wrong.
    """
    return load_rulebook(library.find("productions", name))


MODULES = ("perception", "productions", "memory")


class _Engine(_Strict):
    """The part of a rule set that ``--set productions.parameters...`` reaches."""

    parameters: EngineParameters


def resolve(scenario: Scenario, base: Path, overrides: list[str] | None = None) -> Resolved:
    """Read the files that a scenario names and apply ``--set`` overrides.

    Parameters
    ----------
    scenario : Scenario
        As read, or made from command-line arguments.
    base : Path
        Folder that relative paths start from.
    overrides : list of str
        ``key=value`` each: ``memory.decay=0.3``, ``runs=3``, ``source.strict=true``.

    Raises
    ------
    LibraryError, SettingsError, RuleError
        A name is unknown, or a file or override is wrong.
    """
    changes: dict[str, dict[str, Any]] = {module: {} for module in MODULES}
    own: dict[str, Any] = {}
    typed = dict(settings.parse_override(text) for text in overrides or [])
    for key, value in {**scenario.set, **typed}.items():
        head, dot, rest = key.partition(".")
        if head in changes and dot:
            changes[head][rest] = value
        elif key in typed and head in Scenario.model_fields:
            own[key] = value
        else:
            fields = Scenario.model_fields if key in typed else ()
            known = [*fields, *(f"{module}." for module in MODULES)]
            raise SettingsError(
                f"--set {key}: unknown key '{head}'{nearest(head, (*fields, *MODULES))}; "
                f"known: {choices(known)}"
            )
    scenario = settings.override(scenario, own, "")
    # A path that was typed starts where it was typed; one in a scenario file, at that file.
    start = {key: Path() if key in own else base for key in (*MODULES, "source.log")}
    perception = load_perception(_at(start["perception"], scenario.perception))
    book = load_productions(_at(start["productions"], scenario.productions))
    memory = load_memory(_at(start["memory"], scenario.memory))
    engine = settings.override(
        _Engine(parameters=book.parameters), changes["productions"], "productions."
    )
    return Resolved(
        scenario=scenario,
        log=start["source.log"] / scenario.source.log,
        perception=settings.override(perception, changes["perception"], "perception."),
        productions=replace(book, parameters=engine.parameters),
        memory=settings.override(memory, changes["memory"], "memory."),
    )


def _at(base: Path, name: str) -> str:
    """Make a path relative to the scenario file; leave a library name as it is."""
    if "/" in name or name.endswith(library.SUFFIXES):
        return str(base / name)
    return name
