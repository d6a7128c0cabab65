"""Reads and writes learned cues: JSON documents that say how they were trained.

The numbers of a tree stand in arrays, one a line, so that two cues can be compared by eye and by
``diff``. All numbers have 7 significant digits, which moves no probability by as much as 1e-5.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NoReturn

import numpy as np

from ssrics_like.atomic import write_atomically
from ssrics_like.errors import CueError
from ssrics_like.perception.doorways import DoorwayCue
from ssrics_like.perception.gap import FEATURES, MEASURES
from ssrics_like.perception.trees import BoostedTrees

FORMAT, VERSION = "ssrics-like doorway cue", 2
DIGITS = 7
MOST = 1e30
LEAF = -1
_KEYS = (
    "format", "version", "title", "source", "measures", "features", "threshold", "baseline",
    "trees",
)  # fmt: skip
_COLUMNS = ("feature", "threshold", "left", "right", "value")


def write_cue(path: Path, cue: DoorwayCue, about: Mapping[str, Any]) -> None:
    """Write a cue, whole or not at all.

    Parameters
    ----------
    path : Path
        The file.
    cue : DoorwayCue
        What was learned.
    about : mapping
        ``title``, text, and ``source``, a mapping that says how the cue was trained: command,
        seed, number of buildings, version of scikit-learn.

    Raises
    ------
    OSError
        The folder cannot be written.
    """
    head = {
        "format": FORMAT,
        "version": VERSION,
        "title": about["title"],
        "source": dict(about["source"]),
        "measures": MEASURES,
        "features": list(FEATURES),
        "threshold": _rounded(cue.threshold),
        "baseline": _rounded(cue.trees.baseline),
    }
    lines = [f'"{key}": {json.dumps(value, ensure_ascii=False)},' for key, value in head.items()]
    trees = ",\n".join(_tree_text(tree) for tree in _separate(cue.trees))
    body = "\n".join(lines)
    write_atomically(path, f'{{\n{body}\n"trees": [\n{trees}\n]\n}}\n')


def read_cue(path: Path) -> DoorwayCue:
    """Read a cue.

    Parameters
    ----------
    path : Path
        A file that `write_cue` has written.

    Raises
    ------
    CueError
        The file cannot be read, is damaged, of another kind or newer than this version, or its
        trees ask for other measures than are made here: file, key, and what was expected.
    """
    document = _document(path)
    for key in _KEYS:
        if key not in document:
            _refuse(path, key, "is missing")
    _expect_measures(path, document["measures"], document["features"])
    threshold = _number(path, "threshold", document["threshold"])
    if not 0.0 < threshold <= 1.0:
        _refuse(path, "threshold", f"{threshold:g}, expected more than 0 and at most 1")
    tables = document["trees"]
    if not isinstance(tables, list) or not tables:
        _refuse(path, "trees", "expected a list of trees, at least one")
    trees = [_tree(path, f"trees[{i}]", table) for i, table in enumerate(tables)]
    return DoorwayCue(_joined(_number(path, "baseline", document["baseline"]), trees), threshold)


def _document(path: Path) -> dict[str, Any]:
    """Return the content of a file that is a cue of a version known here."""
    try:
        text = path.read_text(encoding="utf-8")
    except FileNotFoundError:
        raise CueError(f"{path}: no such file") from None
    except UnicodeDecodeError:
        raise CueError(f"{path}: is not UTF-8, expected a cue in JSON") from None
    except OSError as e:
        raise CueError(f"{path}: cannot be read ({e.strerror})") from None
    try:
        document = json.loads(text)
    except json.JSONDecodeError as e:
        raise CueError(f"{path}:{e.lineno}:{e.colno}: not valid JSON: {e.msg}") from None
    except (RecursionError, ValueError):  # nested too deeply; a number of too many digits
        raise CueError(f"{path}: not a cue: expected one that `ssrics train` wrote") from None
    kind = document.get("format") if isinstance(document, dict) else None
    if not isinstance(document, dict) or kind != FORMAT:
        _refuse(path, "format", f"{_shown(kind)}, expected '{FORMAT}'")
    version = document.get("version")
    if version != VERSION:
        _refuse(
            path, "version",
            f"{_shown(version)}; this version of ssrics reads {VERSION}: train the cue anew",
        )  # fmt: skip
    return document


def _expect_measures(path: Path, made: Any, names: Any) -> None:
    """Complain of measures of another version, and of the first that is not the one made here."""
    if made != MEASURES:
        _refuse(
            path, "measures",
            f"{_shown(made)}; this version of ssrics makes {MEASURES}: train the cue anew",
        )  # fmt: skip
    if not isinstance(names, list):
        _refuse(path, "features", f"{_shown(names)}, expected a list of {len(FEATURES)} names")
    for i, name in enumerate(FEATURES):
        if i == len(names) or names[i] != name:
            there = "missing" if i == len(names) else _shown(names[i])
            _refuse(path, f"features[{i}]", f"{there}, expected '{name}'; train the cue anew")
    if len(names) > len(FEATURES):
        last = len(FEATURES)
        _refuse(path, f"features[{last}]", f"{_shown(names[last])}, expected no more measures")


def _tree(path: Path, key: str, table: Any) -> dict[str, list[Any]]:
    """Check one tree: equally long columns of numbers, and children below their parents."""
    if not isinstance(table, dict):
        _refuse(path, key, f"{_shown(table)}, expected a tree with {', '.join(_COLUMNS)}")
    columns: dict[str, list[Any]] = {}
    for name in _COLUMNS:
        column = table.get(name)
        if not isinstance(column, list) or not column:
            _refuse(path, f"{key}.{name}", f"{_shown(column)}, expected a list of numbers")
        if len(column) != len(table["feature"]):
            _refuse(
                path,
                f"{key}.{name}",
                f"{len(column)} numbers, expected {len(table['feature'])}, one a node",
            )
        columns[name] = column
    count = len(columns["feature"])
    for node in range(count):
        for name in ("threshold", "value"):
            _number(path, f"{key}.{name}[{node}]", columns[name][node])
        feature = _whole(path, f"{key}.feature[{node}]", columns["feature"][node],
                         LEAF, len(FEATURES) - 1)  # fmt: skip
        if feature != LEAF:
            for side in ("left", "right"):
                # Children stand behind their parents, so that every way down has an end.
                _whole(path, f"{key}.{side}[{node}]", columns[side][node], node + 1, count - 1)
        else:
            for side in ("left", "right"):
                _whole(path, f"{key}.{side}[{node}]", columns[side][node], LEAF, LEAF)
    return columns


def _number(path: Path, key: str, value: Any) -> float:
    number = isinstance(value, int | float) and not isinstance(value, bool)
    if not number or not abs(value) <= MOST:  # neither is NaN, nor a whole number without end
        _refuse(path, key, f"{_shown(value)}, expected a number")
    return float(value)


def _whole(path: Path, key: str, value: Any, least: int, most: int) -> int:
    if not isinstance(value, int) or isinstance(value, bool) or not least <= value <= most:
        expected = f"{least}" if least == most else f"a whole number from {least} to {most}"
        if most < least:
            expected = f"a node behind its parent; the tree has {most + 1}"
        _refuse(path, key, f"{_shown(value)}, expected {expected}")
    return value


def _refuse(path: Path, key: str, why: str) -> NoReturn:
    raise CueError(f"{path}: {key}: {why}")


def _shown(value: Any) -> str:
    text = "nothing" if value is None else repr(value)
    return text if len(text) <= 60 else text[:57] + "..."  # noqa: PLR2004 - a line's worth


def _separate(trees: BoostedTrees) -> list[dict[str, list[Any]]]:
    """Return each tree's nodes, children counted within the tree."""
    ends = [*trees.roots[1:].tolist(), len(trees.feature)]
    tables = []
    for first, end in zip(trees.roots.tolist(), ends, strict=True):
        part = slice(first, end)
        leaf = trees.feature[part] == LEAF
        tables.append(
            {
                "feature": trees.feature[part].tolist(),
                "threshold": [_rounded(value) for value in trees.threshold[part].tolist()],
                "left": np.where(leaf, LEAF, trees.left[part] - first).tolist(),
                "right": np.where(leaf, LEAF, trees.right[part] - first).tolist(),
                "value": [_rounded(value) for value in trees.value[part].tolist()],
            }
        )
    return tables


