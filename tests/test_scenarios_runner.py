"""Runs in a building: the same bytes however they are carried out, and none lost."""

import csv
import html
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from buildings import DOOR, two_rooms

from ssrics_like.cli import main
from ssrics_like.errors import ResultsError, SettingsError, SsricsError
from ssrics_like.maps import load_building, save_building
from ssrics_like.perception.observation import Pose
from ssrics_like.report import write_variants_report
from ssrics_like.results.checking import check_results
from ssrics_like.results.folder import read_manifest
from ssrics_like.scenarios.checking import check_file
from ssrics_like.scenarios.resolving import load_resolved, resolve
from ssrics_like.scenarios.runner import drive_key, run_scenario
from ssrics_like.scenarios.schema import make_scenario, read_scenario
from ssrics_like.scenarios.variants import (
    VARIANTS_MAX,
    resolve_variants,
    run_variants,
    variants_of,
)
from ssrics_like.world.building import Building
from ssrics_like.world.locations import Location

RUNS = 5
ORIGIN = Pose(10.0, -3.0, 0.5)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Return a folder with a map of two rooms and a scenario that explores it five times."""
    path = tmp_path_factory.mktemp("runner")
    grid = two_rooms(origin=ORIGIN)
    ((x, y),) = grid.points_in_map([DOOR]).tolist()
    building = Building("Two rooms", grid, (Location("door", round(x, 4), round(y, 4)),))
    save_building(building, path, "two")
    (path / "scenario.yaml").write_text(
        f"title: Two rooms\nruns: {RUNS}\nseed: 11\nworld:\n  map: two.yaml\n  people: {{count: 1}}\n"
        "  furniture: {pieces: 2}\n  slip: {per_m: 0.2}\n  time_limit_s: 40\n"
        f"  start: {[round(v, 4) for v in grid.points_in_map([(1.0, 1.5)])[0].tolist()]}\n"
    )
    return path


def scenario(folder, *overrides):
    return load_resolved(folder / "scenario.yaml", list(overrides))


@pytest.fixture(scope="module")
def whole(folder):
    """Return the results of an uninterrupted command with one job, and the manifest."""
    out = folder / "whole"
    return out, run_scenario(scenario(folder), out)


def files(path):
    """Return every file of a results folder but for the clock in the manifest."""
    found = {
        str(item.relative_to(path)): item.read_bytes()
        for item in sorted(path.rglob("*"))
        if item.is_file()
    }
    manifest = json.loads(found["manifest.json"])
    assert set(manifest["wall_clock"]) == {"started", "seconds"}
    del manifest["wall_clock"]
    return {**found, "manifest.json": manifest}


def rows(path):
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


def test_two_jobs_give_the_bytes_of_one(folder, whole, tmp_path):
    run_scenario(scenario(folder), tmp_path / "two", jobs=2)
    assert files(tmp_path / "two") == files(whole[0])
    check_results(tmp_path / "two")


def test_a_run_is_the_same_however_many_there_are(folder, whole, tmp_path):
    out = tmp_path / "few"
    manifest = run_scenario(scenario(folder, "runs=2"), out)
    assert manifest["runs"] == whole[1]["runs"][:2]
    assert rows(out / "path.csv") == [r for r in rows(whole[0] / "path.csv") if int(r["run"]) < 2]
    for name in ("trace/run-001.jsonl", "topology/run-001.json", "figures/run-001.json"):
        assert (out / name).read_bytes() == (whole[0] / name).read_bytes()


def test_runs_differ_and_so_do_seeds(folder, whole, tmp_path):
    entries = whole[1]["runs"]
    assert len({entry["seed"] for entry in entries}) == RUNS
    assert len({entry["path_length_m"] for entry in entries}) == RUNS
    other = run_scenario(scenario(folder, "runs=1", "seed=12"), tmp_path / "other")
    assert other["runs"][0]["path_length_m"] != entries[0]["path_length_m"]


def test_the_manifest_says_how_each_drive_went(whole):
    out, manifest = whole
    assert manifest["frame"] == "odometry"
    assert manifest["input"]["file"] == "two.yaml"
    assert manifest["input"]["format"] == "map"
    world = manifest["scenario"]["world"]
    assert world["robot"]["name"] == "pioneer-dx"
    assert world["people"]["count"] == 1
    for entry in manifest["runs"]:
        assert entry["ended"] in ("no frontier left", "time limit of 40 s")
        assert 0.0 < entry["coverage"] <= 1.0
        assert entry["path_length_m"] > 0.5
        assert entry["duration_s"] == pytest.approx((entry["scans"] - 1) / 10.0)
        assert entry["bumps"] >= 0
    # The building lies beside the tables, in its own frame.
    grid = load_building(out / "map" / "map.yaml").grid
    assert grid.origin == ORIGIN
    assert np.array_equal(grid.cells, two_rooms().cells)


def test_true_poses_stand_beside_the_odometry_in_the_frame_of_the_map(whole):
    grid = two_rooms(origin=ORIGIN)
    paths = rows(whole[0] / "path.csv")
    assert len(paths) > 100
    apart = []
    for r in paths:
        x, y, theta = (float(r[f"true_{name}"]) for name in ("x_m", "y_m", "theta_rad"))
        at = grid.pose_in_grid(Pose(x, y, theta))
        assert grid.is_free(at.x_m, at.y_m)
        apart.append(np.hypot(float(r["x_m"]) - x, float(r["y_m"]) - y))
    assert apart[0] < 1e-5
    assert 0.01 < max(apart) < 3.0  # it drifts, and slips
    for r in rows(whole[0] / "decisions.csv"):
        assert r["true_x_m"]
        assert r["true_y_m"]


def test_what_the_user_should_know_is_a_warning(folder, tmp_path):
    shut = "world.doors=[{location: door, closes_s: 0.1}]"
    manifest = run_scenario(
        scenario(folder, "runs=1", shut, "world.people=null", "world.furniture=null"),
        tmp_path / "a",
    )
    (entry,) = manifest["runs"]
    assert entry["coverage"] < 0.99
    assert any("saw only" in text and "%" in text for text in manifest["warnings"])
    manifest = run_scenario(scenario(folder, "runs=1", "world.time_limit_s=3"), tmp_path / "b")
    assert manifest["runs"][0]["ended"] == "time limit of 3 s"
    assert any("time limit of 3 s; world.time_limit_s raises it" in w for w in manifest["warnings"])
    left_out = "world.waypoints=[[99, 99]]"
    with pytest.raises(SettingsError, match="cannot get there"):
        scenario(folder, left_out)


def interrupted_at(condition, out):
    """Return a progress callback that presses Ctrl-C once."""
    pressed = []

    def progress(number, share):
        if not pressed and condition(number, share, out):
            pressed.append((number, share))
            raise KeyboardInterrupt

    return progress, pressed


@pytest.mark.parametrize("jobs", [1, 2])
def test_an_interrupted_command_leaves_finished_runs_and_is_resumed_to_the_same_bytes(
    folder, whole, tmp_path, jobs
):
    out = tmp_path / "out"
    # In the third run, or, with two jobs, as soon as a run is finished.
    progress, pressed = interrupted_at(
        lambda number, _, out: number == 2 if jobs == 1 else (out / "manifest.json").is_file(),
        out,
    )
    with pytest.raises(KeyboardInterrupt):
        run_scenario(scenario(folder), out, jobs=jobs, progress=progress)
    assert len(pressed) == 1
    manifest = read_manifest(out)
    check_results(out)
    done = [entry["run"] for entry in manifest["runs"]]
    assert done == [0, 1] if jobs == 1 else 1 <= len(done) < RUNS
    assert manifest["runs"] == [whole[1]["runs"][run] for run in done]
    assert {int(r["run"]) for r in rows(out / "path.csv")} == set(done)
    assert not list((out / ".runs").glob("*.partial"))
    seen = set()
    run_scenario(scenario(folder), out, resume=True, jobs=jobs, progress=lambda n, _: seen.add(n))
    assert seen.isdisjoint(done)
    assert files(out) == files(whole[0])
    # There is nothing left to do.
    run_scenario(scenario(folder), out, resume=True, jobs=jobs, progress=pytest.fail)
    assert files(out) == files(whole[0])


def test_runs_in_another_building_are_not_resumed(folder, tmp_path):
    (tmp_path / "s.yaml").write_text((folder / "scenario.yaml").read_text())
    grid = two_rooms(origin=ORIGIN)
    save_building(load_building(folder / "two.yaml"), tmp_path, "two")
    out = tmp_path / "out"
    progress, _ = interrupted_at(lambda number, _share, _out: number == 1, out)
    with pytest.raises(KeyboardInterrupt):
        run_scenario(load_resolved(tmp_path / "s.yaml"), out, progress=progress)
    before = (out / "path.csv").read_bytes()
    changed = grid.cells.copy()
    changed[30, 100] = 1
    save_building(
        Building("Two rooms", type(grid)(changed, grid.cell_m, ORIGIN), ()), tmp_path, "two"
    )
    with pytest.raises(ResultsError, match="made from other settings"):
        run_scenario(load_resolved(tmp_path / "s.yaml"), out, resume=True)
    assert (out / "path.csv").read_bytes() == before


def test_ctrl_c_with_two_jobs_stops_all_processes_with_one_line(folder, tmp_path):
    out = tmp_path / "out"
    process = subprocess.Popen(
        [
            sys.executable, "-m", "ssrics_like", "run", str(folder / "scenario.yaml"),
            "-n", "200", "--jobs", "2", "-o", str(out),
        ],
        stderr=subprocess.PIPE, stdout=subprocess.PIPE, text=True, start_new_session=True,
    )  # fmt: skip
    deadline = time.monotonic() + 60
    while not (out / "manifest.json").exists() and time.monotonic() < deadline:
        time.sleep(0.02)
    os.killpg(process.pid, signal.SIGINT)  # as a terminal does: to every process of the command
    _, complained = process.communicate(timeout=60)
    assert process.returncode == 130
    assert complained.splitlines() == [
        f"ssrics: interrupted: finished runs are kept in {out}; --resume goes on"
    ]
    assert 0 < len(read_manifest(out)["runs"]) < 200
    check_results(out)
    deadline = time.monotonic() + 10
    while time.monotonic() < deadline:  # its helpers go when they notice that it has gone
        try:
            os.killpg(process.pid, 0)
        except ProcessLookupError:
            return
        time.sleep(0.05)
    pytest.fail("a process of the interrupted command is still there")


def command(capsys, *arguments):
    with pytest.raises(SystemExit) as stopped:
        main([str(argument) for argument in arguments])
    captured = capsys.readouterr()
    return stopped.value.code, captured.out, captured.err


def test_the_number_of_runs_can_be_typed(folder, capsys, tmp_path):
    path, out = folder / "scenario.yaml", tmp_path / "out"
    status, said, complained = command(capsys, "run", path, "-n", "2", "--jobs", "1", "-o", out)
    assert (status, complained) == (0, "")
    lines = said.splitlines()
    assert [line.split(":")[0] for line in lines[:2]] == ["run 0", "run 1"]
    assert "% seen" in lines[0]
    assert any(line.startswith("location door: found in ") for line in lines)
    assert lines[-1] == f"report: {out / 'report.html'}"
    manifest = read_manifest(out)
    assert len(manifest["runs"]) == manifest["scenario"]["runs"] == 2
    for wrong in (["-n", "0"], ["--jobs", "0"], ["-n", "many"], ["--jobs", "1.5"]):
        status, _, complained = command(capsys, "run", path, *wrong, "-o", tmp_path / "none")
        assert status == 1
        assert len(complained.splitlines()) == 1
        assert not (tmp_path / "none").exists()


FACTORS = """\
factors:
  mind:
    as it is: {}
    calm: {perception.interval: 30}
  speed:
    slow: {robot.speed_m_s: 0.4}
    fast: {}
