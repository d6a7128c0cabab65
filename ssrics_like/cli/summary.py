"""What a command says at its end: the runs, what was found, variants side by side."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rich.table import Table

    from ssrics_like.report.variants import Variants

WIDTH = 200
"""A table of variants is as wide as it needs to be, up to this."""


def summary(manifest: dict[str, Any]) -> list[str]:
    """Say in a few lines what the runs gave."""
    from ssrics_like.results.counts import counted
    from ssrics_like.results.errands import errand_text

    lines = []
    for entry in manifest["runs"]:
        decided = ", ".join(f"{n} {what}" for what, n in entry["decisions"].items()) or "no reflex"
        seen = f"{100 * entry['coverage']:.1f} % seen, " if "coverage" in entry else ""
        lines.append(
            f"run {entry['run']}: {counted(entry['scans'], 'scan')}, "
            f"{entry['path_length_m']:.1f} m, {seen}"
            f"{counted(entry['landmarks'], 'landmark')} ({decided})"
        )
        lines += [f"  {errand_text(errand)}" for errand in entry.get("errands", ())]
    lines += [f"warning: {text}" for text in manifest["warnings"]]
    return lines


def found(out: Path) -> list[str]:
    """Say in how many runs each designated location was found (the report's table 1)."""
    from ssrics_like.comparison import score_folder
    from ssrics_like.results.counts import counted

    scored = score_folder(out)
    if scored is None:
        return []
    lines = []
    for place in scored.scores.places:
        if place.designated:
            low, high = place.interval
            published = scored.published.get(place.location.id)
            beside = f", published {100 * published:.0f} %" if published is not None else ""
            lines.append(
                f"location {place.location.id}: found in {place.found} of "
                f"{counted(place.runs, 'run')} "
                f"({100 * low:.0f}-{100 * high:.0f} %), by chance {100 * place.chance:.0f} %"
                f"{beside}"
            )
    return lines


def print_variants(out: Path, manifests: Sequence[dict[str, Any]]) -> None:
    """Print a row for each variant, and what the user should know of their runs."""
    from rich.console import Console

    from ssrics_like.report.variants import read_variants

    variants = read_variants(out)
    Console(width=WIDTH, highlight=False, markup=False).print(_table(variants, manifests))
    for text in variants.warnings:
        print(f"warning: {text}")


def _table(variants: Variants, manifests: Sequence[dict[str, Any]]) -> Table:
    import math

    from rich import box
    from rich.table import Table

    from ssrics_like.report.words import interval_text, percent_text

    table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    table.add_column("variant", no_wrap=True)
    scored = any(not math.isnan(variant.figures["recall"]) for variant in variants.done)
    shares = ("recall", "95 % interval", "by chance", "by a clock", "precision") if scored else ()
    for name in ("runs", "path, m", "landmarks", *shares):
        table.add_column(name, justify="right", no_wrap=True)
    for variant, manifest in zip(variants.done, manifests, strict=True):
        runs = manifest["runs"]
        cells = [
            str(len(runs)),
            f"{sum(run['path_length_m'] for run in runs):.1f}",
            str(sum(run["landmarks"] for run in runs)),
        ]
        if scored:
            recall, *others = (
                percent_text(variant.figures[name])
                for name in ("recall", "chance", "clock", "precision")
            )
            interval = interval_text((variant.figures["low"], variant.figures["high"]))
            cells += [recall, interval, *others]
        table.add_row(variant.name, *cells)
    return table