def _joined(baseline: float, tables: list[dict[str, list[Any]]]) -> BoostedTrees:
    """Put the nodes of all trees into one table; undoes `_separate`."""
    sizes = np.array([len(table["feature"]) for table in tables])
    roots = np.concatenate([[0], sizes.cumsum()[:-1]]).astype(np.int32)
    first = np.repeat(roots, sizes)
    columns = {name: np.concatenate([table[name] for table in tables]) for name in _COLUMNS}
    leaf = columns["feature"] == LEAF
    return BoostedTrees(
        baseline=baseline,
        roots=roots,
        feature=columns["feature"].astype(np.int32),
        threshold=columns["threshold"].astype(np.float64),
        left=np.where(leaf, LEAF, first + columns["left"]).astype(np.int32),
        right=np.where(leaf, LEAF, first + columns["right"]).astype(np.int32),
        value=columns["value"].astype(np.float64),
    )


def _rounded(value: float) -> float | int:
    number = float(f"{value:.{DIGITS}g}")
    return int(number) if number == 0.0 else number  # most zeros stand for nothing; they are short


def _tree_text(table: Mapping[str, list[Any]]) -> str:
    lines = (f'"{name}":{json.dumps(table[name], separators=(",", ":"))}' for name in _COLUMNS)
    return "{" + ",\n ".join(lines) + "}"
