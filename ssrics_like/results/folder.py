"""The results folder: what stands in it, and how runs get into it unharmed.

Each run is written apart, in ``.runs/run-NNN.partial``, and renamed when it is
complete; the tables that users read are put together from complete runs only.
So an interrupted command leaves finished runs whole, and can be resumed.
"""

from __future__ import annotations

import json
import re
import shutil
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from filelock import FileLock, Timeout

from ssrics_like.errors import ResultsError
from ssrics_like.results import tables
from ssrics_like.results.files import csv_line, json_text, plain, write_atomically

MANIFEST = "manifest.json"
FORMAT = "ssrics-results"
VERSION = 1
MADE_FROM_ALL = ("report.html", "locations.csv", "scores.json")
"""Files that are worked out from all runs, after the tables."""
OURS = (
    MANIFEST,
    "decisions.csv",
    "landmarks.csv",
    "path.csv",
    "topology",
    "trace",
    "figures",
    "map",
    *MADE_FROM_ALL,
)
_RUN_FILE = re.compile(r"run-\d{3,}\.(json|graphml|jsonl)")


class ResultsFolder:
    """One results folder, for as long as a command writes to it.

    Parameters
    ----------
    path : Path
        The folder; made if it does not exist. Files of others in it are left alone.

    Raises
    ------
    ResultsError
        It cannot be made, another command is writing to it, or files that are no results bear
        the names of results.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.staging = path / ".runs"
        self._lock = FileLock(path / ".lock", timeout=0)
        if path.exists() and not path.is_dir():
            raise ResultsError(f"{path}: is a file, expected a folder for results")
        if (path / "variants.json").is_file():
            raise ResultsError(f"{path}: holds the results of variants; name another folder")
        taken = [name for name in OURS if (path / name).exists()]
        if taken and not (path / MANIFEST).is_file():
            raise ResultsError(
                f"{path}: holds '{taken[0]}' but no {MANIFEST}, so it is no result of ssrics and "
                "would be lost; name another folder"
            )

    def __enter__(self) -> Self:
        self._new = not self.path.exists()
        try:
            self.path.mkdir(parents=True, exist_ok=True)
            self._lock.acquire()
        except Timeout:
            raise ResultsError(f"{self.path}: another ssrics is writing to it") from None
        except OSError as e:
            raise ResultsError(f"{self.path}: cannot be written ({e.strerror})") from None
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Remove what an unfinished run left; the folder too, if it is new and nothing is in it."""
        for partial in self.staging.glob("*.partial"):
            shutil.rmtree(partial)
        if self.staging.is_dir() and not self._complete():
            shutil.rmtree(self.staging)
        self._lock.release()
        Path(self._lock.lock_file).unlink(missing_ok=True)
        if self._new and not any(self.path.iterdir()):
            self.path.rmdir()

    def begin(self, description: dict[str, Any], *, resume: bool) -> dict[int, dict[str, Any]]:
        """Prepare for runs of a scenario.

        Parameters
        ----------
        description : dict
            All that decides the results; runs of another description cannot be resumed, but
            there may be more of them.
        resume : bool
            Keep the runs that are complete, rather than start anew.

        Returns
        -------
        dict
            Run number -> entry, of the runs that are kept.

        Raises
        ------
        ResultsError
            It is to be resumed, but the runs there belong to another scenario.
        """
        note = self.staging / "scenario.json"
        text = json_text(_but_for_runs(description))
        if resume and note.is_file():
            if note.read_text(encoding="utf-8") != text:
                raise self._other()
        else:
            if self.staging.exists():
                shutil.rmtree(self.staging)
            self.staging.mkdir()
            write_atomically(note, text)
        for partial in self.staging.glob("*.partial"):
            shutil.rmtree(partial)
        return {entry["run"]: entry for entry in self._entries()}

    def complete(self, description: dict[str, Any]) -> dict[str, Any] | None:
        """Return the manifest, if a finished command has left all its runs here.

        Raises
        ------
        ResultsError
            It has, but they were made from another description.
        """
        if self.staging.exists() or not (self.path / MANIFEST).is_file():
            return None
        manifest = read_manifest(self.path)
        if any(manifest.get(key) != value for key, value in plain(description).items()):
            raise self._other()
        return manifest

    def _other(self) -> ResultsError:
        return ResultsError(
            f"{self.path}: its runs were made from other settings or another version; resume "
            "with the same ones, or without --resume to start anew"
        )

    def tidy(self) -> None:
        """Remove the separate runs once the tables hold all of them."""
        shutil.rmtree(self.staging)

    def open_run(self, run: int) -> Path:
        """Make the folder that a run is written to."""
        partial = self.staging / f"run-{run:03d}.partial"
        partial.mkdir()
        return partial

    def close_run(self, run: int, entry: dict[str, Any]) -> None:
        """Declare a run complete."""
        partial = self.staging / f"run-{run:03d}.partial"
        write_atomically(partial / "run.json", json_text(entry))
        partial.rename(partial.with_suffix(""))

    @property
    def has_runs(self) -> bool:
        """Whether a run of the scenario under way is complete."""
        return bool(self._complete())

    def _entries(self) -> list[dict[str, Any]]:
        return [
            json.loads((folder / "run.json").read_text(encoding="utf-8"))
            for folder in self._complete()
        ]

    def _complete(self) -> list[Path]:
        folders = self.staging.glob("run-*[0-9]")
        return sorted(folders, key=lambda folder: int(folder.name.removeprefix("run-")))

    def combine(self, description: dict[str, Any]) -> dict[str, Any]:
        """Put the complete runs together into the tables that users read; return the manifest."""
        folders = self._complete()
        entries = self._entries()
        warnings = list(dict.fromkeys(text for entry in entries for text in entry["warnings"]))
        for name, header in (("decisions.csv", tables.DECISIONS), ("path.csv", tables.PATH)):
            self._join(name, csv_line(header), folders, skip=0)
        self._join("landmarks.csv", csv_line(tables.LANDMARKS), folders, skip=1)
        for name in ("topology", "trace", "figures"):
            (self.path / name).mkdir(exist_ok=True)
            for old in (self.path / name).iterdir():
                if _RUN_FILE.fullmatch(old.name):
                    old.unlink()
        for name in MADE_FROM_ALL:
            (self.path / name).unlink(missing_ok=True)
        for folder in folders:
            for source, target in (
                ("topology.json", f"topology/{folder.name}.json"),
                ("topology.graphml", f"topology/{folder.name}.graphml"),
                ("trace.jsonl", f"trace/{folder.name}.jsonl"),
                ("figures.json", f"figures/{folder.name}.json"),
            ):
                if (folder / source).is_file():  # a scenario may do without the trace
                    _link(folder / source, self.path / target)
        manifest: dict[str, Any] = plain(
            {
                "format": FORMAT,
                "version": VERSION,
                **description,
                "warnings": warnings,
                "runs": entries,
            }
        )
        write_atomically(self.path / MANIFEST, json_text(manifest))
        return manifest

    def _join(self, name: str, header: str, folders: list[Path], *, skip: int) -> None:
        temporary = self.staging / f"{name}.joined"
        with temporary.open("wb") as out:
            out.write(header.encode())
            for folder in folders:
                with (folder / name).open("rb") as part:
                    for _ in range(skip):
                        part.readline()
                    shutil.copyfileobj(part, out)
        temporary.replace(self.path / name)


