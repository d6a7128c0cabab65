"""The content of a YAML file, and where each of its keys stands."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import yaml

from ssrics_like.errors import SettingsError
from ssrics_like.settings.yaml_numbers import Loader

Key = tuple[str | int, ...]
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
        loader = Loader(text)
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
