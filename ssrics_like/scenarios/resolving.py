"""From a scenario to all that a run needs: files read, overrides applied, places checked."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, TypeVar

from pydantic import BaseModel

from ssrics_like import settings
from ssrics_like.errors import SettingsError, choices, nearest
from ssrics_like.maps import load_choices
from ssrics_like.memory.profile import MemoryProfile
from ssrics_like.perception.profile import PerceptionProfile
from ssrics_like.productions.rules import EngineParameters, Rulebook
from ssrics_like.scenarios.modules import (
    load_memory,
    load_perception,
    load_productions,
    load_robot,
)
from ssrics_like.scenarios.place import Place, place_of
from ssrics_like.scenarios.problems import Problems
from ssrics_like.scenarios.remembering import Recollection, recollect
from ssrics_like.scenarios.schema import MODULES, Scenario, at, read_scenario
from ssrics_like.scenarios.world_settings import Strict
from ssrics_like.wayfinding import ALL, HOME


@dataclass(frozen=True)
class Resolved:
    """A scenario with its files read and overrides applied: all that a run needs.

    Attributes
    ----------
    scenario : Scenario
        As it was written, with what was set at the command line.
    log : Path or None
        The log that observations come from,
    place : Place or None
        or the building and robot.
    perception, productions, memory
        The modules of the mind.
    recollection : Recollection or None
        What they remember from the beginning.
    """

    scenario: Scenario
    log: Path | None
    place: Place | None
    perception: PerceptionProfile
    productions: Rulebook
    memory: MemoryProfile
    recollection: Recollection | None = None

    def of_run(self, run: int) -> Resolved:
        """Return what one run needs of it: memories of others are large, and travel far."""
        if self.recollection is None:
            return self
        return replace(self, recollection=self.recollection.of_run(run))

    @property
    def source_name(self) -> str:
        """Name of the log or map."""
        return self.log.name if self.log else self.place.name if self.place else ""

    def as_data(self) -> dict[str, Any]:
        """Return everything that decides the results, as plain values for the manifest."""
        book, scenario = self.productions, self.scenario
        data: dict[str, Any] = {"title": scenario.title, "description": scenario.description}
        if scenario.source is not None and self.log is not None:
            data["source"] = {**scenario.source.model_dump(), "log": self.log.name}
        if self.place is not None:
            data["world"] = self.place.as_data()
        if self.recollection is not None:
            data["memory_from"] = self.recollection.as_data()
        return {
            **data,
            "perception": {"name": scenario.perception, **self.perception.model_dump()},
            "productions": {
                "name": scenario.productions,
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
            "memory": {"name": scenario.memory, **self.memory.model_dump()},
            "set": scenario.set,
            "humans": Path(scenario.humans).name if scenario.humans else None,
            "match_radius_m": scenario.match_radius_m,
            "trace": scenario.trace,
            "published": scenario.published.model_dump() if scenario.published else None,
            "runs": scenario.runs,
            "seed": scenario.seed,
        }


Settings = TypeVar("Settings", bound=BaseModel)


class _Engine(Strict):
    """The part of a rule set that ``--set productions.parameters...`` reaches."""

    parameters: EngineParameters


def load_resolved(path: Path, overrides: list[str] | None = None) -> Resolved:
    """Read a scenario file and all that it names.

    Raises
    ------
    LibraryError, SettingsError, RuleError, MapError
        A name is unknown, or a file or override is wrong.
    """
    scenario, document = read_scenario(path)
    return resolve(scenario, path.parent, overrides, where=document.where)


def resolve(
    scenario: Scenario,
    base: Path,
    overrides: list[str] | None = None,
    *,
    where: Callable[[settings.Key], str] | None = None,
) -> Resolved:
    """Read the files that a scenario names and apply ``--set`` overrides.

    Parameters
    ----------
    scenario : Scenario
        As read, or made from command-line arguments.
    base : Path
        Folder that relative paths start from.
    overrides : list of str
        ``key=value`` each: ``memory.decay=0.3``, ``runs=3``, ``source.strict=true``.
    where : callable, optional
        Gives the place of a key in the scenario's file, for messages.

    Raises
    ------
    LibraryError, SettingsError, RuleError, MapError
        A name is unknown, or a file or override is wrong.
    """
    typed = dict(settings.parse_override(text) for text in overrides or [])
    heads = (*MODULES, *(("robot",) if scenario.world is not None else ()))
    written = _by_module(scenario.set, heads)
    changes = _by_module({k: v for k, v in typed.items() if "." in k}, heads)
    own = {k: v for k, v in typed.items() if k.partition(".")[0] in Scenario.model_fields
           and not any(k.startswith(f"{head}.") for head in heads)}  # fmt: skip
    problems = Problems()
    problems.lines += [
        _unknown(_place(where, ("set", key)) or "set.", key, heads, ())
        for key in scenario.set
        if not any(key.startswith(f"{head}.") for head in heads)
    ]
    problems.lines += [
        _unknown("--set ", key, heads, Scenario.model_fields)
        for key in typed
        if key not in own and not any(key.startswith(f"{head}.") for head in heads)
    ]

    def changed(settings_of: Settings, head: str) -> Settings:
        """Apply what the scenario's `set` says, then what was typed."""

        def label(dotted: str) -> str:
            return _place(where, ("set", f"{head}.{dotted}")) or "set."

        first = settings.override(settings_of, written[head], f"{head}.", label)
        return settings.override(first, changes[head], f"{head}.")

    with problems.gathered():
        scenario = settings.override(scenario, own, "")
    # A path that was typed starts where it was typed; one in a scenario file, at that file.
    start = {
        key: Path() if key in own else base
        for key in (
            *MODULES, "memory_from", "source.log", "world.map", "world.robot", "world.locations",
            "humans",
        )
    }  # fmt: skip
    with problems.gathered():
        perception = load_perception(at(start["perception"], scenario.perception))
        perception = changed(perception, "perception")
    book = None
    with problems.gathered():
        book = load_productions(at(start["productions"], scenario.productions))
        engine = changed(_Engine(parameters=book.parameters), "productions")
    with problems.gathered():
        memory = changed(load_memory(at(start["memory"], scenario.memory)), "memory")
    recollection = None
    remembering = "" if "memory_from" in own else _dotted(where, ("memory_from",))
    with problems.gathered(remembering):
        if scenario.memory_from is not None:
            there = start["memory_from"] / scenario.memory_from
            recollection = recollect(
                there, scenario.runs, scenario.memory_pause_s,
                at_home=scenario.at_home,
            )  # fmt: skip
    place = None
    if scenario.world is not None:
        typed_keys = [tuple(key.split(".")) for key in own]

        def said_at(key: settings.Key) -> str:
            if any(key[: len(each)] == each for each in typed_keys):
                return "--set"
            return where(key) if where else ""

        with problems.gathered():
            robot = load_robot(at(start["world.robot"], scenario.world.robot))
            robot = changed(robot, "robot")
            place = place_of(scenario.world, robot, start, said_at)
            _check_published(scenario, place, said_at)
            _check_errands(scenario, book, recollection, said_at)
    with problems.gathered():
        if scenario.humans is not None:
            load_choices(start["humans"] / scenario.humans)
    problems.complain()
    with problems.gathered(remembering):
        if recollection is not None:
            recollection.check_views(perception.view_length)
    problems.complain()
    return Resolved(
        scenario=scenario,
        log=start["source.log"] / scenario.source.log if scenario.source else None,
        place=place,
        perception=perception,
        productions=replace(book, parameters=engine.parameters),
        memory=memory,
        recollection=recollection,
    )


