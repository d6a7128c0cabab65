"""What pydantic complains of, a line each: place, key, value, what was expected."""

from __future__ import annotations

import re
import types
import typing
from collections.abc import Iterable, Sequence
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError

from ssrics_like.errors import SettingsError, nearest
from ssrics_like.settings.document import Document, Key

Settings = TypeVar("Settings", bound=BaseModel)


def validated(kind: type[Settings], document: Document) -> Settings:
    """Check a document against a settings model.

    Raises
    ------
    SettingsError
        With one line for each thing that is wrong, in order of their lines.
    """
    problems = list(document.problems)
    try:
        settings = kind.model_validate(document.data)
    except ValidationError as e:
        problems += [
            f"{document.where(key)}: {text}"
            for key, text in explain(kind, e, document.data)
            if key not in document.unread
        ]
        raise SettingsError("\n".join(in_order(problems))) from None
    if problems:
        raise SettingsError("\n".join(in_order(problems)))
    return settings


def explain(kind: type[BaseModel], error: ValidationError, data: Any) -> list[tuple[Key, str]]:
    """Say each of pydantic's complaints in one line: key, value, expectation, nearest name."""
    lines: list[tuple[Key, str]] = []
    mistyped: dict[Key, list[str]] = {}
    places = {tuple(item["loc"]) for item in error.errors()}
    for item in error.errors():
        where = _in_data(tuple(item["loc"]), data)
        key = ".".join(str(part) for part in item["loc"])
        depth = len(item["loc"])
        if item["type"] == "too_short" and any(
            len(at) > depth and at[:depth] == item["loc"] for at in places
        ):
            continue  # the items are there, but they have complaints of their own
        if item["type"] == "too_short":
            least = item["ctx"]["min_length"]
            lines.append((where, f"{key}: {_shown(item['input'])}: expected {least} or more"))
        elif item["type"] == "extra_forbidden":
            known = fields_at(kind, where[:-1])
            lines.append((where, f"unknown key '{key}'{hint(str(where[-1]), known)}"))
        elif item["loc"][-1:] == ("[key]",):  # of a mapping whose keys are fixed words
            known = re.findall(r"'([^']*)'", item["msg"])
            name = ".".join(str(part) for part in where)
            lines.append((where, f"unknown key '{name}'{hint(str(item['input']), known)}"))
        elif item["type"] == "missing":
            lines.append((where, f"key '{key}' is missing"))
        elif item["type"].endswith(("_type", "_parsing")) or item["type"] == "literal_error":
            expected = item["msg"].removeprefix("Input should be ").partition(", unable")[0]
            expected = expected.partition(" or instance of")[0]
            mistyped.setdefault(where, []).append(_PLAIN_WORDS.get(expected, expected))
        else:
            key = ".".join(str(part) for part in where)
            said = item["msg"].removeprefix("Input should be ")
            own = said.removeprefix("Value error, ")  # a validator's own words say it all
            shown = _shown(item["input"])
            said = f"{shown}: expected {said}" if own == said else own
            lines.append((where, f"{key}: {said}" if key else said))
    for where, expectations in mistyped.items():
        value: Any = data
        for part in where:
            value = value[part]
        wanted = " or ".join(dict.fromkeys(expectations))
        words = re.findall(r"'([^']*)'", wanted)
        # The only word there is has been said already.
        near = nearest(value, words) if len(words) > 1 and isinstance(value, str) else ""
        key = ".".join(str(part) for part in where)
        lines.append((where, f"{key}: {_shown(value)} where {wanted} was expected{near}"))
    return lines


_PLAIN_WORDS = {
    "a valid tuple": "a list",
    "a valid list": "a list",
    "a valid dictionary": "keys and values",
    "a valid string": "text",
    "a valid number": "a number",
    "a valid integer": "a whole number",
    "a valid boolean": "true or false",
}
"""pydantic's words for a kind of value -> those of this project."""


def _in_data(at: Key, data: Any) -> Key:
    """Cut a complaint's path to the keys that the data has: a union adds its branches' names."""
    for depth, part in enumerate(at):
        try:
            data = data[part]
        except (KeyError, IndexError, TypeError):
            return at[:depth]
    return at


def _shown(value: Any) -> str:
    text = repr(value)
    return text if len(text) <= 60 else text[:57] + "..."  # noqa: PLR2004 - a line's worth


def hint(word: str, known: Iterable[str]) -> str:
    """Return the known key that a word is nearest to, or all of them, as the end of a complaint."""
    names = list(known)
    return nearest(word, names) or (f"; known keys: {', '.join(names)}" if names else "")


def in_order(problems: list[str]) -> list[str]:
    """Return problems in order of the lines and columns that they name."""

    def place(line: str) -> tuple[int, int]:
        parts = line.split(":", 3)
        try:
            return int(parts[1]), int(parts[2])
        except (IndexError, ValueError):
            return 0, 0

    return sorted(problems, key=place)


def fields_at(kind: type[BaseModel], at: Sequence[str | int]) -> list[str]:
    """Return the field names of the model that stands at a path of keys below `kind`."""
    model: Any = kind
    for part in at:
        if isinstance(part, int):
            continue
        if not (isinstance(model, type) and issubclass(model, BaseModel)):
            return []
        info = model.model_fields.get(part)
        if info is None:
            continue  # a union's branch name, which is no key of the file
        model = _model_in(info.annotation)
    return (
        list(model.model_fields) if isinstance(model, type) and issubclass(model, BaseModel) else []
    )


def _model_in(annotation: Any) -> Any:
    """Find the model inside ``X | None``, ``tuple[X, ...]`` and the like."""
    if isinstance(annotation, type) and not isinstance(annotation, types.GenericAlias):
        return annotation
    for part in typing.get_args(annotation):
        found = _model_in(part)
        if isinstance(found, type) and issubclass(found, BaseModel):
            return found
    return None
