"""``ssrics report``: draw a results folder's report anew."""

from __future__ import annotations

from pathlib import Path


def report(folder: Path) -> None:
    """Write the figures and report.html of a results folder anew.

    Parameters
    ----------
    folder
        A folder that run or replay has written; that of a scenario with variants gets the page
        that compares them.
    """
    from ssrics_like.comparison import write_scores
    from ssrics_like.report import has_variants, write_report, write_variants_report

    if has_variants(folder):
        print(f"report: {write_variants_report(folder)}")
        return
    write_scores(folder)
    print(f"report: {write_report(folder)}")
