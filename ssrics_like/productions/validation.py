"""What can be wrong in a rule set, found before it runs.

pyactr raises bare KeyErrors for some of these mistakes, in the middle of a run,
and says nothing of the others: an unknown buffer on the left side never
matches, an unknown slot silently widens the chunk type.
"""

from __future__ import annotations

import math
import re
import sys
from collections.abc import Collection, Iterator, Mapping
from typing import TYPE_CHECKING

from ssrics_like.errors import choices, nearest
from ssrics_like.productions.reachability import unreachable
from ssrics_like.productions.syntax import Clause, Pair
from ssrics_like.productions.vocabulary import (
    BUFFERS,
    FIXED_TYPES,
    OUTCOMES,
    QUERIES,
    STEP_ACTS,
    STEP_OUTCOMES,
    WAY_EVENTS,
    BufferKind,
)

if TYPE_CHECKING:
    from ssrics_like.productions.rules import Rule, Rulebook

Problem = tuple[int, str]
NAME = re.compile(r"[A-Za-z]\w*")


def problems(book: Rulebook, key_line: Mapping[str, int], *, complete: bool) -> list[Problem]:
    """Return every problem as (line, text).

    Parameters
    ----------
    book : Rulebook
        What was read.
    key_line : mapping
        Line of each top-level key of the file.
    complete : bool
        Whether every rule could be read; if not, reachability cannot be judged.
    """
    found = [(key_line.get(key, 1), text) for key, text in _of_the_file(book)]
    names: dict[str, int] = {}
    for rule in book.rules:
        if rule.name in names:
            found.append(
                (rule.line, f"rule '{rule.name}': the name stands twice (line {names[rule.name]})")
            )
        names.setdefault(rule.name, rule.line)
        found += [(line, f"rule '{rule.name}': {text}") for line, text in _of_a_rule(book, rule)]
    if complete and not found:
        found += [
            (rule.line, f"rule '{rule.name}': no other rule can lead to it: {why}")
            for rule, why in unreachable(book)
        ]
    return found


def _of_the_file(book: Rulebook) -> Iterator[tuple[str, str]]:
    for name, slots in book.chunk_types.items():
        for word in (name, *slots):
            if not NAME.fullmatch(word):
                yield "chunk_types", f"'{word}': expected letters, digits and _, a letter first"
        for slot in slots:
            if slots.count(slot) > 1:
                yield "chunk_types", f"chunk type '{name}': slot '{slot}' stands twice"
            if name in FIXED_TYPES and slot not in FIXED_TYPES[name]:
                known = FIXED_TYPES[name]
                hint = f"{nearest(slot, known)}; the module fills {choices(known)}"
                yield "chunk_types", f"chunk type '{name}': unknown slot '{slot}'{hint}"
    goal_type = book.goal.get("isa")
    if goal_type is None:
        yield "goal", "goal: 'isa' is missing, expected a chunk type"
    elif goal_type not in book.chunk_types:
        yield "goal", f"goal: {_unknown('chunk type', goal_type, book.chunk_types)}"
    else:
        for slot in book.goal:
            if slot != "isa" and slot not in book.chunk_types[goal_type]:
                yield "goal", f"goal: {_unknown('slot', slot, book.chunk_types[goal_type])}"
    for buffer in book.harvest:
        if buffer not in BUFFERS:
            yield "harvest", f"harvest: {_unknown('buffer', buffer, BUFFERS)}"


def _of_a_rule(book: Rulebook, rule: Rule) -> Iterator[Problem]:
    bound = {
        pair.word
        for clause in rule.text.tests
        if clause.sign == "="
        for pair in clause.pairs
        if pair.variable and not pair.negated
    }
    for clause in rule.text.tests:
        yield from _of_a_clause(book, clause)
        for pair in clause.pairs:
            if pair.variable and (pair.word not in bound or clause.sign == "?"):
                yield pair.line, _unbound(pair, bound)
    tested = {clause.buffer for clause in rule.text.tests if clause.sign == "="}
    for clause in rule.text.actions:
        yield from _of_a_clause(book, clause)
        yield from _of_an_action(clause, tested)
        for pair in clause.pairs:
            if pair.variable and pair.word not in bound:
                yield pair.line, _unbound(pair, bound)
    for side in (rule.text.tests, rule.text.actions):
        heads = [str(clause) for clause in side]
        for i, clause in enumerate(side):
            if heads[i] in heads[:i]:
                yield clause.line, f"'{clause}' stands twice on one side"


