"""Comparisons of people at the edges: few people, no marks, no locations, other maps and frames."""

import json
import math
import re

import numpy as np
import pytest
from people_choices import at_doors, compared, near, rows, run, write_choices
from results_folders import DOORS, build, build_world, building

from ssrics_like.cli.study_simulate import simulate
from ssrics_like.errors import MapError, ResultsError, SettingsError
from ssrics_like.maps import save_building
from ssrics_like.people.markers import Marker
from ssrics_like.report import style
from ssrics_like.report.frames import frame_around
from ssrics_like.report.people_agreement_figure import draw_people_agreement
from ssrics_like.report.people_map_figure import density
from ssrics_like.report.people_novelty_figure import counted, moments_of
from ssrics_like.results.files import json_text
from ssrics_like.results.reading import read_records


@pytest.fixture(scope="module")
def world(tmp_path_factory):
    return build_world(tmp_path_factory.mktemp("world") / "world", runs=3, poses=400)


@pytest.fixture(scope="module")
def choices(tmp_path_factory):
    return write_choices(tmp_path_factory.mktemp("choices") / "people.csv", at_doors())


def test_locations_are_found_from_marks_where_that_is_asked(world, choices):
    made = compared([world], choices, "cluster")
    assert made.clustered
    assert any("found by clustering people's marks" in note for note in made.notes)
    places = np.array([(place.x_m, place.y_m) for place in made.units.locations])
    for door in (0, 1, 2):
        assert np.hypot(*(places - DOORS[door]).T).min() < 0.5
    assert [share.marked for share in made.shares if share.group == "people"][:3] == [5, 5, 5]


def test_locations_can_be_those_of_another_map(world, choices, tmp_path):
    named = save_building(building(doors=2, others=False), tmp_path)
    made = compared([world], choices, str(named))
    assert [place.id for place in made.units.locations] == ["1", "2"]


def test_a_folder_called_people_is_a_model_all_the_same(tmp_path, choices):
    made = compared([build_world(tmp_path / "people", runs=2, poses=200)], choices)
    assert list(made.marked) == ["people", "people/"]
    assert [len(table) for table in made.marked.values()] == [5, 2]


def test_folders_of_one_name_are_called_by_their_paths(world, tmp_path, choices):
    same = build_world(tmp_path / "world", runs=2, poses=200)
    made = compared([world, same], choices)
    assert [model.name for model in made.models] == [str(world), str(same)]


def edge(world, tmp_path, marks, **kind):
    return compared([world], write_choices(tmp_path / "c.csv", marks), **kind)


def test_one_participant_is_a_result(world, tmp_path):
    made = edge(world, tmp_path, {"only": [near(0), near(1)]})
    people, model = made.figures["people"], made.figures["world"]
    for name in ("fleiss", "alpha", "kappa_people", "f_others"):
        assert math.isnan(people[name].value)
    assert math.isnan(model["f_ceiling"].value)
    assert 0 < model["f"].value <= 1  # against the only person there is
    assert all(map(math.isnan, model["f"].interval))
    assert "There is one participant" in made.notes[0]


def test_people_without_a_consensus_are_a_result(world, tmp_path):
    marks = {f"p{k}": [near(k)] for k in range(6)}
    made = edge(world, tmp_path, marks)
    assert not made.crowd.consensus.any()
    assert math.isnan(made.figures["world"]["f"].value)
    assert math.isfinite(made.figures["people"]["alpha"].value)
    assert any("there is no consensus" in note for note in made.notes)


def test_marks_far_from_the_route_are_counted_and_nothing_else(world, tmp_path):
    made = edge(world, tmp_path, {"a": [near(0), (0.0, 0.0)], "b": [near(0), (0.5, 0.0)]})
    assert made.marked["people"].sum() == 2
    assert any("2 of 4 marks of people lie off the route" in note for note in made.notes)


def test_a_robot_without_marks_is_a_result(tmp_path, choices):
    idle = build_world(tmp_path / "idle", runs=2, poses=200, misses=0.0)
    file = idle / "decisions.csv"
    file.write_text(file.read_text().splitlines()[0] + "\n")
    with pytest.raises(ResultsError, match=r"decisions.csv: has 0 rows of run 0, the manifest \d+"):
        compared([idle], choices)
    manifest = json.loads((idle / "manifest.json").read_text())
    for entry in manifest["runs"]:
        entry["decisions"] = {}
    (idle / "manifest.json").write_text(json.dumps(manifest))
    made = compared([idle], choices)
    figures = made.figures["idle"]
    assert figures["f"].value == 0.0
    assert math.isnan(figures["precision"].value)
    assert math.isnan(figures["consistency"].value)  # both runs marked nothing
    assert any("run 0 and run 1 of idle marked nothing" in note for note in made.notes)
    with style.context():
        assert "Hatched" in draw_people_agreement(made).caption


