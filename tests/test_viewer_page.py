"""The page as a file: what it holds, that it is the same again, what is answered with one line."""

import base64
import json
import re
import shutil

import numpy as np
import pytest
from results_folders import build
from viewer_runs import DEMO_LOG, page, results

from ssrics_like.cli import main
from ssrics_like.errors import ResultsError
from ssrics_like.results.reading import read_records
from ssrics_like.viewer import write_view
from ssrics_like.viewer.page import page_text
from ssrics_like.viewer.tables import read_poses


def data_of(file):
    text = file.read_text(encoding="utf-8")
    (found,) = re.findall(
        r'<script type="application/json" id="data">(.*?)</script>', text, re.DOTALL
    )
    return json.loads(found)


def unpacked(made):
    steps = np.frombuffer(base64.b64decode(made["data"]), "<u2")
    return made["least"] + made["step"] * steps


@pytest.mark.parametrize("name", ["demo", "errand"])
def test_the_page_holds_the_path_within_a_centimetre(name):
    folder, data = results(name), data_of(page(name))
    run = read_records(folder).runs[0]
    poses = read_poses(folder, run)
    assert abs(unpacked(data["path"]["x"]) - poses[:, 1]).max() <= 0.0051
    assert abs(unpacked(data["path"]["y"]) - poses[:, 2]).max() <= 0.0051
    times = np.frombuffer(base64.b64decode(data["path"]["t"]), "<u4") / 1000.0
    assert abs(times - (poses[:, 0] - run.start_s)).max() <= 0.00051
    assert data["end_s"] >= run.duration_s


@pytest.mark.parametrize("name", ["demo", "errand"])
def test_the_page_holds_every_decision_landmark_arc_and_scan(name):
    folder, data = results(name), data_of(page(name))
    run = read_records(folder).runs[0]
    assert len(data["decisions"]) == len(run.reflexes)
    assert [mark[0] for mark in data["landmarks"]] == [mark.name for mark in run.landmarks]
    edges = json.loads((folder / "topology" / "run-000.json").read_text())["edges"]
    assert {(a, b) for a, b, *_ in data["arcs"]} == {(e["source"], e["target"]) for e in edges}
    scans = data["scans"]
    poses = np.frombuffer(base64.b64decode(scans["poses"]), "<u4")
    ranges = np.frombuffer(base64.b64decode(scans["ranges"]), "<u2").reshape(-1, scans["beams"])
    assert len(poses) == len(ranges) == len(run.path)
    assert {name for name, *_ in data["activation"]["levels"]} == {m.name for m in run.landmarks}


def test_a_landmark_stands_where_it_is_drawn_since_it_was_declared():
    folder, data = results("errand"), data_of(page("errand"))
    run = read_records(folder).runs[0]
    declared = {r.landmark: r for r in run.reflexes if r.decision == "declared"}
    for name, t_s, x_m, y_m, sector, _ in data["landmarks"]:
        reflex = declared[name]
        assert (t_s, x_m, y_m) == pytest.approx((reflex.decided_s, reflex.x_m, reflex.y_m))
        assert sector == reflex.sector


def test_what_is_recomputed_or_missing_is_said():
    assert "cast anew at the true pose" in page("errand").read_text()
    assert "Doors that shut are not on the saved map" in page("errand").read_text()
    assert "The scan is that of demo.log.gz." in page("demo").read_text()


def test_the_same_run_gives_the_same_bytes(tmp_path):
    again = write_view(results("demo"), log=DEMO_LOG, out=tmp_path / "again.html")
    assert again.read_bytes() == page("demo").read_bytes()


@pytest.mark.parametrize("name", ["demo", "errand"])
def test_the_page_asks_nobody_for_anything(name):
    text = page(name).read_text(encoding="utf-8")
    assert not re.findall(r'(?:src|href)="(?!data:)[^"]', text)
    assert not re.findall(r"https?://|@import|fetch\(|XMLHttpRequest|WebSocket", text)
    assert "default-src 'none'" in text


def test_words_of_the_user_are_never_read_as_html():
    evil = "</script><script>alert(1)</script><!--"
    data = {"title": evil, "run": 0, "runs": 1, "positions": evil, "notes": [evil]}
    text = page_text(data)
    assert "<script>alert" not in text
    assert "<!--" not in text
    (found,) = re.findall(r'id="data">(.*?)</script>', text, re.DOTALL)
    assert json.loads(found)["title"] == evil


def copied(tmp_path, name="demo"):
    return shutil.copytree(results(name), tmp_path / "copy")


def damaged(folder, **keys):
    """Change keys of a manifest, `a__b` being b of a; None takes one away."""
    file = folder / "manifest.json"
    manifest = json.loads(file.read_text())
    for path, value in keys.items():
        *above, last = path.split("__")
        at = manifest
        for key in above:
            at = at[key]
        if value is None:
            del at[last]
        else:
            at[last] = value
    file.write_text(json.dumps(manifest))


