"""The report of a results folder that is built by hand, in our writers' formats."""

import itertools
import json
import math
import re
import subprocess
import sys
import xml.etree.ElementTree as ET
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from matplotlib.collections import LineCollection
from results_folders import (
    LAP_S,
    PUBLISHED,
    START_S,
    Page,
    build,
    build_world,
    building,
    events,
)

from ssrics_like import library
from ssrics_like.errors import MemoryFileError, ResultsError
from ssrics_like.memory.landmark import Arc
from ssrics_like.perception.observation import Pose
from ssrics_like.report import locations_figure, style, write_report
from ssrics_like.report.contours import coarser as joined_cells
from ssrics_like.report.contours import polygons
from ssrics_like.report.episodes import chosen
from ssrics_like.report.frames import Frame, frame_around, round_length
from ssrics_like.report.graph_figure import ways_of
from ssrics_like.report.labels import Room, around, legend_grid, spread
from ssrics_like.report.map_figure import draw_map
from ssrics_like.report.markers import describe
from ssrics_like.report.novelty_figure import coarser
from ssrics_like.report.pictures import Novelty, Outline
from ssrics_like.report.plan import bounds_of
from ssrics_like.report.reading import read_results
from ssrics_like.report.spans import spans_of
from ssrics_like.report.walls import raster
from ssrics_like.report.words import clock, fraction_text, number_text, time_text
from ssrics_like.results.records import Reflex
from ssrics_like.world.grid import GridMap


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


@pytest.mark.parametrize("kind", ["page", "world_page"])
def test_the_page_asks_nothing_of_the_net(kind, request):
    page = request.getfixturevalue(kind)
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


@pytest.mark.parametrize("kind", ["page", "world_page"])
def test_ids_are_unique_and_references_meet_one(kind, request):
    page = request.getfixturevalue(kind)
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
    assert "keeps no landmark in declarative memory" in words


def test_several_runs_are_listed_and_the_first_is_shown(tmp_path):
    page = Page(write_report(build(tmp_path / "r", runs=3, poses=100, per_lap=2)))
    assert "3 runs; run 0 is shown in detail" in page.words
    assert "Small maps of 3 runs" in page.text
    assert page.words.count("end of log") >= 3


# Runs in a simulated building.

WORLD_FIGURES = ["map", "locations", "runs", *FIGURES[1:]]


