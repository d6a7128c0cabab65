"""Saves and loads a topological memory: node-link JSON, or GraphML for other tools.

Numbers are rounded to 6 decimals, equal memories give equal bytes, and a file is renamed
into place when it is complete.
"""

from __future__ import annotations

import io
import json
import warnings
from collections.abc import Callable, Iterable, Mapping
from dataclasses import MISSING, fields
from pathlib import Path
from typing import Any
from xml.etree.ElementTree import ParseError

import networkx as nx

from ssrics_like.errors import MemoryFileError, choices
from ssrics_like.memory.files import (
    LARGEST,
    check_header,
    damaged,
    is_finite_number,
    parsed_json,
    read_whole,
    write_whole,
)
from ssrics_like.memory.landmark import LAYOUT_LABELS, NOT_LABELS, Arc, Landmark
from ssrics_like.memory.topological import TopologicalMemory

FORMAT = "ssrics-topology"
VERSION = 1
DECIMALS = 6

ARC_NUMBERS = tuple(f.name for f in fields(Arc) if f.name not in ("from_id", "to_id"))
LANDMARK_NUMBERS = tuple(f.name for f in fields(Landmark) if f.name not in ("id", "labels"))
COUNTS = {"visits": 1, "missed": 0, "missed_since": 0, "traversals": 1, "closed": 0}
"""Fields that are whole numbers, and the least that each can be."""
_NO_LABELS = NOT_LABELS.union(LAYOUT_LABELS)
ARC_OPTIONAL, LANDMARK_OPTIONAL = (
    frozenset(f.name for f in fields(kind) if f.default is not MISSING) for kind in (Arc, Landmark)
)
"""Fields that came later: a file without them has their default."""


def save_topology(memory: TopologicalMemory, path: str | Path) -> None:
    """Write a memory to a file; its ending, .json or .graphml, names the format.

    Raises
    ------
    MemoryFileError
        For another ending, or a file that cannot be written.
    """
    path = Path(path)
    write, _ = _codec(path)
    write_whole(path, write(_to_graph(memory.nodes, memory.arcs)))


def load_topology(path: str | Path) -> TopologicalMemory:
    """Read a memory that :func:`save_topology` wrote.

    Raises
    ------
    MemoryFileError
        If the file is missing, damaged, of another kind, or of a newer version.
    """
    path = Path(path)
    _, read = _codec(path)
    return TopologicalMemory.restored(*_from_graph(read(path, read_whole(path)), path))


def node_link(landmarks: Iterable[Landmark], arcs: Iterable[Arc]) -> dict[str, Any]:
    """Return landmarks and arcs as networkx's node-link data, as they stand in a JSON file."""
    data: dict[str, Any] = nx.node_link_data(_to_graph(landmarks, arcs), edges="edges")
    return data


def from_node_link(path: Path, data: Any) -> tuple[tuple[Landmark, ...], tuple[Arc, ...]]:
    """Return the landmarks and arcs that node-link data hold.

    Parameters
    ----------
    path : Path
        Where they were read, for messages.
    data : Any
        As JSON has them.

    Raises
    ------
    MemoryFileError
        If they are damaged, of another kind, or of a newer version.
    """
    return _from_graph(_linked(path, data), path)


def _codec(path: Path) -> tuple[Callable[[Any], bytes], Callable[[Path, bytes], Any]]:
    known = {".json": (_to_json, _from_json), ".graphml": (_to_graphml, _from_graphml)}
    if path.suffix not in known:
        raise MemoryFileError(
            f"{path}: ending '{path.suffix}' names no format; expected {choices(known)}"
        )
    return known[path.suffix]


def _to_graph(landmarks: Iterable[Landmark], arcs: Iterable[Arc]) -> Any:
    graph: Any = nx.DiGraph(format=FORMAT, version=VERSION)
    for landmark in landmarks:
        numbers = {name: _rounded(getattr(landmark, name)) for name in LANDMARK_NUMBERS}
        labels = {name: _rounded(value) for name, value in landmark.labels.items()}
        graph.add_node(landmark.id, **numbers, **labels)
    for arc in arcs:
        numbers = {name: _rounded(getattr(arc, name)) for name in ARC_NUMBERS}
        graph.add_edge(arc.from_id, arc.to_id, **numbers)
    return graph


def _rounded(value: Any) -> Any:
    return round(value, DECIMALS) + 0.0 if isinstance(value, float) else value  # no -0.0