def _of_a_clause(book: Rulebook, clause: Clause) -> Iterator[Problem]:
    kind = BUFFERS.get(clause.buffer)
    if kind is None:
        yield clause.line, _unknown("buffer", clause.buffer, BUFFERS)
        return
    if clause.sign == "?":
        for pair in clause.pairs:
            yield from _of_a_query(book, pair, kind)
        return
    if clause.sign == "~":
        return
    if clause.chunk_type is None:
        yield clause.line, f"'{clause}' names no chunk type, expected 'isa ...'"
        return
    if clause.chunk_type not in book.chunk_types:
        yield clause.line, _unknown("chunk type", clause.chunk_type, book.chunk_types)
        return
    slots = book.chunk_types[clause.chunk_type]
    for pair in clause.pairs:
        if pair.slot not in slots:
            yield pair.line, f"{_unknown('slot', pair.slot, slots)} of '{clause.chunk_type}'"
        elif (clause.chunk_type, pair.slot) == ("way", "event") and not pair.variable:
            yield from _of_a_word({"event": pair}, "event", WAY_EVENTS)


def _of_a_query(book: Rulebook, pair: Pair, kind: BufferKind) -> Iterator[Problem]:
    numeric = kind.numeric_queries
    if pair.slot in numeric:
        most, slot = kind.measures[numeric[pair.slot]]
        try:
            sensible = 0 <= float(pair.word) <= min(most, sys.float_info.max)
        except ValueError:
            sensible = False
        if not sensible:
            span = "0 or more" if math.isinf(most) else f"0 to {most:g}"
            said = f"{pair.word!r} where a number of {span} was expected"
            yield pair.line, f"query '{pair.slot}': {said}"
        if slot and slot not in book.chunk_types.get("reflex", ()):
            yield pair.line, f"query '{pair.slot}': chunk type 'reflex' has no slot '{slot}'"
    elif pair.slot not in QUERIES:
        yield pair.line, _unknown("query", pair.slot, (*QUERIES, *numeric))
    elif pair.word not in QUERIES[pair.slot]:
        yield pair.line, _unknown(f"value of query '{pair.slot}'", pair.word, QUERIES[pair.slot])


def _of_an_action(clause: Clause, tested: set[str]) -> Iterator[Problem]:
    kind = BUFFERS.get(clause.buffer)
    if kind is None:
        return
    if clause.sign == "+" and not kind.requests:
        yield clause.line, f"'{clause}': {clause.buffer} takes no requests ({kind.role})"
    if clause.sign == "=" and not kind.modifies:
        yield clause.line, f"'{clause}': {clause.buffer} cannot be modified ({kind.role})"
    elif clause.sign == "=" and clause.buffer not in tested:
        yield clause.line, f"'{clause}': modifies a buffer that the left side does not test"
    if clause.sign != "+" or clause.buffer != "retrieval":
        for pair in clause.pairs:
            if pair.negated:
                yield pair.line, f"'{pair.slot}': only a retrieval request can exclude a value"
    if clause.sign == "+":
        yield from _of_a_request(clause)


def _of_a_request(clause: Clause) -> Iterator[Problem]:
    """Check what is asked of the landmark module, or of the way module."""
    given = {pair.slot: pair for pair in clause.pairs}
    if clause.buffer == "landmark":
        yield from _of_a_word(given, "outcome", OUTCOMES)
        outcome = given.get("outcome")
        recognised = outcome is not None and outcome.word == "recognised"
        needed = ["outcome", "event", *(["landmark"] if recognised else [])]
    elif clause.buffer == "way":
        yield from _of_a_word(given, "act", STEP_ACTS)
        yield from _of_a_word(given, "outcome", STEP_OUTCOMES)
        act = given.get("act")
        needed = ["act", *STEP_ACTS.get(act.word if act else "", ())]
    else:
        return
    for slot in needed:
        if slot not in given:
            yield clause.line, f"'{clause}': slot '{slot}' is missing"


def _of_a_word(given: Mapping[str, Pair], slot: str, known: Collection[str]) -> Iterator[Problem]:
    """Check a slot that must hold one of a few words."""
    pair = given.get(slot)
    if pair is not None and (pair.variable or pair.word not in known):
        yield pair.line, _unknown(slot, pair.word, known)


def _unknown(what: str, word: str, known: object) -> str:
    names = list(known)  # type: ignore[call-overload]
    return f"unknown {what} '{word}'{nearest(word, names)}; known: {choices(names)}"


def _unbound(pair: Pair, bound: set[str]) -> str:
    return (
        f"variable '={pair.word}' of slot '{pair.slot}' is not bound by a test on the left side"
        f"{nearest(pair.word, bound)}"
    )
