"""Which reflexes the timeline shows, and the part of the trace that is about them."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ssrics_like.errors import ResultsError
from ssrics_like.report.spans import Span, spans_of
from ssrics_like.results.records import Reflex, Run

EPISODES_MAX = 4
LOOKED_AT = 400
"""How many reflexes from the start are looked through for one of each kind."""
BEFORE_S, AFTER_S = 0.04, 0.16
"""What is shown before a reflex enters its buffer, and after the decision."""


@dataclass(frozen=True)
class Episode:
    """One reflex from its arrival to its decision.

    Attributes
    ----------
    reflex : Reflex
        The reflex.
    arrival_s : float
        When its chunk entered the orienting buffer, source time.
    end_s : float
        End of what is shown, source time.
    spans : tuple of Span
        What stood where meanwhile.
    """

    reflex: Reflex
    arrival_s: float
    end_s: float
    spans: tuple[Span, ...]


def chosen(reflexes: tuple[Reflex, ...], count: int = EPISODES_MAX) -> list[Reflex]:
    """Choose reflexes worth looking at: the first of each decision, then the first of all.

    A reflex that was overwritten was never attended to, and is left out.
    """
    seen = sorted(
        (r for r in reflexes[:LOOKED_AT] if r.decision != "overwritten"), key=lambda r: r.decided_s
    )
    firsts = {r.decision: r for r in reversed(seen)}
    picked = sorted(firsts.values(), key=lambda r: r.decided_s)[:count]
    for reflex in seen:
        if len(picked) < count and reflex not in picked:
            picked.append(reflex)
    return sorted(picked, key=lambda r: r.decided_s)


def read_episodes(folder: Path, run: Run) -> list[Episode]:
    """Read the chosen reflexes' part of a run's trace.

    Parameters
    ----------
    folder : Path
        The results folder.
    run : Run
        The run.

    Returns
    -------
    list of Episode
        In order of time; empty where nothing was decided.

    Raises
    ------
    ResultsError
        The trace is missing or damaged.
    """
    wanted = chosen(run.reflexes)
    if not wanted:
        return []
    last_s = run.start_s + wanted[-1].decided_s + AFTER_S
    events = list(_events(folder / "trace" / f"{run.name}.jsonl", last_s))
    spans = spans_of(events)
    arrivals = {
        str(event["chunk"].get("event")): float(event["t_s"])
        for event in events
        if event["name"] == "orienting" and event.get("chunk")
    }
    episodes = []
    for reflex in wanted:
        arrival_s = arrivals.get(str(reflex.event))
        if arrival_s is None:
            continue  # a rule set that marks without the orienting buffer shows nothing here
        end_s = run.start_s + reflex.decided_s + AFTER_S
        within = [s for s in spans if s.start_s < end_s and s.end_s > arrival_s - BEFORE_S]
        episodes.append(Episode(reflex, arrival_s, end_s, tuple(within)))
    return episodes


def _events(file: Path, last_s: float) -> Iterator[dict[str, Any]]:
    """Yield the events up to a time, without the long lists of candidates."""
    try:
        lines = file.open(encoding="utf-8")
    except OSError as e:
        raise ResultsError(f"{file}: cannot be read ({e.strerror})") from None
    with lines:
        for number, line in enumerate(lines, 1):
            if '"candidates"' in line:
                continue
            try:
                event = json.loads(line)
                t_s = float(event["t_s"])
            except (KeyError, TypeError, ValueError) as e:
                raise ResultsError(f"{file}:{number}: is damaged: {e!r}") from None
            if t_s > last_s:
                return
            yield event
