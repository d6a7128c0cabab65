"""Errands in scenarios: carried out, said in the manifest, refused where they cannot be."""

import json

import pytest
import yaml

from ssrics_like.errors import LibraryError, SettingsError
from ssrics_like.library import find
from ssrics_like.report.page import write_report
from ssrics_like.results.errands import errand_text
from ssrics_like.scenarios.resolving import resolve
from ssrics_like.scenarios.runner import run_scenario
from ssrics_like.scenarios.schema import make_scenario, read_scenario

RING = find("scenarios", "closed-door")


@pytest.fixture(scope="module")
def tour(tmp_path_factory):
    """Results of the shipped scenario with a shut doorway."""
    out = tmp_path_factory.mktemp("errands") / "out"
    scenario, document = read_scenario(RING)
    manifest = run_scenario(resolve(scenario, RING.parent, where=document.where), out)
    return out, manifest


def test_a_shut_doorway_is_found_remembered_and_gone_round(tour):
    out, manifest = tour
    (entry,) = manifest["runs"]
    tour_of_all, home = entry["errands"]
    assert (tour_of_all["order"], tour_of_all["outcome"]) == ("visit-all", "reached")
    assert (home["order"], home["outcome"]) == ("home", "reached")
    assert len(tour_of_all["shut"]) == 1
    graph = json.loads((out / "topology" / "run-000.json").read_text())
    shut = [f"{e['source']}-{e['target']}" for e in graph["edges"] if e["closed"]]
    one, other = tour_of_all["shut"][0].split("-")
    assert shut
    assert set(shut) <= {f"{one}-{other}", f"{other}-{one}"}
    assert set(tour_of_all["visited"]) == {node["id"] for node in graph["nodes"]}


def test_the_report_tells_of_errands(tour):
    out, _ = tour
    page = write_report(out).read_text()
    assert 'id="errands"' in page
    assert "found shut: " in page
    assert "A dashed orange line is a way that was found shut" in page


def test_a_carried_robot_finds_itself_and_goes_home(tmp_path):
    path = find("scenarios", "kidnapped")
    scenario, document = read_scenario(path)
    manifest = run_scenario(resolve(scenario, path.parent, where=document.where), tmp_path / "out")
    (errand,) = manifest["runs"][0]["errands"]
    assert errand["outcome"] == "reached"
    assert errand["searches"] >= 1


def refused(tmp_path, **changes):
    data = yaml.safe_load(RING.read_text())
    data["world"]["map"] = str(RING.parent / data["world"]["map"])
    data["world"].update(changes.pop("world", {}))
    data.update(changes)
    path = tmp_path / "mine.yaml"
    path.write_text(yaml.safe_dump(data, sort_keys=False))
    scenario, document = read_scenario(path)
    with pytest.raises(SettingsError) as error:
        resolve(scenario, path.parent, where=document.where)
    return str(error.value)


def test_an_errand_needs_rules_that_lead(tmp_path):
    said = refused(tmp_path, productions="landmark")
    assert "world.legs.2.goto: 'visit-all': no rule of landmark.yaml attends" in said
    assert "wayfinding" in said
    assert said.startswith(f"{tmp_path}/mine.yaml:")


def test_a_rule_set_that_there_is_not_is_said_alone(tmp_path):
    with pytest.raises(
        (SettingsError, LibraryError), match=r"wayfindng.*did you mean 'wayfinding'"
    ):
        resolve(
            make_scenario({"world": {"map": "ring.yaml", "goto": "home"}}),
            RING.parent / "maps",
            overrides=["productions=wayfindng"],
        )


def test_a_landmark_must_be_one_that_can_be_known(tmp_path):
    alone = {"legs": [{"goto": "L3"}], "doors": []}
    assert "memory has no landmark 'L3'; nothing was explored before" in refused(
        tmp_path, world=alone
    )
    memory = str(find("scenarios", "second-visit").parent / "memories" / "complex.json")
    far = {"legs": [{"goto": "L33"}], "doors": []}
    said = refused(tmp_path, world=far, memory_from=memory)
    assert "memory has no landmark 'L33'; did you mean 'L3'?" in said


def test_a_leg_is_one_thing():
    with pytest.raises(SettingsError, match="a leg is explore, goto, wait_s, waypoints, one of"):
        make_scenario({"world": {"map": "a.yaml", "legs": [{"goto": "L1", "wait_s": 3.0}]}})


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"outcome": "reached"}, "errand L3: reached after 12 s; by L1, L3"),
        (
            {"outcome": "failed", "reason": "no-open-way", "shut": ["L1-L2"]},
            (
                "errand L3: failed, because no way leads there that was not found shut after 12 s; "
                "by L1, L3; found shut: L1-L2"
            ),
        ),
        ({"outcome": ""}, "errand L3: not ended when the run was"),
        (
            {"outcome": "reached", "searches": 2, "left_out": ["L9"]},
            "errand L3: reached after 12 s; by L1, L3; left out: L9; looked about 2 times",
        ),
    ],
)
def test_an_errand_is_said_in_a_line(changes, said):
    errand = {
        "order": "L3", "started_s": 5.0, "ended_s": 17.0, "goal": "L3", "visited": ["L1", "L3"],
        "shut": [], "left_out": [], "searches": 0, "outcome": "", "reason": "",
    }  # fmt: skip
    assert errand_text(errand | changes) == said
