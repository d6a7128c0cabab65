"""A benchmark as files: tables for machines and for documents."""

from __future__ import annotations

from collections.abc import Sequence
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from platform import python_version
from typing import TYPE_CHECKING, Any

import ssrics_like
from ssrics_like.bench.candidates import TRAINED
from ssrics_like.bench.drives import OfLog, OnPlan, Simulated
from ssrics_like.bench.tuned import Tuned, tuned_data
from ssrics_like.bench.words import course_table, summary_table
from ssrics_like.comparison.definitions import DEFINITIONS
from ssrics_like.comparison.writing import counted
from ssrics_like.errors import ResultsError
from ssrics_like.results.counts import counted as of_count
from ssrics_like.results.files import csv_text, json_text, write_atomically

if TYPE_CHECKING:
    from ssrics_like.bench.courses import Course
    from ssrics_like.bench.running import Bench, Figures

FORMAT, VERSION = "ssrics-bench-designators", 1
NAME, CURVES, TUNED = "designators", "curves.svg", "tuned.json"
PACKAGES = ("numpy", "scipy", "numba", "pyactr", "scikit-learn", "ruptures")
COLUMNS = (
    "course", "sweep", "value", "candidate", "hindsight", "drives", "path_m", "passages", "passed",
    "designated", "found", "marks", "merged", "right", "f", "f_low", "f_high", "f_chance",
    "f_clock", "f_place", "f_place_chance", "f_place_clock", "pass_recall", "pass_low",
    "pass_high", "pass_chance", "pass_clock", "recall", "precision", "precision_chance",
    "precision_clock", "marks_per_100_m", "duplicates", "delay_m", "consistency",
)  # fmt: skip


def bench_rows(bench: Bench) -> list[dict[str, Any]]:
    """Return a row for each course and candidate, with the columns of ``designators.csv``."""
    rows = []
    for course in bench.courses:
        for candidate in bench.candidates:
            made = bench.figures[course.name, candidate.name]
            row = {
                "course": course.name,
                "sweep": course.sweep,
                "value": course.value if course.sweep else None,
                "candidate": candidate.name,
                "hindsight": int(candidate.hindsight),
                **_figures(made),
            }
            rows.append({name: row[name] for name in COLUMNS})
    return rows


def bench_data(bench: Bench, tuned: Tuned, notes: Sequence[str] = ()) -> dict[str, Any]:
    """Return a benchmark as plain values, as they stand in ``designators.json``.

    Parameters
    ----------
    bench : Bench
        The benchmark.
    tuned : Tuned
        Where the settings come from.
    notes : sequence of str
        What the reader should know: which courses were left out.
    """
    return {
        "format": FORMAT,
        "version": VERSION,
        "settings": bench.settings.model_dump(),
        "versions": versions(),
        "notes": list(notes),
        "definitions": {
            **DEFINITIONS,
            "f_low, f_high": "2.5 % and 97.5 % points of f over sets of as many drives, drawn with "
            "replacement",
            "consistency": "that of the drives through one plan, the mean over plans",
        },
        "tuned": tuned_data(tuned),
        "candidates": [
            {
                "name": one.name,
                "source": one.source,
                "hindsight": one.hindsight,
                "settings": {key: value for key, value in one.settings.items() if key != "model"},
                "trained": one.name == TRAINED,
            }
            for one in bench.candidates
        ],
        "courses": [_course(course) for course in bench.courses],
        "figures": bench_rows(bench),
    }


