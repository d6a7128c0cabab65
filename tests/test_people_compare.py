"""``ssrics compare DIR... PEOPLE.csv``: tables, files, pictures, the page, wrong input."""

import json
import math
import re
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from people_choices import at_doors, compared, rows, run, write_choices
from results_folders import Page, build, build_world, building

from ssrics_like.cli import main
from ssrics_like.comparison import write_scores
from ssrics_like.people.raters import kappas

FILES = [
    "agreement.csv", "comparison.html", "comparison.json", "figures", "locations.csv", "marks.csv",
    "models.csv", "pairs.csv", "people.csv",
]  # fmt: skip
PEOPLES = (
    "{text}: expected a folder of labels, a map's file ending in .yaml, or people's choices, a table "
    "that ends in .csv and is given last"
)
PICTURES = ["agreement", "ceiling", "locations", "map", "novelty"]


@pytest.fixture(scope="module")
def world(tmp_path_factory):
    folder = build_world(tmp_path_factory.mktemp("world") / "world", runs=3, poses=400)
    write_scores(folder)
    return folder


@pytest.fixture(scope="module")
def other(tmp_path_factory):
    return build_world(
        tmp_path_factory.mktemp("other") / "other", runs=2, poses=400, misses=0.8, seed=5
    )


@pytest.fixture(scope="module")
def choices(tmp_path_factory):
    return write_choices(tmp_path_factory.mktemp("choices") / "people.csv", at_doors())


@pytest.fixture(scope="module")
def out(world, other, choices, tmp_path_factory):
    folder = tmp_path_factory.mktemp("out") / "out"
    with pytest.raises(SystemExit) as stopped:
        main(["compare", str(world), str(other), str(choices), "-o", str(folder)])
    assert stopped.value.code == 0
    return folder


def test_all_files_are_written(out):
    assert sorted(path.name for path in out.iterdir()) == FILES
    assert sorted(path.name for path in (out / "figures").iterdir()) == [
        f"{name}.{kind}" for name in PICTURES for kind in ("pdf", "svg")
    ]


def test_table_1_counts_people_and_runs(out, world):
    table = rows(out / "locations.csv")
    assert [row["group"] for row in table[:3]] == ["people", "world", "other"]
    people = {row["location"]: row for row in table if row["group"] == "people"}
    assert [people[str(n)]["marked"] for n in range(1, 7)] == [*"555111"]
    assert [people[str(n)]["consensus"] for n in range(1, 7)] == [*"111000"]
    # Wilson (1927) for 5 of 5: z² / (n + z²) below, 1 above.
    z2 = 1.959964**2
    assert float(people["1"]["low"]) == pytest.approx(1 - z2 / (5 + z2), abs=1e-4)
    assert float(people["1"]["high"]) == pytest.approx(1.0)
    # Of the runs, as the results folder's own table has it.
    own = {row["location"]: row["found"] for row in rows(world / "locations.csv")}
    runs = {row["location"]: row["marked"] for row in table if row["group"] == "world"}
    assert [runs[str(n)] for n in range(1, 7)] == [own[str(n)] for n in range(1, 7)]


def test_figures_of_people_by_hand(out):
    figures = {row["figure"]: row for row in rows(out / "models.csv") if row["group"] == "people"}
    # Everybody has the three doors of the consensus; two nothing else, three one more each.
    assert float(figures["recall_others"]["value"]) == 1.0
    assert float(figures["precision_others"]["value"]) == pytest.approx((2 + 3 * 0.75) / 5)
    assert float(figures["f_others"]["value"]) == pytest.approx((2 + 3 * 6 / 7) / 5)
    assert (
        float(figures["f_others"]["low"]) < (2 + 3 * 6 / 7) / 5 < float(figures["f_others"]["high"])
    )


def test_agreement_holds_every_pair_of_markers(out):
    table = rows(out / "agreement.csv")
    assert len(table) == 10 * 9 // 2  # 5 people, 3 and 2 runs
    data = json.loads((out / "comparison.json").read_text())
    assert data["agreement"]["markers"][4:6] == ["people: p4", "world: run 0"]
    (pair,) = (
        r for r in table if (r["first"], r["second"], r["second_group"]) == ("p4", "run 0", "world")
    )
    assert float(pair["kappa"]) == pytest.approx(data["agreement"]["kappa"][4][5])


def test_each_mark_has_its_unit(out):
    marks = rows(out / "marks.csv")
    first = [row["unit"] for row in marks if row["marker"] == "p0"]
    assert first == ["1", "2", "3"]
    assert all(row["unit"] == row["location"] for row in marks if row["location"])
    assert {row["group"] for row in marks} == {"people", "world", "other"}