def refused(*arguments, **options):
    with pytest.raises(ResultsError) as caught:
        write_view(*arguments, **options)
    assert "\n" not in str(caught.value)
    return str(caught.value)


def test_a_folder_that_holds_no_results_is_refused(tmp_path):
    assert "no such folder" in refused(tmp_path / "gone")
    assert "manifest.json is missing" in refused(tmp_path)


def test_a_run_that_is_not_there_is_refused(tmp_path):
    folder = build(tmp_path / "runs", runs=3)
    assert refused(folder, 3).endswith("holds runs 0 to 2")
    assert "holds run 0" in refused(results("demo"), 1)


def test_a_run_of_several_is_chosen(tmp_path):
    folder = build(tmp_path / "runs", runs=3)
    file = write_view(folder, 2)
    assert file == folder / "view-run-002.html"
    assert data_of(file)["run"] == 2
    assert "run 2 of 3" in file.read_text()


def test_an_unfinished_folder_says_so_on_the_page(tmp_path):
    folder = build(tmp_path / "runs", runs=2)
    damaged(folder, scenario__runs=14)
    assert "2 of 14 runs are complete" in write_view(folder).read_text()


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("path.csv", "path.csv: cannot be read"),
        ("decisions.csv", "decisions.csv: cannot be read"),
        ("trace/run-000.jsonl", "run-000.jsonl: is missing"),
        ("figures/run-000.json", "run-000.json: cannot be read"),
    ],
)
def test_a_missing_file_is_named(tmp_path, name, said):
    folder = copied(tmp_path)
    (folder / name).unlink()
    assert said in refused(folder)


def test_a_simulated_run_without_its_map_is_refused(tmp_path):
    folder = copied(tmp_path, "errand")
    shutil.rmtree(folder / "map")
    assert refused(folder).endswith("map.yaml: is missing")


@pytest.mark.parametrize(
    ("keys", "said"),
    [
        ({"input": None}, "'input' is missing"),
        ({"scenario__productions__rules": None}, "'rules' is missing"),
        ({"scenario__perception__threshold": "high"}, "could not convert"),
        (
            {"scenario__productions__rules__store__rule": "=g> isa"},
            "rule 'store': expected one '==>'",
        ),
        (
            {"scenario__productions__rules__store__rule": "=smell> isa task\n==>\n~g>"},
            "rule 'store': unknown buffer 'smell'",
        ),
    ],
)
def test_a_foreign_or_damaged_manifest_is_one_line(tmp_path, keys, said):
    folder = copied(tmp_path)
    damaged(folder, **keys)
    assert said in refused(folder)


def test_a_damaged_line_of_the_trace_is_named(tmp_path):
    folder = copied(tmp_path)
    file = folder / "trace" / "run-000.jsonl"
    lines = file.read_text().splitlines()
    lines[4] = "{"
    file.write_text("\n".join(lines))
    assert "run-000.jsonl:5: is damaged" in refused(folder)


def test_a_scenario_that_keeps_no_trace_has_a_page_that_says_so(tmp_path):
    folder = copied(tmp_path)
    damaged(folder, scenario__trace=False)
    (folder / "trace" / "run-000.jsonl").unlink()
    file = write_view(folder)
    assert "The scenario keeps no trace" in file.read_text()
    assert data_of(file)["story"] is None


def test_the_results_of_variants_are_refused(tmp_path):
    (tmp_path / "variants.json").write_text("{}")
    assert "name the folder of one" in refused(tmp_path)


def test_a_page_needs_a_name_and_a_folder(tmp_path):
    assert "ending in .html" in refused(results("demo"), out=tmp_path)
    assert "ending in .html" in refused(results("demo"), out=tmp_path / "page.txt")
    assert "there is no folder" in refused(results("demo"), out=tmp_path / "nix" / "page.html")


def test_the_command_says_where_the_page_is(tmp_path, capsys):
    out = tmp_path / "page.html"
    with pytest.raises(SystemExit) as caught:
        main(["view", str(results("demo")), "--log", str(DEMO_LOG), "-o", str(out)])
    assert caught.value.code == 0
    assert capsys.readouterr().out == f"view: {out}\n"
    assert [path.name for path in tmp_path.iterdir()] == ["page.html"]


def test_the_command_answers_a_wrong_log_with_one_line(tmp_path, capsys):
    out = tmp_path / "page.html"
    with pytest.raises(SystemExit) as caught:
        main(["view", str(results("errand")), "--log", str(DEMO_LOG), "-o", str(out)])
    assert caught.value.code == 1
    (line,) = capsys.readouterr().err.splitlines()
    assert line.endswith("is of a simulated building, not of a log")
    assert not out.exists()
