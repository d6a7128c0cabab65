"""What a scenario may say of its world: every mistake with its place, all of them at once."""

import json
import math

import numpy as np
import pytest
from buildings import room

from ssrics_like import library
from ssrics_like.errors import MapError, SettingsError, SsricsError, choices
from ssrics_like.maps import load_building, save_building
from ssrics_like.perception.observation import Pose
from ssrics_like.scenarios.checking import check_file, json_schema
from ssrics_like.scenarios.feeds import DriveFeed
from ssrics_like.scenarios.modules import load_robot
from ssrics_like.scenarios.place import place_of
from ssrics_like.scenarios.resolving import load_resolved, resolve
from ssrics_like.scenarios.runner import drive_key
from ssrics_like.scenarios.schema import Scenario, make_scenario, read_scenario
from ssrics_like.scenarios.variants import resolve_variants
from ssrics_like.settings import read_document
from ssrics_like.world.building import Building
from ssrics_like.world.buildings.generator import BuildingSettings, generate
from ssrics_like.world.buildings.plan import build
from ssrics_like.world.locations import Location
from ssrics_like.world.reachable import clearance, roomiest

# The map lies turned: its x is -2 less the grid's y, its y is 1 and the grid's x.
ORIGIN = Pose(-2.0, 1.0, math.pi / 2)
ROOMS = room(8.0, 4.0, walls=[(3.9, 0.0, 4.1, 1.55), (3.9, 2.45, 4.1, 4.0)], origin=ORIGIN)
LOCATIONS = (
    Location("door", -2.0 - 2.0, 1.0 + 4.0, "between the rooms"),
    Location("hall", -2.0 - 2.0, 1.0 + 2.0, "in the middle of a room", "other"),
)


def in_map(x_m, y_m):
    """Return a place of the grid in the frame of the map, to four decimals."""
    pose = ROOMS.pose_in_map(Pose(x_m, y_m, 0.0))
    return [round(pose.x_m, 4), round(pose.y_m, 4)]


@pytest.fixture(scope="module")
def maps(tmp_path_factory):
    """Return a folder with a map of two rooms and a table of its locations."""
    folder = tmp_path_factory.mktemp("maps")
    save_building(Building("Two rooms", ROOMS, LOCATIONS), folder, "two")
    (folder / "mine.csv").write_text("id,x_m,y_m\ngate,{},{}\n".format(*in_map(4.0, 2.0)))
    return folder


def written(folder, text, name="scenario.yaml"):
    path = folder / name
    path.write_text(text)
    return path


def complaints(path, overrides=()):
    """Return what is wrong with a scenario file, a line each, without the file's path."""
    with pytest.raises((SettingsError, MapError)) as caught:
        load_resolved(path, list(overrides))
    return [line.removeprefix(f"{path}:") for line in str(caught.value).splitlines()]


EVERY_KEY_WRONG = """\
titel: every key is wrong
runs: 0
seed: -1
match_radius_m: nine
perception: humanlike
productions: [landmark]
memory: ./none.yaml
humans: none.csv
world:
  map: none.yaml
  robot: pioneer
  start: [1.0]
  explore: frontiers
  waypoints: [[1, 1], [2]]
  repeat: 0
  time_limit_s: 0
  tiem_limit: 5
  locations: {id: A}
  building: {seed: -1, room: 3, rooms: 1, hallways: Z, scale: [3, 1]}
  legs:
    - explore: frontier
      wait_s: 3
    - wait_s: -1
    - waypoint: [[1, 1]]
    - {wait_s: 1, repeat: 2}
    - {}
  people: {count: many, speed: 3}
  furniture: {pieces: -3, moved: 1}
  slip: {per_m: .nan, length_m: 0, share: 2}
  doors:
    - {location: door, at: [1, 2]}
    - {at: [1, 2], closes_s: 5, opens_s: 4}
    - {at: here}
    - {locaton: door}
  kidnaps:
    - {to: [1, 2]}
    - {at_s: soon, to: [1, 2, 3, 4]}
factors: {a: {}}
variants:
  - {name: a b, sett: {}}
  - {title: nameless}
set: [1]
"""