def test_people_and_models_are_held_against_the_same_others(out):
    table = rows(out / "people.csv")
    assert [row["measured"] for row in table[:3]] == ["people", "world", "other"]
    assert len(table) == 5 * 3
    data = json.loads((out / "comparison.json").read_text())
    for group, name in ((1, "world"), (2, "other")):
        figures = data["groups"][group]["figures"]
        mine = [float(row["f"]) for row in table if row["measured"] == name]
        theirs = [float(row["f"]) for row in table if row["measured"] == "people"]
        assert figures["f_others"]["value"] == pytest.approx(np.mean(mine), abs=1e-5)
        assert figures["f_ceiling"]["value"] == pytest.approx(
            np.mean(mine) - np.mean(theirs), abs=1e-5
        )
        above = np.mean([a > b for a, b in zip(mine, theirs, strict=True)])
        assert figures["f_exceeds"]["value"] == pytest.approx(above)


def test_every_figure_and_column_is_defined(out):
    data = json.loads((out / "comparison.json").read_text())
    assert (data["format"], data["version"]) == ("ssrics-people-comparison", 1)
    defined = set().union(*(key.split(", ") for key in data["definitions"]))
    for group in data["groups"]:
        assert set(group["figures"]) <= defined
    assert len(data["sources"]["choices"]["sha256"]) == 64


def test_equal_input_gives_equal_bytes(out, world, other, choices, tmp_path, capsys):
    status, *_ = run(capsys, world, other, choices, "-o", tmp_path / "again")
    assert status == 0
    for file in sorted(out.rglob("*.*")):
        assert (tmp_path / "again" / file.relative_to(out)).read_bytes() == file.read_bytes(), file


def test_another_seed_changes_intervals_and_not_the_figures(world, choices):
    one, two = (compared([world], choices, seed=seed).figures["world"] for seed in (1, 2))
    for name in set(one) - {"f_chance", "f_corrected"}:
        assert one[name].value == two[name].value or math.isnan(one[name].value)
    assert one["f_others"].interval != two["f_others"].interval


def test_the_pictures_show_what_they_should(out):
    svg = "{http://www.w3.org/2000/svg}"
    texts, tips = {}, {}
    for name in PICTURES:
        root = ET.fromstring((out / "figures" / f"{name}.svg").read_text())
        texts[name] = " ".join(e.text or "" for e in root.iter(f"{svg}text"))
        tips[name] = [e.text for e in root.iter(f"{svg}title")]
        assert (out / "figures" / f"{name}.pdf").read_bytes().startswith(b"%PDF")
    assert "people (5)" in texts["map"]
    assert "world (3 runs)" in texts["map"]
    # Nine locations on each of two panels.
    assert len(tips["map"]) == 18
    assert "1: people 5 of 5, world" in tips["map"][0]
    assert "5 of 5" in texts["locations"]
    assert "people" in texts["agreement"]
    assert "p0" in texts["agreement"]
    assert "novel ≥ .25" in texts["novelty"]
    assert "other, run 0" in texts["novelty"]


def test_the_page_stands_alone_and_can_be_read_aloud(out):
    page = Page(out / "comparison.html")
    assert "People and robots on Rooms round a block" in page.words
    levels = [tag for tag, _ in page.tags if re.fullmatch("h[1-6]", tag)]
    assert levels[0] == "h1"
    assert levels.count("h1") == 1
    pictures = [attributes for tag, attributes in page.tags if tag == "svg"]
    assert len(pictures) == len(PICTURES)
    assert all(a["role"] == "img" and len(a["aria-label"]) > 20 for a in pictures)
    for tag, attributes in page.tags:
        for name in ("src", "href"):
            link = attributes.get(name) or ""
            assert not link.startswith(("http", "//")), (tag, link)
    ids = [a["id"] for _, a in page.tags if "id" in a]
    assert len(ids) == len(set(ids))
    tables = [a["id"] for tag, a in page.tags if tag == "table"]
    assert tables == ["location-table", "figure-table", "pair-table", "people-table"]


def test_the_terminal_gets_three_tables_and_notes(capsys, world, other, tmp_path):
    marks = {**at_doors(4), "lost": [(100.0, 100.0)]}
    status, said, complained = run(
        capsys, world, other, write_choices(tmp_path / "c.csv", marks), "--radius", "1.5",
        "--bin", "2", "--seed", "3",
    )  # fmt: skip
    assert (status, complained) == (0, "")
    assert said.splitlines()[0].startswith("5 people; world: 3 runs; other: 2 runs; ")
    for title in ("Locations, within 1.5 m", "Agreement, with 95 % intervals", "Models compared"):
        assert title in said
    assert "note: 1 of 16 marks of people lie off the route" in said
    assert "note: lost of people marked nothing on the route" in said