def test_whoever_marks_everything_has_no_kappa(world, tmp_path):
    path = [(float(r["true_x_m"]), float(r["true_y_m"])) for r in rows(world / "path.csv")]
    made = edge(world, tmp_path, {"a": path[::2], "b": path[::2]})
    assert made.marked["people"].all()
    assert math.isnan(made.figures["people"]["kappa_people"].value)
    assert math.isnan(made.figures["people"]["fleiss"].value)
    assert any("marked every unit" in note for note in made.notes)


def test_one_location_and_one_run(tmp_path, choices):
    places = building(doors=1, others=False)
    made = compared([build_world(tmp_path / "one", runs=1, poses=300, places=places)], choices)
    assert len(made.units.location_of) == 1
    assert math.isnan(made.figures["one"]["consistency"].value)
    assert math.isfinite(made.figures["one"]["kappa"].value)


def test_no_location_at_all(world, tmp_path):
    made = edge(world, tmp_path, {"a": [near(0)], "b": [near(3)]}, locations="cluster")
    assert made.units.locations == ()
    assert made.pairs == ()
    assert any("There is no location" in note for note in made.notes)


def test_a_log_in_the_frame_of_the_map_needs_no_map_and_names_are_escaped(tmp_path, capsys):
    log = build(tmp_path / "log", poses=400)
    file = log / "manifest.json"
    file.write_text(json_text({**json.loads(file.read_text()), "frame": "map"}))
    # With times these people pressed a key; the second at one moment only.
    marks = {"<script>alert(1)</script>": [(*near(0), 5.0)], "b": [(*near(0), 5.5), near(1)]}
    out = tmp_path / "out"
    status, _, complained = run(capsys, log, write_choices(tmp_path / "c.csv", marks), "-o", out)
    assert (status, complained) == (0, "")
    assert rows(out / "locations.csv")[0]["location"] == "C1"
    for file in (out / "comparison.html", *(out / "figures").glob("*.svg")):
        assert "<script>alert" not in file.read_text()
    assert "when they pressed the key" in (out / "comparison.html").read_text()


def test_marks_without_a_time_are_due_when_the_robot_first_comes_by(world):
    (run, *_) = read_records(world).runs
    # Two laps of a minute; the first door is passed after 5 s and 65 s, the second after 15 s and
    # 75 s, the third after 25 s. The third mark's time is of another run.
    person = Marker("p", "people", np.array([DOORS[0], DOORS[1], DOORS[2], (0.0, 0.0)]),
                    np.array([math.nan, 75.2, 3.0, math.nan]), ("",) * 4)  # fmt: skip
    found = moments_of(person, run, 1.0)
    assert found == pytest.approx([5.0, 25.0, 75.2], abs=0.3)
    assert counted([found, found[:1]], np.array([0.0, 5.0, 25.0, 76.0])).tolist() == [0, 2, 1, 1]


def test_a_place_that_every_marker_marked_once_has_a_density_of_one():
    frame = frame_around(np.array([(-5.0, -5.0), (5.0, 5.0)]), 400.0, (100.0, 400.0))
    spot = np.array([(frame.left + 4.025, frame.bottom + 4.025)])
    markers = [Marker(str(k), "people", spot, np.array([math.nan]), ("",)) for k in range(3)]
    values = density(markers, frame, 0.5, 0.05)
    assert values.max() == pytest.approx(1.0, abs=0.01)
    assert values[80, 80] == values.max()
    assert values[80, 90] == pytest.approx(math.exp(-0.5), abs=0.01)  # one deviation off


def test_simulated_choices_can_be_compared(world, tmp_path, capsys):
    named, file = save_building(building(), tmp_path), tmp_path / "new" / "people.csv"
    simulate(str(named), participants=8, seed=4, out=file)
    assert capsys.readouterr().out.startswith(f"{file}: ")
    again = tmp_path / "again.csv"
    simulate(str(named), participants=8, seed=4, out=again)
    assert again.read_bytes() == file.read_bytes()
    made = compared([world], file)
    assert len(made.people) == 8
    assert made.figures["people"]["alpha"].value > 0.4


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ({"participants": 0}, "--participants: 0: expected 1 to 10000"),
        ({"noise": -1.0}, "--noise: -1.0: expected metres, 0 or more"),
        ({"shared": 1.5}, "--shared: 1.5: expected a share, 0 to 1"),
        ({"sensitivity": math.nan}, "--sensitivity: nan: expected a number"),
        ({"seed": -1}, "--seed: -1: expected 0 or more"),
        ({"criterion": 99.0}, "--criterion: 99: nobody marked anything; expected a lower one"),
    ],
)
def test_wrong_parameters_of_participants_are_named(tmp_path, wrong, said):
    named = save_building(building(), tmp_path)
    with pytest.raises(SettingsError, match=re.escape(said)):
        simulate(str(named), out=tmp_path / "people.csv", **wrong)
    assert not (tmp_path / "people.csv").exists()


def test_a_map_without_labels_has_nothing_to_mark(tmp_path):
    plain = building()
    bare = save_building(type(plain)("bare", plain.grid), tmp_path)
    with pytest.raises(MapError, match="no place is labelled"):
        simulate(str(bare), out=tmp_path / "people.csv")
