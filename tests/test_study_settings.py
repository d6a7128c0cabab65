"""Study files: what may stand in them, and what is said of what may not."""

import json
import math
import re

import pytest
from studies import STUDY, write_study

from ssrics_like.cli import main
from ssrics_like.errors import LibraryError, SettingsError
from ssrics_like.library import folder
from ssrics_like.maps import load_building, save_building
from ssrics_like.scenarios.checking import STUDY_KEYS
from ssrics_like.study import read_study
from ssrics_like.study.reading import study_file
from ssrics_like.study.texts import html_of


def complaint(tmp_path, text):
    with pytest.raises(SettingsError) as caught:
        read_study(write_study(tmp_path, text))
    return str(caught.value).replace(f"{tmp_path}/", "")


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("title: A", "titel: A", "small.yaml:1:1: unknown key 'titel'; did you mean 'title'?"),
        ("map: simple, question: Try", "map: simpel, question: Try",
         "small.yaml:7:27: practice.0.map: no map 'simpel'; did you mean 'simple'?"),
        ("kind: plan, map: simple, question: Mark", "kind: plam, map: simple, question: Mark",
         "trials.0.kind: 'plam' where 'plan', 'walk' or 'attention' was expected; did you mean"),
        ("id: plan", "id: try", "small.yaml:9:6: trials.0.id: 'try' stands twice (first in line 7)"),
        ("id: plan", "id: Try", "trials.0.id: 'Try' names the same files as 'try' in line 7 where"),
        ("id: plan", "id: instructions",
         "trials.0.id: 'instructions': is what the step before the first trial is called"),
        ("id: plan", "id: Instructions", "is what the step before the first trial is called"),
        ("id: plan", "id: ../x", "trials.0.id: '../x': expected up to 40 letters"),
        ("kind: plan, map: simple, question: Mark", "kind: plan, question: Mark",
         "trials.0: a trial of the kind plan needs map"),
        ("key: k", "key: kk", "trials.2.key: 'kk'"),
        ("key: k,", "", "trials.2: a trial of the kind attention needs key"),
        ("    waypoints:", "    results: out\n    waypoints:", "has either waypoints or results"),
        ("    waypoints:", "    run: 0\n    waypoints:", "trials.1: run goes with results"),
        ("[10.9, 1.1]", "[6.25, 3.0]", "trials.1.waypoints.1: [6.25, 3]: the robot"),
        ("[9.0, 1.1, 0.0]", "[0.0, 0.0]", "trials.1.start: [0, 0]: the robot"),
        ("start: [9.0, 1.1, 0.0]", "robot: pionier-dx",
         "trials.1.robot: no robots entry 'pionier-dx'; did you mean 'pioneer-dx'?"),
        ("question: Mark landmarks.", "check: {location: 9}, question: Mark.",
         "trials.0.check.location: 9 where text was expected"),
        ("question: Mark landmarks.", "check: {location: '9'}, question: Mark.",
         "trials.0.check.location: the map has no location '9'; it has 1, 2, 3"),
        ("question: Press K.", "question: Press K., map: simple",
         "trials.2: map does not go with the kind attention"),
        ("instructions: Mark what you *like*.", "instructions: missing.md",
         "small.yaml:3:1: instructions: missing.md: cannot be read (No such file or directory)"),
        ("seed: 7", "seed: -7", "small.yaml:2:1: seed: -7: expected greater than or equal to 0"),
    ],
)  # fmt: skip
def test_a_mistake_is_told_with_its_place(tmp_path, old, new, said):
    assert old in STUDY
    assert said in complaint(tmp_path, STUDY.replace(old, new, 1))


def test_all_mistakes_are_told_at_once(tmp_path):
    text = STUDY.replace("map: simple, question: Try", "map: nowhere, question: Try")
    text = text.replace("map: simple, question: Mark", "map: maps/none.yaml, question: Mark")
    lines = complaint(tmp_path, text).splitlines()
    assert [line.split(": ")[0] for line in lines] == ["small.yaml:7:27", "small.yaml:9:28"]
    assert "no such file" in lines[1]


OF_A_RUN = re.sub(
    r"    map: simple\n    start.*\n    waypoints.*\n", "    results: out\n    run: 1\n", STUDY
)
PATH = """\
run,t_s,x_m,y_m,theta_rad,true_x_m,true_y_m,true_theta_rad
0,0,9,1,0,9,1,0
1,10,5,5,5,9,1.1,3.1
1,10.5,5,5,5,9.5,1.1,-3.1
"""


def results(tmp_path, path=PATH, frame="odometry"):
    out = tmp_path / "out"
    save_building(load_building(folder("scenarios") / "maps" / "simple.yaml"), out / "map")
    manifest = {"format": "ssrics-results", "version": 1, "frame": frame, "runs": []}
    (out / "manifest.json").write_text(json.dumps(manifest))
    (out / "path.csv").write_text(path)


