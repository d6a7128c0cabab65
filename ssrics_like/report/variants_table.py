"""Variants as tables: variants.csv, the page's table, and what each choice does on average."""

from __future__ import annotations

import math
from typing import Any

from ssrics_like.report.variants import FIGURES, Variant, Variants
from ssrics_like.report.words import figure_text, interval_text, percent_text
from ssrics_like.results.files import csv_text

DISTANCE = "distance_to_published"
UNSORTED = -math.inf
"""Sorts a dash below every figure."""
AVERAGED = ("recall", "chance", "clock", "corrected_recall", "precision", "f", "marks_per_100_m")
HEADINGS = {
    "recall": "recall",
    "chance": "by chance",
    "clock": "by a clock",
    "corrected_recall": "corrected recall",
    "precision": "precision",
    "f": "F",
    "marks_per_100_m": "marks per 100 m",
    "duplicates": "duplicates",
    "consistency": "consistency",
}
Cell = tuple[str, Any, str]
"""What is shown, what it is sorted by, of what kind."""


def variants_csv(variants: Variants) -> str:
    """Return variants.csv: one row a variant."""
    factors = variants.factors
    fixed = ["name", "runs", *FIGURES, DISTANCE]
    # A factor that bears the name of another column is told apart from it.
    named = [f"factor_{name}" if name in fixed else name for name in factors]
    rows = [
        [
            variant.name,
            *(variant.factors.get(factor, "") for factor in factors),
            variant.runs,
            *(variant.figures[name] for name in FIGURES),
            variant.distance,
        ]
        for variant in variants.done
    ]
    return csv_text(["name", *named, "runs", *FIGURES, DISTANCE], rows)


def variants_table(variants: Variants) -> dict[str, Any]:
    """Return the page's table: headings and rows of cells."""
    compared = variants.nearest is not None
    headings = ["variant", *variants.factors, "runs", "recall", "95 % interval"]
    headings += [HEADINGS[name] for name in HEADINGS if name != "recall"]
    if compared:
        headings.append("distance to published")
    rows = []
    for order, variant in enumerate(variants.done):
        cells: list[Cell] = [(variant.name, order, "name")]
        for factor in variants.factors:
            level = variant.factors.get(factor, "–")
            cells.append((level, level, "word"))
        low, high = variant.figures["low"], variant.figures["high"]
        cells += [
            (str(variant.runs), variant.runs, "number"),
            _cell("recall", variant.figures["recall"]),
            (interval_text((low, high)), _sortable(low), "number"),
            *(_cell(name, variant.figures[name]) for name in HEADINGS if name != "recall"),
        ]
        if compared:
            cells.append((figure_text(variant.distance, 3), _sortable(variant.distance), "number"))
        page = variants.folder / variant.name / "report.html"
        rows.append(
            {
                "cells": cells,
                "link": f"{variant.name}/report.html" if page.is_file() else "",
                "nearest": variant is variants.nearest,
            }
        )
    return {"headings": headings, "words": 1 + len(variants.factors), "rows": rows}


def levels_table(variants: Variants) -> dict[str, Any] | None:
    """Return the mean figures of all variants that share a level; None with nothing to compare."""
    rows = []
    for factor in variants.factors:
        levels = dict.fromkeys(v.factors[factor] for v in variants.done if factor in v.factors)
        if len(levels) < 2:  # noqa: PLR2004 - one level makes no difference
            continue
        for level in levels:
            same = [v for v in variants.done if v.factors.get(factor) == level]
            cells: list[Cell] = [
                (factor, factor, "name"),
                (level, level, "word"),
                (str(len(same)), len(same), "number"),
                *(_cell(name, _mean(same, name)) for name in AVERAGED),
            ]
            rows.append({"cells": cells, "link": "", "nearest": False})
    if not rows:
        return None
    headings = ["factor", "level", "variants", *(HEADINGS[name] for name in AVERAGED)]
    return {"headings": headings, "words": 2, "rows": rows}


def _mean(variants: list[Variant], name: str) -> float:
    """Return the mean of a figure over the variants that have it."""
    values = [v.figures[name] for v in variants if not math.isnan(v.figures[name])]
    return sum(values) / len(values) if values else math.nan


def _cell(name: str, value: float) -> Cell:
    if name == "marks_per_100_m":
        text = figure_text(value, 1)
    elif name in ("f", "duplicates", "consistency"):
        text = figure_text(value)
    else:
        text = percent_text(value)
    return text, _sortable(value), "number"


def _sortable(value: float) -> float:
    return UNSORTED if math.isnan(value) else value
