"""YAML files as checked settings: every error with its place, all of them at once.

PyYAML keeps a line mark on each node but drops it on loading, and lets a key
stand twice. Here the node tree is walked once, so that both are known when
pydantic has said what is wrong.
"""

from __future__ import annotations

import itertools
import re
import types
import typing
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeVar

import yaml
from pydantic import BaseModel, ValidationError

from ssrics_like.errors import SettingsError, nearest

Key = tuple[str | int, ...]


class _Loader(yaml.SafeLoader):
    """Reads 1e-3 as a number, as YAML 1.2 does; YAML 1.1 wants 1.0e-3."""


_Loader.add_implicit_resolver(
    "tag:yaml.org,2002:float",
    re.compile(r"[-+]?[0-9][0-9_]*(\.[0-9_]*)?[eE][-+]?[0-9]+"),
    list("-+0123456789"),
)
Settings = TypeVar("Settings", bound=BaseModel)
VALUES_MAX = 100_000  # in one file; aliases can make billions out of a few lines


@dataclass(frozen=True)
class Mark:
    """A place in a file, 1-based."""

    line: int
    column: int


@dataclass
class Document:
    """The content of one YAML file and where each key of it stands.

    Attributes
    ----------
    path : Path
        The file.
    data : dict
        Its content as plain Python values.
    marks : dict
        Path of keys -> place of the key (of the item, in a list).
    first_line : dict
        Path of keys -> line on which the value's own text begins: below the key of a block.
    unread : set
        Paths of keys whose value could not be read.
    problems : list of str
        What is already known to be wrong: keys that stand twice, values that cannot be read.
    """

    path: Path
    data: dict[str, Any] = field(default_factory=dict)
    marks: dict[Key, Mark] = field(default_factory=dict)
    first_line: dict[Key, int] = field(default_factory=dict)
    unread: set[Key] = field(default_factory=set)
    problems: list[str] = field(default_factory=list)

    def where(self, key: Key) -> str:
        """Return ``file:line:column`` of `key` or of the nearest key above it."""
        while key and key not in self.marks:
            key = key[:-1]
        mark = self.marks.get(key)
        return f"{self.path}:{mark.line}:{mark.column}" if mark else f"{self.path}"


def read_document(path: Path) -> Document:
    """Read a YAML file whose top level is a mapping.

    Raises
    ------
    SettingsError
        The file cannot be read, is empty, or is not YAML.
    """
    try:
        text = path.read_text(encoding="utf-8")
    except FileNotFoundError:
        raise SettingsError(f"{path}: no such file") from None
    except IsADirectoryError:
        raise SettingsError(f"{path}: is a folder, expected a YAML file") from None
    except (OSError, UnicodeDecodeError) as e:
        why = e.strerror if isinstance(e, OSError) else "it is not UTF-8"
        raise SettingsError(f"{path}: cannot be read as text ({why})") from None
    try:
        loader = _Loader(text)
        root = loader.get_single_node()
    except RecursionError:
        raise SettingsError(f"{path}: is nested too deeply") from None
    except yaml.MarkedYAMLError as e:
        mark = e.problem_mark or e.context_mark
        place = f":{mark.line + 1}:{mark.column + 1}" if mark else ""
        raise SettingsError(f"{path}{place}: not valid YAML: {e.problem}") from None
    except yaml.YAMLError as e:
        raise SettingsError(f"{path}: not valid YAML: {str(e).splitlines()[0]}") from None
    if root is None:
        raise SettingsError(f"{path}: the file is empty, expected YAML keys")
    document = Document(path)
    if not isinstance(root, yaml.MappingNode):
        mark = root.start_mark
        place = f"{path}:{mark.line + 1}:{mark.column + 1}"
        raise SettingsError(f"{place}: expected keys and values at the top")
    document.data = _plain(root, (), document, loader, ())
    return document


def _plain(node: Any, at: Key, doc: Document, loader: Any, above: tuple[int, ...]) -> Any:
    """Turn a node into plain values, noting marks and keys that stand twice."""
    if id(node) in above:
        raise SettingsError(f"{doc.where(at)}: the value contains itself")
    if len(doc.marks) > VALUES_MAX:
        raise SettingsError(f"{doc.path}: holds more than {VALUES_MAX} values")
    if isinstance(node, yaml.SequenceNode):
        items = []
        for i, child in enumerate(node.value):
            doc.marks[*at, i] = _mark(child)
            items.append(_plain(child, (*at, i), doc, loader, (*above, id(node))))
        return items
    if isinstance(node, yaml.MappingNode):
        values: dict[str, Any] = {}
        for key_node, child in node.value:
            mark = _mark(key_node)
            if not isinstance(key_node, yaml.ScalarNode):
                place = f"{doc.path}:{mark.line}:{mark.column}"
                doc.problems.append(f"{place}: a key must be a word, not a list or mapping")
                continue
            key = str(key_node.value)
            if key in values:
                first = doc.marks[*at, key]
                doc.problems.append(
                    f"{doc.path}:{mark.line}:{mark.column}: key '{key}' stands twice "
                    f"(first in line {first.line})"
                )
                continue
            doc.marks[*at, key] = mark
            values[key] = _plain(child, (*at, key), doc, loader, (*above, id(node)))
        return values
    mark = _mark(node)
    doc.first_line[at] = mark.line + (node.style in ("|", ">"))
    try:
        return loader.construct_object(node)
    except (yaml.YAMLError, ValueError):
        doc.unread.add(at)
        doc.problems.append(
            f"{doc.path}:{mark.line}:{mark.column}: {node.value!r} cannot be read as {node.tag}"
        )
        return None


def _mark(node: Any) -> Mark:
    return Mark(node.start_mark.line + 1, node.start_mark.column + 1)


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
            lines.append((where, f"unknown key '{key}'{_hint(str(where[-1]), known)}"))
        elif item["loc"][-1:] == ("[key]",):  # of a mapping whose keys are fixed words
            known = re.findall(r"'([^']*)'", item["msg"])
            name = ".".join(str(part) for part in where)
            lines.append((where, f"unknown key '{name}'{_hint(str(item['input']), known)}"))
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
        hint = nearest(value, words) if len(words) > 1 and isinstance(value, str) else ""
        key = ".".join(str(part) for part in where)
        lines.append((where, f"{key}: {_shown(value)} where {wanted} was expected{hint}"))
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


def _hint(word: str, known: Iterable[str]) -> str:
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
            return f"'{key}'{_hint(key, known)}"
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
        return key.strip(), yaml.load(value, _Loader)  # noqa: S506 - a SafeLoader
    except (yaml.YAMLError, ValueError):
        raise SettingsError(f"--set {text}: the value {value!r} is not valid YAML") from None
