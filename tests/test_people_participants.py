"""Who took part: people who marked nothing are counted where a list tells of them."""

import contextlib
import json

import pytest
from hypothesis import given
from hypothesis import strategies as st
from people_choices import at_doors, compared, rows, run, write_choices
from results_folders import Page, build_world

from ssrics_like.errors import MapError
from ssrics_like.people import read_folders
from ssrics_like.people.names import short
from ssrics_like.people.participants import list_beside, notes_on, read_participants
from ssrics_like.results.files import csv_text
from ssrics_like.study.export import PARTICIPANTS


@pytest.fixture(scope="module")
def world(tmp_path_factory):
    return build_world(tmp_path_factory.mktemp("world") / "world", runs=2, poses=200)


@pytest.fixture
def choices(tmp_path):
    return write_choices(tmp_path / "choices.csv", at_doors())


def write_list(folder, finished, name="participants.csv"):
    """Write a list as a study's export does: participant -> whether they finished."""
    table = [
        [who, "2026-05-04T09:00:00", "2026-05-04T09:20:00" if done else "", 5, "plan walk", 0, 0]
        for who, done in finished.items()
    ]
    file = folder / name
    file.write_text(csv_text(PARTICIPANTS, table))
    return file


def everybody(**more):
    return {**dict.fromkeys(at_doors(), True), **more}


def test_whoever_finished_and_marked_nothing_is_counted(world, choices, tmp_path, capsys):
    write_list(tmp_path, everybody(silent=True, gone=False))
    out = tmp_path / "out"
    status, said, _ = run(capsys, world, choices, "-o", out)
    assert status == 0
    assert said.splitlines()[0].startswith("6 people, 1 of whom marked nothing; world: 2 runs; ")
    assert "note: silent finished the study and marked nothing (participants.csv); they are" in said
    assert "note: Not counted: 1 who marked nothing and did not finish the study" in said
    table = [row for row in rows(out / "locations.csv") if row["group"] == "people"]
    # Five of six marked the first three doors.
    assert [(row["markers"], row["marked"]) for row in table[:3]] == [("6", "5")] * 3
    sources = json.loads((out / "comparison.json").read_text())["sources"]
    assert sources["participants"]["marked_nothing"] == ["silent"]
    assert sources["participants"]["unfinished"] == 1
    page = Page(out / "comparison.html").words
    assert "6 people, 1 of whom marked nothing, beside" in page
    assert "1 finished and marked nothing, 1 neither finished nor marked anything" in page


def test_without_a_list_it_is_said_that_shares_may_be_too_large(world, choices, tmp_path, capsys):
    _, said, _ = run(capsys, world, choices)
    assert "note: No list of participants was read: whoever marked nothing is not counted" in said
    write_list(tmp_path, everybody(silent=True))
    status, said, _ = run(capsys, world, choices, "--participants", "none")
    assert status == 0
    assert "No list of participants" in said
    assert said.startswith("5 people; ")


def test_another_list_can_be_named(world, choices, tmp_path):
    other = write_list(tmp_path, everybody(silent=True, quiet=True), "who.csv")
    read = read_folders([world], choices, None, 1.0, other)
    assert read.listed.silent == ("silent", "quiet")
    assert [len(person) for person in read.people[-2:]] == [0, 0]


def test_a_list_of_which_everybody_marked_something_changes_nothing(world, choices, tmp_path):
    before = compared([world], choices).figures
    write_list(tmp_path, everybody(gone=False))
    assert str(compared([world], choices).figures) == str(before)


def test_a_table_of_that_name_that_is_no_list_is_passed_over(world, choices, tmp_path):
    (tmp_path / "participants.csv").write_text("participant_id,age\nsub-01,31\n")
    assert read_folders([world], choices, None, 1.0).listed is None


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("participant,finished\np0,x\np1,x\np2,x\np3,x\n", "{file}: does not list p4 of {choices}, e"),
        ("participant,finished\np0,x\np0,x\n", "{file}:3: participant 'p0' stands twice"),
        ("participant,finished\n,x\n", "{file}:2: participant: is empty"),
        ("participant,finished\np0\n", "{file}:2: has 1 cells, expected 2 as in line 1"),
        ("participant,finished\n", "{file}: the table has a header but no rows"),
    ],
)  # fmt: skip
def test_a_wrong_list_gets_one_line(world, choices, tmp_path, capsys, text, said):
    file = tmp_path / "participants.csv"
    file.write_text(text)
    status, _, complained = run(capsys, world, choices)
    assert (status, len(complained.splitlines())) == (1, 1)
    assert complained.startswith(f"ssrics: {said.format(file=file, choices=choices)}")


def test_locations_are_named_as_maps_are_everywhere(world, choices, tmp_path, capsys):
    elsewhere = build_world(tmp_path / "elsewhere", runs=1, poses=20)
    for name in (elsewhere, f"{elsewhere}/", elsewhere / "map" / "map.yaml"):
        status, said, _ = run(capsys, world, choices, "--locations", name)
        assert status == 0
        assert "7 locations" in said.splitlines()[0]
    status, said, _ = run(capsys, world, choices, "--locations", "complex")
    assert status == 0
    assert "Location 6" in said


NAMES = st.text(st.characters(codec="utf-8", exclude_categories=["C", "Z"]), min_size=1, max_size=9)


@given(st.dictionaries(NAMES, st.tuples(st.booleans(), st.booleans()), min_size=1))
def test_everybody_of_a_list_is_counted_once_or_left_out(tmp_path_factory, people):
    folder = tmp_path_factory.mktemp("list")
    file = write_list(folder, {name: done for name, (done, _) in people.items()})
    choosing = {name for name, (_, chose) in people.items() if chose}
    listed = read_participants(file, folder / "choices.csv", choosing)
    assert listed.silent == tuple(n for n, (done, chose) in people.items() if done and not chose)
    assert len(choosing) + len(listed.silent) + listed.unfinished == len(people)
    assert len(notes_on(listed)) == bool(listed.silent) + bool(listed.unfinished)
    assert list_beside(folder / "choices.csv") == file


@given(st.binary(max_size=200))
def test_whatever_a_list_holds_it_is_read_or_refused(tmp_path_factory, content):
    file = tmp_path_factory.mktemp("list") / "participants.csv"
    file.write_bytes(content)
    assert list_beside(file.parent / "choices.csv") in (None, file)
    with contextlib.suppress(MapError):
        listed = read_participants(file, file.parent / "choices.csv", ())
        assert len(listed.silent) + listed.unfinished >= 1


@given(st.text(st.characters(exclude_characters="…"), max_size=60), st.integers(2, 40))
def test_a_shortened_name_has_room_and_keeps_its_ends(name, most):
    shown = short(name, most)
    assert len(shown) <= most
    if len(name) <= most:
        assert shown == name
    else:
        head, tail = shown.split("…")
        assert name.startswith(head)
        assert name.endswith(tail)
