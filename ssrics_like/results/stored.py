"""A complete run that waits, in a folder of its own, to be joined to the tables.

It is sealed with the digests of its files, so that what happens to them until the
command is resumed is noticed. A finished results folder can be taken apart into
such runs again, to add more.
"""

from __future__ import annotations

import hashlib
import json
import shutil
from pathlib import Path
from typing import Any

from ssrics_like.results.files import json_text, write_atomically

RUN = "run.json"
JOINED = {"decisions.csv": 0, "path.csv": 0, "landmarks.csv": 1}
"""Tables of a run that are joined to those of all, and how many lines of heading each has."""
KEPT = {
    "topology.json": "topology/{run}.json",
    "topology.graphml": "topology/{run}.graphml",
    "memory.json": "memory/{run}.json",
    "trace.jsonl": "trace/{run}.jsonl",  # a scenario may do without
    "figures.json": "figures/{run}.json",
}
"""Files of a run that stay files, and what they are called among those of all."""


def seal(folder: Path, entry: dict[str, Any]) -> None:
    """Note a run's entry for the manifest, and the digests of its files."""
    files = {file.name: _digest(file) for file in sorted(folder.iterdir())}
    write_atomically(folder / RUN, json_text({"entry": entry, "files": files}))


def entry_of(folder: Path) -> dict[str, Any]:
    """Return the entry of a run that is whole."""
    entry: dict[str, Any] = json.loads((folder / RUN).read_text(encoding="utf-8"))["entry"]
    return entry


def is_whole(folder: Path) -> bool:
    """Tell whether a run's files are all there, and as they were when it was sealed."""
    try:
        files = json.loads((folder / RUN).read_text(encoding="utf-8"))["files"]
        return entry_of(folder)["run"] == number_of(folder) and all(
            _digest(folder / name) == digest for name, digest in files.items()
        )
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return False


def number_of(folder: Path) -> int:
    """Return the number of a run."""
    return int(folder.name.removeprefix("run-"))


def copy_out(results: Path, run: int, folder: Path) -> None:
    """Copy a run's part of a finished results folder into a folder of its own."""
    mine = f"{run},".encode()
    for name, heading in JOINED.items():
        with (results / name).open("rb") as table, (folder / name).open("wb") as part:
            first = table.readline()
            part.write(first if heading else b"")
            part.writelines(line for line in table if line.startswith(mine))
    for name, among_all in KEPT.items():
        source = results / among_all.format(run=f"run-{run:03d}")
        if source.is_file():
            link(source, folder / name)


def link(source: Path, target: Path) -> None:
    """Give a file a second name; copy it where the file system has no hard links."""
    try:
        target.hardlink_to(source)
    except OSError:
        shutil.copyfile(source, target)


def _digest(file: Path) -> str:
    with file.open("rb") as data:
        return hashlib.file_digest(data, "sha256").hexdigest()
