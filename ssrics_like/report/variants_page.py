"""Variants of a scenario on one page that opens offline, and as one table."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from ssrics_like.errors import ResultsError
from ssrics_like.report import style
from ssrics_like.report.drawing import as_svg
from ssrics_like.report.rendering import rendered
from ssrics_like.report.variants import Variant, Variants, read_variants
from ssrics_like.report.variants_figure import draw_variants
from ssrics_like.report.variants_table import levels_table, variants_csv, variants_table
from ssrics_like.report.words import figure_text, fraction_text, number_text, percent_text
from ssrics_like.results.counts import and_others
from ssrics_like.results.files import write_atomically

PAGE, TABLE = "report.html", "variants.csv"


def write_variants_report(folder: Path) -> Path:
    """Compare the variants of a scenario: write ``variants.csv`` and ``report.html``.

    What is written depends on nothing but the results: the same ones give the same bytes.

    Parameters
    ----------
    folder : Path
        A folder with ``variants.json`` and a results folder for each variant.

    Returns
    -------
    Path
        ``report.html``, which needs no other file.

    Raises
    ------
    ResultsError
        No variant has results, a file is missing or damaged, or nothing can be written.
    """
    folder = Path(folder)
    variants = read_variants(folder)
    with style.context():
        drawing = draw_variants(variants)
        svg = as_svg(drawing) if drawing else ""
    html = rendered(
        "variants.html",
        {
            **content_of(variants),
            "svg": svg,
            "caption": drawing.caption if drawing else "",
        },
    )
    try:
        (folder / "figures").mkdir(exist_ok=True)
        figure = folder / "figures" / "variants.svg"
        if svg:
            write_atomically(figure, svg)
        else:
            figure.unlink(missing_ok=True)  # of an earlier report
        write_atomically(folder / TABLE, variants_csv(variants))
        write_atomically(folder / PAGE, html)
    except OSError as e:
        raise ResultsError(f"{e.filename or folder}: cannot be written ({e.strerror})") from None
    return folder / PAGE


def content_of(variants: Variants) -> dict[str, Any]:
    """Return all that the template shows besides the figure, as plain values."""
    return {
        "title": variants.title or variants.folder.name,
        "description": variants.description,
        "notes": [
            (heading, lines)
            for heading, lines in (
                ("Not complete", variants.unfinished),
                ("Warnings", variants.warnings),
            )
            if lines
        ],
        "cards": _cards(variants),
        "nearest": _nearest(variants),
        "table": variants_table(variants),
        "levels": levels_table(variants),
        "settings": [
            {
                "name": variant.name,
                "title": variant.title,
                "values": {key: str(value) for key, value in variant.settings.items()},
            }
            for variant in variants.done
        ],
    }


def _cards(variants: Variants) -> list[tuple[str, str, str]]:
    """Return the figures at the top of the page: what, how much, and of which variant."""
    runs = sorted({variant.runs for variant in variants.done})
    cards = [
        ("variants", str(len(variants.done)), ""),
        ("runs of each", "–".join(str(n) for n in dict.fromkeys((runs[0], runs[-1]))), ""),
    ]
    for heading, value_of, text_of in BEST:
        known = [v for v in variants.done if not math.isnan(value_of(v))]
        if known:
            best = max(map(value_of, known))
            cards.append((heading, text_of(best), _tied(known, value_of, best)))
    nearest = variants.nearest
    if nearest is not None:
        tied = _tied(variants.done, lambda variant: variant.distance, nearest.distance)
        cards.append(("nearest to published", figure_text(nearest.distance, 3), tied))
    return cards


def _tied(variants: Sequence[Variant], value_of: Callable[[Variant], float], best: float) -> str:
    """Name the variants that have the best value: the first, and how many more."""
    return and_others([v.name for v in variants if math.isclose(value_of(v), best, abs_tol=1e-6)])


def _above_chance(variant: Variant) -> float:
    """Return recall less chance; corrected recall is 1 for whoever marks everywhere."""
    return variant.figures["recall"] - variant.figures["chance"]


def _points(difference: float) -> str:
    """Return a difference between two shares in percentage points: ``+21``."""
    text = number_text(100 * difference, 0)
    return text if text.startswith("−") else f"+{text}"


BEST: tuple[tuple[str, Callable[[Variant], float], Callable[[float], str]], ...] = (
    ("highest recall", lambda variant: variant.figures["recall"], percent_text),
    ("points above chance", _above_chance, _points),
    ("highest precision", lambda variant: variant.figures["precision"], percent_text),
    ("highest F", lambda variant: variant.figures["f"], figure_text),
)
"""Heading, figure and how it is written, of the cards that name the best variant."""


def _nearest(variants: Variants) -> str:
    """Say which variant comes nearest to what was published, and what that is worth."""
    best = variants.nearest
    if best is None:
        return ""
    recall, chance = best.figures["recall"], best.figures["chance"]
    name = _tied(variants.done, lambda variant: variant.distance, best.distance)
    only = "there is only one" if best.runs == 1 else f"there are only {best.runs} of them"
    return (
        f"The distance to the published shares ({variants.published_in}) is the root mean square "
        f"difference over the {len(best.published)} locations that have one. Nearest is "
        f"{name}, {fraction_text(best.distance, 3)} away, which found "
        f"{percent_text(recall)} where marks at random find {percent_text(chance)}. Runs that find "
        f"each location with exactly the published probability would come out about "
        f"{fraction_text(best.expected_distance, 3)} away, because {only}; differences between "
        "small distances say nothing."
    )