EVERY_COMPLAINT = """\
1:1: unknown key 'titel'; did you mean 'title'?
2:1: runs: 0: expected greater than or equal to 1
3:1: seed: -1: expected greater than or equal to 0
4:1: match_radius_m: 'nine' where a number was expected
5:1: perception: no perception entry 'humanlike'; did you mean 'human-like'?; {perception}
6:1: productions: ['landmark'] where text was expected
7:1: memory: {here}/none.yaml: no such file
8:1: humans: {here}/none.csv: no such file
10:3: world.map: {here}/none.yaml: no such file
11:3: world.robot: no robots entry 'pioneer'; did you mean 'pioneer-dx'?; {robots}
12:3: world.start: [1.0]: expected [x, y] or [x, y, heading] in metres and radians
13:3: world.explore: 'frontiers' where 'frontier' was expected
14:23: world.waypoints.1: [2]: expected [x, y] or [x, y, heading] in metres and radians
15:3: world.repeat: 0: expected greater than or equal to 1
16:3: world.time_limit_s: 0: expected greater than 0
17:3: unknown key 'world.tiem_limit'; did you mean 'time_limit_s'?
18:3: world.locations: {'id': 'A'} where text was expected
19:14: world.building.seed: -1: expected greater than or equal to 0
19:24: unknown key 'world.building.room'; did you mean 'rooms'?
19:33: world.building.rooms: 1: expected greater than or equal to 2
19:43: world.building.hallways: 'Z' where 'any', 'straight', 'L', 'T', 'X', 'U' or 'ring' was expected
19:56: world.building.scale: [3.0, 1.0]: expected [from, to], rising, within 0.7 and 3
21:7: world.legs.0: a leg is explore, goto, wait_s, waypoints, one of them; it has explore and wait_s
23:7: world.legs.1.wait_s: -1: expected greater than or equal to 0
24:7: unknown key 'world.legs.2.waypoint'; did you mean 'waypoints'?
25:7: world.legs.3: repeat goes with waypoints, this leg has wait_s
26:7: world.legs.4: a leg is explore, goto, wait_s, waypoints, one of them; it has none of them
27:12: world.people.count: 'many' where a whole number was expected
27:25: unknown key 'world.people.speed'; did you mean 'speed_m_s'?
28:15: world.furniture.pieces: -3: expected greater than or equal to 0
28:27: world.furniture.moved: 1 where true or false was expected
29:10: world.slip.per_m: nan: expected a finite number
29:23: world.slip.length_m: 0: expected greater than 0
29:36: world.slip.share: 2: expected less than or equal to 1
31:7: world.doors.0: a door has either location or at
32:7: world.doors.1: opens_s is 4, not after closes_s 5
33:8: world.doors.2.at: 'here': expected [x, y] in metres
34:8: unknown key 'world.doors.3.locaton'; did you mean 'location'?
36:7: key 'world.kidnaps.0.at_s' is missing
37:8: world.kidnaps.1.at_s: 'soon' where a number was expected
37:20: world.kidnaps.1.to: [1, 2, 3, 4]: expected [x, y] or [x, y, heading] in metres and radians
38:11: factors.a: {}: expected 1 or more
40:6: variants.0.name: 'a b': expected letters, digits, dots and dashes
40:17: unknown key 'variants.0.sett'; did you mean 'set'?
41:5: key 'variants.1.name' is missing
42:1: set: [1] where keys and values was expected
"""


def test_a_scenario_with_every_key_wrong_gives_every_mistake_with_line_and_column(tmp_path):
    expected = EVERY_COMPLAINT.replace("{here}", str(tmp_path))
    for kind in ("robots", "perception"):
        known = f"the library has {choices(library.entries(kind))} (a path ends in .yaml)"
        expected = expected.replace(f"{{{kind}}}", known)
    found = complaints(written(tmp_path, EVERY_KEY_WRONG))
    assert found == expected.splitlines()
    # Every line of the file is named, but for those that begin a block or go on with a leg.
    named = {int(line.split(":")[0]) for line in found}
    for i, line in enumerate(EVERY_KEY_WRONG.splitlines(), 1):
        assert i in named or line.endswith(":") or line == "      wait_s: 3", line


