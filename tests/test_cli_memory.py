"""Runs that go on from the memory of others, and the command that looks at memories."""

import csv
import hashlib
import json
import math
import re
import shutil
from dataclasses import replace
from pathlib import Path

import networkx as nx
import numpy as np
import pytest
from saved_memories import arc, chunk, landmark, memory
from test_cli import run

from ssrics_like.errors import SettingsError
from ssrics_like.library import folder
from ssrics_like.memory import (
    load_memory_file,
    load_topology,
    save_memory_file,
    save_topology,
)
from ssrics_like.results.folder import read_manifest
from ssrics_like.scenarios.checking import check_file
from ssrics_like.scenarios.resolving import resolve
from ssrics_like.scenarios.runner import run_scenario
from ssrics_like.scenarios.schema import make_scenario, read_scenario

DEMO = folder("scenarios") / "logs" / "demo.log.gz"


def carried_out(out, **changes):
    data = {"source": {"log": str(DEMO)}, "title": DEMO.name, "seed": 7, "trace": False, **changes}
    return run_scenario(resolve(make_scenario(data), Path.cwd()), out)


@pytest.fixture(scope="module")
def first(tmp_path_factory):
    """Return the results of one run."""
    out = tmp_path_factory.mktemp("memory") / "first"
    carried_out(out)
    return out


@pytest.fixture(scope="module")
def second(first):
    """Return those of two runs, each of which began with that memory, an hour later."""
    out = first.parent / "second"
    carried_out(out, runs=2, memory_from=str(first), memory_pause_s=3600.0)
    return out


def memory_of(out, number=0):
    return load_memory_file(out / "memory" / f"run-{number:03d}.json")


def test_every_run_leaves_its_memory(first):
    (entry,) = read_manifest(first)["runs"]
    saved = memory_of(first)
    assert len(saved.landmarks) == entry["landmarks"] == entry["decisions"]["declared"] > 0
    assert len(saved.chunks) == entry["chunks"]
    assert saved.frame == "odometry"
    assert "memory_from" not in read_manifest(first)["scenario"]
    assert check_file(first) == "results, 1 run; frame odometry"


def test_the_next_run_begins_with_it_and_says_so(first, second):
    file = first / "memory" / "run-000.json"
    digest = hashlib.sha256(file.read_bytes()).hexdigest()
    manifest = read_manifest(second)
    told = {"name": "first", "sha256": digest, "pause_s": 3600.0, "start": "unknown"}
    assert manifest["scenario"]["memory_from"] == told
    for entry in manifest["runs"]:
        assert entry["memory_from"] == {"file": "run-000.json", "sha256": digest}
        # The same log again: each place is known, and none is declared anew.
        assert entry["decisions"].get("declared", 0) == 0
        assert entry["decisions"]["recognised"] > 0
    before, after = memory_of(first), memory_of(second, 1)
    assert after.origins == before.origins
    assert len(after.runs) == 2
    assert len({memory_of(second, n).runs[-1].id for n in (0, 1)}) == 2
    for one, other in zip(before.chunks, after.chunks, strict=True):
        grown_s = {round(b - a, 6) for a, b in zip(one.ages_s, other.ages_s, strict=False)}
        assert grown_s == {round(after.runs[0].ended_ago_s, 6)}


def test_a_run_from_home_knows_the_first_place_at_once(capsys, first, second, tmp_path):
    out = tmp_path / "home"
    carried_out(out, memory_from=str(first), memory_start="home")
    assert read_manifest(out)["scenario"]["memory_from"]["start"] == "home"
    confident = {}
    for each in (out, second):
        with (each / "decisions.csv").open() as lines:
            row = next(row for row in csv.DictReader(lines) if row["landmark"] == "L1")
        confident[each] = float(row["confidence"])
    assert confident[out] > confident[second]
    assert memory_of(out).home == memory_of(first).home
    for each, said in ((out, "0.0 s before; the robot begins at home"), (second, "1:00:00 before")):
        assert run(capsys, "report", each)[0] == 0
        assert f"run-000.json, {said}<" in (each / "report.html").read_text()


