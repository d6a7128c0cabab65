"""Runs a resolved scenario with a progress bar, writes the report, says what came out."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ssrics_like.scenarios.schema import Resolved


def execute(resolved: Resolved, out: Path, *, resume: bool, quiet: bool) -> None:
    """Carry a scenario out and report on it."""
    from ssrics_like.scenarios.runner import run_scenario

    bar = progress_bar(quiet=quiet)
    with bar:
        task = bar.add_task(resolved.log.name, total=resolved.scenario.runs)
        try:
            manifest = run_scenario(
                resolved,
                out,
                resume=resume,
                progress=lambda run, share: bar.update(task, completed=run + share),
            )
        except KeyboardInterrupt:
            if out.is_dir():
                raise KeyboardInterrupt(
                    f"finished runs are kept in {out}; --resume goes on"
                ) from None
            raise
    from ssrics_like.report import write_report

    page = write_report(out)
    if not quiet:
        for line in summary(manifest):
            print(line)
        print(f"report: {page}")


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
        lines.append(
            f"run {entry['run']}: {entry['scans']} scans, {entry['path_length_m']:.1f} m, "
            f"{entry['landmarks']} landmarks ({decided})"
        )
    lines += [f"warning: {text}" for text in manifest["warnings"]]
    return lines
