"""Saves and loads both memories of a run in one JSON file.

One chunk a line. Numbers are rounded to 6 decimals, but ages to 9: the base level of a
reference made just now, 50 ms old, changes by d / 0.05 for each second, so that 6 decimals
would be felt in the sixth decimal of an activation, and 9 are not. Numbers that are symbols
(slots that hold no view) are kept as they are, since they are compared for
equality.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import asdict, fields, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ssrics_like.errors import MemoryFileError
from ssrics_like.memory.chunks import Chunk, Value, View
from ssrics_like.memory.files import (
    check_header,
    damaged,
    is_finite_number,
    parsed_json,
    read_whole,
    shown,
    uncollected,
    write_whole,
)
from ssrics_like.memory.home import Home
from ssrics_like.memory.landmark import LAYOUT_LABELS, Label, Landmark
from ssrics_like.memory.saved import PastRun, RememberedChunk, SavedMemory
from ssrics_like.memory.store import DECIMALS, from_node_link, node_link, save_topology
from ssrics_like.memory.topological import TopologicalMemory

if TYPE_CHECKING:
    from ssrics_like.memory.layout import Placed

FORMAT = "ssrics-memory"
VERSION = 3
WITHOUT_VISTA, VISTA = 72, 36
"""Numbers of a view of surroundings in version 1, and of what has been added since: what is seen in
the distance. Version 2 held something else there, how far one sees."""
AGE_DECIMALS = 9
_ENCODER = json.JSONEncoder(allow_nan=False)
ORIGIN = "origin"
"""What the origin of a landmark is called among its attributes in the file."""


def save_memory_file(memory: SavedMemory, path: str | Path) -> None:
    """Write a memory to a file.

    Raises
    ------
    MemoryFileError
        If it cannot be written, or a slot holds a number that is not finite.
    """
    path = Path(path)
    with uncollected():
        write_whole(path, memory_bytes(memory, path))


def load_memory_file(path: str | Path) -> SavedMemory:
    """Read a memory that :func:`save_memory_file` wrote.

    Raises
    ------
    MemoryFileError
        If the file is missing, damaged, of another kind, or of a newer version.
    """
    path = Path(path)
    with uncollected():
        return memory_from(path, read_whole(path))


def export_graph(memory: SavedMemory, path: str | Path, layout: Mapping[str, Placed]) -> None:
    """Write landmarks and arcs alone, as :func:`save_topology`; origins and layout are labels.

    Parameters
    ----------
    memory : SavedMemory
        Whose.
    path : str or Path
        The file; its ending names the format.
    layout : mapping of str to Placed
        Where each landmark lies (see `layout_of`); :func:`load_topology` leaves it out.

    Raises
    ------
    MemoryFileError
        For another ending than .json and .graphml, or a file that cannot be written.
    """
    landmarks = (
        replace(each, labels={**each.labels, **_laid_out(layout[each.id])})
        for each in _labelled(memory)
    )
    save_topology(TopologicalMemory.restored(landmarks, memory.arcs), path)


def _laid_out(placed: Placed) -> dict[str, Label]:
    pose = placed.pose
    values = pose.x_m, pose.y_m, pose.theta_rad, placed.component
    return dict(zip(LAYOUT_LABELS, values, strict=True))


def _labelled(memory: SavedMemory) -> Iterator[Landmark]:
    """Return the landmarks, each with its origin among its labels."""
    for landmark in memory.landmarks:
        origin = memory.origins[landmark.id]
        yield replace(landmark, labels={**landmark.labels, ORIGIN: origin})


def memory_bytes(memory: SavedMemory, path: Path) -> bytes:
    """Return a memory as the content of a file; `path` is for messages.

    Raises
    ------
    MemoryFileError
        If a slot holds a number that is not finite.
    """
    head: dict[str, Any] = {
        "format": FORMAT,
        "version": VERSION,
        "saved_s": round(memory.saved_s, DECIMALS) + 0.0,
        "frame": memory.frame,
        "runs": [
            {"id": run.id, "ended_ago_s": round(run.ended_ago_s, AGE_DECIMALS) + 0.0}
            for run in memory.runs
        ],
    }
    if memory.home is not None:
        head["home"] = _home_data(memory.home)
    linked = node_link(_labelled(memory), memory.arcs)
    graph = {key: value for key, value in linked.items() if key not in ("nodes", "edges")}
    lines = [f"{json.dumps(key)}: {json.dumps(value)}" for key, value in head.items()]
    lines.append(_block("chunks", (_chunk_data(each) for each in memory.chunks), path))
    inner = [f"{json.dumps(key)}: {json.dumps(value)}" for key, value in graph.items()]
    inner += [_block(key, linked[key], path) for key in ("nodes", "edges")]
    lines.append('"topology": {\n' + ",\n".join(inner) + "\n}")
    return ("{\n" + ",\n".join(lines) + "\n}\n").encode()


def _home_data(home: Home) -> dict[str, Any]:
    return {
        key: value if isinstance(value, str) else round(value, DECIMALS) + 0.0
        for key, value in asdict(home).items()
    }


def _block(key: str, items: Iterable[Any], path: Path) -> str:
    """Return a list of which each item has its line."""
    try:
        lines = list(map(_ENCODER.encode, items))
    except ValueError as error:
        raise MemoryFileError(
            f"{path}: cannot be written: {key} hold a number that is not finite"
        ) from error
    body = ",\n".join(lines)
    return f"{json.dumps(key)}: [\n{body}\n]" if body else f"{json.dumps(key)}: []"


def _chunk_data(each: RememberedChunk) -> dict[str, Any]:
    return {
        "name": each.chunk.name,
        "type": each.chunk.type,
        "slots": {slot: _value_data(value) for slot, value in each.chunk.slots.items()},
        "ages_s": [round(age_s, AGE_DECIMALS) + 0.0 for age_s in each.ages_s],
    }


def _value_data(value: Value) -> Any:
    if isinstance(value, View):
        # Where float32 is coarser than 6 decimals, they still tell its neighbours apart.
        numbers = np.round(value.descriptor.astype(np.float64), DECIMALS) + 0.0
        return {"view": value.name, "numbers": numbers.tolist()}
    return value


def memory_from(path: Path, content: bytes) -> SavedMemory:
    """Return the memory that the content of a file holds; `path` is for messages.

    Raises
    ------
    MemoryFileError
        As :func:`load_memory_file`.
    """
    data = parsed_json(path, content)
    head = data if isinstance(data, dict) else {}
    check_header(path, head, "saved memory", FORMAT, VERSION)
    for key, kind, said in (
        ("saved_s", float, "a number"),
        ("frame", str, "text"),
        ("runs", list, "a list"),
        ("chunks", list, "a list"),
        ("topology", dict, "a graph"),
    ):
        _expect(path, key, head.get(key), kind, said)
    topology, origins = _without_origins(path, head["topology"])
    landmarks, arcs = from_node_link(path, topology)
    try:
        chunks = tuple(_chunk(path, chunk) for chunk in head["chunks"])
        if head["version"] < VERSION:
            chunks = tuple(map(_with_unknown_vista, chunks))
        return SavedMemory(
            saved_s=float(head["saved_s"]),
            frame=head["frame"],
            runs=tuple(_run(path, run) for run in head["runs"]),
            chunks=chunks,
            landmarks=landmarks,
            arcs=arcs,
            origins=origins,
            home=_home(path, head["home"]) if "home" in head else None,
        )
    except MemoryFileError:
        raise
    except ValueError as error:
        raise MemoryFileError(f"{path}: damaged: {error}") from error


def _without_origins(path: Path, topology: dict[str, Any]) -> tuple[dict[str, Any], dict[str, str]]:
    """Take the origins out of node-link data."""
    origins: dict[str, str] = {}
    nodes = _expect(path, "topology: nodes", topology.get("nodes"), list, "a list")
    plain = []
    for given in nodes:
        node = dict(_expect(path, "topology: a landmark", given, dict, "its attributes"))
        name = _expect(path, "topology: a landmark's id", node.get("id"), str, "text")
        at = f"landmark '{name}': {ORIGIN}"
        origins[name] = _expect(path, at, node.pop(ORIGIN, None), str, "text")
        plain.append(node)
    return {**topology, "nodes": plain}, origins


def _run(path: Path, given: Any) -> PastRun:
    run = _expect(path, "runs: one", given, dict, "its id and ended_ago_s")
    name = _expect(path, "runs: an id", run.get("id"), str, "text")
    at = f"run '{name}': ended_ago_s"
    return PastRun(name, float(_expect(path, at, run.get("ended_ago_s"), float, "a number")))


def _home(path: Path, given: Any) -> Home:
    home = _expect(path, "home", given, dict, "its landmark and pose")
    landmark = _expect(path, "home: landmark", home.get("landmark"), str, "text")
    return Home(
        landmark,
        *(
            float(_expect(path, f"home: {each.name}", home.get(each.name), float, "a number"))
            for each in fields(Home)[1:]
        ),
    )


def _chunk(path: Path, given: Any) -> RememberedChunk:
    chunk = _expect(path, "chunks: one", given, dict, "its name, type, slots and ages_s")
    name = _expect(path, "chunks: a name", chunk.get("name"), str, "text")
    at = f"chunk '{name}'"
    kind = _expect(path, f"{at}: type", chunk.get("type"), str, "text")
    slots = _expect(path, f"{at}: slots", chunk.get("slots"), dict, "keys and values")
    ages_s = _numbers(path, f"{at}: ages_s", chunk.get("ages_s"))
    values = {slot: _value(path, f"{at}: {slot}", value) for slot, value in slots.items()}
    return RememberedChunk(Chunk(name, kind, values), tuple(ages_s.tolist()))


def _with_unknown_vista(each: RememberedChunk) -> RememberedChunk:
    slots = {
        slot: View(value.name, np.pad(value.descriptor[:WITHOUT_VISTA], (0, VISTA)))
        if isinstance(value, View) and _surrounds(value)
        else value
        for slot, value in each.chunk.slots.items()
    }
    return replace(each, chunk=replace(each.chunk, slots=slots))


def _surrounds(view: View) -> bool:
    """Tell a view of surroundings, all lengths, from one of a scan, whose mean is 0."""
    known = len(view.descriptor) in (WITHOUT_VISTA, WITHOUT_VISTA + VISTA)
    return known and bool((view.descriptor[:WITHOUT_VISTA] >= 0.0).all())


def _value(path: Path, at: str, given: Any) -> Value:
    if isinstance(given, str) or is_finite_number(given):
        value: str | float = given
        return value
    if not isinstance(given, dict) or "view" not in given:
        damaged(path, f"{at} is {shown(given)}, expected text, a number or a view")
    return _view(path, at, given)


def _view(path: Path, at: str, given: dict[str, Any]) -> View:
    name = _expect(path, f"{at}: view", given["view"], str, "text")
    numbers = _numbers(path, f"{at}: numbers", given.get("numbers"))
    with np.errstate(over="ignore"):  # View refuses what is not finite in float32
        return View(name, numbers.astype(np.float32))


def _numbers(path: Path, at: str, given: Any) -> NDArray[np.float64]:
    """Return a list of numbers as an array; all are looked at in one go, since they are many."""
    numbers = _expect(path, at, given, list, "a list of numbers")
    plain = set(map(type, numbers)) <= {int, float}
    try:
        array = np.array(numbers if plain else math.nan, np.float64)
    except OverflowError:  # a whole number that is too large
        array = np.array(math.nan)
    if not np.isfinite(array).all():
        odd = next(number for number in numbers if not is_finite_number(number))
        damaged(path, f"{at} holds {shown(odd)}, expected finite numbers")
    return array


def _expect(path: Path, at: str, given: Any, kind: type, said: str) -> Any:
    """Return a value of a kind, or complain of it."""
    if not (is_finite_number(given) if kind is float else isinstance(given, kind)):
        damaged(path, f"{at} is {shown(given)}, expected {said}")
    return given
