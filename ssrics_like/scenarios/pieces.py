"""What a scenario's variants are put together from, and what is wrong with each piece."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ssrics_like import settings
from ssrics_like.errors import SsricsError, choices, nearest
from ssrics_like.scenarios.problems import Problems
from ssrics_like.scenarios.resolving import Resolved, resolve
from ssrics_like.scenarios.schema import MODULES, Scenario, make_scenario

Where = Callable[[settings.Key], str]


@dataclass(frozen=True)
class Piece:
    """A level of a factor, or a variant of its own.

    Attributes
    ----------
    key : tuple
        Where its values stand in the scenario's file.
    said : str
        What it is called in messages.
    values : dict
        What it sets.
    """

    key: settings.Key
    said: str
    values: dict[str, Any]


def pieces_of(scenario: Scenario) -> Iterator[Piece]:
    """Return every level of every factor, then the single variants."""
    for factor, levels in scenario.factors.items():
        for level, values in levels.items():
            yield Piece(("factors", factor, level), f"factor '{factor}', level '{level}'", values)
    for i, variant in enumerate(scenario.variants):
        yield Piece(("variants", i, "set"), f"variant '{variant.name}'", variant.set)


def resolve_with(
    scenario: Scenario,
    values: Mapping[str, Any],
    title: str,
    base: Path,
    overrides: list[str] | None,
    where: Where | None,
) -> Resolved:
    """Resolve a scenario with some values changed.

    Raises
    ------
    SettingsError, LibraryError, RuleError, MapError
        With one line for each thing that is wrong.
    """
    modules = {key: value for key, value in values.items() if key in MODULES}
    own = {k: v for k, v in values.items() if k.startswith(("world.", "source."))}
    rest = {k: v for k, v in values.items() if k not in modules and k not in own}
    data = scenario.model_dump()
    data |= {**modules, "set": {**scenario.set, **rest}, "factors": {}, "variants": []}
    data["title"] = title

    def label(dotted: str) -> str:
        place = where(tuple(dotted.split("."))) if where else ""
        return f"{place}: " if place else ""

    problems = Problems()
    changed = make_scenario(data)
    with problems.gathered():
        changed = settings.override(changed, own, "", label)
    with problems.gathered():
        resolved = resolve(changed, base, overrides, where=where)
    problems.complain()
    return resolved


def problems_of(
    scenario: Scenario, base: Path, overrides: list[str] | None, where: Where | None
) -> list[str]:
    """Return what is wrong with the scenario as it is, and with each piece alone.

    One line a problem: file, line and column, whose it is, and what.
    """

    def lines_of(values: Mapping[str, Any], there: Where | None) -> list[str]:
        try:
            resolve_with(scenario, values, scenario.title, base, overrides, there)
        except SsricsError as e:
            return str(e).splitlines()
        return []

    plain = lines_of({}, where)
    found = list(plain)
    for piece in pieces_of(scenario):
        there = _in_piece(piece, where)
        known = {key: value for key, value in piece.values.items() if "." in key or key in MODULES}
        found += [
            f"{there(('set', key))}: unknown key '{key}'{nearest(key, MODULES)}; known: "
            f"{choices(MODULES)} and single values as memory.decay or world.people.count"
            for key in piece.values
            if key not in known
        ]
        found += [
            line if piece.said in line else f"{there(())}: {line}"
            for line in lines_of(known, there)
            if line not in plain
        ]
    return found


def _in_piece(piece: Piece, where: Where | None) -> Where:
    """Return where keys stand: those that a piece sets in it, with its name; others as before."""

    def there(key: settings.Key) -> str:
        for own in piece.values:
            path = tuple(own.split("."))
            if key in ((), ("set", own)) or key[: len(path)] == path:
                at = where((*piece.key, own) if key else piece.key) if where else ""
                return f"{at}: {piece.said}" if at else piece.said
        return where(key) if where else ""

    return there
