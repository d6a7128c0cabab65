"""The file of a structure cue."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ssrics_like.atomic import write_atomically
from ssrics_like.cues.document import (
    expect_features,
    expect_format,
    expect_keys,
    expect_measures,
    expect_version,
    head_text,
    load,
    read_threshold,
    rounded,
)
from ssrics_like.cues.tables import read_trees, trees_text
from ssrics_like.perception.layout import LAYOUT, REVISION
from ssrics_like.perception.structure import KINDS, StructureCue

FORMAT, VERSION = "ssrics-like structure cue", 1
_KEYS = ("title", "source", "layout", "features", "kinds")


def write_structure_cue(path: Path, cue: StructureCue, about: Mapping[str, Any]) -> None:
    """Write a cue, whole or not at all.

    Parameters
    ----------
    path : Path
        The file.
    cue : StructureCue
        What was learned.
    about : mapping
        As in `write_cue`.

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
        "layout": REVISION,
        "features": list(LAYOUT),
    }
    kinds = ",\n".join(
        f'"{kind}": {{\n"threshold": {rounded(cue.thresholds[kind])},\n'
        f'"baseline": {rounded(cue.trees[kind].baseline)},\n'
        f'"trees": {trees_text(cue.trees[kind])}\n}}'
        for kind in KINDS
    )
    write_atomically(path, f'{{\n{head_text(head)}\n"kinds": {{\n{kinds}\n}}\n}}\n')


def read_structure_cue(path: Path) -> StructureCue:
    """Read a cue.

    Parameters
    ----------
    path : Path
        A file that `write_structure_cue` has written.

    Raises
    ------
    CueError
        The file cannot be read, is damaged, of another kind or version, or its trees ask for other
        measures than are made here: file, key, and what was expected.
    """
    document = load(path)
    expect_format(path, document, FORMAT)
    expect_version(path, document, VERSION)
    expect_keys(path, document, _KEYS)
    expect_measures(path, "layout", document["layout"], REVISION)
    expect_features(path, document["features"], LAYOUT)
    expect_keys(path, document["kinds"], KINDS, "kinds")
    trees, thresholds = {}, {}
    for kind in KINDS:
        key, part = f"kinds.{kind}", document["kinds"][kind]
        expect_keys(path, part, ("threshold", "baseline", "trees"), key)
        thresholds[kind] = read_threshold(path, f"{key}.threshold", part["threshold"])
        trees[kind] = read_trees(path, key, part["baseline"], part["trees"], len(LAYOUT))
    return StructureCue(trees, thresholds)