def test_home_must_be_remembered(capsys, first, tmp_path):
    path = scenario_file(tmp_path, "memory_start: home")
    assert refusal(path).endswith("memory_start: home needs memory_from, which knows where that is")
    saved = replace(memory_of(first), home=None)
    save_memory_file(saved, tmp_path / "old.json")
    status, _, complained = run(
        capsys, "replay", DEMO, "-o", tmp_path / "out", "-q", "--memory-from",
        tmp_path / "old.json", "--set", "memory_start=home",
    )  # fmt: skip
    assert status == 1
    assert complained.count("\n") == 1
    assert "old.json: remembers no home, which memory_start: home needs" in complained
    assert not (tmp_path / "out").exists()


def test_the_same_runs_give_the_same_memory_and_run_ids(first, tmp_path):
    carried_out(tmp_path / "again", title="another title", runs=2)
    file = Path("memory", "run-000.json")
    assert (tmp_path / "again" / file).read_bytes() == (first / file).read_bytes()


def test_of_several_runs_each_goes_on_from_its_own(second, tmp_path):
    carried_out(tmp_path / "third", runs=2, memory_from=str(second))
    entries = read_manifest(tmp_path / "third")["runs"]
    assert [entry["memory_from"]["file"] for entry in entries] == ["run-000.json", "run-001.json"]
    for number in (0, 1):
        ids = [each.id for each in memory_of(tmp_path / "third", number).runs]
        assert ids[:2] == [each.id for each in memory_of(second, number).runs]


def test_a_run_can_go_on_in_the_folder_that_its_memory_is_in(first, tmp_path):
    out = tmp_path / "out"
    shutil.copytree(first, out)
    carried_out(out, memory_from=str(out))
    assert len(memory_of(out).runs) == 2


def test_other_runs_resume_only_from_the_same_memory(capsys, first, second, tmp_path):
    out = tmp_path / "out"
    shutil.copytree(second, out)
    common = ("replay", DEMO, "-o", out, "-q", "--seed", 7, "--runs", 3, "--jobs", 1, "--resume",
              "--set", "trace=false")  # fmt: skip
    status, _, complained = run(capsys, *common, "--memory-from", first)
    assert status == 1
    assert "memory_from.pause_s was 3600.0, now it is 0.0" in complained
    status, _, complained = run(
        capsys, *common, "--memory-from", first, "--set", "memory_pause_s=3600"
    )
    assert (status, complained) == (0, "")
    assert read_manifest(out)["runs"][:2] == read_manifest(second)["runs"]


def scenario_file(tmp_path, *lines):
    path = tmp_path / "scenario.yaml"
    path.write_text("\n".join([f"source: {{log: {DEMO}}}", *lines]) + "\n")
    return path


def refusal(path):
    with pytest.raises(SettingsError) as caught:
        read_scenario(path)
    return str(caught.value)


def test_the_key_of_a_scenario_starts_at_its_file(first, tmp_path):
    path = scenario_file(tmp_path, "memory_from: kept/", "memory_pause_s: 60")
    shutil.copytree(first, tmp_path / "kept")
    scenario, document = read_scenario(path)
    resolved = resolve(scenario, tmp_path, where=document.where)
    assert resolved.recollection.pause_s == 60.0
    assert resolved.recollection.by_run[0].memory.runs[0].ended_ago_s == 60.0
    assert "1 run of demo.log.gz" in check_file(path)


def test_what_is_wrong_with_the_key_is_said_with_its_place(tmp_path):
    path = scenario_file(tmp_path, "memory_from: nowhere")
    assert refusal(path) == f"{path}:2:1: memory_from: {tmp_path}/nowhere: no such file or folder"
    path = scenario_file(tmp_path, "memory_from: .", "memory_pause_s: -1", "decay: 3")
    here, pause, unknown = refusal(path).splitlines()
    assert here.startswith(f"{path}:2:1: memory_from: {tmp_path}: holds no memory (memory/run-NNN")
    assert pause.startswith(f"{path}:3:1: memory_pause_s: -1: expected greater than or equal to 0")
    assert unknown.startswith(f"{path}:4:1: unknown key 'decay'")
    path = scenario_file(tmp_path, "memory_from: 3")
    assert refusal(path) == f"{path}:2:1: memory_from: 3 where text was expected"


