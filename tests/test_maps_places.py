"""Tables of places: labelled locations and people's choices."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ssrics_like.errors import MapError
from ssrics_like.maps import load_choices, load_locations
from ssrics_like.world.choices import Choice
from ssrics_like.world.locations import Location


def complaints(load, path, text):
    path.write_bytes(text.encode() if isinstance(text, str) else text)
    with pytest.raises(MapError) as caught:
        load(path)
    return [line.replace(f"{path.parent}/", "") for line in str(caught.value).splitlines()]


@pytest.fixture
def table(tmp_path):
    return tmp_path / "t.csv"


def test_locations_need_an_id_and_a_place_only(table):
    table.write_text("id,x_m,y_m\nA,1,-2.5\n")
    assert load_locations(table) == (Location("A", 1.0, -2.5, "", "doorway"),)


def test_further_columns_are_passed_over_and_foreign_kinds_become_other(table):
    table.write_bytes(
        b'\xef\xbb\xbfwidth_m, y_m ,x_m,id,kind,label\r\n0.9,2,1,D00,cut,"left, at the lift"\r\n'
        b"\r\n,3,1e1,D01,junction,\r\n,3,4,D02,,x\r\n"
    )
    assert load_locations(table) == (
        Location("D00", 1.0, 2.0, "left, at the lift", "other"),
        Location("D01", 10.0, 3.0, "", "junction"),
        Location("D02", 4.0, 3.0, "x", "doorway"),
    )


def test_choices_may_leave_label_and_time_empty(table):
    table.write_text("participant,landmark,x_m,y_m,label,t_s\np1,a,1,2,the door,3.5\np1,b,1,2,,\n")
    assert load_choices(table) == (
        Choice("p1", "a", 1.0, 2.0, "the door", 3.5),
        Choice("p1", "b", 1.0, 2.0, "", None),
    )
    table.write_text("participant,landmark,x_m,y_m\np1,a,1,2\n")
    assert load_choices(table) == (Choice("p1", "a", 1.0, 2.0),)


def test_every_error_of_a_table_comes_at_once_with_its_line(table):
    found = complaints(
        load_locations,
        table,
        "id,x_m,y_m,kind\nA,1,2\n,1,x,doorway\nB,nan,inf,openin\n\nA,1,,\nA,1,2,\nB,1,2,3,4\n",
    )
    assert found == [
        "t.csv:2: has 3 cells, expected 4 as in line 1",
        "t.csv:3: id: is empty",
        "t.csv:3: y_m: 'x' where a number was expected",
        "t.csv:4: kind: unknown 'openin'; did you mean 'opening'?",
        "t.csv:4: x_m: 'nan' where a number was expected",
        "t.csv:4: y_m: 'inf' where a number was expected",
        "t.csv:6: y_m: nothing where a number was expected",
        "t.csv:7: id 'A' stands twice (first in line 6)",
        "t.csv:8: has 5 cells, expected 4 as in line 1",
    ]
    found = complaints(
        load_choices, table, "participant,landmark,x_m,y_m,t_s\n,a,1,2,\np,,1,2,soon\n"
    )
    assert found == [
        "t.csv:2: participant: is empty",
        "t.csv:3: landmark: is empty",
        "t.csv:3: t_s: 'soon' where a number was expected",
    ]


def test_a_row_that_spans_lines_is_named_by_its_first(table):
    found = complaints(load_locations, table, 'id,x_m,y_m,label\nA,1,2,"two\nlines"\nB,x,2,\n')
    assert found == ["t.csv:4: x_m: 'x' where a number was expected"]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", ["t.csv: the file is empty, expected columns id, x_m, y_m"]),
        ("\n\n", ["t.csv: the file is empty, expected columns id, x_m, y_m"]),
        ("id,x_m,y_m\n", ["t.csv: the table has a header but no rows"]),
        ("id;x_m;y_m\nA;1;2\n", ["t.csv:1: 'id;x_m;y_m': expected columns id, x_m, y_m, separated by commas"]),
        ("id,x,y_m\nA,1,2\n", ["t.csv:1: column 'x_m' is missing"]),
        (
            "id,x_mm,y_m,lable\nA,1,2,\n",
            [
                "t.csv:1: column 'x_m' is missing; did you mean 'x_mm'?",
                "t.csv:1: unknown column 'lable'; did you mean 'label'?",
            ],
        ),
        ("id,x_m,y_m,x_m\nA,1,2,1\n", ["t.csv:1: column 'x_m' stands twice"]),
        (b"\xff\xfe\x00", ["t.csv: cannot be read as text (it is not UTF-8)"]),
    ],
)  # fmt: skip
def test_a_table_without_a_usable_header_is_refused(table, text, expected):
    assert complaints(load_locations, table, text) == expected


def test_missing_files_and_folders_are_named(tmp_path):
    for load in (load_locations, load_choices):
        with pytest.raises(MapError, match=r"t\.csv: no such file"):
            load(tmp_path / "t.csv")
        with pytest.raises(MapError, match="is a folder, expected a CSV file"):
            load(tmp_path)


TEXTS = st.text("id,x_my\n\r\"';1.e-\0 é", max_size=60)


@given(
    st.sampled_from([b"", b"id,x_m,y_m\n", b"participant,landmark,x_m,y_m\n"]),
    TEXTS | st.binary(max_size=60),
)
@settings(max_examples=200, deadline=None)
def test_any_bytes_give_places_or_a_map_error(tmp_path_factory, header, rest):
    path = tmp_path_factory.mktemp("any") / "t.csv"
    path.write_bytes(header + (rest if isinstance(rest, bytes) else rest.encode()))
    for load in (load_locations, load_choices):
        try:
            assert load(path)
        except MapError as error:
            assert str(error)  # noqa: PT017
