"""Reads and writes learned cues: JSON documents that say how they were trained.

The numbers of a tree stand in arrays, one a line, so that two cues can be compared by eye and by
``diff``. All numbers have 7 significant digits, which moves no probability by as much as 1e-5.
"""

from ssrics_like.cues.any import read_any_cue
from ssrics_like.cues.doorways import read_cue, write_cue
from ssrics_like.cues.structure import read_structure_cue, write_structure_cue

__all__ = [
    "read_any_cue",
    "read_cue",
    "read_structure_cue",
    "write_cue",
    "write_structure_cue",
]