variants:
  - {name: forgetful, set: {memory.decay: 0.9, memory: act-r}}
  - name: report
    title: as the report has it
    set: {perception: report, productions: report}
"""


@pytest.fixture(scope="module")
def varied(folder):
    """Return a scenario with four combinations and two more variants, two runs each, done."""
    text = (folder / "scenario.yaml").read_text().replace(f"runs: {RUNS}", "runs: 2")
    path = folder / "varied.yaml"
    path.write_text(text + FACTORS)
    read, document = read_scenario(path)
    each = resolve_variants(read, folder, where=document.where)
    calls = []
    run_variants(read, each, folder / "varied", progress=lambda n, share: calls.append((n, share)))
    return read, each, folder / "varied", calls


def test_every_combination_of_levels_is_a_variant_and_then_the_single_ones(varied):
    read, each, _, _ = varied
    assert [v.name for v in variants_of(read)] == [
        "as-it-is_slow", "as-it-is_fast", "calm_slow", "calm_fast", "forgetful", "report",
    ]  # fmt: skip
    calm_slow, report = each[2], each[5]
    assert calm_slow[0].title == "calm, slow"
    assert calm_slow[0].factors == {"mind": "calm", "speed": "slow"}
    assert calm_slow[0].set == {"perception.interval": 30, "robot.speed_m_s": 0.4}
    assert calm_slow[1].perception.interval == 30
    assert calm_slow[1].place.robot.speed_m_s == 0.4
    assert calm_slow[1].scenario.title == "Two rooms: calm, slow"
    assert report[0].factors == {}
    assert report[0].title == "as the report has it"
    assert report[1].scenario.perception == "report"
    assert each[4][0].title == "forgetful"
    assert each[4][1].memory.decay == 0.9


def test_variants_are_written_down(varied):
    _, each, out, _ = varied
    data = json.loads((out / "variants.json").read_text())
    assert {key: data[key] for key in ("format", "version", "title", "description")} == {
        "format": "ssrics-variants", "version": 1, "title": "Two rooms", "description": "",
    }  # fmt: skip
    assert data["variants"] == [
        {"name": v.name, "title": v.title, "factors": v.factors, "set": v.set} for v, _ in each
    ]
    assert {path.name for path in out.iterdir()} == {"variants.json", *(v.name for v, _ in each)}
    for variant, _ in each:
        assert (
            read_manifest(out / variant.name)["scenario"]["title"] == f"Two rooms: {variant.title}"
        )


def test_variants_are_checked_together(varied):
    _, each, out, _ = varied
    assert check_file(out) == f"results of {len(each)} variants"


def test_variants_with_the_same_drives_share_them(varied):
    _, each, _, calls = varied
    keys = {variant.name: drive_key(resolved) for variant, resolved in each}
    # Another mind watches the same drive; a slower robot makes another one.
    assert len(set(keys.values())) == 2
    assert keys["as-it-is_slow"] == keys["calm_slow"]
    assert len({keys[n] for n in ("as-it-is_fast", "calm_fast", "forgetful", "report")}) == 1
    assert {number for number, _ in calls} == set(range(2 * 2))  # two drives of two runs
    assert max(share for _, share in calls) == 1.0


def test_a_shared_drive_gives_the_bytes_of_one_alone(varied, tmp_path):
    _, each, out, _ = varied
    for variant, resolved in each[2:4]:
        run_scenario(resolved, tmp_path / variant.name)
        assert files(tmp_path / variant.name) == files(out / variant.name)


def test_variants_with_two_jobs_interrupted_and_resumed_are_the_same_bytes(varied, tmp_path):
    read, each, out, _ = varied
    again = tmp_path / "again"
    progress, pressed = interrupted_at(
        lambda *_: any((again / v.name / "manifest.json").is_file() for v, _ in each), again
    )
    with pytest.raises(KeyboardInterrupt):
        run_variants(read, each, again, jobs=2, progress=progress)
    assert pressed
    for variant, _ in each:
        if (again / variant.name / "manifest.json").is_file():
            check_results(again / variant.name)
    run_variants(read, each, again, resume=True, jobs=2)
    for variant, _ in each:
        assert files(again / variant.name) == files(out / variant.name)
    assert (again / "variants.json").read_bytes() == (out / "variants.json").read_bytes()


def variants(**more):
    return variants_of(make_scenario({"world": {"building": {}}, **more}))


def test_two_variants_of_one_name_are_refused():
    for more in (
        {"variants": [{"name": "a"}, {"name": "a"}]},
        {"factors": {"f": {"a": {}, "b": {}}}, "variants": [{"name": "b"}]},
        {"factors": {"f": {"a b": {}, "a-b": {}}}},
        {"factors": {"f": {"a": {}, "a_b": {}}, "g": {"b_c": {}, "c": {}}}},  # a_b_c twice
    ):
        with pytest.raises(SettingsError, match="two are called '"):
            variants(**more)


@pytest.mark.parametrize("level", ["a/b", "../a", "/a", "..", "", "a\nb", ".hidden"])
def test_levels_that_name_no_folder_are_refused(level):
    with pytest.raises(SettingsError, match="cannot name a folder"):
        variants(factors={"f": {level: {}}})


def test_too_many_variants_are_refused():
    levels = {f"l{i}": {} for i in range(11)}
    assert len(variants(factors={"a": levels, "b": levels})) == 121
    with pytest.raises(SettingsError, match=f"1331 variants are more than {VARIANTS_MAX}"):
        variants(factors={"a": levels, "b": levels, "c": levels})


@pytest.mark.parametrize(
    ("set_", "said"),
    [
        ({"percepton": "report"}, "variant 'v': unknown key 'percepton'; did you mean 'perception'?"),
        ({"seed": 4}, "variant 'v': unknown key 'seed'"),
        ({"memory.decya": 1}, "unknown key 'decya'; did you mean 'decay'?"),
        ({"memory.decay": -1}, "memory.decay: -1: expected greater than 0"),
        ({"memry.decay": 1}, "unknown key 'memry'; did you mean 'memory'?"),
        ({"robot.speed": 1}, "unknown key 'speed'"),
        ({"perception": "reprot"}, "did you mean 'report'?"),
    ],
)  # fmt: skip
def test_what_a_variant_cannot_set_is_said(folder, set_, said):
    data = {"world": {"map": "two.yaml"}, "variants": [{"name": "v", "set": set_}]}
    with pytest.raises(SsricsError) as caught:
        resolve_variants(make_scenario(data), folder)
    assert said in str(caught.value)
    assert len(str(caught.value).splitlines()) == 1


def test_variants_say_what_they_found_and_what_did_not_go_as_planned(folder, tmp_path, capsys):
    near, beyond = (
        [round(v, 4) for v in two_rooms(origin=ORIGIN).points_in_map([place])[0].tolist()]
        for place in ((1.0, 1.5), (5.0, 1.5))
    )
    path, out = folder / "shut.yaml", tmp_path / "out"
    path.write_text(
        f"title: Shut\nperception: report\nproductions: report\nworld:\n  map: two.yaml\n  start: {near}\n  repeat: 2\n"
        f"  waypoints: [{near}, {beyond}]\n  doors: [{{location: door}}]\n"
        "variants: [{name: one}, {name: two, set: {perception.interval: 30}}]\n"
    )
    status, said, complained = command(capsys, "run", path, "--jobs", "1", "-o", out)
    assert (status, complained) == (0, "")
    lines = said.splitlines()
    starts = (["variant"], ["one"], ["two"])
    heading, one, two = (line.split() for line in lines if line.split()[:1] in starts)
    assert heading[:3] == ["variant", "runs", "path,"]
    assert (one[:2], two[:2]) == (["one", "1"], ["two", "1"])
    assert not re.search(r"\d\.\d{2}", said.partition("warning")[0])  # no long decimals
    left_out = [
        f"one and 1 other: waypoint 2 [{beyond[0]:g}, {beyond[1]:g}] of lap {lap} was left out: "
        "no way led there for 10 s"
        for lap in (1, 2)
    ]
    assert [line for line in lines if line.startswith("warning")] == [
        f"warning: {text}" for text in left_out
    ]
    page = (out / "report.html").read_text()
    assert all(html.escape(text) in page for text in left_out)


def test_unfinished_variants_say_so(varied, tmp_path):
    read, each, _, _ = varied
    out = tmp_path / "out"
    progress, _ = interrupted_at(lambda number, *_: number == 2, out)
    with pytest.raises(KeyboardInterrupt):
        run_variants(read, each, out, progress=progress)
    shutil.rmtree(out / "forgetful")
    far = "1 of 2 runs are complete; --resume goes on"
    said = check_file(out)
    assert said.startswith(f"results of 6 variants, not finished: as-it-is_slow: {far}, ")
    assert "forgetful: no run is complete; --resume goes on" in said
    page = write_variants_report(out).read_text()
    assert f"as-it-is_slow: {far}" in page
    assert "1 variant has no results yet: forgetful" in page


WRONG_PIECES = """\
world:
  map: two.yaml
