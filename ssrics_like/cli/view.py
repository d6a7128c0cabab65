"""``ssrics view``: a run to look at, moment by moment."""

from __future__ import annotations

from pathlib import Path

from ssrics_like.cli.options import Out, Whole


def view(
    folder: Path, *, run: Whole | None = None, log: Path | None = None, out: Out = None
) -> None:
    """Write a page that plays a run: map, scan, novelty, buffers, productions, memory.

    It is one file that opens in any browser, offline.

    For example:

        ssrics view out/complex/
        ssrics view out/complex/ --run 3 -o page.html
        ssrics view out/log/ --log robot.log

    Parameters
    ----------
    folder
        A folder that run or replay has written.
    run
        Number of the run; the first one if left out.
    log
        The log that the folder was made from, to show its scans.
    out
        The page; view-run-NNN.html in the folder if left out.
    """
    from ssrics_like.viewer import write_view

    print(f"view: {write_view(folder, run, log=log, out=out)}")