def test_a_damaged_memory_is_named_with_the_key(capsys, tmp_path):
    (tmp_path / "old.json").write_text("{}")
    path = scenario_file(tmp_path, "memory_from: old.json")
    status, _, complained = run(capsys, "run", path, "-o", tmp_path / "out")
    assert status == 1
    assert complained == (
        f"ssrics: {path}:2:1: memory_from: {tmp_path}/old.json: no saved memory: its format is "
        "None, expected 'ssrics-memory'\n"
    )
    assert not (tmp_path / "out").exists()


def odd(tmp_path, **changes):
    path = tmp_path / "odd folder: 1.json"  # a name that YAML would not take unquoted
    save_memory_file(memory(**changes), path)
    return path


@pytest.mark.parametrize(
    ("changes", "more", "message"),
    [
        ({}, (), "its views have 36 numbers, those of this model 108 (perception.view and view_beams)"),
        ({"frame": "map"}, ("--set", "perception.view=scan"), "its positions are in the frame 'map', those of this run in 'odometry'"),
    ],
)  # fmt: skip
def test_a_memory_that_does_not_fit_is_refused_in_a_line(capsys, tmp_path, changes, more, message):
    path = odd(tmp_path, **changes)
    for command in (["run", "demo"], ["replay", DEMO]):
        status, _, complained = run(
            capsys, *command, "-o", tmp_path / "out", "--memory-from", path, *more
        )
        assert status == 1
        assert complained == f"ssrics: {path}: {message}\n"
        assert not (tmp_path / "out").exists()


def test_a_run_that_has_no_memory_to_go_on_from_is_said(capsys, second, tmp_path):
    status, _, complained = run(
        capsys, "run", "demo", "-n", 3, "-o", tmp_path / "out", "--memory-from", second
    )
    assert status == 1
    assert complained == (
        f"ssrics: {second}: holds the memories of 2 runs, but none of run 2; name the file that "
        f"all runs shall begin with, for example {second}/memory/run-000.json\n"
    )


def test_the_command_run_goes_on_and_reports(capsys, first, tmp_path):
    out = tmp_path / "out"
    status, said, complained = run(
        capsys, "run", "demo", "-o", out, "--memory-from", first / "memory" / "run-000.json"
    )
    assert (status, complained) == (0, "")
    assert "0 declared" not in said
    assert (out / "report.html").is_file()
    assert read_manifest(out)["scenario"]["memory_from"]["name"] == "run-000.json"


def test_show_lists_landmarks(capsys, first):
    status, said, _ = run(capsys, "memory", "show", first)
    lines = said.splitlines()
    assert status == 0
    count = len(memory_of(first).landmarks)
    assert f"{count} landmarks" in lines[0]
    assert lines[2].split() == [
        "landmark", "structure", "visits", "references", "activation", "last", "seen,", "ago",
        "degree", "salience", "relevance", "permanence",
    ]  # fmt: skip
    assert [line.split()[0] for line in lines[4 : 4 + count]] == list(memory_of(first).origins)


def test_show_prints_json_of_any_later_moment(capsys, tmp_path):
    path = tmp_path / "run.json"
    save_memory_file(memory(1, 2), path)
    status, said, _ = run(capsys, "memory", "show", path, "--pause", "40", "--json")
    assert status == 0
    one, _ = json.loads(said)
    views = [chunk(n).chunk.slots["view"].descriptor.astype(float) for n in (1, 2)]
    correlated = max(0.0, np.corrcoef(views)[0, 1])
    assert one == {
        "landmark": "L1", "structure": "doorway", "visits": 2, "references": 2,
        "activation": round(math.log(100**-0.5 + 52.5**-0.5), 6),
        "last_seen_ago_s": 52.5, "degree": 1, "origin": "run-a/L1",
        # Two scans, correlated by r; a dead end; it lasted 47.5 s.
        "salience": round(math.log2(2 / (1 + math.exp(-2 * (1 - correlated)))), 6),
        "relevance": 0, "permanence": round((47.5 + 60) / (47.5 + 60 + 52.5), 6),
    }  # fmt: skip