def test_every_name_and_file_that_is_not_there_is_said(tmp_path):
    path = written(
        tmp_path,
        "perception: humanlike\nproductions: landmrk\nmemory: ./none.yaml\nhumans: none.csv\n"
        "world:\n  map: none.yaml\n  locations: none-either.csv\n  robot: pioneer\n",
    )
    found = complaints(path)
    assert [line.split(": ")[:2] for line in found] == [
        ["1:1", "perception"], ["2:1", "productions"], ["3:1", "memory"], ["4:1", "humans"],
        ["6:3", "world.map"], ["7:3", "world.locations"], ["8:3", "world.robot"],
    ]  # fmt: skip
    for line, said in zip(
        found,
        ["'human-like'?", "'landmark'?", "no such file", "no such file", "no such file",
         "no such file", "'pioneer-dx'?"],
        strict=True,
    ):  # fmt: skip
        assert said in line


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("title: nothing\n", "a scenario has either source (a log) or world (a building)"),
        (
            "source: {log: x.log}\nworld: {building: {}}\n",
            "a scenario has either source (a log) or world (a building)",
        ),
        ("world: {robot: pioneer-dx}\n", "1:1: world: a world has either map or building"),
        (
            "world:\n  map: x.yaml\n  building: {seed: 1}\n",
            "1:1: world: a world has either map or building",
        ),
        (
            "world:\n  building: {}\n  explore: frontier\n  legs: [{wait_s: 1}]\n",
            "1:1: world: explore and legs exclude each other; list them in legs",
        ),
        (
            "world:\n  building: {}\n  waypoints: [[1, 1]]\n  explore: frontier\n  legs: [{wait_s: 1}]\n",
            "1:1: world: explore and waypoints and legs exclude each other; list them in legs",
        ),
        (
            "world:\n  building: {}\n  explore: frontier\n  repeat: 2\n",
            "1:1: world: repeat goes with waypoints",
        ),
        (
            "world:\n  building: {rooms: 2, hallways: ring}\n",
            "2:3: world.building: rooms: 2: expected at least 7 where hallways run as ring",
        ),
    ],
)
def test_what_excludes_each_other_is_said(tmp_path, text, expected):
    found = complaints(written(tmp_path, text))
    assert expected in [line.strip() for line in found if "no such file" not in line]


WRONG_PLACES = """\
world:
  map: two.yaml
  legs:
    - waypoints:
        - {inside}
        - {in_wall}
        - [99, 99]
    - explore: frontier
    - waypoints: [{behind_table}]
  doors:
    - {{location: dor}}
    - {{location: hall}}
    - {{at: {in_wall}}}
    - {{location: door, opens_s: 5}}
  kidnaps:
    - {{at_s: 1, to: {in_wall}}}
    - {{at_s: 2, to: {inside}}}
"""


def test_every_place_that_the_robot_cannot_be_at_is_said_with_the_nearest_one(maps):
    path = written(
        maps,
        WRONG_PLACES.format(
            inside=in_map(6.0, 2.0), in_wall=in_map(4.0, 0.5), behind_table=in_map(0.2, 1.5)
        ),
    )
    body, wall, no_door = "the robot (radius 0.27 m)", "[-2.5, 5]", "there is no doorway here"
    # The nearest middles of cells with more than 0.27 m around them, in the frame of the map.
    found = complaints(path)
    assert [line.partition("; the nearest")[0] for line in found] == [
        f"6:11: world.legs.0.waypoints.1: {wall}: {body} cannot get there from its start",
        f"7:11: world.legs.0.waypoints.2: [99, 99]: {body} cannot get there from its start",
        f"9:19: world.legs.2.waypoints.0: [-3.5, 1.2]: {body} cannot get there from its start",
        f"16:17: world.kidnaps.0.to: {wall}: {body} does not fit there",
        "11:8: world.doors.0.location: the map has no location 'dor'; did you mean 'door'?",
        f"12:8: world.doors.1.location: [-4, 3]: {no_door}: no gap of up to 3 m between walls",
        f"13:8: world.doors.2.at: {wall}: {no_door}: the place is inside a wall or off the map",
    ]
    fits = np.argwhere(clearance(ROOMS) > 0.27)
    middles = ROOMS.points_in_map((fits[:, ::-1] + 0.5) * ROOMS.cell_m)
    for line, place in [(found[0], (-2.5, 5.0)), (found[1], (99, 99)), (found[2], (-3.5, 1.2))]:
        near = json.loads(line.partition("it could be is ")[2])
        assert np.hypot(*(middles - near).T).min() <= 0.01
        least = np.hypot(*(middles - place).T).min()
        assert math.dist(near, place) == pytest.approx(least, abs=0.01)