def test_kappa_of_all_markers_is_of_the_units_marked(world, other, choices):
    made = compared([world, other], choices)
    np.testing.assert_array_equal(made.kappa, kappas(np.vstack(list(made.marked.values()))))
    assert len(made.markers) == len(made.kappa) == 10


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["{choices}"], "compare: name a results folder before {choices}"),
        (["{world}", "{tmp}/no.csv"], "{tmp}/no.csv: no such file"),
        (["{world}", "{wrong}"], "{wrong}:2: x_m: 'x' where a number was expected"),
        (["{tmp}/nowhere", "{choices}"], "{tmp}/nowhere: no such folder"),
        (["{log}", "{choices}"], "{log}/manifest.json: frame: 'odometry': expected positions on "),
        (["{world}", "{world}", "{choices}"], "{world}: is named twice; expected every folder once"),
        (["{world}", "{elsewhere}", "{choices}"], "{elsewhere}/map/map.yaml: is another map than"),
        (["{world}", "{off}"], "{off}: 2 of 2 marks lie outside the map 'Rooms round a block', exp"),
        (["{world}", "{choices}", "--locations", "clusters"], "--locations: no map 'clusters'"),
        (["{world}", "{choices}", "--locations", "{tmp}/m.yaml"], "--locations: {tmp}/m.yaml: no su"),
        (["{world}", "{choices}", "--locations", "{tmp}"], "--locations: {tmp}: expected a results "),
        (["{world}", "{choices}", "--radius", "1", "--radius", "2"], "--radius: given 2 times; exp"),
        (["{world}", "{choices}", "--radius", "0"], "--radius: '0': expected metres, more than 0"),
        (["{world}", "{choices}", "--bin", "wide"], "--bin: 'wide': expected metres, 0.1 or more"),
        (["{world}", "{choices}", "--seed", "-1"], "--seed: -1: expected 0 or more"),
        (["{world}", "--bin", "1"], "--bin: goes with people's choices only; expected a .csv file"),
        (["{world}", "{choices}", "-o", "{choices}"], "{choices}: is a file, expected a folder"),
        (["{world}", "{choices}", "-o", "{world}"], "{world}: holds results of runs, with tables"),
        (["{world}", "{text}"], PEOPLES),
        (["{choices}", "{world}"], "{choices}: people's choices are given last, after the folders"),
        (["{world}", "--participants", "none"], "--participants: goes with people's choices only"),
        (["{world}", "{choices}", "--participants", "{tmp}/no"], "{tmp}/no: no such file"),
    ],
)  # fmt: skip
def test_each_wrong_input_gets_one_line(capsys, world, choices, tmp_path, arguments, said):
    names = {"world": world, "choices": choices, "tmp": tmp_path}
    names["wrong"] = tmp_path / "wrong.csv"
    names["wrong"].write_text("participant,landmark,x_m,y_m\na,1,x,2\n")
    names["off"] = write_choices(tmp_path / "off.csv", {"a": [(500, 500)], "b": [(600, 500)]})
    names["text"] = tmp_path / "choices.txt"
    names["text"].write_text(choices.read_text())
    names["log"] = names["elsewhere"] = tmp_path / "log"
    if "{log}" in arguments:
        build(names["log"], poses=20)
    if "{elsewhere}" in arguments:
        plain = building()
        cells = plain.grid.cells.copy()
        cells[0, 0] = 0
        grid = type(plain.grid)(cells, plain.grid.cell_m, plain.grid.origin)
        places = type(plain)("elsewhere", grid, plain.locations)
        build_world(names["elsewhere"], runs=1, poses=20, places=places)
    status, _, complained = run(capsys, *(text.format(**names) for text in arguments))
    assert status == 1
    assert len(complained.splitlines()) == 1
    assert complained.startswith(f"ssrics: {said.format(**names)}")


@pytest.mark.parametrize("module", ["krippendorff", "statsmodels.stats.inter_rater"])
def test_a_package_that_is_missing_is_named(capsys, world, choices, monkeypatch, module):
    monkeypatch.setitem(__import__("sys").modules, module, None)
    status, _, complained = run(capsys, world, choices)
    assert status == 1
    assert complained == (
        f"ssrics: comparing people needs the package {module.split('.')[0]}; "
        "pip install 'ssrics-like[people]'\n"
    )
