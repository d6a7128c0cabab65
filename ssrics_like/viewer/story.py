"""What the buffers held when, which productions fired, and why the others did not: from a trace."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace

from ssrics_like.productions.rules import Rule
from ssrics_like.viewer.judging import BUSY, EMPTY, ERROR, FREE, Standing, Verdict, judge
from ssrics_like.viewer.trace import Event

ASKED_AT_ONCE = ("landmark", "way")
"""Buffers whose modules answer before conflicts are resolved again."""


@dataclass(frozen=True, slots=True)
class Change:
    """From a moment on, a buffer holds something else or its module does something else."""

    t_s: float
    buffer: str
    standing: Standing


@dataclass(frozen=True, slots=True)
class Resolution:
    """A conflict resolution.

    Attributes
    ----------
    t_s : float
        When, seconds since the start of the run.
    selected : str
        The production that was selected; empty where none was.
    verdicts : tuple of Verdict
        One a rule, in the order of the rule set.
    """

    t_s: float
    selected: str
    verdicts: tuple[Verdict, ...]


@dataclass(frozen=True, slots=True)
class Firing:
    """A production that fired.

    Attributes
    ----------
    t_s : float
        When, seconds since the start of the run.
    rule : str
        Its name.
    resolution : int
        Index of the conflict resolution that selected it; -1 where the trace shows none.
    """

    t_s: float
    rule: str
    resolution: int


@dataclass(frozen=True, slots=True)
class Confidence:
    """What decisions.csv says of one decision: the rule, and how sure memory's answer was."""

    rule: str
    value: float | None


@dataclass
class Story:
    """What a trace tells."""

    changes: list[Change] = field(default_factory=list)
    resolutions: list[Resolution] = field(default_factory=list)
    firings: list[Firing] = field(default_factory=list)


def told(events: Sequence[Event], rules: Sequence[Rule], decided: Iterable[Confidence]) -> Story:
    """Follow a trace.

    Parameters
    ----------
    events : sequence of Event
        The trace, in its order.
    rules : sequence of Rule
        The rule set, in its order.
    decided : iterable of Confidence
        The decisions that productions took, in order of deciding. They tell how sure an answer
        was that a rule may have asked about; the trace does not.

    Returns
    -------
    Story
        With every rule judged at every conflict resolution.
    """
    teller = _Teller(rules, answers_of(events, rules, decided))
    for event in events:
        teller.take(event)
    return teller.story


def answers_of(
    events: Iterable[Event], rules: Iterable[Rule], decided: Iterable[Confidence]
) -> dict[int, float]:
    """Return how sure memory's answers were: number of the retrieval -> confidence.

    A decision notes the confidence of what was recalled last before it. A retrieval that no
    decision followed, and one whose rule decides and asks at once, is left out.
    """
    asks = {
        rule.name: {clause.buffer for clause in rule.text.actions if clause.sign == "+"}
        for rule in rules
    }
    rows = iter(decided)
    found: dict[int, float] = {}
    retrieval = -1
    for event in events:
        if event.action == "start-retrieval":
            retrieval += 1
        elif event.action == "production-fired" and "landmark" in asks.get(event.name, ()):
            row = next(rows, None)
            if row is None or row.rule != event.name:
                return found  # the tables do not belong to this trace from here on
            if row.value is not None and "retrieval" not in asks[event.name]:
                found[retrieval] = row.value
    return found


class _Teller:
    """Follows the events one by one."""

    def __init__(self, rules: Sequence[Rule], answers: Mapping[int, float]) -> None:
        self.story = Story()
        self._rules = rules
        self._answers = answers
        self._buffers: dict[str, Standing] = {}
        self._waiting: set[str] = set()  # asked, and not answered yet
        self._retrieval = -1
        self._resolved: int | None = None

    def take(self, event: Event) -> None:
        """Take the next event."""
        action, name, t_s = event.action, event.name, event.t_s
        if action.startswith("set-buffer-chunk"):
            self._set(t_s, name, event.chunk)
        elif action == "mod-buffer-chunk":
            self._change(t_s, name, chunk=event.chunk, state=FREE)
        elif action == "module-request":
            self._waiting.add(name)
            self._change(t_s, name, state=BUSY)
        elif action == "clear-buffer":
            state = BUSY if name in self._waiting else FREE
            self._change(t_s, name, chunk=None, state=state)
        elif action == "start-retrieval":
            self._retrieval += 1
        elif action == "retrieval-failure":
            self._answer(t_s, ERROR)
        elif action == "retrieved-chunk":
            self._answer(t_s, FREE)
        elif action == "conflict-resolution":
            self._resolve(t_s, "")
        elif action == "production-selected":
            self._select(t_s, name)
        elif action == "production-fired":
            at = -1 if self._resolved is None else self._resolved
            self.story.firings.append(Firing(t_s, name, at))

    def _set(self, t_s: float, buffer: str, chunk: Mapping[str, str] | None) -> None:
        if buffer in self._waiting:
            self._waiting.discard(buffer)
            self._change(t_s, buffer, chunk=chunk, state=FREE)
        else:  # pushed in from outside, which does not touch the state
            self._change(t_s, buffer, chunk=chunk)

    def _answer(self, t_s: float, state: str) -> None:
        """Note that memory has answered, and what is recorded of the answer."""
        self._waiting.discard("retrieval")
        confidence = self._answers.get(self._retrieval)
        measures = {} if confidence is None else {"confidence": confidence}
        self._change(t_s, "retrieval", state=state, answered=True, measures=measures)

    def _resolve(self, t_s: float, selected: str) -> None:
        for buffer in ASKED_AT_ONCE:
            if buffer in self._waiting:  # it has answered, with nothing
                self._waiting.discard(buffer)
                self._change(t_s, buffer, state=ERROR)
        verdicts = tuple(judge(rule, self._buffers) for rule in self._rules)
        self.story.resolutions.append(Resolution(t_s, selected, verdicts))

    def _select(self, t_s: float, name: str) -> None:
        last = self.story.resolutions[-1] if self.story.resolutions else None
        if last is None or last.t_s != t_s or last.selected:
            self._resolve(t_s, name)
        else:
            self.story.resolutions[-1] = replace(last, selected=name)
        self._resolved = len(self.story.resolutions) - 1

    def _change(self, t_s: float, buffer: str, **what: object) -> None:
        before = self._buffers.get(buffer, EMPTY)
        now = replace(before, **what)  # type: ignore[arg-type]
        self._buffers[buffer] = now
        self.story.changes.append(Change(t_s, buffer, now))
