"""The file of a doorway cue."""

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
from ssrics_like.perception.doorways import DoorwayCue
from ssrics_like.perception.gap import FEATURES, MEASURES

FORMAT, VERSION = "ssrics-like doorway cue", 2
_KEYS = ("title", "source", "measures", "features", "threshold", "baseline", "trees")


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
        "threshold": rounded(cue.threshold),
        "baseline": rounded(cue.trees.baseline),
    }
    trees = trees_text(cue.trees)
    write_atomically(path, f'{{\n{head_text(head)}\n"trees": {trees}\n}}\n')


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
    document = load(path)
    expect_format(path, document, FORMAT)
    expect_version(path, document, VERSION)
    expect_keys(path, document, _KEYS)
    expect_measures(path, "measures", document["measures"], MEASURES)
    expect_features(path, document["features"], FEATURES)
    threshold = read_threshold(path, "threshold", document["threshold"])
    trees = read_trees(path, "", document["baseline"], document["trees"], len(FEATURES))
    return DoorwayCue(trees, threshold)
