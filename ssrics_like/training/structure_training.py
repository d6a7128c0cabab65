"""A whole training of structure: examples, trees for each kind, thresholds, figures."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.perception.structure import KINDS, Kind, StructureCue
from ssrics_like.training.fitting import Size, grown, learner
from ssrics_like.training.labels import LEFT_OUT
from ssrics_like.training.making import Say, made
from ssrics_like.training.structure_examples import Asked, structure_example
from ssrics_like.training.structure_labels import LIES, structure_labels
from ssrics_like.training.structure_scoring import (
    Counts,
    choose_thresholds,
    figures,
    scored,
)
from ssrics_like.training.training import HELD_OUT, TRAINING

if TYPE_CHECKING:
    from ssrics_like.perception.trees import BoostedTrees
    from ssrics_like.training.settings import TrainingSettings
    from ssrics_like.training.structure_examples import StructureExample

UNSEEN = 2
"""First number of the spawn keys of drives that decide about nothing; see `TRAINING`."""
SIZE = Size(trees=100, leaves=16, rate=0.1)
"""Ours: half as much for each kind as for doorways, there being four."""
BUILDINGS = ("cluttered", "plain", "plain")
"""One building of three is as those that doorways are learned in, the others are as the generator
furnishes them by default: where clutter hides the walls, there is little to learn of them."""

Figures = dict[str, dict[str, Counts]]


@dataclass(frozen=True, eq=False)
class StructureTraining:
    """What came of a training.

    Attributes
    ----------
    seed : int
        Its seed.
    cue : StructureCue
        What was learned.
    places : int
        Places that were learned from.
    held_out : dict
        What the cue does in the buildings that its thresholds were chosen on; see `figures`.
    unseen : dict
        The same for cluttered and for plain buildings, in buildings that decided about nothing.
    """

    seed: int
    cue: StructureCue
    places: int
    held_out: Figures
    unseen: dict[str, Figures]


def train_structure(
    settings: TrainingSettings, jobs: int = 1, say: Say = lambda _: None
) -> Iterator[StructureTraining]:
    """Train the structure cue.

    Parameters
    ----------
    settings : TrainingSettings
        How much; as many buildings as thresholds are chosen on are driven through once more for
        figures alone.
    jobs : int
        How many drives, or threads, at the same time; it makes no difference to the result.
    say : callable
        Is told how far it is, a line at a time.

    Yields
    ------
    StructureTraining
        One a repeat, as soon as it is there.

    Raises
    ------
    MissingPackageError
        scikit-learn is not installed.
    SettingsError
        No drive to learn from, or none of the held-out ones, led past an opening, a junction or a
        corner.
    ResultsError
        A worker process died.
    """
    learner()  # before the drives, which take long
    for repeat in range(settings.repeats):
        yield _trained(settings, settings.seed + repeat, jobs, say)


def _trained(settings: TrainingSettings, seed: int, jobs: int, say: Say) -> StructureTraining:
    learned = _examples("training", TRAINING, settings.buildings, seed, jobs, say)
    trees, places = _grown(learned, seed, jobs, say)
    del learned
    held_out = [
        scored(trees, one)
        for one in _examples("held-out", HELD_OUT, settings.held_out, seed, jobs, say)
    ]
    cue = StructureCue(trees, choose_thresholds(held_out))
    unseen = [
        scored(trees, one)
        for one in _examples("unseen", UNSEEN, settings.held_out, seed, jobs, say)
    ]
    parts = {
        name: [one for i, one in enumerate(unseen) if BUILDINGS[i % len(BUILDINGS)] == name]
        for name in dict.fromkeys(BUILDINGS)
    }
    return StructureTraining(
        seed, cue, places, figures(cue, held_out),
        {name: figures(cue, part) for name, part in parts.items()},
    )  # fmt: skip


def _grown(
    learned: list[StructureExample], seed: int, jobs: int, say: Say
) -> tuple[dict[Kind, BoostedTrees], int]:
    """Grow trees for each kind, and count the places."""
    measures = np.concatenate([one.example.measures for one in learned])
    told = np.concatenate([structure_labels(one) for one in learned])
    trees: dict[Kind, BoostedTrees] = {}
    for column, kind in enumerate(KINDS):
        used = told[:, column] != LEFT_OUT
        say(f"seed {seed}: growing trees for {kind} on {used.sum()} places")
        trees[kind] = grown(measures[used], told[used, column], seed, jobs, SIZE, LIES[kind])
    return trees, len(told)


def _examples(
    what: str, kind: int, count: int, seed: int, jobs: int, say: Say
) -> list[StructureExample]:
    asked = [
        Asked(
            np.random.SeedSequence(seed, spawn_key=(kind, number)),
            BUILDINGS[number % len(BUILDINGS)] == "cluttered",
        )
        for number in range(count)
    ]
    return made(what, structure_example, asked, seed, jobs, say)