factors:
  mind:
    one: {memory.decya: 1, seed: 4}
    two:
      memory.decay: -1
      perception: reprot
      world.people.count: -4
  body:
    wide: {robot.radius_m: 4.0}
    a/b: {}
variants:
  - {name: v, set: {memory.decay: 0.4}}
  - name: v
    set:
      robot.speed: 1
"""


def test_all_mistakes_in_factors_and_variants_are_said_at_once_with_their_places(folder):
    path = folder / "wrong.yaml"
    path.write_text(WRONG_PIECES)
    read, document = read_scenario(path)
    with pytest.raises(SettingsError) as caught:
        resolve_variants(read, folder, where=document.where)
    found = str(caught.value).replace(f"{path}:", "").splitlines()
    one, two = "factor 'mind', level 'one'", "factor 'mind', level 'two'"
    for line, said in zip(
        found,
        [
            f"5:11: {one}: memory.decya: unknown key 'decya'; did you mean 'decay'?",
            f"5:28: {one}: unknown key 'seed'; known: memory, perception, productions",
            f"6:5: {two}: no perception entry 'reprot'; did you mean 'report'?",
            f"7:7: {two}: memory.decay: -1: expected greater than 0",
            f"9:7: {two}: world.people.count: -4: expected greater than or equal to 0",
            "11:5: factor 'body', level 'wide': 1:1: world.robot: the robot (radius 4 m) fits",
            "12:5: factor 'body', level 'a/b': cannot name a folder",
            "15:5: variants: two are called 'v'",
            "17:7: variant 'v': robot.speed: unknown key 'speed'; did you mean 'speed_m_s'?",
        ],
        strict=True,
    ):
        assert line.startswith(said)


def test_levels_that_do_not_go_together_are_said_of_the_variant():
    data = {
        "world": {"building": {"rooms": 2}},
        "factors": {
            "first": {"wait": {"world.legs": [{"wait_s": 1}]}},
            "then": {"explore": {"world.explore": "frontier"}},
        },
    }
    with pytest.raises(SettingsError) as caught:
        resolve_variants(make_scenario(data), Path())
    assert str(caught.value) == (
        "variant 'wait_explore': world: explore and legs exclude each other; list them in legs"
    )


def test_what_is_typed_reaches_every_variant(varied, folder):
    read, _, _, _ = varied
    each = resolve_variants(read, folder, ["runs=1", "memory.decay=0.2", "robot.radius_m=0.2"])
    assert {resolved.memory.decay for _, resolved in each} == {0.2}
    assert {resolved.scenario.runs for _, resolved in each} == {1}
    assert {resolved.place.robot.radius_m for _, resolved in each} == {0.2}


def test_variants_of_the_world_are_other_drives(folder):
    data = {
        "world": {"map": "two.yaml", "people": {"count": 1}},
        "factors": {"crowd": {"few": {}, "many": {"world.people.count": 6}}},
        "variants": [{"name": "swift", "set": {"robot.speed_m_s": 2.0, "world.slip.per_m": 0.1}}],
    }
    few, many, swift = (each for _, each in resolve_variants(make_scenario(data), folder))
    assert few.place.settings.people.count == 1
    assert many.place.settings.people.count == 6
    assert swift.place.settings.slip.per_m == 0.1
    assert len({drive_key(each) for each in (few, many, swift)}) == 3


def test_a_folder_of_variants_and_one_of_runs_are_not_mixed(folder, whole, varied):
    read, each, out, _ = varied
    with pytest.raises(ResultsError, match="holds the results of variants"):
        run_scenario(scenario(folder), out)
    with pytest.raises(ResultsError, match="holds the results of a single scenario"):
        run_variants(read, each, whole[0])


def test_a_scenario_made_in_python_runs_without_a_file(tmp_path):
    data = {"world": {"building": {"rooms": 2}, "legs": [{"wait_s": 3}]}, "runs": 1}
    manifest = run_scenario(resolve(make_scenario(data), tmp_path), tmp_path / "out")
    (entry,) = manifest["runs"]
    assert entry["ended"] == "end of the wait"
    assert (entry["scans"], entry["path_length_m"]) == (31, 0.0)
    assert manifest["input"]["file"] == "building-0"
