"""The story of a trace as the page reads it: everything that comes twice stands once."""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from typing import Any

from ssrics_like.productions.rules import Rule
from ssrics_like.viewer.judging import HOLDS, Verdict
from ssrics_like.viewer.story import Resolution, Story

DECIMALS = 4
"""The engine's clock has tenths of a millisecond."""


class Table:
    """Gives equal values one number each, in order of their first coming."""

    def __init__(self) -> None:
        self.values: list[Any] = []
        self._numbers: dict[Hashable, int] = {}

    def number(self, key: Hashable, value: Any) -> int:
        """Return the number of a value, which `key` stands for."""
        if key not in self._numbers:
            self._numbers[key] = len(self.values)
            self.values.append(value)
        return self._numbers[key]


def story_data(story: Story, rules: Sequence[Rule]) -> dict[str, Any]:
    """Return a story as plain data.

    Returns
    -------
    dict
        ``buffers``: name -> [t_s, number of the chunk or -1, state] for each change;
        ``chunks``: type and slots; ``verdicts``: kind, condition and what was found;
        ``judged``: a verdict's number for each rule; ``resolutions``: t_s, number of the rule
        selected or -1, number of the judgement; ``firings``: t_s, rule, resolution or -1.
    """
    order = {rule.name: number for number, rule in enumerate(rules)}
    chunks, verdicts, judged = Table(), Table(), Table()
    buffers: dict[str, list[list[Any]]] = {}
    for change in story.changes:
        held = change.standing.chunk
        number = -1
        if held is not None:
            slots = [[slot, word] for slot, word in held.items() if slot != "isa"]
            key = (held.get("isa", ""), *(tuple(pair) for pair in slots))
            number = chunks.number(key, [held.get("isa", ""), slots])
        entry = [round(change.t_s, DECIMALS), number, change.standing.state]
        history = buffers.setdefault(change.buffer, [])
        if history and history[-1][0] == entry[0]:
            history[-1] = entry  # of one moment the last counts
        elif not history or history[-1][1:] != entry[1:]:
            history.append(entry)
    resolutions = []
    for resolution in story.resolutions:
        numbers = tuple(
            verdicts.number(verdict, [verdict.kind, verdict.condition, verdict.found])
            for verdict in said_of(resolution, rules)
        )
        chosen = order.get(resolution.selected, -1)
        at = round(resolution.t_s, DECIMALS)
        resolutions.append([at, chosen, judged.number(numbers, list(numbers))])
    return {
        "buffers": buffers,
        "chunks": chunks.values,
        "verdicts": verdicts.values,
        "judged": judged.values,
        "resolutions": resolutions,
        "firings": [
            [round(firing.t_s, DECIMALS), order.get(firing.rule, -1), firing.resolution]
            for firing in story.firings
        ],
    }


def said_of(resolution: Resolution, rules: Sequence[Rule]) -> list[Verdict]:
    """Return the verdicts of a resolution; of rules that matched and lost, why they lost."""
    utilities = {rule.name: rule.utility for rule in rules}
    won = utilities.get(resolution.selected)
    said = []
    for rule, verdict in zip(rules, resolution.verdicts, strict=True):
        if verdict.kind != HOLDS or rule.name == resolution.selected or won is None:
            said.append(verdict)
            continue
        why = (
            f"{resolution.selected} has the greater utility, {won:g} over {rule.utility:g}"
            if won > rule.utility
            else f"{resolution.selected} was chosen: it stands first in the rule set"
            if won == rule.utility
            else f"{resolution.selected} was chosen, utilities being noisy"
        )
        said.append(Verdict(HOLDS, "", why))
    return said