@pytest.fixture(scope="module")
def world(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("world")
    return build_world(folder, poses=200, published=PUBLISHED, title="Complex map")


@pytest.fixture(scope="module")
def world_page(world: Path) -> Page:
    return Page(write_report(world))


def test_the_page_of_a_building_shows_plan_locations_and_coverage(world_page, world):
    assert sum(tag == "svg" for tag, _ in world_page.tags) == len(WORLD_FIGURES)
    for name in [*WORLD_FIGURES, "map-column"]:
        ET.fromstring((world / "figures" / f"{name}.svg").read_text(encoding="utf-8"))
    for words in ("The simulated building rooms.yaml, sensed with",
                  "coverage 99.3 % of what was reachable at the start", "The floor plan of the building", "metres, true positions",
                  "location found (", "location missed (", "other labelled place (3)",
                  "Table 1. In what share of 14 runs", "as published (report, table 1)",
                  "5 office & archive", "78 %", "no frontier left", "World: rooms.yaml",
                  "Rooms round a block", "speed_m_s 0.894", "of 84", "consistency"):  # fmt: skip
        assert words in world_page.words, words
    assert "own clock" not in world_page.words
    assert "laser beams ended" not in world_page.words


def test_the_table_of_locations_says_what_locations_csv_says(world_page, world):
    scores = read_results(world).scores.scores
    for place in scores.places:
        low, high = place.interval
        row = (
            f"{place.found} of 14 {100 * place.share:.0f} % {100 * low:.0f}–{100 * high:.0f} % "
            f"{100 * place.chance:.0f} %"
        )
        assert row in world_page.words


def test_what_a_building_is_drawn_as_is_vectors_and_stands_once_in_a_figure(world):
    for name in ("map", "map-column", "runs", "graph"):
        assert "<image" not in (world / "figures" / f"{name}.svg").read_text()
    plan = re.compile(r'<path id="runs-[^"]*" d="([^"]*)"')
    longest = max(plan.findall((world / "figures" / "runs.svg").read_text()), key=len)
    assert (world / "figures" / "runs.svg").read_text().count(longest) == 1


def test_equal_buildings_give_equal_pages(world_page, tmp_path):
    twin = build_world(tmp_path / "twin", poses=200, published=PUBLISHED, title="Complex map")
    assert write_report(twin).read_text(encoding="utf-8") == world_page.text


def test_names_and_labels_of_places_are_escaped(tmp_path):
    evil = '<b>&"x'
    places = tuple(replace(p, id=f"{p.id}{evil}", label=evil) for p in building().locations)
    folder = build_world(
        tmp_path / "r", runs=2, poses=30, places=replace(building(), locations=places)
    )
    page = Page(write_report(folder))
    assert evil not in page.text
    assert evil in page.words
    for name in ("map", "map-column", "locations", "runs"):
        ET.fromstring((folder / "figures" / f"{name}.svg").read_text(encoding="utf-8"))


@pytest.mark.parametrize(
    ("kind", "says"),
    [
        ({"places": replace(building(), locations=())}, "floor plan"),
        ({"places": building(doors=0)}, "No doorway is labelled"),
        ({"places": building(others=False), "runs": 1}, "Table 1. In what share of 1 run "),
        ({"misses": 1.0, "laps": 0.4}, "precision –"),
    ],
)  # fmt: skip
def test_poor_buildings_make_a_page_too(kind, says, tmp_path):
    folder = build_world(tmp_path / "r", **{"runs": 2, "poses": 30, **kind})
    page = Page(write_report(folder))
    assert says in page.words
    assert "Traceback" not in page.words


def test_figures_of_a_building_do_not_stay_in_the_folder_of_a_log(tmp_path):
    folder = build(tmp_path / "r", poses=20)
    stale = [folder / "figures" / f"{name}.svg" for name in ("locations", "map-column", "runs")]
    for file in stale:
        file.write_text("old")
    write_report(folder)
    assert not any(file.exists() for file in stale)


def test_simulated_runs_are_drawn_at_the_true_positions(tmp_path):
    run = read_results(build(tmp_path / "r", is_true=True)).shown
    assert run.path[0].tolist() == [0.0, 10.0, 0.0]
    first = run.landmarks[0]
    assert (first.drawn_x_m, first.drawn_y_m) == (run.reflexes[0].x_m, run.reflexes[0].y_m)
    assert first.x_m == pytest.approx(first.drawn_x_m + 1)


def test_a_short_kidnap_breaks_the_path_too(tmp_path):
    folder = build_world(tmp_path / "r", runs=2, poses=400)
    manifest = json.loads((folder / "manifest.json").read_text())
    manifest["scenario"]["world"]["kidnaps"] = [
        {"at_s": 30.0, "to": [1, 1]}, {"at_s": 0.0, "to": [1, 1]}, {"at_s": 1e4, "to": [1, 1]},
    ]  # fmt: skip
    (folder / "manifest.json").write_text(json.dumps(manifest))
    results = read_results(folder)
    run = results.shown
    (landing,) = run.landings  # not at the start, nor after the end
    assert run.path[landing - 1, 0] < 30.0 <= run.path[landing, 0]
    with style.context():
        drawing = draw_map(results)
    (axes,) = drawing.figure.axes
    lines = [line for c in axes.collections if isinstance(c, LineCollection)
             for line in c.get_segments()]  # fmt: skip
    before, after = run.path[landing - 1, 1:], run.path[landing, 1:]
    assert any(np.array_equal(line[-1], before) for line in lines)
    assert any(np.array_equal(line[0], after) for line in lines)
    for line in lines:
        assert not any((a == before).all() and (b == after).all()
                       for a, b in itertools.pairwise(line))  # fmt: skip
    words = Page(write_report(folder)).words
    assert "carried elsewhere (1)" in words
    assert "Dotted: the robot was carried" in words


def test_what_no_memory_holds_is_not_said_to_be_undeclared(tmp_path):
    words = Page(write_report(build(tmp_path / "a", poses=50, memory=False))).words
    assert "keeps no landmark in declarative memory" in words
    words = Page(write_report(build(tmp_path / "b", poses=50, per_lap=0, memory=False))).words
    assert "No landmark was declared in this run, so that declarative memory held none." in words


def test_the_robot_has_a_table_of_its_own(tmp_path):
    folder = build_world(tmp_path / "r", runs=1, poses=50)
    manifest = json.loads((folder / "manifest.json").read_text())
    manifest["scenario"]["world"]["robot"]["laser"] = {"beams": 180, "noise_m": 0.01}
    (folder / "manifest.json").write_text(json.dumps(manifest))
    words = Page(write_report(folder)).words
    assert "Robot: pioneer-dx speed_m_s 0.894 laser.beams 180 laser.noise_m 0.01" in words


def test_the_clock_looks_the_same_in_the_legend():
    assert locations_figure.clock_look().get("linestyle", "-") == "-"  # as its upright mark


def test_the_table_of_landmarks_says_whose_positions_it_has(world_page, page):
    assert "those that the robot believed in (odometry frame)" in world_page.words
    assert "believed in" not in page.words


def test_results_from_before_landmarks_had_these_numbers_are_read(tmp_path):
    """Salience was novelty, relevance a count, permanence an activation or nothing."""
    folder = build(tmp_path / "old", poses=300)
    file = folder / "landmarks.csv"
    header, *lines = file.read_text().splitlines()
    old = [
        ",".join([*line.split(",")[:-4], "0.8", "3", ("-2.5", "")[number % 2], "2"])
        for number, line in enumerate(lines)
    ]
    file.write_text("\n".join([header, *old]) + "\n")
    one, other, *_ = read_results(folder).shown.landmarks
    assert (one.salience, one.relevance, one.permanence) == (0.8, 3.0, -2.5)
    assert other.permanence is None
    assert "−2.50" in Page(write_report(folder)).words


def test_a_landmark_without_a_view_has_no_salience(tmp_path):
    folder = build(tmp_path / "r", poses=300, memory=False)
    landmark = read_results(folder).shown.landmarks[0]
    assert landmark.salience is None
    assert "salience" not in describe(landmark)
    assert describe(replace(landmark, salience=2.254)).endswith("; salience 2.25; visits: 2")
    assert Page(write_report(folder)).words.count("–") >= len(read_results(folder).shown.landmarks)


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
    from ssrics_like.scenarios.resolving import resolve
    from ssrics_like.scenarios.runner import run_scenario
    from ssrics_like.scenarios.schema import LogSettings, Scenario

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


def winding(x: float, y: float, rings: list[np.ndarray]) -> int:
    """Count how often closed polygons run round a point, counter-clockwise positive."""
    total = 0.0
    for ring in rings:
        angles = [math.atan2(v - y, u - x) for u, v in ring.tolist()]
        for a, b in zip(angles, angles[1:] + angles[:1], strict=True):
            total += math.remainder(b - a, math.tau)
    return round(total / math.tau)


@settings(max_examples=60, deadline=None)
@given(st.integers(1, 6), st.integers(1, 6), st.integers(0, 2**32 - 1))
def test_outlines_run_round_filled_cells_once_and_round_no_other(rows, columns, seed):
    mask = np.random.default_rng(seed).random((rows, columns)) < 0.5
    rings = polygons(mask)
    for row in range(-1, rows + 1):
        for column in range(-1, columns + 1):
            inside = 0 <= row < rows and 0 <= column < columns and mask[row, column]
            assert winding(column + 0.5, row + 0.5, rings) == inside
    for ring in rings:  # every corner is one
        steps = np.sign(np.diff(np.vstack([ring, ring[:1]]), axis=0))
        assert (np.abs(steps).sum(axis=1) == 1).all()
        assert (steps != np.roll(steps, 1, axis=0)).any(axis=1).all()


def test_squares_of_cells_are_filled_if_any_cell_is():
    mask = np.zeros((5, 4), bool)
    mask[4, 3] = mask[0, 1] = True
    joined = joined_cells(mask, 2)
    assert np.argwhere(joined).tolist() == [[0, 0], [2, 1]]
    assert joined.shape == (3, 2)


def test_a_plan_lies_where_its_map_lies():
    grid = GridMap(np.array([[2, 2, 2], [2, 0, 1]], np.uint8), 0.5, Pose(10.0, 20.0, math.pi / 2))
    # Columns 1 and 2 of row 1: x from .5 to 1.5 and y from .5 to 1 of the grid, turned left.
    found = {tuple(corner) for corner in bounds_of(grid).round(9).tolist()}
    assert found == {(9.5, 20.5), (9.0, 20.5), (9.5, 21.5), (9.0, 21.5)}
    assert len(bounds_of(GridMap(np.full((2, 2), 2, np.uint8), 0.5))) == 0


def test_a_legend_takes_as_many_rows_as_it_needs():
    texts = ["landmark, left (12)"] * 5
    assert legend_grid(texts, 1000.0) == (5, 1)
    assert legend_grid(texts, 350.0) == (3, 2)
    assert legend_grid(texts, 1.0) == (1, 5)
    assert legend_grid([], 100.0) == (1, 1)


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


@pytest.mark.parametrize(
    ("perception", "counted"), [("report", "50 scans"), ("human-like", "12 places along the way")]
)
def test_the_caption_of_novelty_says_what_intervals_count(tmp_path, perception, counted):
    from ssrics_like.scenarios.resolving import resolve
    from ssrics_like.scenarios.runner import run_scenario
    from ssrics_like.scenarios.schema import make_scenario

    log = library.root() / "scenarios" / "logs" / "demo.log.gz"
    scenario = make_scenario({"source": {"log": str(log)}, "perception": perception})
    run_scenario(resolve(scenario, tmp_path), tmp_path / "out")
    write_report(tmp_path / "out")
    page = (tmp_path / "out" / "report.html").read_text()
    assert f"of each interval of {counted}: the line" in page