def test_a_run_is_replayed_where_it_truly_was_and_from_its_beginning(tmp_path):
    results(tmp_path)
    replay = read_study(write_study(tmp_path, OF_A_RUN)).by_id["walk"].replay
    assert replay.t_s.tolist() == [0.0, 0.5]
    assert replay.at(0.25).tolist() == pytest.approx([9.25, 1.1, math.pi])


def test_positions_in_the_frame_of_the_map_will_do(tmp_path):
    results(tmp_path, "run,t_s,x_m,y_m,theta_rad,true_x_m,true_y_m,true_theta_rad\n"
            "1,0,9,1,0,,,\n1,1,9.5,1,0,,,\n", "map")  # fmt: skip
    assert read_study(write_study(tmp_path, OF_A_RUN)).by_id["walk"].replay.length_s == 1.0


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("1,10", "2,10", "has no run 1; the runs are 0, 2"),
        ("9,1.1,3.1", ",,", "run 1 has no positions in the frame of the map, only of odometry"),
        ("1.1,3.1", "1.1,x", "path.csv:3: is damaged: expected a number in each column"),
        ("1,10.5", "1", "path.csv:4: is damaged: expected a number in each column"),
        ("1,10.5", "1,9", "the route is damaged: times do not rise"),
        ("9.5,1.1,-3.1", "0.05,1.1,0", "leads through (0.05, 1.10), which is not free on the map"),
        ("run,", "rum,", "path.csv: is damaged: it lacks the column 'run'"),
    ],
)
def test_a_run_that_cannot_be_replayed_is_told(tmp_path, old, new, said):
    results(tmp_path, PATH.replace(old, new))
    text = complaint(tmp_path, OF_A_RUN)
    assert "trials.1.results: " in text
    assert said in text


def test_results_that_are_none_are_told(tmp_path):
    assert "trials.1.results: " in complaint(tmp_path, OF_A_RUN)


def test_a_markdown_file_beside_the_study_is_read(tmp_path):
    (tmp_path / "text.md").write_text("From a *file*.\n")
    path = write_study(tmp_path, STUDY.replace("Mark what you *like*.", "text.md"))
    assert read_study(path).settings.instructions == "From a *file*."


def test_what_is_shipped_can_be_read_and_found():
    path = study_file("complex")
    assert path == folder("scenarios") / "studies" / "complex.yaml"
    study = read_study(path)
    assert [trial.id for trial in study.trials] == ["plan", "walk"]
    walk = study.by_id["walk"].replay
    assert 60 < walk.length_s < 180


def test_an_unknown_study_is_told_with_the_nearest():
    with pytest.raises(LibraryError, match="no study 'complx'; did you mean 'complex'"):
        study_file("complx")


@pytest.mark.parametrize(
    ("markdown", "html"),
    [
        ("*a* & b", "<p><em>a</em> &amp; b</p>\n"),
        ("<script>alert(1)</script>", "<p>&lt;script&gt;alert(1)&lt;/script&gt;</p>\n"),
        ("<img src=x onerror=y>", "<p>&lt;img src=x onerror=y&gt;</p>\n"),
    ],
)
def test_markup_of_a_texts_own_is_shown_not_obeyed(markdown, html):
    assert html_of(markdown) == html


@pytest.mark.parametrize("markdown", ["[x](javascript:alert(1))", "![x](http://elsewhere/x.png)"])
def test_a_text_makes_no_script_and_no_request(markdown):
    shown = html_of(markdown)
    assert "<img" not in shown
    assert 'href="javascript' not in shown


def command(capsys, *arguments):
    with pytest.raises(SystemExit) as stop:
        main([str(each) for each in arguments])
    return (stop.value.code, *capsys.readouterr())


def test_check_list_and_schema_know_studies(tmp_path, capsys):
    path = write_study(tmp_path)
    said = f"{path}: ok: study, 'A small study', 3 trials, 1 of practice\n"
    assert command(capsys, "check", path) == (0, said, "")
    path.write_text(STUDY.replace("order: fixed", "order: fixt"))
    status, _, complaint = command(capsys, "check", path)
    assert (status, len(complaint.splitlines())) == (1, 1)
    assert "small.yaml:4:1: order: 'fixt' where" in complaint
    assert "is a study, expected a scenario" in command(capsys, "run", path, "-o", tmp_path)[2]
    assert command(capsys, "list", "studies")[1] == "studies/\n  complex  Landmarks in a building\n"
    keys = set(json.loads(command(capsys, "schema", "study")[1])["properties"])
    assert keys - {"title", "seed"} == STUDY_KEYS
