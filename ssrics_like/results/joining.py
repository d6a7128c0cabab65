"""Puts complete runs together into the tables that users read."""

from __future__ import annotations

import re
import shutil
from pathlib import Path
from typing import Any

from ssrics_like.results.checking import HEADERS
from ssrics_like.results.files import csv_line, json_text, plain, write_atomically
from ssrics_like.results.manifest import FORMAT, MANIFEST, VERSION, unfinished
from ssrics_like.results.stored import JOINED, KEPT, entry_of, link

MADE_FROM_ALL = ("report.html", "locations.csv", "scores.json")
"""Files that are worked out from all runs, after the tables."""
PAGES = re.compile(r"view-run-\d{3,}\.html")
"""On which runs are played; those of the runs before would tell of these no more."""
_RUN_FILE = re.compile(r"run-\d{3,}\.(json|graphml|jsonl)")


def join_runs(path: Path, folders: list[Path], description: dict[str, Any]) -> dict[str, Any]:
    """Put complete runs together; return the manifest.

    Parameters
    ----------
    path : Path
        The results folder.
    folders : list of Path
        Those of the runs, in order; see `stored`.
    description : dict
        What else stands in the manifest.
    """
    entries = [entry_of(folder) for folder in folders]
    for name, skip in JOINED.items():
        _join(path / name, csv_line(HEADERS[name]), folders, skip=skip)
    for name in ("topology", "memory", "trace", "figures"):
        (path / name).mkdir(exist_ok=True)
        for old in (path / name).iterdir():
            if _RUN_FILE.fullmatch(old.name):
                old.unlink()
    outdated = [path / name for name in MADE_FROM_ALL]
    outdated += [file for file in path.iterdir() if PAGES.fullmatch(file.name)]
    for file in outdated:
        file.unlink(missing_ok=True)
    for folder in folders:
        for source, among_all in KEPT.items():
            if (folder / source).is_file():
                link(folder / source, path / among_all.format(run=folder.name))
    said = [unfinished({**description, "runs": entries})]
    said += [text for entry in entries for text in entry["warnings"]]
    manifest: dict[str, Any] = plain(
        {
            "format": FORMAT,
            "version": VERSION,
            **description,
            "warnings": list(dict.fromkeys(filter(None, said))),
            "runs": entries,
        }
    )
    write_atomically(path / MANIFEST, json_text(manifest))
    return manifest


def _join(table: Path, header: str, folders: list[Path], *, skip: int) -> None:
    """Write a table: its heading, then the rows of each run."""
    temporary = folders[0].parent / f"{table.name}.joined"
    with temporary.open("wb") as out:
        out.write(header.encode())
        for folder in folders:
            with (folder / table.name).open("rb") as part:
                for _ in range(skip):
                    part.readline()
                shutil.copyfileobj(part, out)
    temporary.replace(table)
