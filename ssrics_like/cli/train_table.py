"""The tables that ``ssrics train`` prints: a column for each training, then mean and spread."""

from __future__ import annotations

import statistics
from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.table import Table

    from ssrics_like.training import StructureTraining, Training
    from ssrics_like.training.structure_scoring import Counts

Row = tuple[str, str, list[float]]


def doorway_rows(trainings: Sequence[Training]) -> list[Row]:
    """Return name, format and values of each figure."""
    return [
        ("places learned from", ".0f", [one.places for one in trainings]),
        ("  in doorways", ".1%", [one.positive for one in trainings]),
        ("threshold", ".2f", [one.cue.threshold for one in trainings]),
        ("held out: passages", ".0f", [one.held_out.passages for one in trainings]),
        ("  found (recall)", ".3f", [one.held_out.pass_recall for one in trainings]),
        ("  marks at a label (precision)", ".3f", [one.held_out.precision for one in trainings]),
        ("  F", ".3f", [one.held_out.f for one in trainings]),
    ]


def structure_rows(trainings: Sequence[StructureTraining]) -> list[Row]:
    """Return name, format and values of each figure."""
    from ssrics_like.perception.structure import KINDS, SPOTS

    rows: list[Row] = [("places learned from", ".0f", [one.places for one in trainings])]
    rows += [
        (f"threshold: {kind}", ".2f", [one.cue.thresholds[kind] for one in trainings])
        for kind in KINDS
    ]
    for name in trainings[0].unseen:
        for kind in SPOTS:
            counts = [one.unseen[name]["passages"][kind] for one in trainings]
            rows.append((f"{name}, {kind}: passages", ".0f", [one.told for one in counts]))
            rows += _shares("  found (recall)", counts)
        for word in ("corridor", "room"):
            counts = [one.unseen[name]["places"][word] for one in trainings]
            rows.append((f"{name}, {word}: places", ".0f", [one.told for one in counts]))
            rows += _shares("  called so (recall)", counts)
    return rows


def _shares(recall: str, counts: Sequence[Counts]) -> list[Row]:
    return [
        (recall, ".3f", [one.recall for one in counts]),
        ("  of what is called so (precision)", ".3f", [one.precision for one in counts]),
        ("  F", ".3f", [one.f for one in counts]),
    ]


def table(seeds: Sequence[int], rows: Sequence[Row]) -> Table:
    """Return a table with a column for each seed; of several their mean and spread too."""
    from rich import box
    from rich.table import Table

    drawn = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    drawn.add_column("", no_wrap=True)
    for seed in seeds:
        drawn.add_column(f"seed {seed}", justify="right")
    if len(seeds) > 1:
        drawn.add_column("mean", justify="right")
        drawn.add_column("spread", justify="right")
    for name, form, values in rows:
        cells = [*values]
        if len(values) > 1:
            cells += [statistics.mean(values), statistics.stdev(values)]
        drawn.add_row(name, *(format(value, form) for value in cells))
    return drawn