def test_a_start_in_a_wall_is_said_with_the_nearest_place(maps):
    path = written(maps, f"world:\n  map: two.yaml\n  start: {in_map(4.0, 0.5)}\n")
    (said,) = complaints(path)
    assert said.startswith(
        "3:3: world.start: [-2.5, 5]: the robot (radius 0.27 m) does not fit there; the nearest "
        "place where it could be is ["
    )
    for outside in ("[99, 99]", "[-1e5, 0, 3]"):
        (said,) = complaints(written(maps, f"world:\n  map: two.yaml\n  start: {outside}\n"))
        assert "does not fit there" in said


def test_a_wrong_start_does_not_hide_what_else_is_wrong(maps):
    path = written(
        maps,
        f"world:\n  map: two.yaml\n  start: {in_map(4.0, 0.5)}\n  waypoints: [[99, 99]]\n"
        "  doors: [{location: dor}]\n",
    )
    assert [line.split(": ")[:2] for line in complaints(path)] == [
        ["3:3", "world.start"], ["4:15", "world.waypoints.0"], ["5:12", "world.doors.0.location"],
    ]  # fmt: skip


def test_a_robot_too_wide_for_the_map_is_said(maps, tmp_path):
    (maps / "wide.yaml").write_text("radius_m: 2.5\n")
    path = written(maps, "world:\n  map: two.yaml\n  robot: ./wide.yaml\n")
    (said,) = complaints(path)
    assert said == "3:3: world.robot: the robot (radius 2.5 m) fits nowhere on two.yaml"
    (maps / "wide.yaml").write_text("radius_m: 0.6\n")
    path = written(
        maps, f"world:\n  map: two.yaml\n  robot: ./wide.yaml\n  waypoints: [{in_map(4.5, 1.5)}]\n"
        f"  start: {in_map(1.5, 1.5)}\n",
    )  # fmt: skip
    (said,) = complaints(path)  # it does not get through the doorway
    assert said.startswith("4:15: world.waypoints.0: [-3.5, 5.5]: the robot (radius 0.6 m) cannot")


def test_every_wrong_value_of_set_is_said_at_its_own_line(maps):
    path = written(
        maps,
        "world:\n  map: two.yaml\nset:\n  memory.decay: -1\n  perception.mrk: onset\n"
        "  perception.interval: 1\n  robot.speed_m_s: fast\n  seed: 4\n",
    )
    assert sorted(line.split("; ")[0] for line in complaints(path)) == [
        "4:3: memory.decay: -1: expected greater than 0",
        "5:3: perception.mrk: unknown key 'mrk'",
        "6:3: perception.interval: 1: expected greater than or equal to 2",
        "7:3: robot.speed_m_s: 'fast' where a number was expected",
        "8:3: seed: unknown key 'seed'",
    ]


def test_every_mistake_about_doors_is_said_at_once(maps):
    path = written(
        maps,
        "world:\n  map: two.yaml\n  doors:\n    - {location: dor}\n"
        "    - {location: door, at: [1, 2], closes_s: 5, opens_s: 4}\n",
    )
    assert complaints(path) == [
        "4:8: world.doors.0.location: the map has no location 'dor'; did you mean 'door'?",
        "5:7: world.doors.1: a door has either location or at; opens_s is 4, not after closes_s 5",
    ]


def test_locations_of_a_table_replace_those_of_the_map(maps):
    path = written(maps, "world: {map: two.yaml, locations: mine.csv, doors: [{location: gate}]}\n")
    place = load_resolved(path).place
    assert [location.id for location in place.building.locations] == ["gate"]
    assert len(place.doors) == 1
    assert place.doors[0].closed
    (said,) = complaints(
        written(maps, "world: {map: two.yaml, locations: mine.csv, doors: [{location: hall}]}\n")
    )
    assert said.endswith("the map has no location 'hall'; it has gate")


def test_a_damaged_map_is_said_as_such(maps):
    (maps / "bad.yaml").write_text("image: none.png\nresolution: -1\norigin: [0, 0, 0]\n")
    said = complaints(written(maps, "world: {map: bad.yaml}\n"))
    assert any("bad.yaml" in line and "resolution" in line for line in said)


