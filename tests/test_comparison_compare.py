"""Results folders against labels: figures, files, the picture, and the command."""

import csv
import json
import math
import re
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from labelled_logs import build_log, write_truth
from results_folders import build, build_world, building, place

from ssrics_like.cli import main
from ssrics_like.comparison import (
    compare_folder,
    load_truth,
    score_folder,
    truth_at,
    write_comparison,
)
from ssrics_like.errors import ResultsError
from ssrics_like.maps import save_building
from ssrics_like.report import comparison_svg
from ssrics_like.results.files import json_text


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return build_log(tmp_path_factory.mktemp("log") / "log", runs=2)


@pytest.fixture(scope="module")
def labels(tmp_path_factory):
    return write_truth(tmp_path_factory.mktemp("truth") / "corridor")


@pytest.fixture(scope="module")
def world(tmp_path_factory):
    return build_world(tmp_path_factory.mktemp("world") / "world", runs=3, poses=400)


@pytest.fixture(scope="module")
def written(folder, labels, tmp_path_factory):
    out = tmp_path_factory.mktemp("compared") / "out"
    made = [compare_folder(folder, load_truth(labels), (0.25, 1.0))]
    write_comparison(made, out, comparison_svg(made))
    return out


def run(capsys, *arguments):
    with pytest.raises(SystemExit) as stopped:
        main(["compare", *map(str, arguments)])
    captured = capsys.readouterr()
    return stopped.value.code, captured.out, captured.err


def rows(file):
    with file.open(newline="") as lines:
        return list(csv.DictReader(lines))


def edit(folder, change):
    file = folder / "manifest.json"
    manifest = json.loads(file.read_text())
    change(manifest)
    file.write_text(json_text(manifest))


def test_a_labelled_log_counted_by_hand(folder, labels):
    made = compare_folder(folder, load_truth(labels), (0.25, 1.0))
    near, far = (scores.runs[0] for scores in made.scores)
    # Marks at 0, 1, 2, 3, 4, 5, 7, 9 and 11 m; doorways at 3.2 and 8 m, another seen at 5 m.
    # Passages at 3.2, 8 and 90 m.
    assert (near.marks, near.merged, near.right) == (9, 9, 2)
    assert (near.designated, near.found) == (2, 1)
    assert (near.passages, near.passed) == (3, 1)
    assert near.length_m == pytest.approx(120.0)
    assert made.scores[0].outcomes[0].fates() == [
        "false", "false", "false", "hit", "false", "other", "false", "false", "false",
    ]  # fmt: skip
    # Within 1 m neighbours merge two by two, 0 with 1, ..., and the doorway at 8 m is met.
    assert (far.merged, far.found, far.passed) == (6, 2, 2)
    assert made.scores[0].consistency == 1.0


def test_marks_lie_where_the_labels_poses_put_their_scans(folder, labels):
    marks = compare_folder(folder, load_truth(labels), (1.0,)).drives[0].marks
    assert marks.along_m == pytest.approx([0, 1, 2, 3, 4, 5, 7, 9, 11])
    np.testing.assert_allclose(marks.xy_m[:, 0], marks.along_m)


def test_the_delay_is_driven_between_perceiving_and_deciding(folder, labels):
    made = compare_folder(folder, load_truth(labels), (1.0,))
    # The log's robot goes round an ellipse; each mark was decided 0.3 s after 5, 15, ... s.
    driven = [
        math.dist(place(5 + 10 * k), place(5.3 + 10 * k)) for k in (0, 1, 2, 3, 4, 5, 7, 9, 11)
    ]
    marks = made.drives[0].marks
    np.testing.assert_allclose(marks.decided_m - marks.along_m, driven, atol=0.002)
    assert made.scores[0].pooled.delay_m == pytest.approx(np.mean(driven), abs=0.002)


