"""Reads a cue of whichever kind."""

from __future__ import annotations

from pathlib import Path

from ssrics_like.cues import doorways, structure
from ssrics_like.cues.document import expect_format, load
from ssrics_like.perception.doorways import DoorwayCue
from ssrics_like.perception.structure import StructureCue


def read_any_cue(path: Path) -> DoorwayCue | StructureCue:
    """Read a doorway cue or a structure cue.

    Parameters
    ----------
    path : Path
        The file.

    Raises
    ------
    CueError
        As `read_cue` and `read_structure_cue`.
    """
    document = load(path)
    expect_format(path, document, doorways.FORMAT, structure.FORMAT)
    if document["format"] == doorways.FORMAT:
        return doorways.read_cue(path)
    return structure.read_structure_cue(path)