def _but_for_runs(description: dict[str, Any]) -> dict[str, Any]:
    scenario = {key: value for key, value in description["scenario"].items() if key != "runs"}
    return {**description, "scenario": scenario}


def _link(source: Path, target: Path) -> None:
    """Give a file a second name; copy it where the file system has no hard links."""
    try:
        target.hardlink_to(source)
    except OSError:
        shutil.copyfile(source, target)


def read_manifest(path: Path) -> dict[str, Any]:
    """Read the manifest of a results folder.

    Raises
    ------
    ResultsError
        The folder holds no results, or those of a newer version.
    """
    file = path / MANIFEST
    if not file.is_file():
        what = "no such folder" if not path.exists() else f"no results here ({MANIFEST} is missing)"
        raise ResultsError(f"{path}: {what}")
    try:
        manifest: dict[str, Any] = json.loads(file.read_text(encoding="utf-8"))
    except ValueError as e:
        raise ResultsError(f"{file}: is damaged: {e}") from None
    if (
        not isinstance(manifest, dict)
        or manifest.get("format") != FORMAT
        or not isinstance(manifest.get("version"), int)
    ):
        raise ResultsError(f"{file}: is not a results manifest")
    if manifest["version"] > VERSION:
        raise ResultsError(
            f"{file}: results of version {manifest['version']}, this program reads up to {VERSION}"
        )
    return manifest