def test_against_its_own_map_a_folder_scores_as_in_scores_json(world):
    made, scored = compare_folder(world, None, (0.5, 1.0)), score_folder(world).scores
    assert made.scores[1].pooled == scored.pooled
    assert made.scores[1].places == scored.places
    assert made.scores[0].pooled.found <= made.scores[1].pooled.found
    # Two laps through six doorways.
    assert all(tally.passages == 12 for tally in scored.runs)


def test_a_map_can_be_named_as_labels(world, tmp_path):
    named = save_building(building(doors=2), tmp_path)
    made = compare_folder(world, truth_at(named), (1.0,))
    assert made.scores[0].pooled.designated == 2 * 3
    assert all(tally.passages == 4 for tally in made.scores[0].runs)


def test_the_table_holds_each_radius_and_the_figures_of_the_json(written):
    table = rows(written / "comparison.csv")
    data = json.loads((written / "comparison.json").read_text())
    (told,) = data["folders"]
    assert (data["format"], data["version"], told["labels"]) == (
        "ssrics-comparison", 1, "corridor"
    )  # fmt: skip
    assert [row["radius_m"] for row in table] == ["0.25", "1"]
    for row, scored in zip(table, told["radii"], strict=True):
        assert [one["run"] for one in scored["runs"]] == [0, 1]
        for name, value in scored["pooled"].items():
            assert row[name] == "" if value is None else float(row[name]) == value, name
    defined = set().union(*(key.split(", ") for key in data["definitions"]))
    assert set(table[0]) - defined == {
        "folder", "radius_m", "runs", "path_m", "marks", "merged", "right",
    }  # fmt: skip


def test_the_fate_of_each_mark_place_and_passage_stands_in_tables(written):
    marks = rows(written / "comparison-marks.csv")
    assert len(marks) == 2 * 2 * 9
    first = [row for row in marks if row["radius_m"] == "0.25" and row["run"] == "0"]
    assert [row["event"] for row in first] == [*"0123457", "9", "11"]
    hit = first[3]
    assert (hit["fate"], hit["place"], hit["passage"], hit["group_place"]) == (
        "hit", "D1", "0", "D1"
    )  # fmt: skip
    assert (first[5]["fate"], first[5]["place"], first[5]["group_place"]) == ("other", "W1", "W1")
    assert float(hit["path_m"]) == float(hit["x_m"]) == 3.0
    places = [row for row in rows(written / "comparison-places.csv") if row["radius_m"] == "0.25"]
    assert [(r["place"], r["designated"], r["found"], r["event"]) for r in places[:4]] == [
        ("D1", "1", "1", "3"), ("D2", "1", "0", ""), ("W1", "0", "1", "5"), ("J1", "0", "0", ""),
    ]  # fmt: skip
    passages = [r for r in rows(written / "comparison-passages.csv") if r["radius_m"] == "0.25"]
    assert [(r["place"], r["path_m"], r["found"], r["event"]) for r in passages[:3]] == [
        ("D1", "3.2", "1", "3"), ("D2", "8", "0", ""), ("D1", "90", "0", ""),
    ]  # fmt: skip


def test_equal_results_give_equal_bytes(folder, labels, written, tmp_path):
    made = [compare_folder(folder, load_truth(labels), (0.25, 1.0))]
    for file in write_comparison(made, tmp_path, comparison_svg(made)):
        assert file.read_bytes() == (written / file.name).read_bytes()


def shown(svg):
    """Return the tips of a picture by kind of mark or place, and its other text."""
    root = ET.fromstring(svg)
    tips = [element.text for element in root.iter("{http://www.w3.org/2000/svg}title")]
    text = " ".join(e.text or "" for e in root.iter("{http://www.w3.org/2000/svg}text"))
    return tips, text


def test_the_picture_shows_hits_misses_and_false_marks(written):
    tips, text = shown((written / "comparison.svg").read_text())
    # Drawn at 1 m: 9 marks, 4 labels.
    assert len(tips) == 13
    assert sum(": hit" in tip for tip in tips) == 2
    for said in ("hit (2)", "place found (2)", "other label (2)", "D1 1/2", "D2 1/1"):
        assert said in text, said
    assert "log, run 0, against corridor: within 1 m, 2 of 2 places and 2 of 3 passages" in text


