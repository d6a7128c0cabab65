"""The report of a results folder that is built here by hand, in our writers' formats."""

import json
import math
import re
import subprocess
import sys
import xml.etree.ElementTree as ET
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ssrics_like import library
from ssrics_like.errors import MemoryFileError, ResultsError
from ssrics_like.memory.landmark import Arc
from ssrics_like.memory.store import save_topology
from ssrics_like.memory.topological import TopologicalMemory
from ssrics_like.report import write_report
from ssrics_like.report.episodes import chosen
from ssrics_like.report.frames import Frame, frame_around, round_length
from ssrics_like.report.graph_figure import ways_of
from ssrics_like.report.labels import Room, around, spread
from ssrics_like.report.novelty_figure import coarser
from ssrics_like.report.pictures import Novelty, Outline
from ssrics_like.report.reading import read_results
from ssrics_like.report.records import Reflex
from ssrics_like.report.spans import spans_of
from ssrics_like.report.walls import raster
from ssrics_like.report.words import clock, fraction_text, number_text, time_text
from ssrics_like.results import tables
from ssrics_like.results.files import csv_text, json_text

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
) -> Path:
    """Write a results folder: on each lap `per_lap` reflexes at the same places."""
    duration_s = LAP_S * laps
    paths, decisions, marks, entries = [], [], [], []
    for name in ("topology", "trace", "figures"):
        (folder / name).mkdir(parents=True)
    for run in range(runs):
        graph = TopologicalMemory()
        trace = [
            {"t_s": START_S, "module": "goal", "action": "set-buffer-chunk", "name": "g",
             "chunk": {"isa": "task", "state": "watch"}},
            {"t_s": START_S, "module": "declarative", "action": "activation", "name": "",
             "candidates": {"names": [], "total": [], "threshold": -5.0}},
        ]  # fmt: skip
        for t in np.linspace(0.0, duration_s, poses).tolist():
            true = [*place(t), 0.0] if is_true else [None] * 3
            x, y = place(t)
            paths.append([run, START_S + t, x + is_true, y, 0.0, *true])
        previous = ""
        for number in range(int(laps * per_lap)):
            t = (number + 0.5) * LAP_S / per_lap
            x, y = place(t)
            sector = SECTORS[number % 3]
            name = f"{prefix}{number % per_lap + 1}"
            new = number < per_lap
            true = [x, y] if is_true else [None, None]
            said = "declared" if new else "recognised" if number % 2 else "dismissed"
            decisions.append(
                [run, number, number * 10, START_S + t, START_S + t + 0.3, x + is_true, y, 0.0,
                 *true, "laser", 0.8, sector, "doorway", said,
                 "" if said == "dismissed" else name, "declare", -1.5, 0.9]
            )  # fmt: skip
            if number < LONGEST_TRACE:
                trace += events(number, START_S + t, landmark=name, found=not new)
            if new:
                graph.add_landmark(name, x + is_true, y, 0.0, START_S + t, sector=sector)
            if previous and previous != name:
                graph.traverse(previous, name, 6.0, 0.5, 6.5)
            previous = name
        marks += [
            [run, node.id, node.t_s, node.x_m, node.y_m, node.theta_rad, node.labels["sector"],
             "doorway", 0.8, graph.degree(node.id), -2.5 if memory else None, 2]
            for node in graph.nodes
        ]  # fmt: skip
        entries.append(
            {"run": run, "scans": poses, "start_s": START_S, "duration_s": duration_s,
             "path_length_m": 51.0 * laps, "novelty": {"intervals": 300, "novel_intervals": 200,
                                                       "onsets": 9},
             "decisions": {}, "undecided": 0, "landmarks": len(graph), "firings": 30, "seed": 7,
             "ended": "end of log", "warnings": list(warnings)}
        )  # fmt: skip
        save_topology(graph, folder / "topology" / f"run-{run:03d}.json")
        lines = "".join(json_text(event, indent=None) for event in trace)
        (folder / "trace" / f"run-{run:03d}.jsonl").write_text(lines)
        times = np.linspace(0.0, duration_s, 80)
        turn = np.linspace(0.0, 2 * np.pi, 400) if walls else np.empty(0)
        novelty = 0.5 + 0.4 * np.sin(times) if intervals else times[:0]
        made = [(node.id, node.t_s - START_S) for node in graph.nodes] if memory else []
        data = {
            "outline": {"cell_m": 0.1, "x": (120 * np.cos(turn)).astype(int).tolist(),
                        "y": (80 * np.sin(turn)).astype(int).tolist()},
            "novelty": {"t_s": (START_S + times[: len(novelty)]).tolist(),
                        "mean": novelty.tolist(), "least": (novelty - 0.1).tolist(),
                        "largest": (novelty + 0.1).tolist()},
            "histograms": {
                kind: {"scan": 50, "tau": tau, "counts": [*[(1225 - last) // 9] * 9, last],
                       "edges": [0.9 + 0.01 * i for i in range(11)]} if there else None
                for (kind, tau, last), there in zip(
                    (("novel", 0.343, 420), ("bored", 0.96, 1176)), histograms, strict=True)
            },
            "activation": {
                "t_s": (START_S + times).tolist(),
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


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return build(tmp_path_factory.mktemp("results"), warnings=("3 lines were skipped",))


@pytest.fixture(scope="module")
def page(folder: Path) -> Page:
    path = write_report(folder)
    assert path == folder / "report.html"
    return Page(path)


FIGURES = ["map", "novelty", "histograms", "timeline", "activation", "graph"]


def test_the_page_holds_every_figure_with_words_for_those_who_cannot_see_it(page, folder):
    figures = [a for tag, a in page.tags if tag == "svg"]
    assert [a["role"] for a in figures] == ["img"] * len(FIGURES)
    assert all(a["aria-label"] for a in figures)
    assert sum(tag == "figcaption" for tag, _ in page.tags) == len(FIGURES)
    for name in FIGURES:
        svg = (folder / "figures" / f"{name}.svg").read_text(encoding="utf-8")
        ET.fromstring(svg)
        assert svg in page.text


def test_the_page_says_what_came_out(page):
    assert "3 lines were skipped" in page.words
    for words in ("duration 2:00", "path 102.0 m", "novel intervals 67 %", "reflexes 12",
                  "declared 6", "recognised 3", "dismissed 3", "landmarks 6",
                  "marks per 100 m 8.8", "2000-12-05 21:59 UTC", "retrieval threshold −5",
                  "novel ≥ .25", "τ = .343", "420 of 1221 pairs", "Reflex 0: declared L1",
                  "metres, odometry frame", "12 decided"):  # fmt: skip
        assert words in page.words, words


def test_the_page_asks_nothing_of_the_net(page):
    outside = re.compile(r"(?:https?:)?//", re.IGNORECASE)
    for tag, attributes in page.tags:
        for name, value in attributes.items():
            if name in ("src", "href", "xlink:href", "action", "srcset", "data", "poster"):
                assert value is not None
                assert value.startswith(("#", "data:")), (tag, name, value)
            elif not name.startswith("xmlns"):
                assert not outside.search(value or ""), (tag, name, value)
    namespaces = re.sub(r'xmlns(:\w+)?="[^"]*"', "", page.text)
    assert not re.search(r"https?://|@import|url\((?!#)", namespaces)
    assert ("default-src 'none'") in page.text


def test_ids_are_unique_and_references_meet_one(page):
    ids = [a["id"] for _, a in page.tags if "id" in a]
    assert len(ids) == len(set(ids))
    links = {v[1:] for _, a in page.tags for k, v in a.items()
             if k in ("href", "xlink:href") and v and v.startswith("#")}  # fmt: skip
    links |= set(re.findall(r"url\(#([^)]+)\)", page.text))
    assert links <= set(ids)


def test_landmarks_of_the_table_have_a_marker_on_the_map_and_in_the_graph(page):
    rows = [a["data-mark"] for tag, a in page.tags if tag == "tr" and "data-mark" in a]
    assert rows == [str(i) for i in range(6)]
    ids = {a["id"] for _, a in page.tags if "id" in a}
    assert {f"{figure}-lm{i}" for figure in ("map", "graph") for i in range(6)} <= ids


def test_equal_results_give_equal_bytes_whatever_the_users_own_style(page, folder, tmp_path):
    import matplotlib as mpl

    twin = build(tmp_path / "twin", warnings=("3 lines were skipped",))
    with mpl.rc_context({"font.size": 30, "lines.linewidth": 9, "axes.facecolor": "black"}):
        write_report(twin)
        assert mpl.rcParams["font.size"] == 30
    assert (twin / "report.html").read_text(encoding="utf-8") == page.text
    for name in FIGURES:
        file = f"figures/{name}.svg"
        assert (twin / file).read_bytes() == (folder / file).read_bytes()


def test_everything_from_data_is_escaped(tmp_path):
    evil = '<script>alert("x")</script>&$x^2$'
    page = Page(write_report(build(tmp_path / "r", prefix=evil, title=evil, warnings=(evil,))))
    assert evil not in page.text
    assert sum(tag == "script" for tag, _ in page.tags) == 1
    assert evil in page.words
    ET.fromstring((tmp_path / "r" / "figures" / "map.svg").read_text(encoding="utf-8"))


@pytest.mark.parametrize(
    ("kind", "says"),
    [
        ({"per_lap": 0}, "No reflex was decided"),
        ({"per_lap": 1, "laps": 1.0, "histograms": (True, False)}, "no bored interval in this run"),
        ({"histograms": (False, False), "intervals": False}, "before the first interval"),
        ({"poses": 1, "laps": 0.0}, "start, end"),
        ({"poses": 0, "laps": 0.0, "walls": False, "intervals": False}, "marks per 100 m –"),
    ],
)  # fmt: skip
def test_poor_results_make_a_page_too(kind, says, tmp_path):
    assert says in Page(write_report(build(tmp_path / "r", **kind))).words


def test_a_figure_that_is_no_longer_drawn_does_not_stay_behind(tmp_path):
    folder = build(tmp_path / "r", per_lap=0)
    stale = folder / "figures" / "graph.svg"
    stale.write_text("old")
    write_report(folder)
    assert not stale.exists()


def test_ten_thousand_decisions_make_a_page_that_opens(tmp_path):
    folder = build(tmp_path / "r", laps=20.0, per_lap=500, poses=3000, memory=False)
    page = write_report(folder)
    assert page.stat().st_size < 3_000_000
    words = Page(page).words
    assert "landmarks 500" in words
    assert "held no landmark" in words


def test_several_runs_are_listed_and_the_first_is_shown(tmp_path):
    page = Page(write_report(build(tmp_path / "r", runs=3, poses=100, per_lap=2)))
    assert "3 runs; run 0 is shown in detail" in page.words
    assert "Small maps of 3 runs" in page.text
    assert page.words.count("end of log") >= 3


def test_simulated_runs_are_drawn_at_the_true_positions(tmp_path):
    run = read_results(build(tmp_path / "r", is_true=True)).shown
    assert run.path[0].tolist() == [0.0, 10.0, 0.0]
    first = run.landmarks[0]
    assert (first.drawn_x_m, first.drawn_y_m) == (run.reflexes[0].x_m, run.reflexes[0].y_m)
    assert first.x_m == pytest.approx(first.drawn_x_m + 1)


def test_times_count_from_the_start(folder):
    run = read_results(folder).shown
    assert run.start_s == START_S
    assert run.reflexes[0].t_s == 5.0
    assert run.path[-1, 0] == pytest.approx(2 * LAP_S)


def _spoil(folder: Path, name: str, text: str | None) -> None:
    file = folder / name
    file.unlink()
    if text is not None:
        file.write_text(text)


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("path.csv", None, r"path\.csv: cannot be read"),
        ("decisions.csv", "run,event\n0,x\n", r"decisions\.csv:2: is damaged"),
        ("figures/run-000.json", "{}", r"run-000\.json: is damaged: KeyError"),
        ("trace/run-000.jsonl", "{]\n", r"run-000\.jsonl:1: is damaged"),
        ("trace/run-000.jsonl", None, r"run-000\.jsonl: cannot be read"),
    ],
)
def test_a_damaged_file_is_named(name, text, message, tmp_path):
    folder = build(tmp_path / "r", poses=20)
    _spoil(folder, name, text)
    with pytest.raises(ResultsError, match=message) as caught:
        write_report(folder)
    assert "\n" not in str(caught.value)
    assert not (folder / "report.html").exists()


def test_a_missing_graph_or_folder_is_named(tmp_path):
    with pytest.raises(ResultsError, match="no such folder"):
        write_report(tmp_path / "nowhere")
    folder = build(tmp_path / "r", poses=20)
    _spoil(folder, "topology/run-000.json", None)
    with pytest.raises(MemoryFileError, match="cannot be read"):
        write_report(folder)
    manifest = json.loads((folder / "manifest.json").read_text()) | {"runs": []}
    _spoil(folder, "manifest.json", json.dumps(manifest))
    with pytest.raises(ResultsError, match="holds no complete run"):
        write_report(folder)


def test_drawing_costs_nothing_until_it_is_asked_for():
    code = "import sys, ssrics_like.report; sys.exit('matplotlib' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_the_shipped_log_makes_a_report(tmp_path):
    from ssrics_like.scenarios.runner import run_scenario
    from ssrics_like.scenarios.schema import LogSettings, Scenario, resolve

    log = library.root() / "scenarios" / "logs" / "demo.log.gz"
    scenario = Scenario(source=LogSettings(log=str(log)))
    out = tmp_path / "out"
    manifest = run_scenario(resolve(scenario, tmp_path), out)
    page = Page(write_report(out))
    assert f"landmarks {manifest['runs'][0]['landmarks']}" in page.words
    assert len([1 for tag, _ in page.tags if tag == "svg"]) == len(FIGURES)


# What the figures are worked out from.


def reflex(event: int, decision: str, t_s: float) -> Reflex:
    return Reflex(event, t_s, t_s + 1, 0.0, 0.0, 1.0, "left", "", decision, "", "")


def test_the_timeline_shows_the_first_of_each_decision():
    kinds = ["overwritten", "dismissed", "dismissed", "declared", "dismissed", "recognised"]
    reflexes = tuple(reflex(i, kind, float(i)) for i, kind in enumerate(kinds))
    assert [r.event for r in chosen(reflexes)] == [1, 2, 3, 5]
    assert [r.event for r in chosen(reflexes, 2)] == [1, 3]
    assert chosen(()) == []


def test_spans_follow_from_the_trace():
    goal = {"t_s": 0.0, "module": "goal", "action": "set-buffer-chunk", "name": "g",
            "chunk": {"isa": "task", "state": "watch"}}  # fmt: skip
    spans = spans_of([goal, *events(0, 1.0, landmark="L1", found=False)])
    found = {(s.lane, s.start_s, round(s.end_s, 3), s.kind, s.label) for s in spans}
    assert found == {
        ("g", 0.0, 1.05, "full", "watch"),
        ("g", 1.05, 1.3, "full", "recall"),
        ("g", 1.3, math.inf, "full", "watch"),
        ("orienting", 1.0, 1.05, "full", "left, doorway"),
        ("retrieval", 1.05, 1.25, "failed", "recalling"),
        ("productions", 1.0, 1.05, "fired", "attend"),
        ("productions", 1.25, 1.3, "fired", "declare"),
    }


def test_ways_join_both_directions_and_weigh_distances_by_traversals():
    def arc(a: str, b: str, n: int, metres: float) -> Arc:
        return Arc(a, b, n, metres, 0.0, 0.0, 0.0, metres, 0.0)

    ways = ways_of([arc("B", "A", 1, 4.0), arc("A", "B", 3, 2.0), arc("A", "C", 2, 9.0)])
    assert [(w.ends, w.traversals, w.distance_m) for w in ways] == [
        (("A", "B"), 4, 2.5),
        (("A", "C"), 2, 9.0),
    ]


@settings(max_examples=40)
@given(
    st.lists(st.floats(-50, 150), max_size=30),
    st.floats(0.1, 20.0),
)
def test_spread_values_keep_their_order_gap_and_limits(wanted, gap):
    placed = spread(wanted, gap, 0.0, 100.0)
    least = min(gap, 100.0 / max(len(wanted) - 1, 1))
    assert all(-1e-6 <= value <= 100 + 1e-6 for value in placed)
    order = np.argsort(wanted, kind="stable")
    assert (np.diff(np.array(placed)[order]) >= least - 1e-6).all()


@settings(max_examples=40)
@given(st.lists(st.tuples(st.floats(0, 300), st.floats(0, 200)), max_size=40))
def test_labels_never_overlap(points):
    room = Room(300.0, 200.0)
    room.cross(np.array(points).reshape(-1, 2))
    found = [room.find(around(x, y, 3.0, 10.0, 4.0), 10.0, 4.0) for x, y in points]
    placed = [p for p in found if p is not None]
    for i, (x, y) in enumerate(placed):
        assert 10 <= x <= 290
        assert 4 <= y <= 196
        for u, v in placed[:i]:
            assert abs(x - u) >= 20 - 1e-6 or abs(y - v) >= 8 - 1e-6


@settings(max_examples=40)
@given(st.integers(1, 50), st.integers(1, 400))
def test_coarser_novelty_agrees_with_a_loop(bins_max, count):
    values = np.sin(np.arange(float(count)))
    novelty = Novelty(np.arange(float(count)), values, values - 1, values + 1)
    made = coarser(novelty, bins_max)
    per_bin = math.ceil(count / bins_max)
    parts = [values[i : i + per_bin] for i in range(0, count, per_bin)]
    assert len(made.t_s) <= bins_max
    np.testing.assert_allclose(made.mean, [part.mean() for part in parts])
    np.testing.assert_allclose(made.least, [part.min() - 1 for part in parts])
    np.testing.assert_allclose(made.largest, [part.max() + 1 for part in parts])


def test_walls_land_where_their_cells_are():
    outline = Outline(0.5, np.array([-2, 0, 3, 900]), np.array([0, 1, 1, 0]))
    share, (left, right, bottom, top) = raster(outline, Frame(-1.0, 2.0, 0.0, 1.0, 10.0))
    assert (left, right, bottom, top) == (-1.0, 2.0, 0.0, 1.0)
    assert np.argwhere(share).tolist() == [[0, 0], [1, 2], [1, 5]]


def test_a_large_building_is_drawn_in_fewer_pixels():
    cells = np.arange(50_000)
    share, extent = raster(Outline(0.1, cells, cells), Frame(0.0, 5000.0, 0.0, 5000.0, 0.1))
    assert max(share.shape) <= 1800
    assert share.shape[0] == share.shape[1]
    assert (np.diagonal(share) == 1).sum() >= len(cells) // math.ceil(50_000 / 1800)
    assert extent[1] >= 5000.0


def test_a_map_keeps_equal_scales_and_stays_within_its_heights():
    x = np.array([0.0, 100.0])
    wide = frame_around(np.column_stack([x, x * 0]), 700.0, (230.0, 640.0))
    assert (round(wide.width_pt), round(wide.height_pt)) == (700, 230)
    tall = frame_around(np.column_stack([x * 0, x]), 700.0, (230.0, 640.0))
    assert (round(tall.width_pt), round(tall.height_pt)) == (700, 640)
    assert tall.bottom < 0
    assert tall.top > 100


def test_numbers_read_well():
    assert [time_text(t) for t in (0.04, 59.94, 60, 3599.6, -61.0)] == [
        "0.0 s", "59.9 s", "1:00", "1:00:00", "-1:01",
    ]  # fmt: skip
    assert [fraction_text(v) for v in (0.75, 0.0, 1.0, -0.8, 0.343)] == [
        ".75", "0", "1", "−.8", ".343",
    ]  # fmt: skip
    assert [number_text(v, 2) for v in (-0.001, -1.5)] == ["0.00", "−1.50"]
    assert [clock(s).unit for s in (10, 1000, 100_000)] == ["s", "min", "h"]
    assert [round_length(v) for v in (0.7, 1.0, 4.99, 60.0)] == [0.5, 1.0, 2.0, 50.0]
