"""Results folders built by hand, in our writers' formats: of a log, and of a simulated building."""

import itertools
import json
import math
import re
from collections import Counter
from collections.abc import Callable
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import numpy as np

from ssrics_like.comparison import write_scores
from ssrics_like.maps import save_building
from ssrics_like.memory.store import save_topology
from ssrics_like.memory.topological import TopologicalMemory
from ssrics_like.perception.observation import Pose
from ssrics_like.results import tables
from ssrics_like.results.files import csv_text, json_text
from ssrics_like.world.building import Building
from ssrics_like.world.grid import FREE, OCCUPIED, UNKNOWN, GridMap
from ssrics_like.world.locations import Location

START_S = 976053557.75
LAP_S = 60.0
LONGEST_TRACE = 500  # reflexes; the report reads no further
SECTORS = ("left", "front", "right")
RULES = {
    "attend": {
        "why": "Something <novel>.",
        "utility": 0,
        "rule": "=g>\nisa task\n==>\n~orienting>\n",
    },
    "declare": {"why": "A new place.", "utility": 0, "rule": "=g>\nisa task\n==>\n~g>\n"},
}


def place(t_s: float) -> tuple[float, float]:
    """Return where the robot is: it goes round an ellipse of 20 m by 12 m, a lap a minute."""
    turn = 2 * math.pi * t_s / LAP_S
    return 10.0 * math.cos(turn), 6.0 * math.sin(turn)


def events(number: int, t_s: float, *, landmark: str, found: bool) -> list[dict[str, Any]]:
    """Return the trace of one reflex, 0.3 s from arrival to decision."""
    chunk = {"isa": "reflex", "event": str(number), "sector": "left", "structure": "doorway"}
    answer = "retrieved-chunk" if found else "retrieval-failure"
    rows: list[tuple[float, str, str, str, Any]] = [
        (0.0, "orienting", "set-buffer-chunk", "orienting", chunk),
        (0.0, "procedural", "production-selected", "attend", None),
        (0.05, "procedural", "production-fired", "attend", None),
        (0.05, "procedural", "mod-buffer-chunk", "g", {"isa": "task", "state": "recall"}),
        (0.05, "procedural", "clear-buffer", "orienting", None),
        (0.05, "declarative", "start-retrieval", "", None),
        (0.25, "declarative", answer, "", None),
    ]
    if found:
        known = {"isa": "landmark", "id": landmark}
        rows.append((0.25, "declarative", "set-buffer-chunk", "retrieval", known))
    rows += [
        (0.25, "procedural", "production-selected", "declare", None),
        (0.3, "procedural", "production-fired", "declare", None),
        (0.3, "procedural", "mod-buffer-chunk", "g", {"isa": "task", "state": "watch"}),
    ]
    return [
        {"t_s": t_s + dt, "module": module, "action": action, "name": name}
        | ({"chunk": chunk} if chunk else {})
        for dt, module, action, name, chunk in rows
    ]


