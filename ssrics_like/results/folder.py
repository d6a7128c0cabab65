"""The results folder: what stands in it, and how runs get into it unharmed.

Each run is written apart, in ``.runs/run-NNN.partial``, and renamed when it is
complete; the tables that users read are put together from complete runs only.
So an interrupted command leaves finished runs whole, and can be resumed.
"""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from filelock import FileLock, Timeout

from ssrics_like.errors import MemoryFileError, ResultsError
from ssrics_like.results.checking import check_results
from ssrics_like.results.counts import counted
from ssrics_like.results.files import json_text, plain, write_atomically
from ssrics_like.results.joining import MADE_FROM_ALL, join_runs
from ssrics_like.results.manifest import MANIFEST, but_for_runs, difference, read_manifest
from ssrics_like.results.stored import copy_out, entry_of, is_whole, number_of, seal

__all__ = ["MANIFEST", "OURS", "ResultsFolder", "read_manifest"]

NOTE = "scenario.json"
OURS = (
    MANIFEST,
    "decisions.csv",
    "landmarks.csv",
    "path.csv",
    "topology",
    "memory",
    "trace",
    "figures",
    "map",
    *MADE_FROM_ALL,
)


class ResultsFolder:
    """One results folder, for as long as a command writes to it.

    Parameters
    ----------
    path : Path
        The folder; made if it does not exist. Files of others in it are left alone.

    Attributes
    ----------
    notices : list of str
        What the user should know of runs that were there and are not kept.

    Raises
    ------
    ResultsError
        It cannot be made, another command is writing to it, or files that are no results bear
        the names of results.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.staging = path / ".runs"
        self.notices: list[str] = []
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
            Keep the runs that are complete, and whole, rather than start anew.

        Returns
        -------
        dict
            Run number -> entry, of the runs that are kept; `notices` says what was not.

        Raises
        ------
        ResultsError
            It is to be resumed, but the runs there belong to another scenario, or are more than
            it has.
        """
        if not (resume and self._is_ready(description)):
            self._discard(description)
            self._prepare(description)
        for partial in self.staging.glob("*.partial"):
            shutil.rmtree(partial)
        damaged = [folder for folder in self._complete() if not is_whole(folder)]
        for folder in damaged:
            shutil.rmtree(folder)
        if damaged:
            names = ", ".join(str(number_of(folder)) for folder in damaged)
            self.notices.append(f"what is stored of run {names} is damaged; done anew")
        return {entry["run"]: entry for entry in self._entries()}

    def _is_ready(self, description: dict[str, Any]) -> bool:
        """Tell whether stored runs of this very scenario can be gone on with."""
        before = self._stored()
        if not self._complete() or before is None:
            return False
        self._compare(before, description, number_of(self._complete()[-1]) + 1)
        return True

    def _stored(self) -> dict[str, Any] | None:
        """Return what stored runs were made from; None where that cannot be read."""
        try:
            found = json.loads((self.staging / NOTE).read_text(encoding="utf-8"))
        except (OSError, ValueError):
            return None
        return found if isinstance(found, dict) else None

    def _discard(self, description: dict[str, Any]) -> None:
        """Remove stored runs, not without a word."""
        if self._complete():
            said = counted(len(self._complete()), "finished run")
            said = f"{said} of an interrupted command thrown away"
            before = self._stored()
            if before is None:
                said += f": {NOTE}, what they were made from, is damaged"
            elif not difference(before, plain(but_for_runs(description))):
                said += "; --resume would have kept what is whole"
            self.notices.append(said)
        if self.staging.exists():
            shutil.rmtree(self.staging)

    def _prepare(self, description: dict[str, Any]) -> None:
        self.staging.mkdir()
        write_atomically(self.staging / NOTE, json_text(but_for_runs(description)))

    def complete(self, description: dict[str, Any]) -> dict[str, Any] | None:
        """Return the manifest, if a finished command has left all its runs here.

        If it has left fewer than there are to be, they are stored for `begin` to go on with.

        Raises
        ------
        ResultsError
            It has, but they were made from another description, or are more.
        """
        if self.staging.exists() or not (self.path / MANIFEST).is_file():
            return None
        manifest = read_manifest(self.path)
        before = but_for_runs({key: manifest.get(key) for key in description})
        self._compare(before, description, len(manifest.get("runs", [])))
        if len(manifest["runs"]) == description["scenario"]["runs"]:
            return manifest
        try:
            check_results(self.path)
        except (ResultsError, MemoryFileError) as e:
            self.notices.append(f"its runs are damaged and done anew ({e})")
            return None
        self._prepare(description)
        for entry in manifest["runs"]:
            copy_out(self.path, entry["run"], self.open_run(entry["run"]))
            self.close_run(entry["run"], entry)
        return None

    def _compare(self, before: dict[str, Any], description: dict[str, Any], runs: int) -> None:
        """Complain if the runs that are there are other ones than those of a description."""
        differs = difference(before, plain(but_for_runs(description)))
        if differs:
            raise ResultsError(
                f"{self.path}: its runs were made from other settings or another version: "
                f"{differs}; resume with the same ones, or without --resume to start anew"
            )
        if runs > description["scenario"]["runs"]:
            raise ResultsError(
                f"{self.path}: holds {runs} runs, more than {description['scenario']['runs']}; "
                f"resume with -n {runs} or more, or without --resume to start anew"
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
        seal(partial, entry)
        partial.rename(partial.with_suffix(""))

    @property
    def has_runs(self) -> bool:
        """Whether a run of the scenario under way is complete."""
        return bool(self._complete())

    def _entries(self) -> list[dict[str, Any]]:
        return [entry_of(folder) for folder in self._complete()]

    def _complete(self) -> list[Path]:
        folders = self.staging.glob("run-*[0-9]")
        return sorted(folders, key=number_of)

    def combine(self, description: dict[str, Any]) -> dict[str, Any]:
        """Put the complete runs together into the tables that users read; return the manifest."""
        return join_runs(self.path, self._complete(), description)
