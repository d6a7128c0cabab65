"""Maps as ROS map_server has them: what pixels mean, where the grid lies, what is refused."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image

from ssrics_like.errors import MapError
from ssrics_like.maps import humans_file, is_plan, load_building
from ssrics_like.perception.observation import Pose
from ssrics_like.world.choices import Choice
from ssrics_like.world.grid import FREE, OCCUPIED, UNKNOWN
from ssrics_like.world.locations import Location

GREYS = np.array([[0, 100, 254], [205, 255, 89]], np.uint8)
LETTERS = {FREE: ".", OCCUPIED: "#", UNKNOWN: "?"}


def written(tmp_path, text="", picture=GREYS, resolution="resolution: 0.5\n"):
    """Write a map's two files and return the YAML file."""
    Image.fromarray(picture).save(tmp_path / "a.png")
    path = tmp_path / "a.yaml"
    path.write_text(f"image: a.png\n{resolution}{text}")
    return path


def drawn(building):
    """Return the cells as text, the highest row on top."""
    return ["".join(LETTERS[int(cell)] for cell in row) for row in building.grid.cells[::-1]]


def complaints(path):
    with pytest.raises(MapError) as caught:
        load_building(path)
    return [line.replace(f"{path.parent}/", "") for line in str(caught.value).splitlines()]


def test_row_0_of_the_grid_is_the_lowest_of_the_picture(tmp_path):
    building = load_building(written(tmp_path, "origin: [1, 2, 0]\n"))
    # (255 - 205) / 255 = .19608 is not below .196, (255 - 89) / 255 = .65098 is above .65.
    assert drawn(building) == ["#?.", "?.#"]
    assert building.grid.cells[0].tolist() == [UNKNOWN, FREE, OCCUPIED]
    assert building.grid.cell_m == 0.5
    assert building.grid.origin == Pose(1.0, 2.0, 0.0)
    assert building.grid.size_m == (1.5, 1.0)
    assert (building.title, building.locations) == ("a", ())


def test_the_grid_may_lie_turned(tmp_path):
    grid = load_building(written(tmp_path, f"origin: [10, 20, {math.pi / 2}]\n")).grid
    # A quarter turn to the left: along the columns is up in the map, along the rows is left.
    assert grid.points_in_map([[1.5, 0.0], [0.0, 1.0]]) == pytest.approx(
        np.array([[10, 21.5], [9, 20]])
    )


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", ["#?.", "?.#"]),
        ("negate: 1\n", [".?#", "##?"]),
        ("negate: true\n", [".?#", "##?"]),
        ("occupied_thresh: 0.6\nfree_thresh: 0.25\n", ["##.", "..#"]),
        ("occupied_thresh: 1\n", ["??.", "?.?"]),  # more than 1 is nothing
        ("free_thresh: 0.002\n", ["#??", "?.#"]),  # 254 is .0039
        ("mode: scale\n", ["#?.", "?.#"]),
        ("mode: Scale\n", ["#?.", "?.#"]),  # as ROS 2 takes it
        ("mode: raw\n", [".#?", "??#"]),  # 0 free, 100 occupied, 254 unknown, 89 / 100 > .65
        ("mode: raw\noccupied_thresh: 0.95\n", [".#?", "???"]),
        ("mode: raw\nnegate: 1\n", [".#?", "??#"]),  # raw is raw
    ],
)
def test_thresholds_mode_and_negate_mean_what_they_mean_in_ros(tmp_path, text, expected):
    assert drawn(load_building(written(tmp_path, text))) == expected


@pytest.mark.parametrize("mode", ["trinary", "scale"])
def test_what_is_transparent_is_unknown(tmp_path, mode):
    alpha = np.array([[255, 255, 0], [255, 255, 254]], np.uint8)
    path = written(tmp_path, f"mode: {mode}\n", np.dstack([GREYS, alpha]))
    assert drawn(load_building(path)) == ["#??", "?.?"]
    path = written(tmp_path, "mode: raw\n", np.dstack([GREYS, alpha]))
    assert drawn(load_building(path)) == [".#?", "??#"]


