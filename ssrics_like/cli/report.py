"""``ssrics report``: draw a results folder's report anew."""

from __future__ import annotations

from pathlib import Path


def report(folder: Path) -> None:
    """Write the figures and report.html of a results folder anew.

    Parameters
    ----------
    folder
        A folder that run or replay has written.
    """
    from ssrics_like.report import write_report

    print(f"report: {write_report(folder)}")