def test_a_good_scenario_says_what_it_is(maps):
    path = written(
        maps,
        f"""\
title: There and back
world:
  map: two.yaml
  robot: pioneer-dx-360
  start: {[*in_map(1.5, 1.5), 1.0]}
  legs:
    - waypoints: [{in_map(4.5, 1.5)}, {[*in_map(1.5, 1.5), 0.5]}]
      repeat: 2
    - wait_s: 2
    - explore: frontier
  furniture: {{pieces: 3}}
  people: {{count: 2}}
  slip: {{per_m: 0.1}}
  doors: [{{location: door, closes_s: 3, opens_s: 9}}]
  kidnaps: [{{at_s: 4, to: {in_map(4.5, 1.5)}}}]
  time_limit_s: 60
runs: 3
""",
    )
    assert check_file(path) == "scenario, 'There and back', 3 runs of two.yaml"
    place = load_resolved(path).place
    # Everything is kept in the frame of the grid, and told in that of the map.
    assert (place.start.x_m, place.start.y_m) == pytest.approx((1.5, 1.5))
    assert place.start.theta_rad == pytest.approx(1.0 - math.pi / 2)
    assert (place.kidnaps[0].to.x_m, place.kidnaps[0].to.y_m) == pytest.approx((4.5, 1.5))
    assert [(door.at_s, door.closed) for door in place.doors] == [(3.0, True), (9.0, False)]
    data = place.as_data()
    assert data["start"] == pytest.approx([*in_map(1.5, 1.5), 1.0])
    assert data["legs"][1:] == [{"wait_s": 2.0, "repeat": 1}, {"explore": "frontier", "repeat": 1}]
    assert data["robot"]["name"] == "pioneer-dx-360"
    assert data["robot"]["laser"]["beams"] == 360
    assert json.loads(json.dumps(data)) == data


def test_a_drive_keeps_to_the_frame_of_the_map(maps):
    path = written(
        maps,
        f"world: {{map: two.yaml, start: {in_map(1.0, 1.5)}, waypoints: [{in_map(5.0, 1.5)}]}}\n",
    )
    seen = list(DriveFeed(load_resolved(path).place, 1, 0))
    first, last = seen[0].true_pose, seen[-1].true_pose
    assert (first.x_m, first.y_m) == pytest.approx(in_map(1.02, 1.5), abs=0.05)
    assert (last.x_m, last.y_m) == pytest.approx(in_map(5.0, 1.5), abs=0.2)


def test_start_left_out_is_the_roomiest_place_heading_along_the_grid(maps):
    grid = load_building(maps / "two.yaml").grid
    place = load_resolved(written(maps, "world: {map: two.yaml}\n")).place
    assert place.start == roomiest(grid)
    assert place.start.theta_rad == 0.0
    assert place.as_data()["start"][2] == pytest.approx(math.pi / 2)  # of the map


def test_without_a_journey_it_explores():
    place = resolve(make_scenario({"world": {"building": {"rooms": 2}}}), library.root()).place
    assert place.as_data()["legs"] == [{"explore": "frontier", "repeat": 1}]


def test_a_generated_building_is_decided_by_its_seed_and_settings():
    def cells(**building):
        data = {"world": {"building": building}}
        return resolve(make_scenario(data), library.root()).place

    one = cells(seed=3, rooms=4)
    assert one.name == "building-3"
    assert one.sha256 == cells(seed=3, rooms=4).sha256
    assert one.sha256 != cells(seed=4, rooms=4).sha256
    assert one.sha256 != cells(seed=3, rooms=5).sha256
    plan = generate(np.random.default_rng(3), BuildingSettings(rooms=4))
    assert np.array_equal(one.building.grid.cells, build(plan).grid.cells)
    assert one.building.locations == build(plan).locations


