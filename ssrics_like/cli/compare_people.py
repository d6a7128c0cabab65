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

NAME_WIDTH, COLUMN = 30, 22
"""Widths of a table's first column, and of each other one."""
CHOICES = ".csv"


def is_choices(path: Path) -> bool:
    """Tell whether a file is one of people's choices, by its ending."""
    return path.suffix.lower() == CHOICES and not path.is_dir()


def compare_with_people(
    folders: Sequence[Path],
    choices: Path,
    *,
    radius: Sequence[str],
    locations: str | None,
    bin_m: str | None,
    seed: int | None,
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
    from ssrics_like.people.settings import BIN_LEAST_M, BIN_M, RADIUS_M, SEED

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
    if out is not None and out.exists() and not out.is_dir():
        raise ResultsError(f"{out}: is a file, expected a folder")
    read = read_folders(folders, choices, locations, settings.radius_m)
    made = compare_people(
        read.people, read.models, read.locations, settings, clustered=read.clustered
    )
    console = Console(width=NAME_WIDTH + (COLUMN + 2) * (1 + len(made.models)), highlight=False)
    _print(console, made)
    if out is not None:
        from ssrics_like.people.files import write_people
        from ssrics_like.report.people_page import page_and_figures, sources_of

        for file in write_people(made, sources_of(read), out, page_and_figures(read, made)):
            print(file)


def _print(console: Console, made: Beside) -> None:
    from ssrics_like.report.people_tables import figure_table, location_table, pair_table

    console.print(
        f"{len(made.people)} people; "
        + "; ".join(f"{model.name}: {len(model.runs)} runs" for model in made.models)
        + f"; {len(made.units)} units: {len(made.units.location_of)} locations, "
        f"{len(made.units.bins_m)} bins"
    )
    for listed in (location_table(made), figure_table(made), pair_table(made)):
        if listed.rows:
            console.print(_table(listed.title, listed.headings, listed.plain))
    for note in made.notes:
        console.print(f"note: {note}", soft_wrap=True)


def _table(title: str, headings: Sequence[str], rows: Sequence[Sequence[str]]) -> Table:
    from rich import box
    from rich.table import Table

    table = Table(title=title, title_justify="left", title_style="bold", box=box.SIMPLE_HEAD,
                  pad_edge=False)  # fmt: skip
    for number, name in enumerate(headings):
        table.add_column(name, justify="right" if number else "left", overflow="fold")
    for row in rows:
        table.add_row(*row)
    return table
