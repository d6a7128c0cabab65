"""Who took part in a study, so that whoever marked nothing is counted, too.

A table of choices has no row for them. Without them the shares of people who marked a location
would be too large.
"""

from __future__ import annotations

import csv
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from ssrics_like.errors import MapError
from ssrics_like.maps.tables import Table
from ssrics_like.people.names import in_a_row

BESIDE = "participants.csv"
"""The list that ``ssrics study export`` writes beside the choices."""
NONE = "none"
"""Instead of a file: nobody is counted but who has choices."""
UNKNOWN = (
    "No list of participants was read: whoever marked nothing is not counted, and shares of people "
    "may be too large."
)
COLUMNS = ("participant", "finished")


@dataclass(frozen=True, slots=True)
class Listed:
    """Who took part, as a list says.

    Attributes
    ----------
    file : Path
        The list.
    silent : tuple of str
        Who finished and has no choices.
    unfinished : int
        How many neither finished nor have choices; they are not counted.
    """

    file: Path
    silent: tuple[str, ...]
    unfinished: int


def list_beside(choices: Path) -> Path | None:
    """Return the list of a study's participants in the folder of the choices, if there is one.

    A file of that name without the columns of such a list is another's, and passed over.
    """
    file = choices.parent / BESIDE
    try:
        with file.open(encoding="utf-8-sig", newline="") as lines:
            header = next(csv.reader(lines), [])
    except (OSError, ValueError, csv.Error):
        return None
    return file if set(COLUMNS) <= {name.strip() for name in header} else None


def read_participants(file: Path, choices: Path, choosing: Iterable[str]) -> Listed:
    """Read who took part, and tell who has no choices.

    Parameters
    ----------
    file : Path
        CSV file with the columns ``participant`` and ``finished``, which is empty for whoever did
        not do the whole study; others are passed over.
    choices : Path
        The table of choices, to be named in a complaint.
    choosing : iterable of str
        Who has choices.

    Raises
    ------
    MapError
        With one line for each thing that is wrong.
    """
    table = Table(file, COLUMNS, ())
    listed: dict[str, bool] = {}
    for line, cells in table.rows:
        name = table.word(line, cells, "participant")
        if name and name in listed:
            table.problems.append(f"{file}:{line}: participant '{name}' stands twice")
        listed[name] = bool(cells["finished"])
    table.finish()
    known = set(choosing)
    strangers = sorted(known - set(listed))
    if strangers:
        raise MapError(
            f"{file}: does not list {in_a_row(strangers)} of {choices}, expected everybody who has "
            f"choices; --participants names another list, or {NONE}"
        )
    silent = tuple(name for name, done in listed.items() if done and name not in known)
    unfinished = sum(not done and name not in known for name, done in listed.items())
    return Listed(file, silent, unfinished)


def notes_on(listed: Listed | None) -> tuple[str, ...]:
    """Say who was counted, and who was not."""
    if listed is None:
        return (UNKNOWN,)
    notes = []
    if listed.silent:
        notes.append(
            f"{in_a_row(listed.silent)} finished the study and marked nothing "
            f"({listed.file.name}); they are counted."
        )
    if listed.unfinished:
        notes.append(
            f"Not counted: {listed.unfinished} who marked nothing and did not finish the study "
            f"({listed.file.name})."
        )
    return tuple(notes)
