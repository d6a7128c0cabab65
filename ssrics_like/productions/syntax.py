"""The text of one rule, taken apart with the line of every word.

pyactr's own grammar forgets where words stand and accepts any name, so a rule
is read here first; what comes out is plain data that the validation can judge
and the engine can build pyactr's chunks from.

The grammar is the part of ACT-R's that the engine supports::

    rule    = test+ "==>" action+
    test    = "=buffer>" isa pairs  |  "?buffer>" query-value pairs
    action  = "=buffer>" isa pairs  |  "+buffer>" isa pairs  |  "~buffer>"
    pairs   = slot value ...        value = word | "=variable" | "~word" | "~=variable"

A ``#`` begins a comment that ends with the line.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

ARROW = "==>"
TESTS = {"=": "test", "?": "query"}
ACTIONS = {"=": "modify", "+": "request", "~": "clear"}

_HEADER = re.compile(r"([^\w\s])([A-Za-z_]\w*)>")
_SLOT = re.compile(r"[A-Za-z_]\w*")
_VALUE = re.compile(r"(~?)(=?)([\w.\-:]+)")


@dataclass(frozen=True)
class Pair:
    """A slot and what is said of it: ``slot value``, ``slot =variable``, ``slot ~value``.

    Attributes
    ----------
    slot, word : str
        The slot and the value or variable's name without signs.
    variable, negated : bool
        Whether `word` names a variable; whether the pair excludes it.
    line : int
        Line in the file, 1-based.
    """

    slot: str
    word: str
    variable: bool
    negated: bool
    line: int


@dataclass(frozen=True)
class Clause:
    """One buffer's part of a rule: its sign, buffer, chunk type and pairs."""

    sign: str
    buffer: str
    chunk_type: str | None
    pairs: tuple[Pair, ...]
    line: int

    def __str__(self) -> str:
        """Return the head as it stands in the rule: ``=g>``."""
        return f"{self.sign}{self.buffer}>"


@dataclass(frozen=True)
class RuleText:
    """The two sides of a rule."""

    tests: tuple[Clause, ...]
    actions: tuple[Clause, ...]


class RuleSyntaxError(ValueError):
    """The text does not follow the grammar; carries the line."""

    def __init__(self, line: int, message: str) -> None:
        super().__init__(message)
        self.line = line


def parse_rule(text: str, first_line: int = 1) -> RuleText:
    """Take a rule's text apart.

    Parameters
    ----------
    text : str
        The rule.
    first_line : int
        Line of the file on which the text begins.

    Raises
    ------
    RuleSyntaxError
        The text does not follow the grammar above.
    """
    words = [
        (word, first_line + number)
        for number, line in enumerate(text.splitlines())
        for word in line.partition("#")[0].split()
    ]
    if not words:
        raise RuleSyntaxError(first_line, "the rule is empty")
    arrows = [i for i, (word, _) in enumerate(words) if word == ARROW]
    if len(arrows) != 1:
        line = words[arrows[1]][1] if arrows else first_line
        raise RuleSyntaxError(line, f"expected one '{ARROW}' between sides, found {len(arrows)}")
    left, (_, arrow_line), right = words[: arrows[0]], words[arrows[0]], words[arrows[0] + 1 :]
    for side, where in ((left, "before"), (right, "after")):
        if not side:
            raise RuleSyntaxError(arrow_line, f"nothing stands {where} '{ARROW}'")
    return RuleText(_clauses(left, TESTS, "left"), _clauses(right, ACTIONS, "right"))


def _clauses(words: list[tuple[str, int]], signs: dict[str, str], side: str) -> tuple[Clause, ...]:
    heads = [i for i, (word, _) in enumerate(words) if word.endswith(">")]
    if not heads or heads[0] != 0:
        word, line = words[0]
        raise RuleSyntaxError(line, f"'{word}': expected a buffer such as '=g>' first")
    clauses = []
    for start, end in zip(heads, [*heads[1:], len(words)], strict=True):
        word, line = words[start]
        head = _HEADER.fullmatch(word)
        if head is None:
            raise RuleSyntaxError(line, f"'{word}': expected a sign, a buffer and '>', like '=g>'")
        sign, buffer = head.groups()
        if sign not in signs:
            known = ", ".join(f"'{s}' ({what})" for s, what in signs.items())
            raise RuleSyntaxError(
                line, f"'{word}': unknown action '{sign}' on the {side} side; known: {known}"
            )
        body = words[start + 1 : end]
        if sign == "~" and body:
            raise RuleSyntaxError(body[0][1], f"'{word}' clears the buffer and takes nothing more")
        pairs = _pairs(word, body)
        types = [pair for pair in pairs if pair.slot == "isa"]
        chunk_type = types[0].word if types else None
        rest = tuple(pair for pair in pairs if pair.slot != "isa")
        clauses.append(Clause(sign, buffer, chunk_type, rest, line))
    return tuple(clauses)


def _pairs(head: str, body: list[tuple[str, int]]) -> list[Pair]:
    pairs = []
    for i in range(0, len(body), 2):
        slot, line = body[i]
        if not _SLOT.fullmatch(slot):
            raise RuleSyntaxError(line, f"'{slot}' after '{head}': expected the name of a slot")
        if i + 1 == len(body):
            raise RuleSyntaxError(line, f"'{slot}' after '{head}' has no value")
        word, value_line = body[i + 1]
        value = _VALUE.fullmatch(word)
        if value is None:
            raise RuleSyntaxError(
                value_line,
                f"'{word}' for '{slot}': expected a word, =variable, ~word or ~=variable",
            )
        negated, variable, name = value.groups()
        pairs.append(Pair(slot, name, bool(variable), bool(negated), value_line))
    return pairs