def test_colours_are_averaged_as_ros_does(tmp_path):
    # 254, 0 and 254 average to 169.3: .336, neither free nor occupied.
    path = written(tmp_path, picture=np.array([[[254, 0, 254], [255, 255, 250]]], np.uint8))
    assert drawn(load_building(path)) == ["?."]


def test_sixteen_bits_mean_the_same(tmp_path):
    path = written(tmp_path, picture=GREYS.astype(np.uint16) * 257)
    assert drawn(load_building(path)) == ["#?.", "?.#"]
    path = written(tmp_path, "mode: raw\n", picture=GREYS.astype(np.uint16) * 257)
    assert drawn(load_building(path)) == [".#?", "??#"]


def test_the_picture_may_stand_elsewhere(tmp_path):
    written(tmp_path)
    (tmp_path / "deep").mkdir()
    for name in ("../a.png", tmp_path / "a.png"):
        path = tmp_path / "deep" / "b.yaml"
        path.write_text(f"image: {name}\nresolution: 1\n")
        assert drawn(load_building(path)) == ["#?.", "?.#"]


def test_keys_of_other_programs_are_passed_over(tmp_path):
    text = "map_type: occupancy\nframe_id: map\nname: x\ncost_translation_table: [1]\n"
    assert load_building(written(tmp_path, text)).title == "a"


def test_title_and_places_are_read(tmp_path):
    path = written(
        tmp_path,
        "title: A flat\nlocations:\n- {id: 1, x_m: 0.5, y_m: 0.25, label: the door}\n"
        "- {id: J, x_m: 1, y_m: 0.75, kind: junction}\nhumans: h.csv\n",
    )
    (tmp_path / "h.csv").write_text("participant,landmark,x_m,y_m,label,t_s\np,1,0,0,,\n")
    building = load_building(path)
    assert building.title == "A flat"
    assert building.locations == (
        Location("1", 0.5, 0.25, "the door", "doorway"),
        Location("J", 1.0, 0.75, "", "junction"),
    )
    assert humans_file(path) == tmp_path / "h.csv"
    assert humans_file(written(tmp_path)) is None


def test_places_may_stand_in_a_table(tmp_path):
    path = written(tmp_path, "locations: doors.csv\n")
    (tmp_path / "doors.csv").write_text("id,x_m,y_m,kind\nD0,0.5,0.5,cut\n")
    assert load_building(path).locations == (Location("D0", 0.5, 0.5, "", "other"),)


def test_every_error_comes_at_once_with_its_line(tmp_path):
    path = written(
        tmp_path,
        "resolutoin: 3\norigin: [0, 0]\nfree_thresh: .7\nnegate: 3\nlocations:\n"
        "  - {id: 1, x_m: 1, y_m: .nan}\n  - {id: 1, x_m: 1, y_m: 2, kind: dorway}\n"
        "humans: nope.csv\nframe_id: map\nmode: tri\n",
        resolution="resolution: 0\n",
    )
    (tmp_path / "a.png").unlink()
    assert complaints(path) == [
        "a.yaml:1:1: image: a.png: no such file",
        "a.yaml:2:1: resolution: 0: expected greater than 0",
        "a.yaml:3:1: unknown key 'resolutoin'; did you mean 'resolution'?",
        "a.yaml:4:1: origin: [0, 0]: expected three numbers, [x, y, yaw]",
        "a.yaml:5:1: free_thresh: the free threshold 0.7 is above the occupied one, 0.65",
        "a.yaml:6:1: negate: 3 where true or false or 0 or 1 was expected",
        "a.yaml:8:21: locations.0.y_m: nan: expected a finite number",
        "a.yaml:9:6: locations.1.id: '1' stands twice (first in line 8)",
        "a.yaml:9:29: locations.1.kind: 'dorway' where 'doorway', 'opening', 'junction', 'corner' or 'other' was expected; did you mean 'doorway'?",
        "a.yaml:10:1: humans: nope.csv: no such file",
        "a.yaml:12:1: mode: 'tri' where 'trinary', 'scale' or 'raw' was expected; did you mean 'trinary'?",
    ]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("origin: [0, .inf, 0]\n", "a.yaml:3:13: origin.1: inf: expected a finite number"),
        (
            "occupied_thresh: 0.1\n",
            "a.yaml: the free threshold 0.196 is above the occupied one, 0.1",
        ),
        ("free_thresh: 2\n", "a.yaml:3:1: free_thresh: 2: expected less than or equal to 1"),
        ("title: [1]\n", "a.yaml:3:1: title: [1] where text was expected"),
        ("locations: 3\n", "a.yaml:3:1: locations: 3 where a list was expected"),
        ("locations: nope.csv\n", "a.yaml:3:1: locations: nope.csv: no such file"),
        (
            "locations: [{id: X, x_m: 1.6, y_m: 0}]\n",
            "a.yaml:3:14: location 'X' at (1.6, 0) lies off the map",
        ),
        ("image: a.png\n", "a.yaml:3:1: key 'image' stands twice (first in line 1)"),
        ("negate: maybe\n", "a.yaml:3:1: negate: 'maybe' where true or false or 0 or 1"),
    ],
)
def test_a_mistake_is_named_with_its_place(tmp_path, text, said):
    (line,) = complaints(written(tmp_path, text))
    assert line.startswith(said)


