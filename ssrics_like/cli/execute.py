"""Runs a resolved scenario with a progress bar, writes the report, says what came out."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ssrics_like.cli.summary import found, print_variants, summary

if TYPE_CHECKING:
    from typing import TypedDict

    from ssrics_like.results.listing import Variant
    from ssrics_like.scenarios.resolving import Resolved
    from ssrics_like.scenarios.runner import Progress, Say
    from ssrics_like.scenarios.schema import Scenario

    class Watch(TypedDict):
        """What the runner tells."""

        progress: Progress
        say: Say


def execute(resolved: Resolved, out: Path, *, resume: bool, jobs: int, quiet: bool) -> None:
    """Carry a scenario out and report on it."""
    from ssrics_like.scenarios.runner import run_scenario

    with _watched(resolved.source_name, resolved.scenario.runs, out, quiet=quiet) as watch:
        manifest = run_scenario(resolved, out, resume=resume, jobs=jobs, **watch)
    from ssrics_like.report import write_report

    page = write_report(out)
    if not quiet:
        for line in [*summary(manifest), *found(out)]:
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
    from ssrics_like.scenarios.runner import drive_key
    from ssrics_like.scenarios.variants import run_variants
    from ssrics_like.workers import in_order

    runs = sum({drive_key(each): each.scenario.runs for _, each in resolved}.values())
    with _watched(f"{len(resolved)} variants", runs, out, quiet=quiet) as watch:
        manifests = run_variants(scenario, resolved, out, resume=resume, jobs=jobs, **watch)
    folders = [out / variant.name for variant, _ in resolved]
    with progress_bar(quiet=quiet) as bar:
        task = bar.add_task("reports", total=len(folders))
        for _ in in_order(write_report, folders, jobs):
            bar.advance(task)
    page = write_variants_report(out)
    if not quiet:
        print_variants(out, manifests)
        print(f"report: {page}")


@contextmanager
def _watched(what: str, total: int, out: Path, *, quiet: bool) -> Iterator[Watch]:
    """Show how far the work is and what is said of it; say what an interruption leaves."""
    shares: dict[int, float] = {}
    bar = progress_bar(quiet=quiet)
    with bar:
        task = bar.add_task(what, total=total)

        def progress(number: int, share: float) -> None:
            shares[number] = share
            bar.update(task, completed=sum(shares.values()))

        def say(text: str) -> None:
            if not quiet:
                bar.console.print(f"ssrics: {text}", markup=False, highlight=False, soft_wrap=True)

        try:
            yield {"progress": progress, "say": say}
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
