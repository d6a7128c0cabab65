"""Where the runs of a scenario take their memory from: a file, or the runs of a results folder."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from ssrics_like.errors import MemoryFileError
from ssrics_like.memory import SavedMemory
from ssrics_like.memory.files import read_whole
from ssrics_like.memory.home import HOME, UNKNOWN
from ssrics_like.memory.saved_file import memory_from

FOLDER = "memory"
"""Where a results folder keeps the memories of its runs."""
_RUN_FILE = re.compile(r"run-(\d{3,})\.json")


@dataclass(frozen=True)
class Remembered:
    """The memory that one run begins with.

    Attributes
    ----------
    file, sha256 : str
        Name and digest of the file that it was read from.
    memory : SavedMemory
        Aged by the pause between the two.
    """

    file: str
    sha256: str
    memory: SavedMemory

    def as_data(self) -> dict[str, Any]:
        """Return what the manifest says of it."""
        return {"file": self.file, "sha256": self.sha256}


@dataclass(frozen=True)
class Recollection:
    """What all runs of a scenario begin with.

    Attributes
    ----------
    path : Path
        The file or results folder.
    sha256 : str
        Of the file; of the names and digests of all memories of the folder, one a line.
    pause_s : float
        Seconds that have passed since.
    at_home : bool
        Whether each run begins where the first run of its memory began.
    by_run : mapping of int to Remembered
        What each run begins with.
    """

    path: Path
    sha256: str
    pause_s: float
    at_home: bool
    by_run: Mapping[int, Remembered]

    def as_data(self) -> dict[str, Any]:
        """Return what decides the results, for the manifest; the number of runs does not."""
        return {
            "name": self.path.resolve().name,
            "sha256": self.sha256,
            "pause_s": self.pause_s,
            "start": HOME if self.at_home else UNKNOWN,
        }

    def of_run(self, run: int) -> Recollection:
        """Return what one run needs of it."""
        return replace(self, by_run={run: self.by_run[run]})

    def check_views(self, numbers: int) -> None:
        """Check that views of so many numbers can be compared with those remembered.

        Raises
        ------
        MemoryFileError
            If they have another length.
        """
        self._check(lambda memory: memory.check_views(numbers))

    def check_frame(self, frame: str) -> None:
        """Check that positions in a frame can be compared with those remembered.

        Raises
        ------
        MemoryFileError
            If they are in another frame.
        """
        self._check(lambda memory: memory.check_frame(frame))

    def _check(self, check: Callable[[SavedMemory], None]) -> None:
        for each in self.by_run.values():
            file = self.path / FOLDER / each.file if self.path.is_dir() else self.path
            try:
                check(each.memory)
            except ValueError as error:
                raise MemoryFileError(f"{file}: {error}") from None


def recollect(path: Path, runs: int, pause_s: float, *, at_home: bool = False) -> Recollection:
    """Read what the runs of a scenario begin with.

    Parameters
    ----------
    path : Path
        A file, for all runs; or a results folder: of one run, for all; of several, each run
        begins with what the run of its number has left.
    runs : int
        How many runs there are to be.
    pause_s : float
        Seconds that have passed since.
    at_home : bool
        Whether each run begins where the first run of its memory began.

    Raises
    ------
    MemoryFileError
        If there is nothing, or it cannot be read, or a run is missing, or a home that is needed.
    """
    files = memory_files(path)
    content = {number: read_whole(file) for number, file in files.items()}
    digests = {number: hashlib.sha256(data).hexdigest() for number, data in content.items()}

    def remembered(number: int) -> Remembered:
        memory = memory_from(files[number], content[number])
        if at_home and memory.home is None:
            raise MemoryFileError(
                f"{files[number]}: remembers no home, which memory_start: {HOME} needs: where a "
                "first run began that marked a landmark"
            )
        return Remembered(files[number].name, digests[number], memory.aged(pause_s))

    if len(files) == 1:
        (only,) = files
        return Recollection(
            path, digests[only], pause_s, at_home, dict.fromkeys(range(runs), remembered(only))
        )
    missing = next((number for number in range(runs) if number not in files), None)
    if missing is not None:
        first = files[min(files)]
        raise MemoryFileError(
            f"{path}: holds the memories of {len(files)} runs, but none of run {missing}; "
            f"name the file that all runs shall begin with, for example {first}"
        )
    listed = "".join(f"{files[number].name} {digests[number]}\n" for number in sorted(files))
    digest = hashlib.sha256(listed.encode()).hexdigest()
    by_run = {number: remembered(number) for number in range(runs)}
    return Recollection(path, digest, pause_s, at_home, by_run)


def memory_files(path: Path) -> dict[int, Path]:
    """Return the files of memory that a path stands for, by run; a file stands for itself.

    Raises
    ------
    MemoryFileError
        If there is nothing there, or a folder without memories.
    """
    if not path.exists():
        raise MemoryFileError(f"{path}: no such file or folder")
    if not path.is_dir():
        return {0: path}
    found = {
        int(match[1]): file
        for file in sorted((path / FOLDER).glob("run-*.json"))
        if (match := _RUN_FILE.fullmatch(file.name))
    }
    if not found:
        raise MemoryFileError(
            f"{path}: holds no memory ({FOLDER}/run-NNN.json, as ssrics run writes it)"
        )
    return found


def one_memory_file(path: Path) -> Path:
    """Return the one file of memory that a path stands for.

    Raises
    ------
    MemoryFileError
        As `memory_files`; or there are several.
    """
    files = memory_files(path)
    if len(files) > 1:
        raise MemoryFileError(
            f"{path}: holds the memories of {len(files)} runs; name one, for example "
            f"{files[min(files)]}"
        )
    (file,) = files.values()
    return file
