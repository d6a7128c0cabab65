"""Checks that all files of a results folder are there, and whole."""

from __future__ import annotations

import csv
from collections import Counter
from pathlib import Path
from typing import Any

from ssrics_like.errors import ResultsError
from ssrics_like.memory import load_memory_file
from ssrics_like.memory.store import load_topology
from ssrics_like.results import tables
from ssrics_like.results.manifest import read_manifest

HEADERS = {
    "decisions.csv": tables.DECISIONS,
    "landmarks.csv": tables.LANDMARKS,
    "path.csv": tables.PATH,
}


def check_results(path: Path) -> dict[str, Any]:
    """Check a results folder against its manifest and return the manifest.

    Raises
    ------
    ResultsError, MemoryFileError
        A file is missing or damaged, or a table has not the rows that the manifest counts.
    """
    manifest = read_manifest(path)
    try:
        runs = {str(entry["run"]): entry for entry in manifest["runs"]}
        decided = {run: sum(entry["decisions"].values()) for run, entry in runs.items()}
        marked = {run: entry["landmarks"] for run, entry in runs.items()}
    except (KeyError, TypeError, AttributeError) as e:
        raise ResultsError(f"{path / 'manifest.json'}: is damaged: no {e} of the runs") from None
    rows = {name: _rows(path / name, header) for name, header in HEADERS.items()}
    for name, wanted in (("decisions.csv", decided), ("landmarks.csv", marked)):
        for run, count in wanted.items():
            if rows[name][run] != count:
                raise ResultsError(
                    f"{path / name}: has {rows[name][run]} rows of run {run}, the manifest {count}"
                )
    for run, count in marked.items():
        name = f"run-{int(run):03d}"
        for ending in ("json", "graphml"):
            if len(load_topology(path / "topology" / f"{name}.{ending}")) != count:
                raise ResultsError(f"{path}: topology/{name}.{ending} has not {count} landmarks")
        chunks = runs[run].get("chunks")  # results of an earlier version have no such file
        memory = path / "memory" / f"{name}.json"
        if chunks is not None and len(load_memory_file(memory).chunks) != chunks:
            raise ResultsError(f"{memory}: has not {chunks} chunks")
        files = [path / "figures" / f"{name}.json"]
        if manifest["scenario"].get("trace", True):
            files.append(path / "trace" / f"{name}.jsonl")
        for file in files:
            if not file.is_file() or not file.stat().st_size:
                raise ResultsError(f"{file}: is missing or empty")
    return manifest


def _rows(file: Path, header: list[str]) -> Counter[str]:
    """Count a table's rows by run."""
    try:
        text = file.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as e:
        raise ResultsError(f"{file}: cannot be read ({e})") from None
    rows = csv.reader(text.splitlines())
    if next(rows, None) != header:
        raise ResultsError(f"{file}:1: the header is not that of {file.name}")
    found: Counter[str] = Counter()
    for number, row in enumerate(rows, 2):
        if len(row) != len(header):
            raise ResultsError(f"{file}:{number}: has {len(row)} cells, expected {len(header)}")
        found[row[0]] += 1
    return found