@pytest.mark.parametrize(
    ("override", "where", "value"),
    [
        ("robot.speed_m_s=0.5", ("robot", "speed_m_s"), 0.5),
        ("robot.laser.rate_hz=25", ("robot", "laser", "rate_hz"), 25),
        ("robot.odometry.drift_rad=0", ("robot", "odometry", "drift_rad"), 0),
        ("world.robot=pioneer-dx-360", ("robot", "laser", "beams"), 360),
        ("world.time_limit_s=30", ("time_limit_s",), 30),
        ("world.people={count: 3}", ("people", "count"), 3),
        ("world.people.count=4", ("people", "count"), 4),
        ("world.furniture={pieces: 5, moved: false}", ("furniture", "moved"), False),
        ("world.slip={per_m: 0.2}", ("slip", "per_m"), 0.2),
        ("world.start=[-3.5, 2.5, 0.1]", ("start", 2), 0.1),
        ("world.legs=[{wait_s: 3}]", ("legs", 0, "wait_s"), 3),
    ],
)
def test_values_of_world_and_robot_can_be_set(maps, override, where, value):
    path = written(
        maps, "world: {map: two.yaml, people: {count: 1}}\nset: {robot.speed_m_s: 0.3}\n"
    )
    resolved = load_resolved(path, [override])
    found = resolved.place.as_data()
    for key in where:
        found = found[key]
    assert found == pytest.approx(value)
    speed = 0.5 if "speed" in override else 0.3
    assert resolved.place.robot.speed_m_s == speed
    # It decides the drives, and stands in what is said of the results.
    assert drive_key(resolved) != drive_key(load_resolved(path))
    assert resolved.as_data()["world"] == resolved.place.as_data()


@pytest.mark.parametrize(
    "override", ["world.people.count=4", "world.slip.per_m=0.2", "world.furniture.pieces=3"]
)
def test_a_section_that_was_left_out_can_be_set_by_what_it_needs(override):
    resolved = resolve(
        make_scenario({"world": {"building": {"rooms": 2}}}), library.root(), [override]
    )
    _, section, rest = override.split(".", 2)
    key, value = rest.split("=")
    assert resolved.place.as_data()[section][key] == float(value)


@pytest.mark.parametrize(
    ("override", "said"),
    [
        ("robot.sped_m_s=1", "--set robot.sped_m_s: unknown key 'sped_m_s'; did you mean 'speed_m_s'?"),
        ("robot.laser.beams=1", "--set robot.laser.beams: 1: expected greater than or equal to 2"),
        ("world.timelimit_s=1", "--set world.timelimit_s: unknown key 'timelimit_s'; did you mean"),
        ("world.people.count=-1", "--set world.people.count: -1: expected greater than or equal to 0"),
        ("world.people.cuont=1", "--set world.people.cuont: unknown key 'cuont'; did you mean 'count'?"),
        ("world.start=[99, 99]", "world.start: [99, 99]: the robot (radius 0.27 m) does not fit there"),
        ("world.explore=everywhere", "world.explore: 'everywhere' where 'frontier' was expected"),
        ("robt.speed_m_s=1", "--set robt.speed_m_s: unknown key 'robt'; did you mean 'robot'?"),
        ("world.robot=pioneer", "did you mean 'pioneer-dx'?"),
        ("source={log: x.log}", "a scenario has either source (a log) or world (a building)"),
    ],
)  # fmt: skip
def test_what_cannot_be_set_is_said(maps, override, said):
    path = written(maps, "world: {map: two.yaml, people: {count: 2}}\n")
    with pytest.raises(SsricsError) as caught:
        load_resolved(path, [override])
    assert said in str(caught.value)
    assert len(str(caught.value).splitlines()) == 1


def test_a_robot_cannot_be_set_where_a_log_is_replayed():
    log = library.folder("scenarios") / "logs" / "demo.log.gz"
    scenario = make_scenario({"source": {"log": str(log)}})
    with pytest.raises(SettingsError, match="unknown key 'robot'") as caught:
        resolve(scenario, library.root(), ["robot.speed_m_s=1"])
    assert "robot." not in str(caught.value).partition("known: ")[2]


def test_paths_in_a_file_start_there_and_typed_ones_here(maps, tmp_path, monkeypatch):
    path = written(maps, "world: {map: two.yaml}\n")
    monkeypatch.chdir(tmp_path)
    assert load_resolved(path).place.name == "two.yaml"
    with pytest.raises(MapError, match="no such file"):
        load_resolved(path, ["world.map=two.yaml"])
    assert load_resolved(path, [f"world.map={maps / 'two.yaml'}"]).place.name == "two.yaml"


