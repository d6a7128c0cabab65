"""What a scenario file may say: data only; the runner carries it out."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Annotated, Any, Literal, Self

from pydantic import Field, ValidationError, field_validator, model_validator

from ssrics_like import library, settings
from ssrics_like.errors import LibraryError, MapError, MemoryFileError, SettingsError
from ssrics_like.maps import load_building, load_locations
from ssrics_like.memory.home import HOME
from ssrics_like.scenarios.problems import unknown_location
from ssrics_like.scenarios.remembering import memory_files
from ssrics_like.scenarios.world_settings import Strict, WorldSettings

MODULES = ("perception", "productions", "memory")
"""The modules of the mind: keys of a scenario, each with a library folder of its own."""

NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9._-]*")


class LogSettings(Strict):
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


class Published(Strict):
    """Figures of a publication to set beside ours.

    Attributes
    ----------
    source : str
        Where they stand.
    found : dict
        Id of a location -> share of runs in which it was found.
    """

    source: str
    found: dict[str, Annotated[float, Field(ge=0.0, le=1.0)]]


class VariantSettings(Strict):
    """The scenario with some values changed.

    Attributes
    ----------
    name : str
        Names its folder: letters, digits, dots, dashes.
    title : str
        What it is.
    set : dict
        Values, as after ``--set``: ``perception: report``, ``perception.mark: peak``.
    """

    name: str
    title: str = ""
    set: dict[str, Any] = Field(default_factory=dict)

    @field_validator("name")
    @classmethod
    def _names_a_folder(cls, name: str) -> str:
        if not NAME.fullmatch(name):
            raise ValueError(f"{name!r}: expected letters, digits, dots and dashes")
        return name


class Scenario(Strict):
    """An experiment: a source, the three modules of the mind, how often.

    Attributes
    ----------
    title, description : str
        Shown in the report.
    source : LogSettings
        A log that the observations come from; or `world`.
    world : WorldSettings
        A simulated building that they come from.
    perception, productions, memory : str
        Library entries, or paths relative to the scenario file.
    memory_from : str
        What the model remembers from the beginning: a file of memory, or a results folder, relative
        to the scenario file; see `remembering.recollect`.
    memory_pause_s : float
        How many seconds have passed since that memory was saved.
    memory_start : {"unknown", "home"}
        Whether the robot begins where the first run of that memory began; else it may be anywhere.
    runs : int
        Number of runs; they differ in their noise.
    seed : int
        Run k uses the k-th seed spawned from it.
    humans : str
        CSV of people's choices of landmarks, relative to the scenario file.
    match_radius_m : float
        A mark within this of a location has found it.
    trace : bool
        Whether every event of every module is written; many variants are better off without.
    published : Published
        Figures to set beside ours.
    factors : dict
        Name of a factor -> name of a level -> values to set: every combination is a variant.
    variants : list of VariantSettings
        Further variants.
    set : dict
        Single values of the modules to override, as after ``--set``: ``memory.decay: 0.3``.
    """

    title: str = ""
    description: str = ""
    source: LogSettings | None = None
    world: WorldSettings | None = None
    perception: str = "human-like"
    productions: str = "landmark"
    memory: str = "act-r"
    memory_from: Annotated[str, Field(min_length=1)] | None = None
    memory_pause_s: Annotated[float, Field(ge=0.0, le=1e12)] = 0.0
    memory_start: Literal["unknown", "home"] = "unknown"
    runs: Annotated[int, Field(ge=1, le=100_000)] = 1
    seed: Annotated[int, Field(ge=0)] = 2006
    humans: str | None = None
    match_radius_m: Annotated[float, Field(gt=0.0, le=100.0)] = 1.0
    trace: bool = True
    published: Published | None = None
    factors: dict[str, Annotated[dict[str, dict[str, Any]], Field(min_length=1)]] = Field(
        default_factory=dict
    )
    variants: list[VariantSettings] = Field(default_factory=list)
    set: dict[str, Any] = Field(default_factory=dict)

    @property
    def at_home(self) -> bool:
        """Whether the robot begins where the first run of its memory began."""
        return self.memory_start == HOME

    @model_validator(mode="after")
    def _one_source(self) -> Self:
        if (self.source is None) == (self.world is None):
            raise ValueError("a scenario has either source (a log) or world (a building)")
        return self

    @model_validator(mode="after")
    def _home_is_remembered(self) -> Self:
        if self.at_home and self.memory_from is None:
            raise ValueError(f"memory_start: {HOME} needs memory_from, which knows where that is")
        return self


def read_scenario(path: Path) -> tuple[Scenario, settings.Document]:
    """Read and check a scenario file; return it with the places of its keys.

    Raises
    ------
    SettingsError
        With one line for each thing that is wrong.
    """
    document = settings.read_document(path)
    problems = _missing_files(document)
    try:
        scenario = settings.validated(Scenario, document)
    except SettingsError as e:
        problems += [*str(e).splitlines(), *_unknown_doors(document)]
    if problems:
        raise SettingsError("\n".join(settings.in_order(problems)))
    return scenario, document


ENTRIES: dict[settings.Key, str] = {
    **{(module,): module for module in MODULES},
    ("world", "robot"): "robots",
}
FILES: tuple[settings.Key, ...] = (
    ("source", "log"),
    ("world", "map"),
    ("world", "locations"),
    ("humans",),
)


def _missing_files(document: settings.Document) -> list[str]:
    """Complain of names that lead nowhere, whatever else is wrong with the file."""
    problems = []
    base = document.path.parent
    for key, kind in ENTRIES.items():
        name = _value(document.data, key)
        try:
            if isinstance(name, str):
                library.find(kind, at(base, name))
        except LibraryError as e:
            problems.append(f"{document.where(key)}: {'.'.join(map(str, key))}: {e}")
    for key in FILES:
        name = _value(document.data, key)
        if isinstance(name, str) and not (base / name).is_file():
            said = "is a folder" if (base / name).is_dir() else "no such file"
            dotted = ".".join(map(str, key))
            problems.append(f"{document.where(key)}: {dotted}: {base / name}: {said}")
    name = _value(document.data, ("memory_from",))
    try:
        if isinstance(name, str) and name:
            memory_files(base / name)
    except MemoryFileError as e:
        problems.append(f"{document.where(('memory_from',))}: memory_from: {e}")
    return problems


def _unknown_doors(document: settings.Document) -> list[str]:
    """Complain of doors that the map has not; where all else is right, `place_of` does it."""
    plan, table, doors = (
        _value(document.data, ("world", key)) for key in ("map", "locations", "doors")
    )
    base = document.path.parent
    try:
        if isinstance(table, str):
            found = load_locations(base / table)
        elif isinstance(plan, str):
            found = load_building(base / plan).locations
        else:
            return []
    except MapError:
        return []  # is said of the map itself
    known = [location.id for location in found]
    problems = []
    for i, door in enumerate(doors if isinstance(doors, list) else ()):
        name = _value(door, ("location",))
        if isinstance(name, str) and name not in known:
            key = ("world", "doors", i, "location")
            said = unknown_location(name, known)
            problems.append(f"{document.where(key)}: {'.'.join(map(str, key))}: {said}")
    return problems


def _value(data: Any, key: settings.Key) -> Any:
    """Return what stands at a key, or None."""
    for part in key:
        data = data.get(part) if isinstance(data, dict) else None
    return data


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


def at(base: Path, name: str) -> str:
    """Make a path relative to the scenario file; leave a library name as it is."""
    if "/" in name or name.endswith(library.SUFFIXES):
        return str(base / name)
    return name
