"""From the responses of a trial to the marks that stand at its end."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

from ssrics_like.study.events import Response


@dataclass(frozen=True, slots=True)
class Mark:
    """A landmark as a participant left it.

    Attributes
    ----------
    key : str
        Names it.
    x_m, y_m : float
        Where, map frame.
    label : str
        What it is called; may be empty.
    replay_ms : float or None
        Milliseconds of the replay at the key press; None on a plan.
    """

    key: str
    x_m: float
    y_m: float
    label: str = ""
    replay_ms: float | None = None


def marks_of(responses: Iterable[Response]) -> tuple[Mark, ...]:
    """Return the marks that stand after some responses of one trial, in order of their making.

    A key press of a walk is a mark too. What is said of a mark that is not there is passed over.
    """
    marks: dict[str, Mark] = {}
    for each in responses:
        if each.event == "delete":
            marks.pop(each.mark, None)
        elif each.event == "name" and each.mark in marks:
            marks[each.mark] = replace(marks[each.mark], label=each.label)
        elif each.x_m is None or each.y_m is None:
            continue
        elif each.event in ("add", "press"):
            marks[each.key] = Mark(each.key, each.x_m, each.y_m, each.label, each.replay_ms)
        elif each.event == "move" and each.mark in marks:
            marks[each.mark] = replace(marks[each.mark], x_m=each.x_m, y_m=each.y_m)
    return tuple(marks.values())
