"""``ssrics bench``: every designator on the same drives, with chance beside each."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from ssrics_like.cli.options import Flag, Jobs, Out, Quiet, Whole

if TYPE_CHECKING:
    from rich.table import Table

    from ssrics_like.bench import Bench, BenchSettings
    from ssrics_like.bench.running import Say
    from ssrics_like.bench.tuned import Tuned

COLUMN, NAMES = 12, 22


def bench(
    what: Literal["designators"],  # noqa: ARG001 - so far there is one thing to choose
    *,
    out: Out = None,
    maps: tuple[Path, ...] = (),
    log: tuple[tuple[Path, Path], ...] = (),
    only: tuple[str, ...] = (),
    courses: tuple[str, ...] = (),
    seeds: Whole | None = None,
    tuning: Whole | None = None,
    tuned: Path | None = None,
    radius: float = 1.0,
    quick: Flag = False,
    jobs: Jobs = None,
    quiet: Quiet = False,
) -> None:
    """Compare all designators, and the whole model, on the same drives.

    Buildings made up at random under nominal and hard conditions, floor plans and logs if
    they are given, and curves over noise, dropouts, scan rate and speed. Settings are tuned
    in buildings of their own first.

    For example:

        ssrics bench designators --quick
        ssrics bench designators -o bench/ --maps plans/* --log robot.log truth/robot
        ssrics bench designators --tuned bench/tuned.json --courses false-gaps people

    Parameters
    ----------
    what
        What is compared: designators.
    out
        Folder for designators.csv, .json and .md, curves.svg and tuned.json.
    maps
        Folders with map_furnished.yaml and doors.csv, the course plans.
    log
        A log, and the folder of its labels (truth.csv, crossings.csv, poses.csv); may be given
        again.
    only
        Names of candidates: designators, or PERCEPTION+PRODUCTIONS of the library.
    courses
        Names of courses and curves.
    seeds
        How many buildings a course has, and how many drives a plan; 20 if left out.
    tuning
        How many drives settings are tuned on; 11 if left out.
    tuned
        tuned.json of an earlier run, instead of tuning anew.
    radius
        How near a mark has to lie, metres.
    quick
        Few seeds, for a look.
    jobs
        How many drives at the same time; as many as there are cores if left out.
    quiet
        Say nothing of the progress.
    """
    from ssrics_like.bench.candidates import TRAINED, chosen_names, make_candidates
    from ssrics_like.bench.courses import make_courses
    from ssrics_like.bench.curves import curves_svg
    from ssrics_like.bench.outputs import write_bench
    from ssrics_like.bench.running import run_bench
    from ssrics_like.errors import SettingsError
    from ssrics_like.workers import cores

    if tuned is not None and tuning is not None:
        raise SettingsError("--tuning tunes anew, --tuned does not: one of them")
    names = chosen_names(only)
    settings = _settings(seeds, tuning, radius, quick)
    chosen, notes = make_courses(settings, maps=maps, logs=log, chosen=courses)
    _expect_folder(out)
    for one in make_candidates(names, {}):  # what is missing should show before hours of work
        if one.name != TRAINED:
            one.make(0, "odometry")
    say: Say = (lambda _: None) if quiet else (lambda text: print(text, flush=True))
    for note in notes:
        say(note)
    workers = cores() if jobs is None else jobs
    found, given = _tuned(names, settings, tuned, workers, say)
    settings = settings.model_copy(update={"tuning": found.tuning, "training": found.training})
    candidates = make_candidates(names, given)
    made = run_bench(settings, candidates, chosen, workers, say)
    _print(made)
    if out is not None:
        for file in write_bench(made, found, out, curves_svg(made), notes):
            print(file)


def _settings(seeds: int | None, tuning: int | None, radius_m: float, quick: bool) -> BenchSettings:
    from pydantic import ValidationError

    from ssrics_like.bench import settings as sizes
    from ssrics_like.errors import SettingsError

    values = {
        "seeds": sizes.QUICK_SEEDS if quick else sizes.SEEDS,
        "tuning": sizes.QUICK_TUNING if quick else sizes.TUNING,
        "training": sizes.QUICK_TRAINING if quick else sizes.TRAINING,
        "radius_m": radius_m,
    }
    values |= {} if seeds is None else {"seeds": seeds}
    values |= {} if tuning is None else {"tuning": tuning}
    if quick:
        values["sweep_seeds"] = 1
    try:
        return sizes.BenchSettings.model_validate(values)
    except ValidationError as e:
        lines = [
            f"--{str(one['loc'][0]).removesuffix('_m')}: {one['input']}: {one['msg'].lower()}"
            for one in e.errors()
        ]
        raise SettingsError("\n".join(lines)) from None


def _tuned(
    names: Sequence[str], settings: BenchSettings, file: Path | None, jobs: int, say: Say
) -> tuple[Tuned, dict[str, dict[str, object]]]:
    """Read or make what is tuned; return it, and the settings of each designator."""
    from ssrics_like.bench.candidates import TRAINED
    from ssrics_like.bench.tuned import read_tuned
    from ssrics_like.bench.tuning import trained_model, tune_designators

    read = None if file is None else read_tuned(file, names)
    model = None
    if TRAINED in names:
        count = settings.training if read is None else read.training
        say(f"training {TRAINED} on {count} drives")
        model = trained_model(count, jobs)
    found = tune_designators(names, settings, jobs, model, say) if read is None else read
    given = {name: dict(one.settings) for name, one in found.designators.items()}
    if model is not None:
        given[TRAINED]["model"] = model
    return found, given


def _expect_folder(out: Path | None) -> None:
    """Complain before hours of work rather than after them."""
    from ssrics_like.errors import ResultsError

    if out is not None and out.exists() and not out.is_dir():
        raise ResultsError(f"{out}: is a file, expected a folder")


def _print(made: Bench) -> None:
    from rich.console import Console

    from ssrics_like.bench.words import course_table, summary_table
    from ssrics_like.results.counts import counted

    console = Console(width=NAMES + (COLUMN + 2) * 14, highlight=False, markup=False)
    radius = f"within {made.settings.radius_m:g} m"
    table = [course for course in made.courses if not course.sweep]
    for course in table:
        drives = counted(len(course.drives), "drive")
        title = f"{course.name}: {course.title}, {drives}, {radius}"
        console.print(_table(title, course_table(made, course)))
    if len(table) > 1:
        console.print(_table(f"F (by chance), {radius}", summary_table(made)))
    points = [course for course in made.courses if course.sweep]
    for sweep in dict.fromkeys(course.sweep for course in points):
        some = [course for course in points if course.sweep == sweep]
        title = f"{sweep}: F (by chance) over {some[0].title}"
        console.print(_table(title, summary_table(made, some)))
    if any(candidate.hindsight for candidate in made.candidates):
        console.print("* decides in hindsight")


def _table(title: str, cells: list[list[str]]) -> Table:
    from rich import box
    from rich.table import Table

    head, *rows = cells
    table = Table(title=title, title_justify="left", title_style="bold", box=box.SIMPLE_HEAD,
                  pad_edge=False)  # fmt: skip
    table.add_column(head[0], no_wrap=True)
    for name in head[1:]:
        table.add_column(name, justify="right", no_wrap=True)
    for row in rows:
        table.add_row(*row)
    return table