def test_several_folders_have_a_panel_each(world, folder, labels):
    # Ids would clash if panels shared them.
    svg = comparison_svg([compare_folder(world), compare_folder(folder, load_truth(labels))])
    tips, text = shown(svg)
    ids = re.findall(r' id="([^"]*)"', svg)
    assert len(ids) == len(set(ids))
    assert text.count("against") == 2
    assert len(tips) > 13


def test_the_command_prints_a_table_and_writes_the_files(capsys, folder, labels, tmp_path):
    status, said, complained = run(capsys, folder, labels, "-o", tmp_path / "out")
    assert (status, complained) == (0, "")
    lines = said.splitlines()
    assert lines[0].split() == [str(folder), "against", "corridor"]
    assert lines[2].split() == ["0.5", "m", "1", "m", "1.5", "m", "2", "m"]
    (passages,) = (line for line in lines if line.startswith(" passages found"))
    assert " ".join(passages.split()[2:]) == "2 of 6 4 of 6 4 of 6 4 of 6"
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == [
        "comparison-marks.csv", "comparison-passages.csv", "comparison-places.csv",
        "comparison.csv", "comparison.json", "comparison.svg",
    ]  # fmt: skip
    assert lines[-1] == str(tmp_path / "out" / "comparison.svg")


def test_several_folders_stand_side_by_side(capsys, world, tmp_path):
    other = build_world(tmp_path / "other", runs=2, poses=200, misses=0.0)
    status, said, _ = run(capsys, world, other, "--radius", "1", "--radius", "0.5")
    assert status == 0
    titles = [line for line in said.splitlines() if line.startswith("within")]
    assert [title.strip() for title in titles] == ["within 0.5 m", "within 1 m"]
    assert said.splitlines()[2].split() == ["world", "other"]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ([], "compare: name a results folder, and what was labelled after it"),
        (["{labels}"], "compare: name a results folder before {labels}"),
        (["{log}"], "{log}: holds no map/map.yaml, for its runs are of a log; name labels after"),
        (["{log}", "{tmp}/nowhere"], "{tmp}/nowhere: no such file or folder"),
        (["{tmp}/nowhere", "{labels}"], "{tmp}/nowhere: no such folder"),
        (["{log}", "{tmp}"], "{tmp}: expected a results folder, which has manifest.json, or a fo"),
        (
            ["{log}", "{log}/manifest.json"],
            "{log}/manifest.json: expected a folder of labels, a map's file ending in .yaml, or",
        ),
        (["{short}", "{labels}"], "{short}: run 0 has 20 scans, but {labels}/poses.csv 1201: the"),
        (["{log}", "{map}"], "{log}/manifest.json: frame: 'odometry': expected positions on the "),
        (["{world}", "{bare}"], "{bare}: locations: no place is labelled, expected at least one"),
        (["{world}", "{far}"], "{world}: 0 % of the path of run 0 lies on the floor of 'far'"),
        (["{world}", "--radius", "wide"], "--radius: 'wide': expected metres, more than 0 and at"),
        (["{world}", "--radius", "-1"], "--radius: '-1': expected metres, more than 0 and at most"),
        (["{world}", "--radius", "nan"], "--radius: 'nan': expected metres, more than 0 and at m"),
        (["{world}", "-o", "{map}"], "{map}: cannot be written"),
    ],
)
def test_each_wrong_input_gets_one_line(
    capsys, folder, labels, world, tmp_path, arguments, said
):  # fmt: skip
    plain = building()
    far = type(plain.grid)(plain.grid.cells, plain.grid.cell_m, type(plain.grid.origin)(90, 90, 0))
    moved = tuple(type(p)(p.id, p.x_m + 104.5, p.y_m + 100) for p in plain.locations)
    names = {
        "log": folder,
        "labels": labels,
        "world": world,
        "tmp": tmp_path,
        "short": build(tmp_path / "short", poses=20),
        "map": save_building(plain, tmp_path / "maps", "plain"),
        "bare": save_building(type(plain)("bare", plain.grid), tmp_path / "maps", "bare"),
        "far": save_building(type(plain)("far", far, moved), tmp_path / "maps", "far"),
    }
    status, _, complained = run(capsys, *(text.format(**names) for text in arguments))
    assert status == 1
    assert len(complained.splitlines()) == 1
    assert complained.startswith(f"ssrics: {said.format(**names)}")