def test_places_of_a_table_that_lie_off_the_map_are_named_with_their_line(tmp_path):
    path = written(tmp_path, "locations: doors.csv\n")
    (tmp_path / "doors.csv").write_text("id,x_m,y_m\nD0,0.5,0.5\n\nD1,0.5,-1\n")
    assert complaints(path) == ["doors.csv:4: location 'D1' at (0.5, -1) lies off the map"]


def test_a_map_without_any_free_cell_is_refused(tmp_path):
    path = written(tmp_path, picture=np.zeros((3, 3), np.uint8))
    assert complaints(path) == ["a.yaml:1:1: image: no cell of the map is free"]


def test_what_is_no_map_is_one_clear_line(tmp_path):
    path = tmp_path / "a.yaml"
    assert complaints(path) == ["a.yaml: no such file"]
    path.write_text("")
    assert complaints(path) == ["a.yaml: the file is empty, expected YAML keys"]
    path.write_text("- 1\n")
    assert complaints(path) == ["a.yaml:1:1: expected keys and values at the top"]
    path.write_text("image: [\n")
    assert "not valid YAML" in complaints(path)[0]
    path.write_text("image: a.yaml\nresolution: 1\n")
    assert complaints(path) == [
        "a.yaml:1:1: image: a.yaml: is no picture in PNG, PGM, PPM or BMP format"
    ]
    path.write_text("size_m: [1, 1]\nspaces: []\n")
    assert complaints(path) == [
        "a.yaml: is a floor plan, expected a map (ssrics map draw makes one of it)"
    ]
    assert is_plan(path)
    with pytest.raises(MapError, match="is a folder"):
        load_building(tmp_path)


VALUES = st.recursive(
    st.none() | st.booleans() | st.integers(-3, 300) | st.floats() | st.text(max_size=4),
    lambda inner: st.lists(inner, max_size=3),
    max_leaves=4,
)
KEYS = [
    "image",
    "resolution",
    "origin",
    "mode",
    "negate",
    "free_thresh",
    "title",
    "locations",
    "humans",
    "x",
]


@given(st.dictionaries(st.sampled_from(KEYS), VALUES))
@settings(max_examples=100, deadline=None)
def test_any_values_give_a_building_or_a_map_error(tmp_path_factory, values):
    import yaml

    folder = tmp_path_factory.mktemp("any")
    Image.fromarray(GREYS).save(folder / "a.png")
    path = folder / "a.yaml"
    path.write_text(yaml.safe_dump({"image": "a.png", "resolution": 1.0, **values}))
    try:
        load_building(path)
    except MapError as error:
        assert str(error)  # noqa: PT017


@given(st.binary(max_size=100))
@settings(max_examples=100, deadline=None)
def test_any_bytes_give_a_map_error(tmp_path_factory, content):
    path = tmp_path_factory.mktemp("any") / "a.yaml"
    path.write_bytes(content)
    with pytest.raises(MapError):
        load_building(path)


def test_choices_are_values():
    assert Choice("p", "1", 0.0, 0.0) == Choice("p", "1", 0.0, 0.0, "", None)
