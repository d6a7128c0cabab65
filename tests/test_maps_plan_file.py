"""Floor plans as files: read, written, and every mistake with its place."""

from pathlib import Path
from textwrap import dedent

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ssrics_like.errors import MapError
from ssrics_like.maps import load_plan, save_plan
from ssrics_like.world.buildings.pieces import Piece
from ssrics_like.world.buildings.plan import Passage, Plan, Rectangle, Space
from ssrics_like.world.locations import Location

GOOD = """\
title: Flat
size_m: [5, 4]
spaces:
  - {id: hall, kind: hallway, x_m: [0.2, 2], y_m: [0.2, 3.8]}
  - {id: room, x_m: [2.2, 4.8], y_m: [0.2, 3.8]}
passages:
  - {id: D1, label: the door, x_m: 2.1, y_m: 2, axis: x, width_m: 0.9}
walls:
  - {x_m: [3, 3.1], y_m: [0.2, 1]}
furniture:
  - {kind: box, x_m: 4, y_m: 3.5, width_m: 1, turn_rad: 0.1}
locations:
  - {id: 2, x_m: 1, y_m: 1, kind: corner}
"""


@pytest.fixture
def file(tmp_path):
    return tmp_path / "flat.plan.yaml"


def complaints(file, text):
    file.write_text(text)
    with pytest.raises(MapError) as caught:
        load_plan(file)
    return [line.removeprefix(str(file)) for line in str(caught.value).splitlines()]


def test_a_plan_is_read(file):
    file.write_text(GOOD)
    assert load_plan(file) == Plan(
        "Flat", 5.0, 4.0,
        (
            Space(id="hall", kind="hallway", x_m=(0.2, 2.0), y_m=(0.2, 3.8)),
            Space(id="room", kind="room", x_m=(2.2, 4.8), y_m=(0.2, 3.8)),
        ),
        (Passage(id="D1", label="the door", x_m=2.1, y_m=2.0, axis="x", width_m=0.9),),
        (Rectangle(x_m=(3.0, 3.1), y_m=(0.2, 1.0)),),
        (Piece(kind="box", x_m=4.0, y_m=3.5, width_m=1.0, turn_rad=0.1),),
        (Location("2", 1.0, 1.0, "", "corner"),),
    )  # fmt: skip
    file.write_text(GOOD.replace("title: Flat\n", ""))
    assert load_plan(file).title == "flat"


def test_the_plan_of_the_documentation_is_one(file):
    page = (Path(__file__).parents[1] / "docs" / "maps.md").read_text()
    block = page.partition("    title: Flat\n")[2].partition("\n\n")[0]
    file.write_text(dedent("    title: Flat\n" + block))
    plan = load_plan(file)
    assert (plan.title, len(plan.spaces), len(plan.furniture)) == ("Flat", 2, 1)


def test_a_plan_that_is_written_is_read_the_same(file):
    file.write_text(GOOD)
    plan = load_plan(file)
    again = file.with_name("again.yaml")
    save_plan(plan, again)
    assert load_plan(again) == plan
    assert "  - {id: hall, kind: hallway, x_m: [0.2, 2.0], y_m: [0.2, 3.8]}\n" in again.read_text()
    bare = Plan("x: y", 5.0, 4.0, plan.spaces)
    save_plan(bare, again)
    assert load_plan(again) == bare
    with pytest.raises(MapError, match="cannot be written"):
        save_plan(bare, again.parent / "no" / "folder.yaml")


def test_every_error_comes_at_once_with_its_line(file):
    found = complaints(
        file,
        "size_m: [5]\nspaces:\n"
        "- {id: a, x_m: [1, 2], y_m: [3, 2], kind: rom}\n- {id: '', x_m: [1, .inf], y_m: 3}\n"
        "passages:\n- {x_m: 1, y_m: 2, axis: z, width_m: 0, kind: dor}\n"
        "furniture:\n- {kind: chiar, x_m: 1, y_m: 1, widht_m: 2}\nwals: []\n",
    )
    assert found == [
        ":1:1: size_m: [5]: expected two numbers",
        ":3:24: spaces.0.y_m: [3.0, 2.0]: expected [from, to] with from less than to",
        ":3:37: spaces.0.kind: 'rom' where 'room' or 'hallway' was expected; did you mean 'room'?",
        ":4:4: spaces.1.id: '': expected String should have at least 1 character",
        ":4:21: spaces.1.x_m.1: inf: expected a finite number",
        ":4:28: spaces.1.y_m: 3 where a list was expected",
        ":6:20: passages.0.axis: 'z' where 'x' or 'y' was expected",
        ":6:29: passages.0.width_m: 0: expected greater than 0",
        ":6:41: passages.0.kind: 'dor' where 'doorway' or 'opening' was expected; did you mean 'doorway'?",
        ":8:3: key 'furniture.0.width_m' is missing",
        ":8:4: furniture.0.kind: 'chiar' where 'box', 'round', 'table', 'chair' or 'desk' was expected; did you mean 'chair'?",
        ":8:33: unknown key 'furniture.0.widht_m'; did you mean 'width_m'?",
        ":9:1: unknown key 'wals'; did you mean 'walls'?",
    ]


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("id: room", "id: hall", ":5:6: spaces.1.id: 'hall' stands twice"),
        ("id: 2", "id: D1", ":13:6: locations.0.id: 'D1' stands twice"),
        ("[2.2, 4.8]", "[2.2, 5.8]", ":5:16: spaces.1.x_m: [2.2, 5.8]: expected within 0 and 5"),
        ("y_m: 3.5", "y_m: -1", ":11:25: furniture.0.y_m: -1: expected within 0 and 4"),
        (
            "x_m: 2.1,",
            "x_m: 2.1, depth_m: 0.1,",
            ":7:5: passages.0: leads into solid wall at x = 2",
        ),
        ("axis: x", "axis: y", ":7:5: passages.0: leads into solid wall at y = "),
        ("[5, 4]", "[900, 800]", ":2:1: size_m: a plan of 900 x 800 m has 288000000 cells"),
    ],
)
def test_what_does_not_fit_together_is_named(file, old, new, said):
    lines = complaints(file, GOOD.replace(old, new, 1))
    assert lines[0].startswith(said), lines


def test_what_is_no_plan_is_one_clear_line(file):
    with pytest.raises(MapError, match="no such file"):
        load_plan(file)
    assert complaints(file, "") == [": the file is empty, expected YAML keys"]
    assert complaints(file, "image: a.png\nresolution: 1\n") == [
        ": is a map already drawn, expected a floor plan"
    ]
    assert complaints(file, "size_m: [1, 1]\nspaces: []\n") == [
        ":2:1: spaces: []: expected 1 or more"
    ]


@given(st.text(st.sampled_from("spaceidx_my: [1,2]{}-\n"), max_size=60))
@settings(max_examples=100, deadline=None)
def test_any_text_gives_a_map_error(tmp_path_factory, text):
    file = tmp_path_factory.mktemp("any") / "a.yaml"
    file.write_text("size_m: [4, 3]\n" + text)
    with pytest.raises(MapError):
        load_plan(file)
