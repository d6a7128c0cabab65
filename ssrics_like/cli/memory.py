"""``ssrics memory``: what runs have left behind, looked at, merged, handed on."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING

from ssrics_like.cli.options import Flag, NeededOut

if TYPE_CHECKING:
    from collections.abc import Mapping

    from rich.table import Table

    from ssrics_like.memory import SavedMemory
    from ssrics_like.memory.summary import LandmarkSummary

WIDTH = 120
TOLD_MAX = 20
"""So many landmarks are named one by one."""


def show(memory: Path, *, profile: str = "act-r", pause: float = 0.0, json: Flag = False) -> None:
    """List the landmarks of a saved memory, and how well each is remembered.

    For example:

        ssrics memory show out/demo/
        ssrics memory show out/demo/memory/run-000.json --pause 86400 --json

    Parameters
    ----------
    memory
        A file of memory, or a results folder of one run.
    profile
        Memory profile that activations are reckoned by: an entry of the library, or a path.
    pause
        Seconds that pass after the saving.
    json
        Print JSON instead of a table.
    """
    import math
    from dataclasses import asdict

    from ssrics_like.errors import MemoryFileError
    from ssrics_like.memory import load_memory_file
    from ssrics_like.memory.summary import summarised
    from ssrics_like.perception.profile import SURROUNDINGS_LENGTH
    from ssrics_like.results.files import json_text
    from ssrics_like.scenarios.modules import load_memory
    from ssrics_like.scenarios.remembering import one_memory_file

    if not (math.isfinite(pause) and pause >= 0):
        raise MemoryFileError(f"--pause: {pause:g}: expected seconds, 0 or more")
    how = load_memory(profile)
    file = one_memory_file(memory)
    saved = load_memory_file(file).aged(pause)
    try:
        saved.check_views(None)
    except ValueError as error:
        raise MemoryFileError(f"{file}: {error}") from None
    # A file does not say what its views are of; scans of as many beams are not usual.
    rows = summarised(saved, how, surroundings=saved.view_length == SURROUNDINGS_LENGTH)
    if json:
        print(json_text([asdict(row) for row in rows]), end="")
        return
    from rich.console import Console

    from ssrics_like.results.counts import counted

    print(
        f"{file}: {_counted(saved)}, {counted(len(saved.runs), 'run')}{_home(saved)}; "
        f"activations by '{profile}', {pause:g} s after the saving"
    )
    Console(width=WIDTH, highlight=False, markup=False).print(_table(rows))


def merge(first: Path, second: Path, *more: Path, out: NeededOut) -> None:
    """Make one memory of several; landmarks of the same origin become one.

    Those that no other has get the next free numbers, and stay unconnected.

    For example:

        ssrics memory merge out/monday/ out/tuesday/ -o both.json

    Parameters
    ----------
    first
        A file of memory, or a results folder of one run; its landmarks keep their names.
    second
        Another.
    more
        And others.
    out
        The file to write, ending in .json.
    """
    from ssrics_like.errors import MemoryFileError
    from ssrics_like.memory import load_memory_file, save_memory_file
    from ssrics_like.memory.merging import merge as merge_two
    from ssrics_like.scenarios.remembering import one_memory_file

    if out.suffix != ".json":
        raise MemoryFileError(f"{out}: expected a name ending in .json")
    files = [one_memory_file(path) for path in (first, second, *more)]
    memory = load_memory_file(files[0])
    said = [f"{files[0]}: {_counted(memory)}, names kept"]
    for file in files[1:]:
        try:
            merged = merge_two(memory, load_memory_file(file))
        except MemoryFileError:
            raise
        except ValueError as error:
            raise MemoryFileError(f"{file}: cannot be merged with {files[0]}: {error}") from None
        memory = merged.memory
        said.append(f"{file}: {_pairs('joined', merged.joined)}")
        said.append(f"{file}: {_pairs('new', merged.renamed)}")
    save_memory_file(memory, out)
    print("\n".join([*said, f"{out}: {_counted(memory)}"]))


def export(memory: Path, *, out: NeededOut) -> None:
    """Write the landmarks and the ways between them for other programs, or as a picture.

    Landmarks are laid where they contradict the ways between them least.

    For example:

        ssrics memory export out/demo/ -o demo.graphml
        ssrics memory export both.json -o both.svg

    Parameters
    ----------
    memory
        A file of memory, or a results folder of one run.
    out
        The file to write; its ending says which kind: .graphml, .json (node-link) or .svg.
    """
    from ssrics_like.errors import MemoryFileError
    from ssrics_like.memory import load_memory_file
    from ssrics_like.memory.files import write_whole
    from ssrics_like.memory.layout import layout_of
    from ssrics_like.memory.saved_file import export_graph
    from ssrics_like.report.memory_figure import memory_svg
    from ssrics_like.scenarios.remembering import one_memory_file

    endings = (".graphml", ".json", ".svg")
    if out.suffix not in endings:
        raise MemoryFileError(f"{out}: expected a name ending in {', '.join(endings)}")
    file = one_memory_file(memory)
    if out.exists() and out.resolve() == file.resolve():
        raise MemoryFileError(f"{out}: would take the memory's own place; choose another name")
    saved = load_memory_file(file)
    if out.suffix == ".svg":
        write_whole(out, memory_svg(saved, layout_of(saved)).encode())
    else:
        export_graph(saved, out, layout_of(saved))
    print(f"{out}: {_counted(saved)}")


def _table(rows: list[LandmarkSummary]) -> Table:
    from rich import box
    from rich.table import Table

    from ssrics_like.report.words import time_text

    table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    for name in ("landmark", "structure"):
        table.add_column(name, no_wrap=True)
    for name in (
        *("visits", "references", "activation", "last seen, ago", "degree"),
        *("salience", "relevance", "permanence"),
    ):
        table.add_column(name, justify="right", no_wrap=True)
    for row in rows:
        table.add_row(
            row.landmark,
            row.structure,
            str(row.visits),
            str(row.references),
            _figure(row.activation, 3),
            time_text(row.last_seen_ago_s),
            str(row.degree),
            _figure(row.salience, 2),
            _figure(row.relevance, 2),
            _figure(row.permanence, 3),
        )
    return table


def _figure(value: float | None, decimals: int) -> str:
    from ssrics_like.report.words import figure_text

    return figure_text(float("nan") if value is None else value, decimals)


def _home(memory: SavedMemory) -> str:
    home = memory.home
    return f", home {math.hypot(home.x_m, home.y_m):.1f} m from {home.landmark}" if home else ""


def _counted(memory: SavedMemory) -> str:
    from ssrics_like.results.counts import counted

    parts = {"landmark": memory.landmarks, "arc": memory.arcs, "chunk": memory.chunks}
    return ", ".join(counted(len(items), what) for what, items in parts.items())


def _pairs(what: str, names: Mapping[str, str]) -> str:
    """Say which landmarks were joined to which, or are called what now."""
    told = [one if one == now else f"{one} as {now}" for one, now in names.items()]
    more = [f"{len(told) - TOLD_MAX} more"] if len(told) > TOLD_MAX else []
    return f"{len(names)} {what}" + (": " if told else "") + ", ".join(told[:TOLD_MAX] + more)