def test_check_knows_a_memory(capsys, tmp_path):
    path = tmp_path / "run.json"
    save_memory_file(memory(1, 2), path)
    status, said, _ = run(capsys, "check", path)
    assert (status, said) == (0, f"{path}: ok: memory, 2 landmarks, 1 run\n")
    path.write_bytes(path.read_bytes()[:400])
    status, _, complained = run(capsys, "check", path)
    assert status == 1
    assert f"{path}:8: damaged: " in complained


def test_merge_says_what_it_did(capsys, tmp_path):
    for name, run_name in [("a", "run-a"), ("b", "run-b")]:
        save_memory_file(memory(1, 2, run=run_name), tmp_path / f"{name}.json")
    out = tmp_path / "both.json"
    status, said, _ = run(
        capsys, "memory", "merge", *(tmp_path / f"{name}.json" for name in "aba"), "-o", out
    )
    assert status == 0
    assert said.splitlines() == [
        f"{tmp_path}/a.json: 2 landmarks, 1 arc, 2 chunks, names kept",
        f"{tmp_path}/b.json: 0 joined",
        f"{tmp_path}/b.json: 2 new: L1 as L3, L2 as L4",
        f"{tmp_path}/a.json: 2 joined: L1, L2",
        f"{tmp_path}/a.json: 0 new",
        f"{out}: 4 landmarks, 2 arcs, 4 chunks",
    ]
    assert load_memory_file(out).origins == {
        "L1": "run-a/L1", "L2": "run-a/L2", "L3": "run-b/L1", "L4": "run-b/L2",
    }  # fmt: skip


def test_export_is_read_by_others(capsys, tmp_path):
    path = tmp_path / "run.json"
    save_memory_file(memory(1, 2, 3), path)
    for ending in ("graphml", "json", "svg"):
        out = tmp_path / f"graph.{ending}"
        status, said, _ = run(capsys, "memory", "export", path, "-o", out)
        assert (status, said) == (0, f"{out}: 3 landmarks, 2 arcs, 3 chunks\n")
    graph = nx.read_graphml(tmp_path / "graph.graphml")
    assert graph.nodes["L2"]["origin"] == "run-a/L2"
    assert load_topology(tmp_path / "graph.json").arcs == load_memory_file(path).arcs
    picture = (tmp_path / "graph.svg").read_text()
    assert picture.startswith("<svg")
    for name in ("L1", "L2", "L3"):
        assert f">{name}<" in picture
    run(capsys, "memory", "export", path, "-o", tmp_path / "again.svg")
    assert (tmp_path / "again.svg").read_text() == picture


def measured(*steps):
    """A memory of three landmarks declared at one place, with arcs that tell how they lie."""
    arcs = tuple(
        replace(arc(one, other), x_m=x_m, position_sd_m=0.1, direction_sd_rad=0.01)
        for one, other, x_m in steps
    )
    here = tuple(landmark(n, x_m=1.0, y_m=2.0, theta_rad=0.0) for n in (1, 2, 3))
    return memory(1, 2, 3, arcs=arcs, landmarks=here)


def test_an_exported_graph_says_where_landmarks_lie_in_one_frame(capsys, tmp_path):
    path = tmp_path / "run.json"
    # The error of 0.3 m on the way round is shared by three arcs.
    save_memory_file(measured((1, 2, 3.0), (2, 3, 3.0), (1, 3, 6.3)), path)
    graphs = []
    for ending in ("graphml", "json"):
        out = tmp_path / f"graph.{ending}"
        assert run(capsys, "memory", "export", path, "-o", out)[0] == 0
        content = out.read_bytes()
        run(capsys, "memory", "export", path, "-o", out)
        assert out.read_bytes() == content
        graphs.append(
            nx.read_graphml(out) if ending == "graphml"
            else nx.node_link_graph(json.loads(content), edges="edges")
        )  # fmt: skip
    for graph in graphs:
        nodes = dict(graph.nodes(data=True))
        assert [nodes[f"L{n}"]["layout_x_m"] for n in (1, 2, 3)] == [-2.1, 1.0, 4.1]
        assert [node["layout_y_m"] for node in nodes.values()] == [2.0] * 3
        assert [node["layout_theta_rad"] for node in nodes.values()] == [0.0] * 3
        assert [node["component"] for node in nodes.values()] == [0] * 3
        assert nodes["L3"]["x_m"] == 1.0


