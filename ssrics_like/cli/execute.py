"""Runs a resolved scenario with a progress bar, writes the report, says what came out."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ssrics_like.scenarios.resolving import Resolved
    from ssrics_like.scenarios.runner import Progress
    from ssrics_like.scenarios.schema import Scenario
    from ssrics_like.scenarios.variants import Variant


def execute(resolved: Resolved, out: Path, *, resume: bool, jobs: int, quiet: bool) -> None:
    """Carry a scenario out and report on it."""
    from ssrics_like.scenarios.runner import run_scenario

    with _watched(resolved.source_name, resolved.scenario.runs, out, quiet=quiet) as progress:
        manifest = run_scenario(resolved, out, resume=resume, jobs=jobs, progress=progress)
    from ssrics_like.report import write_report

    page = write_report(out)
    if not quiet:
        for line in summary(manifest):
            print(line)
        for line in found(out):
            print(line)
        print(f"report: {page}")


def execute_variants(
    scenario: Scenario,
    resolved: list[tuple[Variant, Resolved]],
    out: Path,
    *,
    resume: bool,
    jobs: int,
    quiet: bool,
) -> None:
    """Carry all variants of a scenario out and report on each, and on them together."""
    from ssrics_like.report import write_report, write_variants_report
    from ssrics_like.scenarios.pool import over_processes
    from ssrics_like.scenarios.runner import drive_key
    from ssrics_like.scenarios.variants import run_variants

    runs = sum({drive_key(each): each.scenario.runs for _, each in resolved}.values())
    with _watched(f"{len(resolved)} variants", runs, out, quiet=quiet) as progress:
        run_variants(scenario, resolved, out, resume=resume, jobs=jobs, progress=progress)
    over_processes(write_report, [out / variant.name for variant, _ in resolved], jobs)
    page = write_variants_report(out)
    if not quiet:
        print((out / "variants.csv").read_text(encoding="utf-8"), end="")
        print(f"report: {page}")


@contextmanager
def _watched(what: str, total: int, out: Path, *, quiet: bool) -> Iterator[Progress]:
    """Show how far the work is; say what is kept when it is interrupted."""
    shares: dict[int, float] = {}
    bar = progress_bar(quiet=quiet)
    with bar:
        task = bar.add_task(what, total=total)

        def progress(number: int, share: float) -> None:
            shares[number] = share
            bar.update(task, completed=sum(shares.values()))

        try:
            yield progress
        except KeyboardInterrupt:
            if any(out.glob("*/manifest.json")) or (out / "manifest.json").is_file():
                raise KeyboardInterrupt(
                    f"finished runs are kept in {out}; --resume goes on"
                ) from None
            raise


def progress_bar(*, quiet: bool) -> Any:
    """Make a progress bar; it stays silent when nobody watches."""
    from rich.console import Console
    from rich.progress import Progress

    shown = sys.stderr.isatty() and not quiet
    return Progress(console=Console(stderr=True), transient=True, disable=not shown)


def summary(manifest: dict[str, Any]) -> list[str]:
    """Say in a few lines what the runs gave."""
    lines = []
    for entry in manifest["runs"]:
        decided = ", ".join(f"{n} {what}" for what, n in entry["decisions"].items()) or "no reflex"
        seen = f"{100 * entry['coverage']:.1f} % seen, " if "coverage" in entry else ""
        lines.append(
            f"run {entry['run']}: {entry['scans']} scans, {entry['path_length_m']:.1f} m, {seen}"
            f"{entry['landmarks']} landmarks ({decided})"
        )
    lines += [f"warning: {text}" for text in manifest["warnings"]]
    return lines


def found(out: Path) -> list[str]:
    """Say in how many runs each designated location was found (the report's table 1)."""
    from ssrics_like.comparison import score_folder

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
                f"location {place.location.id}: found in {place.found} of {place.runs} runs "
                f"({100 * low:.0f}-{100 * high:.0f} %), by chance {100 * place.chance:.0f} %"
                f"{beside}"
            )
    return lines
