"""Reads the entries that a scenario names: the modules of the mind, the robot."""

from __future__ import annotations

from pathlib import Path

from ssrics_like import library, settings
from ssrics_like.cues import read_cue, read_structure_cue
from ssrics_like.memory.profile import MemoryProfile
from ssrics_like.perception.profile import PerceptionProfile
from ssrics_like.productions.rulebook import load_rulebook
from ssrics_like.productions.rules import Rulebook
from ssrics_like.world.robot import RobotProfile


def load_perception(name: str | Path) -> PerceptionProfile:
    """Read a perception profile: a library entry, or a path.

    Raises
    ------
    LibraryError, SettingsError, CueError
        There is none of this name; it is wrong, or the cue that it names.
    """
    path = library.find("perception", name)
    profile = settings.validated(PerceptionProfile, settings.read_document(path))
    for key, read in (("doorways", read_cue), ("structure", read_structure_cue)):
        cue: str = getattr(profile, key)
        if cue.endswith(".json"):  # a path in a file starts at that file
            cue = str(path.parent / cue)
            profile = profile.model_copy(update={key: cue})
        if cue:
            read(library.find_cue(cue))
    return profile


def load_memory(name: str | Path) -> MemoryProfile:
    """Read a memory profile: a library entry, or a path.

    Raises
    ------
    LibraryError, SettingsError
        There is none of this name; it is wrong.
    """
    return settings.validated(MemoryProfile, settings.read_document(library.find("memory", name)))


def load_productions(name: str | Path) -> Rulebook:
    """Read a rule set: a library entry, or a path.

    Raises
    ------
    LibraryError, RuleError
        There is none of this name; it is wrong.
    """
    return load_rulebook(library.find("productions", name))


def load_robot(name: str | Path) -> RobotProfile:
    """Read a robot: an entry of scenarios/robots, or a path.

    Raises
    ------
    LibraryError, SettingsError
        There is none of this name; it is wrong.
    """
    return settings.validated(RobotProfile, settings.read_document(library.find("robots", name)))
