"""``ssrics train``: what the model knows of doorways, learned anew."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from ssrics_like.cli.options import Jobs, NeededOut, Quiet, Whole

if TYPE_CHECKING:
    from rich.table import Table

    from ssrics_like.training import Training, TrainingSettings

TITLE = "Doorways, learned in buildings made up at random"


def train(
    what: Literal["doorways"],
    *,
    out: NeededOut,
    buildings: Whole = 160,
    held_out: Whole = 40,
    seed: Whole = 1,
    repeats: Whole = 1,
    jobs: Jobs = None,
    quiet: Quiet = False,
) -> None:
    """Train a cue that tells doorways from what a robot senses on its way.

    A robot explores buildings made up at random; gradient boosting learns what
    doorways look like there. No data from outside are used. It takes some minutes
    and needs scikit-learn.

    For example:

        ssrics train doorways -o doorways.json
        ssrics train doorways -o doorways.json --repeats 3

    Parameters
    ----------
    what
        What is learned: doorways.
    out
        The cue, a JSON file. A perception profile names it by `doorways`.
    buildings
        How many buildings it learns from.
    held_out
        How many others the threshold is chosen on.
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
    from ssrics_like.cues import write_cue
    from ssrics_like.scenarios.pool import cores
    from ssrics_like.training import train_doorways

    settings = _checked(
        {"buildings": buildings, "held_out": held_out, "seed": seed, "repeats": repeats}
    )
    _expect_place(out)
    places = [out, *(out.with_stem(f"{out.stem}-{seed + i}") for i in range(1, settings.repeats))]
    say = (lambda _: None) if quiet else (lambda text: print(text, flush=True))
    trainings: list[Training] = []
    made = train_doorways(settings, cores() if jobs is None else jobs, say)
    for place, training in zip(places, made, strict=True):
        about = {"title": TITLE, "source": _source(what, settings, training.seed)}
        write_cue(place, training.cue, about)
        trainings.append(training)
    if not quiet:
        from rich.console import Console

        Console(width=80, highlight=False).print(_table(trainings))
        for place in places:
            print(f"{place}: {place.stat().st_size / 1000:.0f} kB")


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


def _source(what: str, settings: TrainingSettings, seed: int) -> dict[str, str | int]:
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


def _table(trainings: Sequence[Training]) -> Table:
    """Return a column for each training; of several their mean and spread too."""
    import statistics

    from rich import box
    from rich.table import Table

    table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    table.add_column("", no_wrap=True)
    for one in trainings:
        table.add_column(f"seed {one.seed}", justify="right")
    if len(trainings) > 1:
        table.add_column("mean", justify="right")
        table.add_column("spread", justify="right")
    rows: list[tuple[str, str, list[float]]] = [
        ("places learned from", ".0f", [one.places for one in trainings]),
        ("  in doorways", ".1%", [one.positive for one in trainings]),
        ("threshold", ".2f", [one.cue.threshold for one in trainings]),
        ("held out: passages", ".0f", [one.held_out.passages for one in trainings]),
        ("  found (recall)", ".3f", [one.held_out.pass_recall for one in trainings]),
        ("  marks at a label (precision)", ".3f", [one.held_out.precision for one in trainings]),
        ("  F", ".3f", [one.held_out.f for one in trainings]),
    ]
    for name, form, values in rows:
        cells = [*values]
        if len(values) > 1:
            cells += [statistics.mean(values), statistics.stdev(values)]
        table.add_row(name, *(format(value, form) for value in cells))
    return table
