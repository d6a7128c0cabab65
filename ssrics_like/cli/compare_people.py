"""``ssrics compare DIR... PEOPLE.csv``: people and models beside each other."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from ssrics_like.cli.options import metres_of

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table

    from ssrics_like.people import Beside

NAME_WIDTH, COLUMN = 42, 22
"""Widths of the columns that name a figure, and of each other one."""
CHOICES = ".csv"
"""How a file of people's choices ends."""


def is_choices(path: Path) -> bool:
    """Tell whether a file is one of people's choices, by its ending."""
    return path.suffix.lower() == CHOICES and not path.is_dir()


def check_choices(given: Sequence[Path]) -> None:
    """Complain of a file in a place where only people's choices could be meant.

    Raises
    ------
    ResultsError
        People's choices stand before a folder, or a file is none of a kind that is known.
    """
    from ssrics_like.errors import ResultsError
    from ssrics_like.library import SUFFIXES

    for path in given[:-1]:
        if is_choices(path):
            raise ResultsError(f"{path}: people's choices are given last, after the folders")
    last = given[-1]
    if last.is_file() and not is_choices(last) and last.suffix not in SUFFIXES:
        raise ResultsError(
            f"{last}: expected a folder of labels, a map's file ending in .yaml, or people's "
            f"choices, a table that ends in {CHOICES} and is given last"
        )


def compare_with_people(
    folders: Sequence[Path],
    choices: Path,
    *,
    radius: Sequence[str],
    locations: str | None,
    bin_m: str | None,
    seed: int | None,
    participants: str | None,
    out: Path | None,
) -> None:
    """Compare results folders, one a model, with people's choices; print, and write to a folder.

    Raises
    ------
    SsricsError
        With one line for each thing that is wrong.
    """
    from rich.console import Console

    from ssrics_like.errors import ResultsError, SettingsError
    from ssrics_like.people import Settings, compare_people, read_folders
    from ssrics_like.people.participants import notes_on
    from ssrics_like.people.settings import BIN_LEAST_M, BIN_M, RADIUS_M, SEED
    from ssrics_like.results.manifest import MANIFEST

    if not folders:
        raise ResultsError(f"compare: name a results folder before {choices}")
    if len(radius) > 1:
        raise SettingsError(
            f"--radius: given {len(radius)} times; expected one radius with people's choices"
        )
    if seed is not None and seed < 0:
        raise SettingsError(f"--seed: {seed}: expected 0 or more")
    settings = Settings(
        radius_m=metres_of("--radius", radius[0]) if radius else RADIUS_M,
        bin_m=metres_of("--bin", bin_m, least=BIN_LEAST_M) if bin_m is not None else BIN_M,
        seed=SEED if seed is None else seed,
    )
    if out is not None and (out / MANIFEST).exists():
        raise ResultsError(
            f"{out}: holds results of runs, with tables of the same names; name another folder"
        )
    if out is not None and out.exists() and not out.is_dir():
        raise ResultsError(f"{out}: is a file, expected a folder")
    read = read_folders(
        folders, choices, _labels(locations), settings.radius_m, participants
    )  # fmt: skip
    made = compare_people(
        read.people, read.models, read.locations, settings,
        clustered=read.clustered, notes=notes_on(read.listed),
    )  # fmt: skip
    console = Console(width=NAME_WIDTH + (COLUMN + 2) * (1 + len(made.models)), highlight=False)
    _print(console, made)
    if out is not None:
        from ssrics_like.people.files import write_people
        from ssrics_like.report.people_page import page_and_figures, sources_of

        for file in write_people(made, sources_of(read), out, page_and_figures(read, made)):
            print(file)


def _labels(locations: str | None) -> str | Path | None:
    """Return the map's file that is meant: itself, an entry of the library, a results folder's.

    Raises
    ------
    SettingsError
        It is none of these.
    """
    from ssrics_like.comparison.folder import MAP
    from ssrics_like.errors import LibraryError, SettingsError
    from ssrics_like.people.folders import CLUSTER
    from ssrics_like.study.reading import map_file

    if locations is None or locations == CLUSTER:
        return locations
    try:
        return map_file(locations)
    except LibraryError as e:
        folder = Path(locations)
        if not folder.is_dir():
            rest = f"; {CLUSTER} finds them from people's marks" if "no map" in str(e) else ""
            raise SettingsError(f"--locations: {e}{rest}") from None
    if not (folder / MAP).is_file():
        raise SettingsError(f"--locations: {folder}: expected a results folder with a {MAP}")
    return folder / MAP


def _print(console: Console, made: Beside) -> None:
    from ssrics_like.people.names import short
    from ssrics_like.report.people_tables import (
        figure_table,
        location_table,
        pair_table,
        people_text,
    )
    from ssrics_like.results.counts import counted

    console.print(
        f"{people_text(made)}; "
        + "; ".join(
            f"{short(model.name)}: {counted(len(model.runs), 'run')}" for model in made.models
        )
        + f"; {len(made.units)} units: {len(made.units.location_of)} locations, "
        f"{len(made.units.bins_m)} bins"
    )
    for listed in (location_table(made), figure_table(made), pair_table(made)):
        if listed.rows:
            headings = [name for name, _ in listed.headings]
            console.print(_table(listed.title, headings, listed.words, listed.plain))
    for note in made.notes:
        console.print(f"note: {note}", soft_wrap=True)


def _table(title: str, headings: Sequence[str], words: int, rows: Sequence[Sequence[str]]) -> Table:
    from rich import box
    from rich.table import Table

    table = Table(title=title, title_justify="left", title_style="bold", box=box.SIMPLE_HEAD,
                  pad_edge=False)  # fmt: skip
    for number, name in enumerate(headings):
        table.add_column(name, justify="left" if number < words else "right", overflow="fold")
    for row in rows:
        table.add_row(*row)
    return table