def test_furniture_moves_from_run_to_run_unless_it_is_told_to_stay(maps):
    def grids(text, seed=1):
        place = load_resolved(written(maps, f"world: {{map: two.yaml{text}}}\n")).place
        return [DriveFeed(place, seed, run).simulation.grid.cells for run in range(2)]

    bare = load_building(maps / "two.yaml").grid.cells
    moved = grids(", furniture: {pieces: 4}")
    stays = grids(", furniture: {pieces: 4, moved: false}")
    assert not np.array_equal(moved[0], moved[1])
    assert np.array_equal(stays[0], stays[1])
    assert not np.array_equal(stays[0], bare)
    assert not np.array_equal(stays[0], grids(", furniture: {pieces: 4, moved: false}", 2)[0])
    assert np.array_equal(grids("")[0], bare)
    assert np.array_equal(moved[0], grids(", furniture: {pieces: 4}")[0])


def resolved_reference(schema, part):
    """Follow ``$ref`` and the one branch of ``anyOf`` that is not null."""
    if "$ref" in part:
        return schema["$defs"][part["$ref"].rpartition("/")[2]]
    branches = [branch for branch in part.get("anyOf", []) if branch.get("type") != "null"]
    return resolved_reference(schema, branches[0]) if len(branches) == 1 else part


def allowed(schema, part, data, at=""):
    """Yield the keys of data that a JSON Schema does not know, and those missing."""
    part = resolved_reference(schema, part)
    if isinstance(data, dict) and "properties" in part:
        assert part["additionalProperties"] is False, at
        yield from (f"{at}.{key}" for key in data if key not in part["properties"])
        yield from (f"{at}.{key} missing" for key in part.get("required", []) if key not in data)
        for key, value in data.items():
            if key in part["properties"]:
                yield from allowed(schema, part["properties"][key], value, f"{at}.{key}")
    elif isinstance(data, list) and "items" in part:
        assert part.get("type") == "array", at
        for i, value in enumerate(data):
            yield from allowed(schema, part["items"], value, f"{at}.{i}")


def test_the_json_schema_knows_every_key_of_the_shipped_scenarios():
    schema = json.loads(json.dumps(json_schema("scenario")))
    assert schema["type"] == "object"
    shipped = library.entries("scenarios")
    assert {"demo", "simple", "complex"} <= set(shipped)
    for path in shipped.values():
        data = read_document(path).data
        assert list(allowed(schema, schema, data)) == [], path
        assert isinstance(read_scenario(path)[0], Scenario)
    wrong = {"world": {"mapp": "x", "legs": [{"wait": 3}], "people": {}}, "sead": 1}
    assert sorted(allowed(schema, schema, wrong)) == [
        ".sead", ".world.legs.0.wait", ".world.mapp", ".world.people.count missing",
    ]  # fmt: skip


def test_the_json_schema_states_kinds_and_limits():
    schema = json_schema("scenario")
    world = schema["$defs"]["WorldSettings"]["properties"]
    assert set(world) == {
        "map", "building", "locations", "robot", "start", "explore", "waypoints", "goto", "repeat",
        "legs",
        "time_limit_s", "furniture", "people", "doors", "slip", "kidnaps",
    }  # fmt: skip
    assert schema["properties"]["runs"]["minimum"] == 1
    assert schema["$defs"]["PeopleSettings"]["required"] == ["count"]
    assert schema["$defs"]["PeopleSettings"]["properties"]["count"]["maximum"] == 200
    assert world["doors"]["items"] == {"$ref": "#/$defs/DoorSettings"}
    assert resolved_reference(schema, world["explore"])["const"] == "frontier"
    # Without a default a key may still be left out: only what has no meaning without it is needed.
    assert "required" not in schema
    robot = json_schema("robot")
    assert robot["$defs"]["LaserProfile"]["properties"]["dropout"]["maximum"] == 1.0


def test_every_shipped_scenario_is_good():
    for name, path in library.entries("scenarios").items():
        scenario, document = read_scenario(path)
        if scenario.factors or scenario.variants:
            assert resolve_variants(scenario, path.parent, where=document.where), name
        else:
            assert resolve(scenario, path.parent, where=document.where).source_name, name


def test_every_place_is_checked_from_python_too(maps):
    world = make_scenario(
        {"world": {"map": str(maps / "two.yaml"), "start": in_map(4.0, 0.5)}}
    ).world
    start = {"world.map": maps, "world.locations": maps}
    with pytest.raises(SettingsError, match=r"^world\.start: \[-2\.5, 5\]"):
        place_of(world, load_robot("pioneer-dx"), start, lambda _: "")
