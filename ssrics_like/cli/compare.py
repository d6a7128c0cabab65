"""``ssrics compare``: marks against what people labelled, or against what each of them marked."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from ssrics_like.cli.compare_people import check_choices, compare_with_people, is_choices
from ssrics_like.cli.options import Bin, Out, Radii, Whole, metres_of

if TYPE_CHECKING:
    from rich.table import Table

    from ssrics_like.comparison import Compared, Scores

COLUMN = 13
"""Width of a table's column; a terminal of 80 characters has room for four of them."""
FIGURES_WIDTH = 26


def compare(
    *folders: Path,
    radius: Radii = (),
    locations: str | None = None,
    bin_m: Bin = None,
    seed: Whole | None = None,
    participants: str | None = None,
    out: Out = None,
) -> None:
    """Compare the marks of results folders with labelled places, or with people's choices.

    For example:

        ssrics compare out/
        ssrics compare out/ truth/intel_lab -o compared/
        ssrics compare onset/ peak/ maps/office.yaml --radius 1
        ssrics compare model-a/ model-b/ people.csv -o compared/

    Parameters
    ----------
    folders
        Results folders that run or replay has written, and last what was labelled: a folder with
        truth.csv, crossings.csv and poses.csv, or a map's YAML file. If that is left out, the
        locations of the map that the runs were made on. Or last a CSV file of people's choices
        (participant,landmark,x_m,y_m): then people and models are compared with one another.
    radius
        How near a mark has to lie, metres; may be given again. 0.5, 1, 1.5 and 2 if left out; with
        people's choices one only, 1 if left out.
    locations
        With people's choices: what labels the locations, which is an entry of scenarios/maps, a
        map's YAML file or a results folder; or cluster to find them from people's marks. The
        locations of the runs' map if left out.
    bin_m
        With people's choices: length of the bins that the route is cut in, metres; 1 if left out.
    seed
        With people's choices: of the draws that intervals are made of; 1 if left out.
    participants
        With people's choices: a CSV file of who took part (participant,finished), so that whoever
        marked nothing is counted; or none. The participants.csv beside the choices, as study export
        writes it, if left out.
    out
        Folder for comparison.csv, .json and .svg, and for tables of what became of each mark,
        place and passage; with people's choices for comparison.html, tables and figures.
    """
    from rich.console import Console

    from ssrics_like.comparison import compare_folder, truth_at, write_comparison
    from ssrics_like.comparison.compared import RADII_M
    from ssrics_like.errors import ResultsError, SettingsError

    if not folders:
        raise ResultsError("compare: name a results folder, and what was labelled after it")
    check_choices(folders)
    if is_choices(folders[-1]):
        compare_with_people(
            folders[:-1], folders[-1],
            radius=radius, locations=locations, bin_m=bin_m, seed=seed, participants=participants,
            out=out,
        )  # fmt: skip
        return
    for name, value in (
        ("--locations", locations), ("--bin", bin_m), ("--seed", seed),
        ("--participants", participants),
    ):  # fmt: skip
        if value is not None:
            raise SettingsError(
                f"{name}: goes with people's choices only; expected a .csv file after the folders"
            )
    radii_m = sorted({metres_of("--radius", text) for text in radius}) or RADII_M
    truth = truth_at(folders[-1])
    chosen = folders if truth is None else folders[:-1]
    if not chosen:
        raise ResultsError(f"compare: name a results folder before {folders[-1]}")
    made = [compare_folder(folder, truth, radii_m) for folder in chosen]
    tables = _tables(made)
    columns = max(len(table.columns) for table in tables) - 1
    console = Console(width=FIGURES_WIDTH + (COLUMN + 2) * columns, highlight=False)
    for table in tables:
        console.print(table)
    if out is not None:
        from ssrics_like.report import comparison_svg

        for file in write_comparison(made, out, comparison_svg(made)):
            print(file)


def _tables(made: Sequence[Compared]) -> list[Table]:
    """Return a table with a column for each radius; of several folders one a radius instead."""
    from ssrics_like.comparison.compared_files import labels_name

    if len(made) == 1:
        one = made[0]
        title = f"{one.records.folder} against {labels_name(one)}"
        return [_table(title, [(f"{s.radius_m:g} m", s) for s in one.scores])]
    names = [one.records.folder.name for one in made]
    if len(set(names)) < len(names):
        names = [str(one.records.folder) for one in made]
    return [
        _table(
            f"within {scores.radius_m:g} m",
            [(name, one.scores[i]) for name, one in zip(names, made, strict=True)],
        )
        for i, scores in enumerate(made[0].scores)
    ]


def _table(title: str, columns: list[tuple[str, Scores]]) -> Table:
    from rich import box
    from rich.table import Table

    table = Table(title=title, title_justify="left", title_style="bold", box=box.SIMPLE_HEAD,
                  pad_edge=False)  # fmt: skip
    table.add_column("", no_wrap=True)
    for name, _ in columns:
        table.add_column(name, justify="right", min_width=COLUMN, overflow="fold")
    cells = [_cells(scores) for _, scores in columns]
    for row, line in enumerate(cells[0]):
        name, _, ends = line
        table.add_row(name, *(column[row][1] for column in cells), end_section=ends)
    return table


def _cells(scores: Scores) -> list[tuple[str, str, bool]]:
    """Return each figure: what it is, how much, and whether a part of the table ends with it."""
    from ssrics_like.report.words import figure_text, interval_text, percent_text

    pooled = scores.pooled
    figures = pooled.figures()

    def share(name: str) -> str:
        return percent_text(figures[name])

    def plain(name: str) -> str:
        return figure_text(figures[name])

    return [
        ("passages found", f"{pooled.passed} of {pooled.passages}", False),
        ("  pass recall", share("pass_recall"), False),
        ("  95 % interval", interval_text(pooled.pass_interval), False),
        ("  by chance", share("pass_chance"), False),
        ("  by a clock", share("pass_clock"), False),
        ("  above chance", share("corrected_pass_recall"), True),
        ("places found", f"{pooled.found} of {pooled.designated}", False),
        ("  place recall", share("recall"), False),
        ("  95 % interval", interval_text(pooled.interval), False),
        ("  by chance", share("chance"), False),
        ("  by a clock", share("clock"), False),
        ("  above chance", share("corrected_recall"), True),
        ("marks at a label", f"{pooled.right} of {pooled.merged}", False),
        ("  precision", share("precision"), False),
        ("  by chance", share("precision_chance"), False),
        ("  by a clock", share("precision_clock"), True),
        ("F, passages", plain("f"), False),
        ("  by chance", plain("f_chance"), False),
        ("  by a clock", plain("f_clock"), False),
        ("F, places", plain("f_place"), False),
        ("  by chance", plain("f_place_chance"), False),
        ("  by a clock", plain("f_place_clock"), True),
        ("marks per 100 m", figure_text(pooled.marks_per_100_m, 1), False),
        ("duplicates per place", plain("duplicates"), False),
        ("delay of decisions, m", plain("delay_m"), False),
        ("consistency of runs", figure_text(scores.consistency), False),
    ]
