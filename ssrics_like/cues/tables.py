"""The trees of a cue as tables of numbers, an array a line."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from ssrics_like.cues.document import read_number, read_whole, refuse, rounded, shown
from ssrics_like.perception.trees import BoostedTrees

LEAF = -1
_COLUMNS = ("feature", "threshold", "left", "right", "value")


def trees_text(trees: BoostedTrees) -> str:
    """Return trees as a JSON list, an array a line."""
    body = ",\n".join(_tree_text(tree) for tree in _separate(trees))
    return f"[\n{body}\n]"


def read_trees(path: Path, key: str, baseline: Any, tables: Any, features: int) -> BoostedTrees:
    """Return the trees that `trees_text` wrote.

    Parameters
    ----------
    path : Path
        The file, to name it in complaints.
    key : str
        Where it has them: empty, or the key within which ``baseline`` and ``trees`` stand.
    baseline, tables
        What stands there.
    features : int
        How many measures there are to ask for.

    Raises
    ------
    CueError
        A tree is damaged, or asks for a measure that there is not.
    """
    within = f"{key}." if key else ""
    number = read_number(path, f"{within}baseline", baseline)
    if not isinstance(tables, list) or not tables:
        refuse(path, f"{within}trees", "expected a list of trees, at least one")
    trees = [_tree(path, f"{within}trees[{i}]", table, features) for i, table in enumerate(tables)]
    return _joined(number, trees)


def _tree(path: Path, key: str, table: Any, features: int) -> dict[str, list[Any]]:
    """Check one tree: equally long columns of numbers, and children below their parents."""
    if not isinstance(table, dict):
        refuse(path, key, f"{shown(table)}, expected a tree with {', '.join(_COLUMNS)}")
    columns: dict[str, list[Any]] = {}
    for name in _COLUMNS:
        column = table.get(name)
        if not isinstance(column, list) or not column:
            refuse(path, f"{key}.{name}", f"{shown(column)}, expected a list of numbers")
        if len(column) != len(table["feature"]):
            refuse(
                path,
                f"{key}.{name}",
                f"{len(column)} numbers, expected {len(table['feature'])}, one a node",
            )
        columns[name] = column
    count = len(columns["feature"])
    for node in range(count):
        for name in ("threshold", "value"):
            read_number(path, f"{key}.{name}[{node}]", columns[name][node])
        feature = read_whole(
            path, f"{key}.feature[{node}]", columns["feature"][node], LEAF, features - 1
        )
        if feature != LEAF:
            for side in ("left", "right"):
                # Children stand behind their parents, so that every way down has an end.
                read_whole(path, f"{key}.{side}[{node}]", columns[side][node], node + 1, count - 1)
        else:
            for side in ("left", "right"):
                read_whole(path, f"{key}.{side}[{node}]", columns[side][node], LEAF, LEAF)
    return columns


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
                "threshold": [rounded(value) for value in trees.threshold[part].tolist()],
                "left": np.where(leaf, LEAF, trees.left[part] - first).tolist(),
                "right": np.where(leaf, LEAF, trees.right[part] - first).tolist(),
                "value": [rounded(value) for value in trees.value[part].tolist()],
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


def _tree_text(table: Mapping[str, list[Any]]) -> str:
    lines = (f'"{name}":{json.dumps(table[name], separators=(",", ":"))}' for name in _COLUMNS)
    return "{" + ",\n ".join(lines) + "}"
