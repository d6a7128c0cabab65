"""What the page says of scans that the results folder does not hold."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

WALLS = "Walls are where the beams of the whole run ended."


def scans_note(file: str, world: Mapping[str, Any], *, is_read: bool) -> str:
    """Say where the scans are from.

    Parameters
    ----------
    file : str
        Name of the log.
    world : mapping
        The simulated world, in which they are cast anew; empty for a log.
    is_read : bool
        Whether they were read from the log.
    """
    if world:
        missing = missing_in(world)
        return (
            "The scan as the map has it: cast anew at the true pose, without the noise that the "
            f"model sensed.{f' {missing}' if missing else ''}"
        )
    if is_read:
        return f"The scan is that of {file}. {WALLS}"
    return f"The results hold no scans; --log {file} adds them. {WALLS}"


def missing_in(world: Mapping[str, Any]) -> str:
    """Say what the robot met that the scan does not show; nothing where that is nothing."""
    kinds = {"furniture": "furniture", "people": "people", "doors": "doors that shut"}
    there = [kind for key, kind in kinds.items() if world.get(key)]
    if not there:
        return ""
    *first, last = there
    text = f"{', '.join(first)} and {last}" if first else last
    verb = "is" if there == ["furniture"] else "are"
    return f"{text[0].upper()}{text[1:]} {verb} not on the saved map, and so not in the scan."
