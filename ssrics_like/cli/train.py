"""``ssrics train``: what the model knows of doorways and other structure, learned anew."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from ssrics_like.cli.options import Jobs, NeededOut, Quiet, Whole

if TYPE_CHECKING:
    from collections.abc import Callable

    from ssrics_like.cli.train_table import Row
    from ssrics_like.training import StructureTraining, Training, TrainingSettings

What = Literal["doorways", "structure"]
TITLES: dict[What, str] = {
    "doorways": "Doorways, learned in buildings made up at random",
    "structure": "Openings, junctions, corners, hallways, learned in buildings made up at random",
}


def train(
    what: What,
    *,
    out: NeededOut,
    buildings: Whole = 160,
    held_out: Whole = 40,
    seed: Whole = 1,
    repeats: Whole = 1,
    jobs: Jobs = None,
    quiet: Quiet = False,
) -> None:
    """Train a cue that tells doorways, or other structure, from what a robot senses on its way.

    A robot explores buildings made up at random; gradient boosting learns what
    doorways look like there, or openings, junctions, corners and hallways. No data
    from outside are used. It takes some minutes and needs scikit-learn.

    For example:

        ssrics train doorways -o doorways.json
        ssrics train structure -o structure.json --repeats 3

    Parameters
    ----------
    what
        What is learned: doorways or structure.
    out
        The cue, a JSON file. A perception profile names it by `doorways` or `structure`.
    buildings
        How many buildings it learns from.
    held_out
        How many others thresholds are chosen on. Of structure, figures come from as many more.
    seed
        Same seed, same cue.
    repeats
        How many trainings, with this seed and those that follow, to see how much is chance. Those
        that follow are written beside the first, as NAME-SEED.json.
    jobs
        How many drives at the same time; as many as there are cores if left out.
    quiet
        Print nothing but errors.
    """
    from ssrics_like.workers import cores

    settings = _checked(
        {"buildings": buildings, "held_out": held_out, "seed": seed, "repeats": repeats}
    )
    _expect_place(out)
    places = [out, *(out.with_stem(f"{out.stem}-{seed + i}") for i in range(1, settings.repeats))]
    say = (lambda _: None) if quiet else (lambda text: print(text, flush=True))
    learn = _doorways if what == "doorways" else _structure
    seeds, rows = learn(places, settings, cores() if jobs is None else jobs, say)
    if not quiet:
        from rich.console import Console

        from ssrics_like.cli.train_table import table

        Console(width=80, highlight=False).print(table(seeds, rows))
        for place in places:
            print(f"{place}: {place.stat().st_size / 1000:.0f} kB")


def _doorways(
    places: list[Path], settings: TrainingSettings, jobs: int, say: Callable[[str], None]
) -> tuple[list[int], list[Row]]:
    """Train, write each cue, and return the seeds and the figures."""
    from ssrics_like.cli.train_table import doorway_rows
    from ssrics_like.cues import write_cue
    from ssrics_like.training import train_doorways

    trainings: list[Training] = []
    for place, training in zip(places, train_doorways(settings, jobs, say), strict=True):
        source = _source("doorways", settings, training.seed)
        write_cue(place, training.cue, {"title": TITLES["doorways"], "source": source})
        trainings.append(training)
    return [one.seed for one in trainings], doorway_rows(trainings)


def _structure(
    places: list[Path], settings: TrainingSettings, jobs: int, say: Callable[[str], None]
) -> tuple[list[int], list[Row]]:
    """Train, write each cue, and return the seeds and the figures."""
    from ssrics_like.cli.train_table import structure_rows
    from ssrics_like.cues import write_structure_cue
    from ssrics_like.training import train_structure

    trainings: list[StructureTraining] = []
    for place, training in zip(places, train_structure(settings, jobs, say), strict=True):
        source = _source("structure", settings, training.seed) | {"figures": _figures(training)}
        write_structure_cue(place, training.cue, {"title": TITLES["structure"], "source": source})
        trainings.append(training)
    return [one.seed for one in trainings], structure_rows(trainings)


def _checked(wanted: dict[str, int]) -> TrainingSettings:
    from pydantic import ValidationError

    from ssrics_like import settings
    from ssrics_like.errors import SettingsError
    from ssrics_like.training import TrainingSettings

    try:
        return TrainingSettings.model_validate(wanted)
    except ValidationError as e:
        lines = settings.explain(TrainingSettings, e, wanted)
        raise SettingsError("\n".join(f"train: {text}" for _, text in lines)) from None


def _expect_place(out: Path) -> None:
    """Complain of a file that could not be written before minutes go into it."""
    from ssrics_like.errors import CueError

    if out.is_dir():
        raise CueError(f"{out}: is a folder, expected a file for the cue")
    if out.suffix != ".json":
        raise CueError(f"{out}: expected a file's name that ends in .json")
    if not out.parent.is_dir():
        raise CueError(f"{out.parent}: no such folder")


def _source(what: What, settings: TrainingSettings, seed: int) -> dict[str, Any]:
    """Say how a cue was trained, so that it can be trained again."""
    import ssrics_like
    from ssrics_like.training.fitting import learner_version

    return {
        "command": (
            f"ssrics train {what} --buildings {settings.buildings} "
            f"--held-out {settings.held_out} --seed {seed}"
        ),
        "seed": seed,
        "buildings": settings.buildings,
        "held_out": settings.held_out,
        "ssrics-like": ssrics_like.__version__,
        "scikit-learn": learner_version(),
    }


def _figures(training: StructureTraining) -> dict[str, Any]:
    """Return how good a cue is: where thresholds were chosen, and in buildings not yet seen."""

    def share(value: float) -> float | None:
        return None if math.isnan(value) else round(value, 3)

    return {
        where: {
            by: {
                word: {
                    "n": one.told,
                    "recall": share(one.recall),
                    "precision": share(one.precision),
                }
                for word, one in counts.items()
            }
            for by, counts in found.items()
        }
        for where, found in {"held_out": training.held_out, **training.unseen}.items()
    }
