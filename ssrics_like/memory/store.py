"""Saves and loads a topological memory: node-link JSON, or GraphML for other tools.

The only module of memory that touches files. Numbers are rounded to 6 decimals, equal
memories give equal bytes, and a file is renamed into place when it is complete.
"""

from __future__ import annotations

import contextlib
import io
import json
import os
import sys
import warnings
from collections.abc import Callable, Mapping
from dataclasses import asdict, fields
from pathlib import Path
from typing import Any, NoReturn
from xml.etree.ElementTree import ParseError

import networkx as nx

from ssrics_like.errors import MemoryFileError, choices
from ssrics_like.memory.landmark import NOT_LABELS, Arc, Landmark
from ssrics_like.memory.topological import TopologicalMemory

FORMAT = "ssrics-topology"
VERSION = 1
DECIMALS = 6

ARC_NUMBERS = tuple(f.name for f in fields(Arc) if f.name not in ("from_id", "to_id"))
LANDMARK_NUMBERS = ("x_m", "y_m", "theta_rad", "t_s", "last_visit_s", "visits")
COUNTS = ("visits", "traversals")


def save_topology(memory: TopologicalMemory, path: str | Path) -> None:
    """Write a memory to a file; its ending, .json or .graphml, names the format.

    Raises
    ------
    MemoryFileError
        For another ending, or a file that cannot be written.
    """
    path = Path(path)
    write, _ = _codec(path)
    temporary = path.with_name(f".{path.name}.{os.getpid()}.part")
    content = write(_to_graph(memory))
    try:
        temporary.write_bytes(content)
        temporary.replace(path)
    except OSError as error:
        raise MemoryFileError(f"{path}: cannot be written: {error.strerror}") from error
    finally:
        with contextlib.suppress(OSError):  # gone already, unless writing was cut short
            temporary.unlink()


def load_topology(path: str | Path) -> TopologicalMemory:
    """Read a memory that :func:`save_topology` wrote.

    Raises
    ------
    MemoryFileError
        If the file is missing, damaged, of another kind, or of a newer version.
    """
    path = Path(path)
    _, read = _codec(path)
    try:
        content = path.read_bytes()
    except OSError as error:
        raise MemoryFileError(f"{path}: cannot be read: {error.strerror}") from error
    return _from_graph(read(path, content), path)


def _codec(path: Path) -> tuple[Callable[[Any], bytes], Callable[[Path, bytes], Any]]:
    known = {".json": (_to_json, _from_json), ".graphml": (_to_graphml, _from_graphml)}
    if path.suffix not in known:
        raise MemoryFileError(
            f"{path}: ending '{path.suffix}' names no format; expected {choices(known)}"
        )
    return known[path.suffix]


def _to_graph(memory: TopologicalMemory) -> Any:
    graph: Any = nx.DiGraph(format=FORMAT, version=VERSION)
    for landmark in memory.nodes:
        numbers = {name: _rounded(getattr(landmark, name)) for name in LANDMARK_NUMBERS}
        labels = {name: _rounded(value) for name, value in landmark.labels.items()}
        graph.add_node(landmark.id, **numbers, **labels)
    for arc in memory.arcs:
        numbers = {name: _rounded(value) for name, value in asdict(arc).items()}
        graph.add_edge(numbers.pop("from_id"), numbers.pop("to_id"), **numbers)
    return graph


def _rounded(value: Any) -> Any:
    return round(value, DECIMALS) + 0.0 if isinstance(value, float) else value  # no -0.0


def _to_json(graph: Any) -> bytes:
    data = nx.node_link_data(graph, edges="edges")
    text = json.dumps(data, indent=1, ensure_ascii=False, allow_nan=False)
    return f"{text}\n".encode()


def _from_json(path: Path, content: bytes) -> Any:
    try:
        data = json.loads(content)
    except UnicodeDecodeError as error:
        raise MemoryFileError(f"{path}: damaged: {error}") from error
    except json.JSONDecodeError as error:
        raise MemoryFileError(f"{path}:{error.lineno}: damaged: {error.msg}") from error
    except RecursionError as error:
        raise MemoryFileError(f"{path}: damaged: nested too deep") from error
    header = data.get("graph") if isinstance(data, dict) else None
    _check_header(path, header if isinstance(header, dict) else {})
    try:
        graph = nx.node_link_graph(data, edges="edges")
    except (LookupError, TypeError, ValueError, AttributeError, nx.NetworkXException) as error:
        raise MemoryFileError(f"{path}: damaged: {type(error).__name__} {error}") from error
    if len(graph) < len(data["nodes"]) or graph.number_of_edges() < len(data["edges"]):
        _damaged(path, "a landmark or an arc stands in it twice")
    return graph


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


def _check_header(path: Path, header: Mapping[str, Any]) -> None:
    if header.get("format") != FORMAT:
        raise MemoryFileError(
            f"{path}: no topological memory: its format is {header.get('format')!r}, "
            f"expected '{FORMAT}'"
        )
    version = header.get("version")
    if not isinstance(version, int) or version < 1:
        _damaged(path, f"its version is {version!r}, expected {VERSION}")
    if version > VERSION:
        raise MemoryFileError(
            f"{path}: written by a newer ssrics: its version is {version}, "
            f"this one reads up to {VERSION}"
        )


def _from_graph(graph: Any, path: Path) -> TopologicalMemory:
    if not graph.is_directed() or graph.is_multigraph():
        _damaged(path, "its arcs have no direction, or stand in it twice")
    landmarks = [_landmark(path, name, data) for name, data in graph.nodes(data=True)]
    arcs = [_arc(path, *ends) for ends in graph.edges(data=True)]
    return TopologicalMemory.restored(landmarks, arcs)


def _landmark(path: Path, name: Any, data: Mapping[str, Any]) -> Landmark:
    if not isinstance(name, str):
        _damaged(path, f"a landmark is called {name!r}, expected text")
    numbers = _numbers(path, f"landmark '{name}'", data, LANDMARK_NUMBERS)
    labels = {key: value for key, value in data.items() if key not in NOT_LABELS}
    for key, value in labels.items():
        if not isinstance(value, str) and not _is_finite_number(value):
            _damaged(path, f"landmark '{name}': {key} is {value!r}, expected text or a number")
    return Landmark(id=name, **numbers, labels=labels)


def _arc(path: Path, from_id: str, to_id: str, data: Mapping[str, Any]) -> Arc:
    where = f"arc from '{from_id}' to '{to_id}'"
    return Arc(from_id=from_id, to_id=to_id, **_numbers(path, where, data, ARC_NUMBERS))


def _numbers(
    path: Path, where: str, data: Mapping[str, Any], names: tuple[str, ...]
) -> dict[str, Any]:
    for name in names:
        value = data.get(name)
        if isinstance(value, bool) or not _is_finite_number(value):
            _damaged(path, f"{where}: {name} is {value!r}, expected a finite number")
        if name in COUNTS and (not isinstance(value, int) or value < 1):
            _damaged(path, f"{where}: {name} is {value!r}, expected a count of 1 or more")
    return {name: data[name] if name in COUNTS else float(data[name]) for name in names}


def _is_finite_number(value: Any) -> bool:
    return isinstance(value, int | float) and abs(value) <= sys.float_info.max


def _damaged(path: Path, what: str) -> NoReturn:
    raise MemoryFileError(f"{path}: damaged: {what}")
