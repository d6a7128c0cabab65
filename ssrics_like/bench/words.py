"""Tables of a benchmark as text, for the terminal and for documents alike."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from ssrics_like.report.words import figure_text, percent_text

if TYPE_CHECKING:
    from ssrics_like.bench.candidates import Candidate
    from ssrics_like.bench.courses import Course
    from ssrics_like.bench.running import Bench

Cells = list[list[str]]
"""The first row names the columns."""
CELLS = (
    ("F", "f", "figure"),
    ("chance", "f_chance", "figure"),
    ("clock", "f_clock", "figure"),
    ("F places", "f_place", "figure"),
    ("chance", "f_place_chance", "figure"),
    ("pass recall", "pass_recall", "share"),
    ("precision", "precision", "share"),
    ("marks/100 m", "marks_per_100_m", "tenth"),
    ("delay, m", "delay_m", "figure"),
)
"""Heading, figure of a tally, and how it is written."""


def called(candidate: Candidate) -> str:
    """Return a candidate's name, with an asterisk if it decides in hindsight."""
    return f"{candidate.name} *" if candidate.hindsight else candidate.name


def summary_table(bench: Bench, courses: Sequence[Course] | None = None) -> Cells:
    """Return F of each candidate on each course, with that of chance in brackets.

    Parameters
    ----------
    bench : Bench
        The benchmark.
    courses : sequence of Course, optional
        Which; those of the table if left out.
    """
    points = bool(courses)
    shown = courses or [course for course in bench.courses if not course.sweep]
    heads = [f"{course.value:g}" if points else course.name for course in shown]
    table = [["", *heads]]
    for candidate in bench.candidates:
        row = [called(candidate)]
        for course in shown:
            figures = bench.figures[course.name, candidate.name].tally.figures()
            row.append(f"{figure_text(figures['f'])} ({figure_text(figures['f_chance'])})")
        table.append(row)
    return table


def course_table(bench: Bench, course: Course) -> Cells:
    """Return the figures of each candidate on one course."""
    made = [bench.figures[course.name, candidate.name] for candidate in bench.candidates]
    between = any(one.interval[0] == one.interval[0] for one in made)
    agreeing = any(one.consistency == one.consistency for one in made)
    heads = [head for head, _, _ in CELLS]
    if between:
        heads.insert(1, "95 %")
    table = [["", *heads, *(["consistency"] if agreeing else [])]]
    for candidate, one in zip(bench.candidates, made, strict=True):
        figures = one.tally.figures()
        cells = [_text(figures[name], how) for _, name, how in CELLS]
        if between:
            cells.insert(1, "–".join(figure_text(end) for end in one.interval))
        if agreeing:
            cells.append(figure_text(one.consistency))
        table.append([called(candidate), *cells])
    return table


def _text(value: float, how: str) -> str:
    if how == "share":
        return percent_text(value)
    return figure_text(value, 1 if how == "tenth" else 2)
