"""Which rules can ever match, judged from what the others write.

A rule whose goal test names a state that nothing sets is nearly always a typing
error, and in a run it only shows as silence. The judgement errs to one side: a
variable on a right side counts as any value, so a rule that is called
unreachable truly is.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from ssrics_like.errors import nearest
from ssrics_like.productions.vocabulary import PUSHED

if TYPE_CHECKING:
    from ssrics_like.productions.rules import Rule, Rulebook

ANY = "*"


def unreachable(book: Rulebook) -> list[tuple[Rule, str]]:
    """Return the rules that no chain of other rules can lead to, and why."""
    goal = {slot: {value} for slot, value in book.goal.items() if slot != "isa"}
    filled = {*PUSHED, "g"}
    waiting = list(book.rules)
    while True:
        ready = [rule for rule in waiting if _obstacle(rule, goal, filled) is None]
        if not ready:
            return [(rule, str(_obstacle(rule, goal, filled))) for rule in waiting]
        for rule in ready:
            waiting.remove(rule)
            for clause in rule.text.actions:
                if clause.sign == "+":
                    filled.add(clause.buffer)
                if clause.buffer == "g":
                    for pair in clause.pairs:
                        value = ANY if pair.variable else pair.word
                        goal.setdefault(pair.slot, set()).add(value)


def _obstacle(rule: Rule, goal: dict[str, set[str]], filled: set[str]) -> str | None:
    """Say what keeps a rule from matching, or None."""
    for clause in rule.text.tests:
        if clause.buffer not in filled and (
            clause.sign == "=" or any(p.word in ("full", "failure", "error") for p in clause.pairs)
        ):
            return f"nothing makes a request to '{clause.buffer}'"
        if clause.sign != "=" or clause.buffer != "g":
            continue
        for pair in clause.pairs:
            values = goal.get(pair.slot, set())
            if not (pair.variable or pair.negated or ANY in values or pair.word in values):
                return f"nothing sets '{pair.slot}' to '{pair.word}'{nearest(pair.word, values)}"
    return None