@pytest.mark.parametrize("ending", ["graphml", "json"])
def test_a_layout_is_reckoned_and_not_remembered(capsys, tmp_path, ending):
    path, out, again = (tmp_path / name for name in ("run.json", f"a.{ending}", f"b.{ending}"))
    saved = measured((1, 2, 3.0))
    save_memory_file(saved, path)
    run(capsys, "memory", "export", path, "-o", out)
    loaded = load_topology(out)
    for node, before in zip(loaded.nodes, saved.landmarks, strict=True):
        assert node.labels == {**before.labels, "origin": saved.origins[node.id]}
    save_topology(loaded, again)
    assert "layout_x_m" not in again.read_text()
    assert load_topology(again).nodes == loaded.nodes


def test_a_picture_shows_landmarks_where_they_fit_best(capsys, tmp_path):
    path, out = tmp_path / "run.json", tmp_path / "graph.svg"
    save_memory_file(measured((1, 2, 3.0), (1, 3, -6.0)), path)
    run(capsys, "memory", "export", path, "-o", out)
    dot = r'id="memory-lm\d">.*?<use [^>]*x="([0-9.]+)"'
    one, two, three = map(float, re.findall(dot, out.read_text(), re.DOTALL))
    assert two - one > 50
    assert one - three == pytest.approx(2 * (two - one), abs=0.05)


def test_a_picture_of_nothing_is_drawn(capsys, tmp_path):
    path = tmp_path / "run.json"
    nothing = {"chunks": (), "landmarks": (), "arcs": (), "origins": {}}
    save_memory_file(memory(**nothing), path)
    for arguments in (["export", path, "-o", tmp_path / "none.svg"], ["show", path]):
        status, _, complained = run(capsys, "memory", *arguments)
        assert (status, complained) == (0, "")


def test_mistakes_are_one_line(capsys, first, second, tmp_path):
    file = tmp_path / "run.json"
    save_memory_file(memory(), file)
    save_memory_file(memory(frame="map", run="b"), tmp_path / "map.json")
    for arguments, message in [
        (["show", tmp_path / "no"], f"{tmp_path}/no: no such file or folder"),
        (["show", second], f"{second}: holds the memories of 2 runs; name one, for example "),
        (["show", DEMO], f"{DEMO}: damaged: 'utf-8' codec can't decode"),
        (["show", file, "--pause", "-1"], "--pause: -1: expected seconds, 0 or more"),
        (["show", file, "--profile", "act-z"], "no memory entry 'act-z'"),
        (["merge", file, file, "-o", tmp_path / "a.txt"], "a.txt: expected a name ending in .json"),
        (["merge", file, tmp_path / "map.json", "-o", tmp_path / "a.json"],
         f"{tmp_path}/map.json: cannot be merged with {file}: its positions are in the frame 'map'"),
        (["export", file, "-o", tmp_path / "a.png"], "a.png: expected a name ending in .graphml,"),
        (["export", file, "-o", file], f"{file}: would take the memory's own place"),
        (["export", file, "-o", tmp_path / "no" / "a.svg"], "a.svg: cannot be written: No such"),
    ]:  # fmt: skip
        status, said, complained = run(capsys, "memory", *arguments)
        assert (status, said) == (1, "")
        assert message in complained
        assert complained.count("\n") == 1


def test_a_word_where_a_view_should_be_is_said(first, tmp_path, capsys):
    data = json.loads((first / "memory" / "run-000.json").read_text())
    data["chunks"][1]["slots"]["view"] = "door"
    odd = tmp_path / "odd.json"
    odd.write_text(json.dumps(data))
    name = data["chunks"][1]["name"]
    out = tmp_path / "out"
    for words in (("memory", "show", odd), ("run", "demo", "--memory-from", odd, "-o", out)):
        code, _, err = run(capsys, *map(str, words))
        assert code == 1
        assert f"{odd}: chunk '{name}': view is 'door'; expected a view" in err
    assert not out.exists()
