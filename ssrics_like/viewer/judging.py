"""Which condition of a rule keeps it from matching: the matcher's meaning, over recorded buffers.

A condition is judged as the engine judges it (`ssrics_like.productions.engine`): pyactr compares
the slots of a chunk and not its type, so that ``isa`` is no condition. What the trace does not
hold cannot be judged, and is said to be unknown.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from ssrics_like.productions.rules import Rule
from ssrics_like.productions.syntax import Clause, Pair
from ssrics_like.productions.vocabulary import BUFFERS

FREE, BUSY, ERROR = "free", "busy", "error"
HOLDS, FAILS, UNKNOWN = "holds", "fails", "unknown"

ROUNDING = 5e-7
"""A recorded number has six decimals, so that the one that was compared may lie so far from it."""

FAILURES = ("retrieval", "landmark", "way", "orienting")
"""Buffers whose modules can fail; the goal and the imaginal buffer cannot."""


@dataclass(frozen=True)
class Standing:
    """What a buffer holds at a moment, and what its module does.

    Attributes
    ----------
    chunk : mapping or None
        Slot -> word, with ``isa``; None for an empty buffer.
    state : str
        ``free``, ``busy``, or ``error`` after a request that brought nothing.
    answered : bool
        Whether its module has answered a request; before that no answer has a number.
    measures : mapping of str to float
        The numbers of the last answer that are recorded.
    """

    chunk: Mapping[str, str] | None = None
    state: str = FREE
    answered: bool = False
    measures: Mapping[str, float] = field(default_factory=dict)


EMPTY = Standing()


@dataclass(frozen=True)
class Verdict:
    """Whether a rule matches.

    Attributes
    ----------
    kind : str
        ``holds``: every condition does; ``fails``: one does not; ``unknown``: none fails, but one
        cannot be judged.
    condition : str
        The first condition that fails, or else cannot be judged; empty where all hold.
    found : str
        What was there instead.
    """

    kind: str
    condition: str = ""
    found: str = ""


def judge(rule: Rule, buffers: Mapping[str, Standing]) -> Verdict:
    """Judge the left side of a rule, in the order in which it is written.

    Parameters
    ----------
    rule : Rule
        The rule.
    buffers : mapping of str to Standing
        Every buffer that has been used; one that is left out is empty and free.

    Returns
    -------
    Verdict
        A condition that fails settles the matter, even behind one that cannot be judged.
    """
    unknown: Verdict | None = None
    for verdict in _verdicts(rule, buffers):
        if verdict.kind == FAILS:
            return verdict
        if verdict.kind == UNKNOWN and unknown is None:
            unknown = verdict
    return unknown or Verdict(HOLDS)


def _verdicts(rule: Rule, buffers: Mapping[str, Standing]) -> Iterator[Verdict]:
    bound: dict[str, str] = {}
    excluded: dict[str, set[str]] = {}
    for clause in rule.text.tests:
        standing = buffers.get(clause.buffer, EMPTY)
        if clause.sign == "?":
            for pair in clause.pairs:
                yield _query(clause, pair, standing)
        elif standing.chunk is None:
            yield Verdict(FAILS, str(clause), "the buffer is empty")
            return
        else:
            for pair in clause.pairs:
                if pair.negated or not _overridden(pair, clause):
                    yield _slot(clause, pair, standing.chunk.get(pair.slot), bound, excluded)


def _overridden(pair: Pair, clause: Clause) -> bool:
    """Tell whether the engine reads a later pair in this one's place."""
    same = [
        other
        for other in clause.pairs
        if (other.slot, other.variable, other.negated) == (pair.slot, pair.variable, False)
    ]
    return same[-1] is not pair


def _slot(
    clause: Clause,
    pair: Pair,
    value: str | None,
    bound: dict[str, str],
    excluded: dict[str, set[str]],
) -> Verdict:
    """Judge one slot of a buffer's chunk; variables are bound on the way."""
    said = f"{clause} {pair.slot} {'~' if pair.negated else ''}{'=' if pair.variable else ''}"
    condition = f"{said}{pair.word}"
    shown = "nothing" if value is None else value
    if not pair.variable:
        fails = (value == pair.word) is pair.negated
        return Verdict(FAILS, condition, f"it holds {shown}") if fails else Verdict(HOLDS)
    if value is None:  # a variable stands for something
        return Verdict(FAILS, condition, "it holds nothing")
    if pair.negated:
        excluded.setdefault(pair.word, set()).add(value)
        fails = bound.get(pair.word) == value
        return Verdict(FAILS, condition, f"it holds {value}, too") if fails else Verdict(HOLDS)
    if value in excluded.get(pair.word, ()):
        return Verdict(FAILS, condition, f"it holds {value}, which ~={pair.word} excludes")
    before = bound.setdefault(pair.word, value)
    if before != value:
        return Verdict(FAILS, condition, f"it holds {value}, but ={pair.word} is {before}")
    return Verdict(HOLDS)


def _query(clause: Clause, pair: Pair, standing: Standing) -> Verdict:
    """Judge one query."""
    condition = f"{clause} {pair.slot} {pair.word}"
    kind = BUFFERS[clause.buffer]
    measure = kind.numeric_queries.get(pair.slot)
    if measure is not None:
        return _compared(condition, pair, measure, kind.measures[measure].slot, standing)
    if pair.slot == "buffer" and pair.word != "failure":
        full = standing.chunk is not None
        holds = full is (pair.word == "full")
        return Verdict(HOLDS) if holds else Verdict(FAILS, condition, _filled(full=full))
    can_fail = clause.buffer in FAILURES
    if pair.slot == "buffer":
        holds = can_fail and standing.state == ERROR
        said = "nothing was asked for in vain" if can_fail else "its module cannot fail"
        return Verdict(HOLDS) if holds else Verdict(FAILS, condition, said)
    is_free = pair.word == FREE and can_fail and standing.state == ERROR  # a failure leaves it free
    holds = is_free or standing.state == pair.word
    return Verdict(HOLDS) if holds else Verdict(FAILS, condition, f"its module is {standing.state}")


def _filled(*, full: bool) -> str:
    return "the buffer is full" if full else "the buffer is empty"


def _compared(condition: str, pair: Pair, measure: str, slot: str, standing: Standing) -> Verdict:
    """Judge the comparison of a number: of the buffer's chunk, or of the last answer."""
    if slot and standing.chunk is None:
        return Verdict(FAILS, condition, f"the buffer is empty, so that there is no {measure}")
    if not slot and (not standing.answered or standing.state == BUSY):
        return Verdict(FAILS, condition, f"there is no answer, and so no {measure}")
    value = standing.measures.get(measure)
    if standing.chunk is not None and slot == measure and slot in standing.chunk:
        value = float(standing.chunk[slot])
        rounding = 0.0  # the rule compares the chunk's own word
    else:
        rounding = ROUNDING
    if value is None:
        return Verdict(UNKNOWN, condition, f"the trace does not record {measure}")
    limit = float(pair.word)
    if abs(value - limit) <= rounding and rounding:
        return Verdict(UNKNOWN, condition, f"{measure} is recorded as {value:g}, rounded")
    holds = (value > limit) is pair.slot.endswith("_above")
    return Verdict(HOLDS) if holds else Verdict(FAILS, condition, f"{measure} is {value:g}")