def _to_json(graph: Any) -> bytes:
    data = nx.node_link_data(graph, edges="edges")
    text = json.dumps(data, indent=1, ensure_ascii=False, allow_nan=False)
    return f"{text}\n".encode()


def _from_json(path: Path, content: bytes) -> Any:
    return _linked(path, parsed_json(path, content))


def _linked(path: Path, data: Any) -> Any:
    header = data.get("graph") if isinstance(data, dict) else None
    _check_header(path, header if isinstance(header, dict) else {})
    try:
        graph = nx.node_link_graph(data, edges="edges")
    except (LookupError, TypeError, ValueError, AttributeError, nx.NetworkXException) as error:
        raise MemoryFileError(f"{path}: damaged: {type(error).__name__} {error}") from error
    if len(graph) < len(data["nodes"]) or graph.number_of_edges() < len(data["edges"]):
        damaged(path, "a landmark or an arc stands in it twice")
    return graph


def _check_header(path: Path, header: Mapping[str, Any]) -> None:
    check_header(path, header, "topological memory", FORMAT, VERSION)


def _to_graphml(graph: Any) -> bytes:
    # The writer in plain Python, not the one in lxml: bytes must not depend on what is installed.
    stream = io.BytesIO()
    nx.write_graphml_xml(graph, stream, encoding="utf-8", prettyprint=True)
    return stream.getvalue()


def _from_graphml(path: Path, content: bytes) -> Any:
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")  # networkx guesses where a key is incomplete
            graph = nx.read_graphml(io.BytesIO(content))
    except ParseError as error:
        raise MemoryFileError(f"{path}:{error.position[0]}: damaged: {error}") from error
    except (
        LookupError,
        TypeError,
        ValueError,
        AttributeError,
        UserWarning,
        nx.NetworkXException,
    ) as error:
        raise MemoryFileError(f"{path}: damaged: {type(error).__name__} {error}") from error
    _check_header(path, graph.graph)
    return graph


def _from_graph(graph: Any, path: Path) -> tuple[tuple[Landmark, ...], tuple[Arc, ...]]:
    if not graph.is_directed() or graph.is_multigraph():
        damaged(path, "its arcs have no direction, or stand in it twice")
    landmarks = (_landmark(path, name, data) for name, data in graph.nodes(data=True))
    arcs = (_arc(path, *ends) for ends in graph.edges(data=True))
    return tuple(landmarks), tuple(arcs)


def _landmark(path: Path, name: Any, data: Mapping[str, Any]) -> Landmark:
    if not isinstance(name, str):
        damaged(path, f"a landmark is called {name!r}, expected text")
    where = f"landmark '{name}'"
    numbers = _numbers(path, where, data, LANDMARK_NUMBERS, LANDMARK_OPTIONAL)
    labels = {key: value for key, value in data.items() if key not in _NO_LABELS}
    for key, value in labels.items():
        if not isinstance(value, str | bool) and not is_finite_number(value):
            damaged(path, f"landmark '{name}': {key} is {value!r}, expected text or a number")
    return Landmark(id=name, **numbers, labels=labels)


def _arc(path: Path, from_id: str, to_id: str, data: Mapping[str, Any]) -> Arc:
    where = f"arc from '{from_id}' to '{to_id}'"
    numbers = _numbers(path, where, data, ARC_NUMBERS, ARC_OPTIONAL)
    return Arc(from_id=from_id, to_id=to_id, **numbers)


def _numbers(
    path: Path,
    where: str,
    data: Mapping[str, Any],
    names: tuple[str, ...],
    optional: frozenset[str],
) -> dict[str, Any]:
    numbers: dict[str, Any] = {}
    for name in names:
        value: Any = data.get(name)
        if type(value) is float and name not in COUNTS and abs(value) <= LARGEST:
            numbers[name] = value  # nearly all are: a large memory is read sooner
            continue
        if value is None and name in optional and name not in data:
            continue
        if not is_finite_number(value):
            damaged(path, f"{where}: {name} is {value!r}, expected a finite number")
        if name not in COUNTS:
            numbers[name] = float(value)
        elif isinstance(value, int) and value >= COUNTS[name]:
            numbers[name] = value
        else:
            least = COUNTS[name]
            damaged(path, f"{where}: {name} is {value!r}, expected a count of {least} or more")
    return numbers
