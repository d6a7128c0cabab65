"""The tables of a comparison with people: for the terminal, and sortable on the page."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from ssrics_like.people.beside import Beside
from ssrics_like.people.definitions import CONSENSUS, EACH, FIGURES
from ssrics_like.people.figures import Figure
from ssrics_like.people.markers import PEOPLE
from ssrics_like.people.names import NAME_MAX, short
from ssrics_like.people.pairs import LOCATIONS
from ssrics_like.people.resampling import LEAST
from ssrics_like.report.words import (
    figure_text,
    interval_text,
    number_text,
    percent_text,
    place_text,
)

Cell = tuple[str, str, str, str]
"""What is read, what is sorted by, the class of the cell, and all of a name that is shortened."""

ROW_MAX = 48
"""The first column has room for so many letters."""
SHARES = ("f_exceeds", "kappa_exceeds")
MEASURES = {
    "f": ("F", EACH), "kappa": ("κ", EACH), LOCATIONS: ("locations right", CONSENSUS),
}  # fmt: skip
"""How two models are compared -> what is compared, and against what."""


@dataclass(frozen=True)
class Listing:
    """A table.

    Attributes
    ----------
    title : str
        What it shows.
    headings : tuple of (str, str)
        Of its columns; and all of a name that is shortened.
    words : int
        So many columns hold words, the others numbers.
    rows : list of list of Cell
        The cells.
    """

    title: str
    headings: tuple[tuple[str, str], ...]
    words: int
    rows: list[list[Cell]]

    @property
    def plain(self) -> list[list[str]]:
        """The cells as text alone."""
        return [[text for text, *_ in row] for row in self.rows]


def location_table(made: Beside) -> Listing:
    """Return Table 1: the share of people, and of the runs of each model, that marked what."""
    groups = (PEOPLE, *(model.name for model in made.models))
    agreed = {
        name: "yes" if yes else "no"
        for name, yes in zip(made.units.names, made.crowd.consensus.tolist(), strict=True)
    }
    rows: dict[str, list[Cell]] = {}
    for one in made.shares:
        place = one.location
        row = rows.setdefault(
            place.id,
            [
                _name(place_text(place.id, place.label), place.id),
                _word(place.kind),
                _word(agreed.get(place.id, "off the route")),
            ],
        )
        text = f"{one.marked}/{one.markers}  [{interval_text(one.interval)}]"
        row.append(_number(text, one.share))
    return Listing(
        f"Locations, within {made.settings.radius_m:g} m: who marked them, with the Wilson 95 % "
        "interval",
        _headings("location", "kind", CONSENSUS, *groups),
        3,
        list(rows.values()),
    )


def figure_table(made: Beside) -> Listing:
    """Return the figures of people and models side by side."""
    groups = (PEOPLE, *(model.name for model in made.models))
    rows = [
        [
            _name(row.term),
            _word(row.against),
            *(
                _figure(made.figures[group].get(row.key, Figure()), share=row.key in SHARES)
                for group in groups
            ),
        ]
        for row in FIGURES
    ]
    title = "Agreement, with 95 % intervals" if len(made.people) >= LEAST else "Agreement"
    return Listing(title, _headings("figure", "against", *groups), 2, rows)


def pair_table(made: Beside) -> Listing:
    """Return every two models compared on the same people."""
    rows = [
        [
            _name(pair.first),
            _word(pair.second),
            *(_word(text) for text in MEASURES[pair.measure]),
            _figure(pair.difference, signed=True),
            *(_number(p_text(p), p) for p in (pair.p, pair.p_runs, pair.p_holm)),
        ]
        for pair in made.pairs
    ]
    headings = _headings(
        "first", "second", "figure", "against", "first less second", "p", "p over runs", "p, Holm"
    )
    return Listing("Models compared on the same people", headings, 4, rows)


def people_table(made: Beside) -> Listing:
    """Return each participant against the others' consensus."""
    own = made.crowd.against_others
    names = ("precision", "recall", "f", "kappa", "d_prime", "criterion")
    rows = []
    for i, person in enumerate(made.people):
        values = [float(own.measure(name)[i]) for name in names]
        rows.append(
            [
                _name(person.name),
                _number(str(len(person)), len(person)),
                *(_number(figure_text(value), value) for value in values),
            ]
        )
    headings = _headings(
        "participant", "marks", "precision", "recall", "F", "κ", "d′", "criterion c"
    )  # fmt: skip
    return Listing("Each participant, against others' consensus", headings, 1, rows)


def p_text(p: float) -> str:
    """Return a probability: ``.034``, ``< .001``, a dash for one that cannot be said."""
    if math.isnan(p):
        return "–"
    return "< .001" if p < 0.001 else f"{p:.3f}".removeprefix("0")  # noqa: PLR2004


def figure_with_interval(figure: Figure, *, share: bool = False, signed: bool = False) -> str:
    """Return a figure with its interval: ``.81 [.70, .90]``."""
    if share:
        low, high = figure.interval
        return percent_text(figure.value) + (
            "" if math.isnan(low) else f"  [{interval_text((low, high))}]"
        )
    text = figure_text(figure.value)
    if signed and figure.value > 0:
        text = f"+{text}"
    low, high = figure.interval
    if math.isnan(low):
        return text
    return f"{text}  [{number_text(low, 2)}, {number_text(high, 2)}]"


def _figure(figure: Figure, *, share: bool = False, signed: bool = False) -> Cell:
    return _number(figure_with_interval(figure, share=share, signed=signed), figure.value)


def _headings(*names: str) -> tuple[tuple[str, str], ...]:
    return tuple((short(name), _whole(name)) for name in names)


def _name(text: str, key: str = "") -> Cell:
    return short(text, ROW_MAX), key or text, "name", _whole(text, ROW_MAX)


def _word(text: str) -> Cell:
    return short(text), text, "word", _whole(text)


def _number(text: str, value: float) -> Cell:
    return text, "-inf" if math.isnan(value) else repr(float(value)), "number", ""


def _whole(name: str, most: int = NAME_MAX) -> str:
    """Return a name that is too long to be shown; nothing for one that is shown whole."""
    return "" if short(name, most) == name else name


def sortable(listing: Listing) -> dict[str, Sequence[object] | int]:
    """Return a table as the templates take it."""
    rows = [{"cells": row, "link": "", "nearest": False} for row in listing.rows]
    return {"headings": listing.headings, "words": listing.words, "rows": rows}


def people_text(made: Beside) -> str:
    """Return how many people there are, and how many of them marked nothing."""
    count, silent = len(made.people), sum(len(person) == 0 for person in made.people)
    text = f"{count} {PEOPLE}" if count > 1 else "1 person"
    return f"{text}, {silent} of whom marked nothing" if silent else text
