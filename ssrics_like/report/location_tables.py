"""What the page says of the labelled locations: table 1, and one line of figures."""

from __future__ import annotations

import math
from typing import Any

from ssrics_like.comparison import FolderScores, PlaceScore
from ssrics_like.report.words import figure_text, interval_text, percent_text

UNSORTED = -math.inf
"""Sorts a dash below every share."""
HEADINGS = (
    "location", "label", "kind", "found", "share of runs", "95 % interval", "by chance",
    "by a clock", "published",
)  # fmt: skip


def locations_of(made: FolderScores | None) -> dict[str, Any] | None:
    """Return the tables of locations as plain values; None where there are none."""
    if made is None:
        return None
    designated = [place for place in made.scores.places if place.designated]
    others = [place for place in made.scores.places if not place.designated]
    return {
        "figures": _figures(made) if designated else [],
        "published_in": made.published_in,
        "designated": _table(made, designated),
        "others": _table(made, others),
        "radius": f"{made.scores.radius_m:g}",
        "runs": len(made.scores.runs),
    }


def _table(made: FolderScores, places: list[PlaceScore]) -> dict[str, Any]:
    """Return a table as listing.html takes it; published shares stand last, if there are any."""
    published = [made.published.get(place.location.id) for place in places]
    has_published = any(share is not None for share in published)
    columns = len(HEADINGS) if has_published else len(HEADINGS) - 1
    return {
        "has_published": has_published,
        "headings": HEADINGS[:columns],
        "words": 3,
        "rows": [
            {"cells": _row(i, place, share)[:columns], "link": "", "nearest": False}
            for i, (place, share) in enumerate(zip(places, published, strict=True))
        ],
    }


def _figures(made: FolderScores) -> list[tuple[str, str, str]]:
    """Return the pooled figures: what, how much, and a word of explanation."""
    pooled = made.scores.pooled
    return [
        ("recall", percent_text(pooled.recall),
         f"{interval_text(pooled.interval)}; {pooled.found} of {pooled.designated}"),
        ("by chance", percent_text(pooled.chance), "as many marks at random"),
        ("by a clock", percent_text(pooled.clock), "as many, evenly in time"),
        ("precision", percent_text(pooled.precision),
         f"{pooled.right} of {pooled.merged} marked places"),
        ("marks per 100 m", figure_text(pooled.marks_per_100_m, 1), "all runs"),
        ("duplicates", figure_text(pooled.duplicates), "further marks per place found"),
        ("consistency", figure_text(made.scores.consistency), "agreement between runs"),
    ]  # fmt: skip


def _row(order: int, place: PlaceScore, published: float | None) -> list[tuple[str, Any, str]]:
    """Return a row's cells: what is shown, what it is sorted by, of what kind."""
    location = place.location
    shown = "–" if published is None else percent_text(published)
    return [
        (location.id, order, "name"),
        (location.label or "–", location.label, "word"),
        (location.kind, location.kind, "word"),
        (f"{place.found} of {place.runs}", place.found, "number"),
        (percent_text(place.share), _sortable(place.share), "number"),
        (interval_text(place.interval), _sortable(place.interval[0]), "number"),
        (percent_text(place.chance), _sortable(place.chance), "number"),
        (percent_text(place.clock), _sortable(place.clock), "number"),
        (shown, UNSORTED if published is None else published, "number"),
    ]


def _sortable(value: float) -> float:
    return UNSORTED if math.isnan(value) else value
