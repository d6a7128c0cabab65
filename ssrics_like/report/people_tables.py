"""The tables of a comparison with people: for the terminal, and sortable on the page."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from ssrics_like.people.beside import Beside
from ssrics_like.people.figures import Figure
from ssrics_like.people.markers import PEOPLE
from ssrics_like.people.pairs import LOCATIONS
from ssrics_like.report.words import (
    figure_text,
    interval_text,
    number_text,
    percent_text,
    place_text,
)

Cell = tuple[str, str, str]
"""What is read, what is sorted by, and the class of the cell."""

FIGURES = (
    ("precision", "precision, consensus"),
    ("recall", "recall, consensus"),
    ("f", "F, consensus"),
    ("f_chance", "F of chance"),
    ("f_corrected", "F above chance"),
    ("kappa", "κ with consensus"),
    ("d_prime", "d′, consensus"),
    ("criterion", "criterion c"),
    ("kappa_people", "κ with each person"),
    ("kappa_people_median", "κ with each person, median"),
    ("fleiss", "Fleiss' κ, people (and run)"),
    ("alpha", "Krippendorff's α, likewise"),
    ("consistency", "κ among runs"),
    ("f_others", "F, others' consensus"),
    ("f_ceiling", "F less a person's"),
    ("f_exceeds", "people exceeded in F"),
    ("kappa_others", "κ, others' consensus"),
    ("kappa_ceiling", "κ less a person's"),
    ("kappa_exceeds", "people exceeded in κ"),
    ("d_prime_others", "d′, others' consensus"),
    ("criterion_others", "criterion c, others' consensus"),
)
"""Every figure in the order of the tables, and what it is called there."""
SHARES = ("f_exceeds", "kappa_exceeds")
MEASURES = {"f": "F with each person", "kappa": "κ with each person", LOCATIONS: "locations right"}


@dataclass(frozen=True)
class Listing:
    """A table.

    Attributes
    ----------
    title : str
        What it shows.
    headings : tuple of str
        Of its columns.
    words : int
        So many columns hold words, the others numbers.
    rows : list of list of Cell
        The cells.
    """

    title: str
    headings: tuple[str, ...]
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
        text = f"{one.marked}/{one.markers}  {interval_text(one.interval)}"
        row.append(_number(text, one.share))
    return Listing(
        f"Locations, within {made.settings.radius_m:g} m: who marked them, with the Wilson 95 % "
        "interval",
        ("location", "kind", "consensus", *groups),
        3,
        list(rows.values()),
    )


def figure_table(made: Beside) -> Listing:
    """Return the figures of people and models side by side."""
    groups = (PEOPLE, *(model.name for model in made.models))
    rows = [
        [
            _name(said, said),
            *(
                _figure(made.figures[group].get(name, Figure()), share=name in SHARES)
                for group in groups
            ),
        ]
        for name, said in FIGURES
    ]
    return Listing("Agreement, with 95 % intervals", ("figure", *groups), 1, rows)


def pair_table(made: Beside) -> Listing:
    """Return every two models compared on the same people."""
    rows = [
        [
            _name(pair.first, pair.first),
            _word(pair.second),
            _word(MEASURES[pair.measure]),
            _figure(pair.difference, signed=True),
            _number(p_text(pair.p), pair.p),
            _number(p_text(pair.p_holm), pair.p_holm),
        ]
        for pair in made.pairs
    ]
    headings = ("first", "second", "measure", "first less second", "p", "p, Holm")
    return Listing("Models compared on the same people", headings, 3, rows)


def people_table(made: Beside) -> Listing:
    """Return each participant against the consensus of the others, and each model against it."""
    own = made.crowd.against_others
    names = ("precision", "recall", "f", "kappa", "d_prime", "criterion")
    rows = []
    for i, person in enumerate(made.people):
        values = [float(own.measure(name)[i]) for name in names]
        rows.append(
            [
                _name(person.name, person.name),
                _number(str(len(person)), len(person)),
                *(_number(figure_text(value), value) for value in values),
            ]
        )
    headings = ("participant", "marks", "precision", "recall", "F", "κ", "d′", "criterion c")
    return Listing("Each participant against the consensus of the others", headings, 1, rows)


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


def _name(text: str, key: str) -> Cell:
    return text, key, "name"


def _word(text: str) -> Cell:
    return text, text, "word"


def _number(text: str, value: float) -> Cell:
    return text, "-inf" if math.isnan(value) else repr(float(value)), "number"


def sortable(listing: Listing) -> dict[str, Sequence[object]]:
    """Return a table as the templates take it."""
    return {
        "headings": listing.headings,
        "words": listing.words,  # type: ignore[dict-item]
        "rows": [{"cells": row, "link": "", "nearest": False} for row in listing.rows],
    }
