"""A whole training: examples, trees, threshold."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.perception.doorways import DoorwayCue
from ssrics_like.training.examples import Example, example
from ssrics_like.training.fitting import grown, learner
from ssrics_like.training.labels import DOORWAY, LEFT_OUT, labels
from ssrics_like.training.making import Say, made
from ssrics_like.training.threshold import choose_threshold

if TYPE_CHECKING:
    from ssrics_like.comparison.tally import Tally
    from ssrics_like.training.settings import TrainingSettings

TRAINING, HELD_OUT = 0, 1
"""First number of an example's spawn key, so that the two kinds never share a building."""


@dataclass(frozen=True, eq=False)
class Training:
    """What came of a training.

    Attributes
    ----------
    seed : int
        Its seed.
    cue : DoorwayCue
        What was learned.
    places : int
        Places that were learned from.
    positive : float
        Share of these that lie in doorways.
    held_out : Tally
        What the cue does in the buildings that its threshold was chosen on.
    """

    seed: int
    cue: DoorwayCue
    places: int
    positive: float
    held_out: Tally


def train_doorways(
    settings: TrainingSettings, jobs: int = 1, say: Say = lambda _: None
) -> Iterator[Training]:
    """Train the doorway cue.

    Parameters
    ----------
    settings : TrainingSettings
        How much.
    jobs : int
        How many drives, or threads, at the same time; it makes no difference to the result.
    say : callable
        Is told how far it is, a line at a time.

    Yields
    ------
    Training
        One a repeat, as soon as it is there.

    Raises
    ------
    MissingPackageError
        scikit-learn is not installed.
    SettingsError
        No drive led through a doorway.
    ResultsError
        A worker process died.
    """
    learner()  # before the drives, which take long
    for repeat in range(settings.repeats):
        yield _trained(settings, settings.seed + repeat, jobs, say)


def _trained(settings: TrainingSettings, seed: int, jobs: int, say: Say) -> Training:
    learned = _examples("training", TRAINING, settings.buildings, seed, jobs, say)
    measures = np.concatenate([one.measures for one in learned])
    told = np.concatenate([labels(one) for one in learned])
    del learned  # the measures are most of the memory, and stand here twice
    used = told != LEFT_OUT
    measures, told = measures[used], told[used]
    say(f"seed {seed}: growing trees on {len(told)} places")
    trees = grown(measures, told, seed, jobs)
    held_out = _examples("held-out", HELD_OUT, settings.held_out, seed, jobs, say)
    threshold, found = choose_threshold(trees, held_out)
    say(
        f"seed {seed}: threshold {threshold:.2f}, recall {found.pass_recall:.3f}, "
        f"precision {found.precision:.3f}, F {found.f:.3f}"
    )
    positive = float(np.mean(told == DOORWAY))
    return Training(seed, DoorwayCue(trees, threshold), len(told), positive, found)


def _examples(what: str, kind: int, count: int, seed: int, jobs: int, say: Say) -> list[Example]:
    seeds = [np.random.SeedSequence(seed, spawn_key=(kind, number)) for number in range(count)]
    return made(what, example, seeds, seed, jobs, say)
