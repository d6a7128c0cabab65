"""Where the rows of the variants' figure stand, and what is written before them."""

from __future__ import annotations

from ssrics_like.report.labels import text_half_size
from ssrics_like.report.variants import Variant

GROUP_ROWS = 0.5
"""Free space above a new group."""
COLUMN_GAP_PT, COLUMN_MAX_PT, LABELS_MAX_PT = 12.0, 150.0, 420.0


def grouped(variants: list[Variant], factors: tuple[str, ...]) -> list[Variant]:
    """Sort variants by their factors, each factor's levels in the order of their appearance."""
    levels = {
        factor: list(dict.fromkeys(v.factors.get(factor, "") for v in variants))
        for factor in factors
    }
    return sorted(variants, key=lambda v: [levels[f].index(v.factors.get(f, "")) for f in factors])


def labels_of(rows: list[Variant], factors: tuple[str, ...]) -> list[tuple[str, ...]]:
    """Return each row's labels; a level is written once where rows below each other share it."""
    if not factors:
        return [(row.title or row.name,) for row in rows]
    texts: list[tuple[str, ...]] = []
    before: tuple[str, ...] = ()
    for row in rows:
        if not row.factors:  # a variant apart from the combinations
            texts.append((row.title or row.name, *("",) * (len(factors) - 1)))
            before = ()
            continue
        here = tuple(row.factors.get(factor, "–") for factor in factors)
        same = 0
        while same < len(before) - 1 and before[same] == here[same]:
            same += 1
        texts.append(("",) * same + here[same:])
        before = here
    return texts


def places_of(columns: list[tuple[str, ...]]) -> tuple[list[float], list[tuple[float, int]]]:
    """Return where rows stand, and where a level changes: the place of a line, and which factor.

    Groups of the first factor stand apart; only levels of factors that have groups below them
    are divided by a line.
    """
    places: list[float] = []
    lines: list[tuple[float, int]] = []
    at = 0.0
    for i, texts in enumerate(columns):
        changed = next((k for k, text in enumerate(texts) if text), 0)
        if i and changed < len(texts) - 1:
            gap = 0.0 if changed else GROUP_ROWS
            lines.append((at - 0.5 + gap / 2, changed))
            at += gap
        places.append(at)
        at += 1.0
    return places, lines


def starts_of(
    columns: list[tuple[str, ...]], headings: tuple[str, ...], size: float
) -> tuple[list[float], float]:
    """Return where each column of labels begins, and how wide all of them are, points."""
    # A lone text in the first column runs on over the others, which are empty then.
    alone = [not any(texts[1:]) and len(texts) > 1 for texts in columns]
    full = [texts for texts, lone in zip(columns, alone, strict=True) if not lone]
    widths = [
        min(max(2 * text_half_size(text, size)[0] for text in texts), COLUMN_MAX_PT)
        for texts in zip(headings, *full, strict=True)
    ]
    shrunk = min(1.0, LABELS_MAX_PT / (sum(widths) + COLUMN_GAP_PT * len(widths)))
    starts, at = [], 2.0
    for width in widths:
        starts.append(at)
        at += (width + COLUMN_GAP_PT) * shrunk
    return starts, at
