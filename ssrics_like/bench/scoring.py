"""The marks of a candidate on one drive, scored as docs/scoring.md has it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.comparison import Drive, Marks, Tally, score_runs
from ssrics_like.comparison.chance import DRAWS

if TYPE_CHECKING:
    from ssrics_like.bench.drives import BenchDrive
    from ssrics_like.designators import Mark

CHANCE_STREAM = 3
"""Keeps the marks that know nothing apart from whatever else is drawn with a drive's seed."""


@dataclass(frozen=True)
class Result:
    """What a candidate reached on one drive.

    Attributes
    ----------
    tally : Tally
        Counts.
    found : tuple of bool
        Which designated place was found.
    """

    tally: Tally
    found: tuple[bool, ...]


def score_marks(
    drive: BenchDrive, marks: Sequence[Mark], radius_m: float, seed: int = 0, draws: int = DRAWS
) -> Result:
    """Score marks on a drive.

    Parameters
    ----------
    drive : BenchDrive
        The drive and its truth.
    marks : sequence of Mark
        In any order.
    radius_m : float
        How near a mark has to lie.
    seed, draws : int
        Of the marks that know nothing.
    """
    ordered = sorted(marks, key=lambda mark: (mark.scan, mark.decided_scan))
    scans = np.array([mark.scan for mark in ordered], np.int64)
    decided = np.array([mark.decided_scan for mark in ordered], np.int64)
    way = drive.way
    placed = Marks.of(way.xy_m[scans], way.along_m[scans], way.along_m[decided])
    scores = score_runs(
        [Drive(way, placed, drive.passages)],
        drive.locations,
        radius_m,
        np.random.default_rng([seed, CHANCE_STREAM]),
        draws,
        drive.designated,
    )
    found = scores.found[0][drive.designated]
    return Result(scores.pooled, tuple(found.tolist()))