def test_a_damaged_table_of_decisions_is_named(folder, labels, tmp_path):
    broken = build_log(tmp_path / "broken")
    file = broken / "decisions.csv"
    lines = file.read_text().splitlines()
    lines[1] = lines[1].replace("0,0,0,", "0,0,x,", 1)
    file.write_text("\n".join(lines) + "\n")
    with pytest.raises(ResultsError, match=r"decisions\.csv:2: is damaged: .*'x'"):
        compare_folder(broken, load_truth(labels))
    lines[1] = lines[1].replace("0,0,x,", "0,0,5000,", 1)
    file.write_text("\n".join(lines) + "\n")
    with pytest.raises(ResultsError, match="a scan of run 0 lies outside 0 to 1200"):
        compare_folder(broken, load_truth(labels))


def test_a_run_that_marked_nothing_has_no_precision_but_a_picture(capsys, labels, tmp_path):
    idle = build_log(tmp_path / "idle", late_s=lambda _run, _number: None)
    status, said, _ = run(capsys, idle, labels, "-o", tmp_path / "out")
    assert status == 0
    (precision,) = (line for line in said.splitlines() if line.startswith("   precision"))
    assert precision.split() == ["precision", *"––––"]
    assert len(rows(tmp_path / "out" / "comparison-marks.csv")) == 0
    tips, text = shown((tmp_path / "out" / "comparison.svg").read_text())
    assert (len(tips), "place missed (2)" in text) == (4, True)


def test_a_log_in_the_frame_of_a_map_is_scored_on_it(tmp_path):
    log = build(tmp_path / "log", poses=400)
    edit(log, lambda manifest: manifest.update(frame="map"))
    made = compare_folder(log, building(), (1.5,))
    # Its reflexes are at the doorways themselves; on the second lap every other is dismissed.
    assert made.scores[0].pooled.found == 6
    assert made.scores[0].pooled.passages == 12
    assert made.scores[0].pooled.passed == 9


def test_a_real_log_is_scored_against_its_labels(data_dir, tmp_path, capsys):
    out, log = tmp_path / "out", data_dir / "logs" / "intel-lab.log.gz"
    with pytest.raises(SystemExit):
        main(["replay", str(log), "-o", str(out), "-q"])
    made = compare_folder(out, load_truth(data_dir / "truth" / "intel_lab"))
    # The log's own poses are those of the labels, so that marks lie where decisions.csv has them.
    marks = made.drives[0].marks
    said = [
        (float(row["x_m"]), float(row["y_m"]))
        for row in rows(out / "decisions.csv")
        if row["decision"] in ("declared", "recognised", "unsure")
    ]
    np.testing.assert_allclose(marks.xy_m, said, atol=0.01)
    assert (marks.decided_m >= marks.along_m).all()
    for scores in made.scores:
        pooled = scores.pooled
        assert (pooled.designated, pooled.passages) == (16, 30)
        for place_score, found in zip(scores.places, scores.found[0], strict=True):
            at = place_score.location.x_m, place_score.location.y_m
            near = np.hypot(*(marks.xy_m - at).T).min() <= scores.radius_m
            assert near or not found
        along = made.drives[0].passages.through(scores.outcomes[0].designated).along_m
        within = np.abs(marks.along_m[:, np.newaxis] - along).min(axis=0) <= scores.radius_m
        assert pooled.passed <= within.sum()
        assert 0 < pooled.chance < 1
    tips, _ = shown(comparison_svg([made]))
    assert len(tips) == len(marks) + len(scores.places)