def _check_published(
    scenario: Scenario, place: Place, where: Callable[[settings.Key], str]
) -> None:
    """Complain of published figures for locations that the map does not have."""
    known = [location.id for location in place.building.locations]
    found = scenario.published.found if scenario.published else {}
    problems = []
    for name in found:
        if name not in known:
            at_file = where(("published", "found", name))
            said = (
                f"the map has no location '{name}'{nearest(name, known)}; it has {choices(known)}"
            )
            problems.append(f"{at_file}: published.found: {said}" if at_file else said)
    if problems:
        raise SettingsError("\n".join(problems))


def _check_errands(
    scenario: Scenario,
    book: Rulebook | None,
    recollection: Recollection | None,
    where: Callable[[settings.Key], str],
) -> None:
    """Complain of errands that no rule could lead on, or to landmarks that cannot be known."""
    world = scenario.world
    assert world is not None
    problems = []
    explored = False
    for i, leg in enumerate(world.journey):
        explored = explored or leg.goto is None
        if leg.goto is None:
            continue
        key: settings.Key = ("world", "legs", i, "goto") if world.legs else ("world", "goto")
        before = _dotted(where, key) or f"{'.'.join(map(str, key))}: "
        if book is None:
            return  # that there is no such rule set is said already
        if not book.leads:
            problems.append(
                f"{before}'{leg.goto}': no rule of {book.path.name} attends to the buffer 'way'; "
                "expected productions that lead, such as wayfinding"
            )
        elif leg.goto not in (HOME, ALL) and not explored:
            memories = recollection.by_run.values() if recollection else ()
            known = {mark.id for each in memories for mark in each.memory.landmarks}
            if leg.goto not in known:
                hint = (
                    nearest(leg.goto, {*known, HOME, ALL})
                    if known
                    else ("; nothing was explored before, and there is no memory_from")
                )
                problems.append(f"{before}memory has no landmark '{leg.goto}'{hint}")
    if problems:
        raise SettingsError("\n".join(problems))


def _by_module(values: dict[str, Any], heads: tuple[str, ...]) -> dict[str, dict[str, Any]]:
    """Sort dotted keys by the module that they belong to."""
    return {
        head: {k.partition(".")[2]: v for k, v in values.items() if k.startswith(f"{head}.")}
        for head in heads
    }


def _place(where: Callable[[settings.Key], str] | None, key: settings.Key) -> str:
    place = where(key) if where else ""
    return f"{place}: " if place else ""


def _dotted(where: Callable[[settings.Key], str] | None, key: settings.Key) -> str:
    """Return where a key stands, and the key; nothing if that is not known."""
    place = _place(where, key)
    return f"{place}{'.'.join(map(str, key))}: " if place else ""


def _unknown(place: str, key: str, heads: tuple[str, ...], fields: Iterable[str]) -> str:
    names = [*fields, *heads]
    known = [*fields, *(f"{head}." for head in heads)]
    head = key.partition(".")[0]
    return f"{place}{key}: unknown key '{head}'{nearest(head, names)}; known: {choices(known)}"
