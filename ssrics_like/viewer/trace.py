"""Reads a run's trace."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ssrics_like.errors import ResultsError


@dataclass(frozen=True, slots=True)
class Event:
    """One line of a trace.

    Attributes
    ----------
    t_s : float
        Seconds since the start of the run.
    action, name : str
        What happened, and the production or buffer that it happened to.
    chunk : mapping or None
        Slots of the chunk that was set, with ``isa``.
    """

    t_s: float
    action: str
    name: str
    chunk: Mapping[str, str] | None


def read_trace(file: Path, start_s: float) -> list[Event] | None:
    """Read a trace; None where there is none.

    Parameters
    ----------
    file : Path
        ``trace/run-NNN.jsonl``.
    start_s : float
        Start of the run on the trace's clock.

    Raises
    ------
    ResultsError
        A line is damaged.
    """
    if not file.is_file():
        return None
    events = []
    try:
        with file.open(encoding="utf-8") as lines:
            for number, line in enumerate(lines, 1):
                if '"candidates"' in line:
                    continue  # long lists, which the page does not show
                try:
                    events.append(_event(json.loads(line), start_s))
                except (KeyError, TypeError, ValueError, AttributeError) as e:
                    raise ResultsError(f"{file}:{number}: is damaged: {e!r}") from None
    except (OSError, UnicodeDecodeError) as e:
        raise ResultsError(f"{file}: cannot be read ({e})") from None
    return events


def _event(data: dict[str, Any], start_s: float) -> Event:
    chunk = data.get("chunk")
    if chunk is not None:
        chunk = {str(slot): str(word) for slot, word in chunk.items()}
    return Event(float(data["t_s"]) - start_s, str(data["action"]), str(data["name"]), chunk)
