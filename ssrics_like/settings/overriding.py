"""Settings with some values replaced, as after ``--set``."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import yaml
from pydantic import BaseModel, ValidationError

from ssrics_like.errors import SettingsError
from ssrics_like.settings.checking import Settings, explain, fields_at, hint
from ssrics_like.settings.document import Key
from ssrics_like.settings.yaml_numbers import Loader


def override(
    settings: Settings,
    changes: Mapping[str, Any],
    prefix: str,
    label: Callable[[str], str] = lambda _: "--set ",
) -> Settings:
    """Return the settings with some values replaced, checked anew.

    Parameters
    ----------
    settings : BaseModel
        Where to start from.
    changes : mapping
        Dotted key below `settings` -> new value.
    prefix : str
        What stands before the key, for messages: ``memory.``.
    label : callable
        Says where a dotted key of `changes` stands, for messages.

    Raises
    ------
    SettingsError
        With one line for each unknown key and each value that does not fit.
    """
    kind = type(settings)
    data = settings.model_dump()
    problems = []
    applied = []
    for dotted, value in changes.items():
        unknown = _unknown_in(kind, data, dotted.split("."))
        if unknown:
            problems.append(f"{label(dotted)}{prefix}{dotted}: unknown key {unknown}")
            continue
        inner: Any = data
        *above, last = dotted.split(".")
        for key in above:
            if inner.get(key) is None:
                inner[key] = {}
            inner = inner[key]
        inner[last] = value
        applied.append(dotted)
    try:
        changed = kind.model_validate(data)
    except ValidationError as e:
        for where, text in explain(kind, e, data):
            key = f"{'.'.join(map(str, where))}: " if text.startswith("unknown key") else ""
            problems.append(f"{label(_changed_at(where, applied))}{prefix}{key}{text}")
    if problems:
        raise SettingsError("\n".join(problems))
    return changed


def _unknown_in(kind: type[BaseModel], data: Any, keys: list[str]) -> str:
    """Return the first key that leads nowhere, with what is known there; nothing if all do."""
    for i, key in enumerate(keys):
        known = fields_at(kind, keys[:i])
        if not isinstance(data, dict) or (known and key not in known):
            return f"'{key}'{hint(key, known)}"
        inner = data.get(key)
        data = {} if inner is None else inner
    return ""


def _changed_at(where: Key, changes: Sequence[str]) -> str:
    """Return the dotted key of the change that a complaint is about."""

    def shared(dotted: str) -> int:
        pairs = zip(dotted.split("."), map(str, where), strict=False)
        return sum(1 for _ in itertools.takewhile(lambda pair: pair[0] == pair[1], pairs))

    return max(changes, key=shared, default="")


def parse_override(text: str) -> tuple[str, Any]:
    """Split ``key=value`` as typed after ``--set``; the value is read as YAML.

    Raises
    ------
    SettingsError
        There is no ``=``, no key, or the value is not YAML.
    """
    key, equals, value = text.partition("=")
    if not equals or not key.strip() or not value.strip():
        raise SettingsError(f"--set {text}: expected key=value, for example memory.decay=0.3")
    try:
        return key.strip(), yaml.load(value, Loader)  # noqa: S506 - a SafeLoader
    except (yaml.YAMLError, ValueError):
        raise SettingsError(f"--set {text}: the value {value!r} is not valid YAML") from None