def markdown(bench: Bench, notes: Sequence[str] = ()) -> str:
    """Return the tables as a document takes them in."""
    table = [course for course in bench.courses if not course.sweep]
    lines = []
    if table:
        lines += [
            f"F within {bench.settings.radius_m:g} m, in brackets that of as many marks at random.",
            "",
            *_rows(summary_table(bench)),
        ]
    for course in table:
        lines += ["", f"## {course.name}", ""]
        drives = of_count(len(course.drives), "drive")
        lines += [f"{_sentence(course.title)}, {drives}.", ""]
        lines += _rows(course_table(bench, course))
    curves = [course for course in bench.courses if course.sweep]
    for sweep in dict.fromkeys(course.sweep for course in curves):
        points = [course for course in curves if course.sweep == sweep]
        drives = of_count(len(points[0].drives), "drive")
        lines += ["", f"## {sweep}", ""]
        lines += [f"F over {points[0].title}, {drives} a point.", ""]
        lines += _rows(summary_table(bench, points))
    if any(candidate.hindsight for candidate in bench.candidates):
        lines += ["", "\\* decides in hindsight."]
    lines += ["", *(f"{_sentence(note)}." for note in notes)]
    return "\n".join(lines).strip() + "\n"


def write_bench(
    bench: Bench, tuned: Tuned, folder: Path, picture: str | None, notes: Sequence[str] = ()
) -> list[Path]:
    """Write a benchmark into a folder, each file whole or not at all.

    Parameters
    ----------
    bench, tuned, notes
        As for `bench_data`.
    folder : Path
        Where to; made if it is not there.
    picture : str or None
        SVG text of the curves; without any, those of an earlier time are removed.

    Returns
    -------
    list of Path
        ``designators.csv``, ``.json`` and ``.md``, ``tuned.json``, ``curves.svg``.

    Raises
    ------
    ResultsError
        They cannot be written.
    """
    rows = bench_rows(bench)
    texts = {
        f"{NAME}.csv": csv_text(COLUMNS, ([row[name] for name in COLUMNS] for row in rows)),
        f"{NAME}.json": json_text(bench_data(bench, tuned, notes)),
        f"{NAME}.md": markdown(bench, notes),
        TUNED: json_text(tuned_data(tuned)),
    }
    if picture is not None:
        texts[CURVES] = picture
    try:
        folder.mkdir(parents=True, exist_ok=True)
        if picture is None:
            (folder / CURVES).unlink(missing_ok=True)
        for name, text in texts.items():
            write_atomically(folder / name, text)
    except OSError as e:
        raise ResultsError(f"{e.filename or folder}: cannot be written ({e.strerror})") from None
    return [folder / name for name in texts]


def versions() -> dict[str, str | None]:
    """Return the versions of what the figures depend on; None for a package that is not there."""
    found: dict[str, str | None] = {
        "ssrics-like": ssrics_like.__version__,
        "python": python_version(),
    }
    for name in PACKAGES:
        try:
            found[name] = version(name)
        except PackageNotFoundError:
            found[name] = None
    return found


def _figures(made: Figures) -> dict[str, Any]:
    low, high = made.interval
    return {
        "drives": made.tally.runs,
        **counted(made.tally),
        "f_low": low,
        "f_high": high,
        "consistency": made.consistency,
    }


def _course(course: Course) -> dict[str, Any]:
    """Say what a course consists of; files by their names alone, wherever they lie."""
    said: dict[str, Any] = {"name": course.name, "title": course.title}
    first = course.drives[0]
    said["seeds"] = list(dict.fromkeys(spec.seed for spec in course.drives))
    if isinstance(first, Simulated):
        said["condition"] = dict(vars(first.condition))
    if isinstance(first, OnPlan):
        names = [spec.folder.name for spec in course.drives if isinstance(spec, OnPlan)]
        said["maps"] = list(dict.fromkeys(names))
    if isinstance(first, OfLog):
        said["log"], said["truth"] = first.log.name, first.truth.name
    return said


def _rows(table: Sequence[Sequence[str]]) -> list[str]:
    """Return a table in Markdown; the first row names the columns."""
    head, *rows = table
    rule = ["---"] + ["---:"] * (len(head) - 1)
    return ["| " + " | ".join(row) + " |" for row in (head, rule, *rows)]


def _sentence(text: str) -> str:
    return text[:1].upper() + text[1:]
