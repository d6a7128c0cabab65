"""Scores of a results folder: its files, what they are worked out from, and when there are none."""

import csv
import json
import math

import numpy as np
import pytest
from results_folders import DOORS, PUBLISHED, build, build_world, building

from ssrics_like.comparison import score_folder, write_scores
from ssrics_like.errors import MapError, ResultsError
from ssrics_like.maps import save_building
from ssrics_like.perception.observation import Pose
from ssrics_like.results.files import json_text
from ssrics_like.world.building import Building
from ssrics_like.world.grid import GridMap
from ssrics_like.world.locations import Location


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    out = build_world(tmp_path_factory.mktemp("world"), poses=200, published=PUBLISHED)
    write_scores(out)
    return out


def edit(folder, change):
    file = folder / "manifest.json"
    manifest = json.loads(file.read_text())
    change(manifest)
    file.write_text(json_text(manifest))


def true_marks(folder):
    """Read each run's marks as a user would: declared or recognised, true positions."""
    marks = {}
    with (folder / "decisions.csv").open(newline="") as file:
        for row in csv.DictReader(file):
            if row["decision"] in ("declared", "recognised"):
                place = float(row["true_x_m"]), float(row["true_y_m"])
                marks.setdefault(int(row["run"]), []).append(place)
    return marks


def test_the_table_has_the_columns_of_the_contract(folder):
    lines = (folder / "locations.csv").read_text().splitlines()
    assert (
        lines[0] == "location,kind,label,x_m,y_m,runs,found,share,low,high,chance,clock,published"
    )
    assert lines[1].startswith("1,doorway,lab,8.660254,3,14,")
    assert lines[1].endswith(",0.57")
    assert [line.split(",")[0] for line in lines[1:]] == [*"123456ABC"]
    assert lines[-1].endswith(",")  # nobody published anything of C


def test_places_were_found_where_a_mark_lies_within_the_radius(folder):
    marks = true_marks(folder)
    with (folder / "locations.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    for row, door in zip(rows, DOORS, strict=False):
        found = sum(any(math.dist(mark, door) <= 1.0 for mark in marks[run]) for run in range(14))
        assert int(row["found"]) == found
        assert float(row["share"]) == pytest.approx(found / 14, abs=1e-6)
        assert float(row["low"]) < found / 14 < float(row["high"])


def test_the_figures_of_scores_json_fit_together(folder):
    data = json.loads((folder / "scores.json").read_text())
    assert (data["format"], data["version"], data["radius_m"]) == ("ssrics-scores", 1, 1.0)
    assert data["published_in"] == "report, table 1"
    assert [run["run"] for run in data["runs"]] == list(range(14))
    pooled = data["pooled"]
    for count in ("marks", "merged", "right", "designated", "found"):
        assert pooled[count] == sum(run[count] for run in data["runs"])
    assert pooled["designated"] == 6 * 14
    assert pooled["marks"] == sum(map(len, true_marks(folder).values()))
    assert pooled["recall"] == pytest.approx(pooled["found"] / 84, abs=1e-6)
    assert pooled["chance"] == pytest.approx(
        np.mean([run["chance"] for run in data["runs"]]), abs=1e-6
    )
    assert 0 < pooled["chance"] < pooled["recall"]
    assert 0 <= pooled["consistency"] <= 1
    names = set().union(*(key.split(", ") for key in data["definitions"]))
    assert names >= set(data["runs"][0]) - {
        "run", "path_m", "marks", "merged", "right", "designated"
    }  # fmt: skip


def test_equal_folders_give_equal_bytes_and_another_seed_another_chance(folder, tmp_path):
    twin = build_world(tmp_path / "twin", poses=200, published=PUBLISHED)
    write_scores(twin)
    for name in ("locations.csv", "scores.json"):
        assert (twin / name).read_bytes() == (folder / name).read_bytes()
    edit(twin, lambda manifest: manifest.update(seed=7))
    write_scores(twin)
    assert (twin / "scores.json").read_bytes() != (folder / "scores.json").read_bytes()


def test_the_scenario_says_how_near_is_near_enough(tmp_path):
    out = build_world(tmp_path / "r", runs=3, poses=50)
    recalls = []
    for radius_m in (0.1, 0.5, 2.0):
        edit(out, lambda manifest, r=radius_m: manifest["scenario"].update(match_radius_m=r))
        scores = score_folder(out).scores
        assert scores.radius_m == radius_m
        recalls.append(scores.pooled.recall)
    assert recalls == sorted(recalls)
    assert recalls[0] < recalls[2]


def test_a_turned_and_shifted_map_is_scored_in_its_own_frame(tmp_path):
    plain = building()
    turn = Pose(3.0, -2.0, 0.7)
    grid = GridMap(plain.grid.cells, plain.grid.cell_m, turn)
    # The same doors, in the frame of the turned map; the marks stay, and so miss them.
    moved = grid.points_in_map(plain.grid.points_in_grid(DOORS)).tolist()
    places = tuple(Location(str(i), *at) for i, at in enumerate(moved))
    out = build_world(
        tmp_path / "r", runs=2, poses=50, misses=0.0, places=Building("t", grid, places)
    )
    assert score_folder(out).scores.pooled.recall < 0.5
    shown = [(p.location.x_m, p.location.y_m) for p in score_folder(out).scores.places]
    np.testing.assert_allclose(shown, moved)


def test_a_log_has_no_scores_and_old_ones_do_not_stay(tmp_path):
    out = build(tmp_path / "r", poses=20)
    for name in ("locations.csv", "scores.json"):
        (out / name).write_text("old")
    assert write_scores(out) is None
    assert not (out / "locations.csv").exists()
    assert not (out / "scores.json").exists()


def test_a_map_on_which_nothing_is_labelled_has_no_scores(tmp_path):
    bare = Building("bare", building().grid)
    out = build_world(tmp_path / "r", runs=2, poses=20, places=bare)
    assert score_folder(out) is None


def test_a_map_without_doorways_has_precision_but_no_recall(tmp_path):
    out = build_world(tmp_path / "r", runs=2, poses=20, places=building(doors=0))
    data = write_scores(out) and json.loads((out / "scores.json").read_text())
    assert data["pooled"]["recall"] is None
    assert data["pooled"]["precision"] is not None


def test_damaged_files_are_named(tmp_path):
    out = build_world(tmp_path / "r", runs=1, poses=20)
    edit(out, lambda manifest: manifest["scenario"].update(published={"found": {}}))
    with pytest.raises(ResultsError, match=r"manifest\.json: is damaged: KeyError\('source'\)"):
        write_scores(out)
    (out / "map" / "map.yaml").write_text("image: nothing.png\nresolution: 0.05\n")
    with pytest.raises(MapError, match=r"nothing\.png"):
        write_scores(out)
    save_building(building(), out / "map")
    edit(out, lambda manifest: manifest["scenario"].pop("published"))
    assert write_scores(out) is not None
    with pytest.raises(ResultsError, match="no such folder"):
        write_scores(tmp_path / "nowhere")