def build(
    folder: Path,
    *,
    runs: int = 1,
    laps: float = 2.0,
    per_lap: int = 6,
    poses: int = 400,
    prefix: str = "L",
    title: str = "",
    memory: bool = True,
    histograms: tuple[bool, bool] = (True, True),
    intervals: bool = True,
    walls: bool = True,
    is_true: bool = False,
    warnings: tuple[str, ...] = (),
    start_s: float = START_S,
    late_s: Callable[[int, int], float | None] = lambda _run, _number: 0.0,
) -> Path:
    """Write a results folder: on each lap `per_lap` reflexes at the same places.

    `late_s` says by how much a reflex (of which run, which number) comes later than that; None
    leaves it out.
    """
    duration_s = LAP_S * laps
    off_m = 0.2 if start_s == 0.0 else 1.0  # how wrong odometry is, where the truth is known
    paths, decisions, marks, entries = [], [], [], []
    for name in ("topology", "trace", "figures"):
        (folder / name).mkdir(parents=True)
    for run in range(runs):
        graph = TopologicalMemory()
        trace = [
            {"t_s": start_s, "module": "goal", "action": "set-buffer-chunk", "name": "g",
             "chunk": {"isa": "task", "state": "watch"}},
            {"t_s": start_s, "module": "declarative", "action": "activation", "name": "",
             "candidates": {"names": [], "total": [], "threshold": -5.0}},
        ]  # fmt: skip
        for t in np.linspace(0.0, duration_s, poses).tolist():
            true = [*place(t), 0.0] if is_true else [None] * 3
            x, y = place(t)
            paths.append([run, start_s + t, x + off_m * is_true, y, 0.0, *true])
        previous, seen = "", set()
        for number in range(int(laps * per_lap)):
            late = late_s(run, number)
            if late is None:
                continue
            t = (number + 0.5) * LAP_S / per_lap + late
            x, y = place(t)
            sector = SECTORS[number % 3]
            name = f"{prefix}{number % per_lap + 1}"
            new = name not in seen
            seen.add(name)
            true = [x, y] if is_true else [None, None]
            said = "declared" if new else "recognised" if number % 2 else "dismissed"
            decisions.append(
                [run, number, number * 10, start_s + t, start_s + t + 0.3, x + off_m * is_true, y, 0.0,
                 *true, "laser", 0.8, sector, "doorway", said,
                 "" if said == "dismissed" else name, "declare", -1.5, 0.9]
            )  # fmt: skip
            if number < LONGEST_TRACE:
                trace += events(number, start_s + t, landmark=name, found=not new)
            if new:
                graph.add_landmark(name, x + off_m * is_true, y, 0.0, start_s + t, sector=sector)
            if previous and previous != name:
                graph.traverse(previous, name, 6.0, 0.5, 6.5)
            previous = name
        marks += [
            [run, node.id, node.t_s, node.x_m, node.y_m, node.theta_rad, node.labels["sector"],
             "doorway", 2.25 if memory else None, 0.5 * graph.degree(node.id), 0.75, 2]
            for node in graph.nodes
        ]  # fmt: skip
        entries.append(
            {"run": run, "scans": poses, "start_s": start_s, "duration_s": duration_s,
             "path_length_m": 51.0 * laps, "novelty": {"intervals": 300, "novel_intervals": 200,
                                                       "onsets": 9},
             "decisions": Counter(row[15] for row in decisions if row[0] == run), "undecided": 0, "landmarks": len(graph), "firings": 30, "seed": 7,
             "ended": "end of log", "warnings": list(warnings)}
        )  # fmt: skip
        save_topology(graph, folder / "topology" / f"run-{run:03d}.json")
        lines = "".join(json_text(event, indent=None) for event in trace)
        (folder / "trace" / f"run-{run:03d}.jsonl").write_text(lines)
        times = np.linspace(0.0, duration_s, 80)
        turn = np.linspace(0.0, 2 * np.pi, 400) if walls else np.empty(0)
        novelty = 0.5 + 0.4 * np.sin(times) if intervals else times[:0]
        made = [(node.id, node.t_s - start_s) for node in graph.nodes] if memory else []
        data = {
            "outline": {"cell_m": 0.1, "x": (120 * np.cos(turn)).astype(int).tolist(),
                        "y": (80 * np.sin(turn)).astype(int).tolist()},
            "novelty": {"t_s": (start_s + times[: len(novelty)]).tolist(),
                        "mean": novelty.tolist(), "least": (novelty - 0.1).tolist(),
                        "largest": (novelty + 0.1).tolist()},
            "histograms": {
                kind: {"scan": 50, "tau": tau, "counts": [*[(1225 - last) // 9] * 9, last],
                       "edges": [0.9 + 0.01 * i for i in range(11)]} if there else None
                for (kind, tau, last), there in zip(
                    (("novel", 0.343, 420), ("bored", 0.96, 1176)), histograms, strict=True)
            },
            "activation": {
                "t_s": (start_s + times).tolist(),
                "base_level": {
                    name: [-0.5 * math.log(t - t0) if t > t0 else None for t in times.tolist()]
                    for name, t0 in made
                },
            },
        }  # fmt: skip
        (folder / "figures" / f"run-{run:03d}.json").write_text(json_text(data, indent=None))
    for file, header, rows in (
        ("path.csv", tables.PATH, paths),
        ("decisions.csv", tables.DECISIONS, decisions),
        ("landmarks.csv", tables.LANDMARKS, marks),
    ):
        (folder / file).write_text(csv_text(header, rows))
    manifest = {
        "format": "ssrics-results",
        "version": 1,
        "scenario": {
            "title": title,
            "source": {"log": "robot.log"},
            "perception": {"name": "human-like", "title": "", "interval": 50, "gradient": 0.99,
                           "threshold": 0.75, "advance": "sliding"},
            "productions": {"name": "landmark", "title": "Recognise, or declare", "rules": RULES},
            "memory": {"name": "act-r", "decay": 0.5, "retrieval_threshold": -5.0,
                       "mismatch_penalty": None},
            "runs": runs,
            "seed": 2006,
        },
        "versions": {"ssrics-like": "0", "numpy": "2"},
        "seed": 2006,
        "frame": "odometry",
        "input": {"file": "robot.log", "format": "carmen", "sha256": "0" * 64},
        "wall_clock": {"started": "2026-01-01T00:00:00+00:00", "seconds": 1.0},
        "warnings": list(warnings),
        "runs": entries,
    }  # fmt: skip
    (folder / "manifest.json").write_text(json_text(manifest))
    return folder


class Page(HTMLParser):
    """What a test asks about a page."""

    def __init__(self, path: Path) -> None:
        super().__init__()
        self.text = path.read_text(encoding="utf-8")
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.said: list[str] = []
        self.feed(self.text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))

    def handle_data(self, data: str) -> None:
        self.said.append(data)

    @property
    def words(self) -> str:
        return re.sub(r"\s+", " ", " ".join(self.said))


# The same drive through a building: a ring of six rooms around a block, a doorway between each
# two, where the robot goes round and where it would notice something.

CELL_M = 0.05
HALF_M = (13.0, 8.5)
BLOCK_M = (6.0, 3.0)
DOOR_M = 0.5
DOORS = tuple(place((number + 0.5) * LAP_S / 6) for number in range(6))
LABELS = ("lab", "kitchen", "workshop", "store", "office & archive", "hall")


def building(*, doors: int = 6, others: bool = True) -> Building:
    """Return the building, with so many of its doorways labelled."""
    outside_m = 1.5
    half = (HALF_M[0] + outside_m, HALF_M[1] + outside_m)
    columns, rows = (round(2 * side / CELL_M) for side in half)
    x = (np.arange(columns) + 0.5) * CELL_M - half[0]
    y = ((np.arange(rows) + 0.5) * CELL_M - half[1])[:, np.newaxis]

    def box(cx: float, cy: float, wide: float, high: float) -> Any:
        return (abs(x - cx) < wide) & (abs(y - cy) < high)

    cells = np.full((rows, columns), UNKNOWN, np.uint8)
    cells[box(0, 0, HALF_M[0] + 0.2, HALF_M[1] + 0.2)] = OCCUPIED
    cells[box(0, 0, *HALF_M)] = FREE
    cells[box(0, 0, *BLOCK_M)] = OCCUPIED
    cells[box(0, 0, BLOCK_M[0] - 0.2, BLOCK_M[1] - 0.2)] = UNKNOWN
    for i, (door_x, door_y) in enumerate(DOORS):
        side_x, side_y = math.copysign(1, door_x), math.copysign(1, door_y)
        if i % 3 == 1:  # at the top and the bottom
            middle = (BLOCK_M[1] + HALF_M[1]) / 2
            wall = box(0, side_y * middle, 0.1, (HALF_M[1] - BLOCK_M[1]) / 2)
        else:
            middle = (BLOCK_M[0] + HALF_M[0]) / 2
            wall = box(side_x * middle, door_y, (HALF_M[0] - BLOCK_M[0]) / 2, 0.1)
        cells[wall] = OCCUPIED
        cells[wall & box(door_x, door_y, DOOR_M, DOOR_M)] = FREE
    grid = GridMap(cells, CELL_M, Pose(-half[0], -half[1], 0.0))
    places = [Location(str(i + 1), *DOORS[i], LABELS[i]) for i in range(doors)]
    if others:
        places += [
            Location("A", 10.6, 5.8, "north-east corner", "corner"),
            Location("B", -10.6, -5.8, "", "corner"),
            Location("C", 10.0, 0.0, "", "opening"),
        ]
    return Building("Rooms round a block", grid, tuple(places))


PUBLISHED = {"1": 0.57, "2": 0.78, "3": 0.57, "4": 0.71, "5": 0.57, "6": 0.71}


def build_world(
    folder: Path,
    *,
    runs: int = 14,
    places: Building | None = None,
    published: dict[str, float] | None = None,
    seed: int = 1,
    misses: float = 0.35,
    **kind: Any,
) -> Path:
    """Write the results folder of runs in the building; some doorways are missed in each run."""
    generator = np.random.default_rng(seed)
    missed = generator.random((runs, 6)) < misses
    late = generator.normal(0.0, 0.8, (runs, 1000))

    def late_s(run: int, number: int) -> float | None:
        if number % 12 in (3, 7):  # away from any doorway
            return 4.0
        return None if missed[run, number % 6] else float(np.clip(late[run, number], -4, 4))

    kind.setdefault("walls", False)  # the plan shows them all
    build(folder, runs=runs, is_true=True, start_s=0.0, late_s=late_s, **kind)
    file = folder / "manifest.json"
    manifest = json.loads(file.read_text())
    scenario = manifest["scenario"]
    del scenario["source"]
    scenario["world"] = {"map": "rooms.yaml", "robot": {"name": "pioneer-dx", "speed_m_s": 0.894},
                         "start": None, "explore": "frontier"}  # fmt: skip
    scenario["match_radius_m"] = 1.0
    if published is not None:
        scenario["published"] = {"source": "report, table 1", "found": published}
    manifest["input"] = {"file": "rooms.yaml", "format": "map", "sha256": "0" * 64}
    for entry in manifest["runs"]:
        entry |= {"coverage": 0.993, "ended": "no frontier left"}
    file.write_text(json_text(manifest))
    save_building(places or building(), folder / "map")
    return folder


def build_variants(folder: Path, factors: dict[str, tuple[str, ...]], **kind: Any) -> Path:
    """Write a folder of variants: one for each combination of levels, the more marks the later."""
    listed = []
    for i, levels in enumerate(itertools.product(*factors.values())):
        name = f"v{i:02d}"
        chosen = dict(zip(factors, levels, strict=True))
        listed.append(
            {"name": name, "title": ", ".join(levels), "factors": chosen,
             "set": {f"perception.{key}": value for key, value in chosen.items()}}
        )  # fmt: skip
        build_world(folder / name, seed=i, misses=1 / (1 + 0.5 * i), **kind)
        write_scores(folder / name)
    data = {
        "format": "ssrics-variants",
        "version": 1,
        "title": "Readings of the report",
        "description": "The text allows several readings; here are all of them.",
        "variants": listed,
    }
    (folder / "variants.json").write_text(json_text(data))
    return folder
