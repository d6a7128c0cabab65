"""The page that compares variants of a scenario."""

import csv
import json
import math
import re
import shutil
import xml.etree.ElementTree as ET

import pytest
from results_folders import PUBLISHED, Page, build_variants, building

from ssrics_like.cli import main
from ssrics_like.errors import ResultsError
from ssrics_like.report import has_variants, write_report, write_variants_report
from ssrics_like.report.variants import Variant, read_variants
from ssrics_like.report.variants_layout import grouped, labels_of, places_of
from ssrics_like.world.building import Building

FACTORS = {"intervals": ("tumbling", "sliding"), "marked": ("every <novel>", "onset", "peak")}
COLUMNS = (  # the contract, literally
    "name,intervals,marked,runs,recall,low,high,chance,clock,corrected_recall,precision,"
    "marks_per_100_m,duplicates,consistency,f,distance_to_published"
)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    out = tmp_path_factory.mktemp("variants")
    return build_variants(out, FACTORS, runs=3, poses=30, published=PUBLISHED)


@pytest.fixture(scope="module")
def page(folder):
    write_report(folder / "v02")
    path = write_variants_report(folder)
    assert path == folder / "report.html"
    return Page(path)


def rows(folder):
    with (folder / "variants.csv").open(newline="") as file:
        return list(csv.DictReader(file))


def scores(folder, name):
    return json.loads((folder / name / "scores.json").read_text())


def test_the_table_has_the_columns_of_the_contract_and_the_figures_of_the_scores(page, folder):
    assert (folder / "variants.csv").read_text().splitlines()[0] == COLUMNS
    for row in rows(folder):
        pooled = scores(folder, row["name"])["pooled"]
        for column in COLUMNS.split(",")[3:-1]:
            value = pooled[column]
            assert row[column] == "" if value is None else float(row[column]) == value
    assert [row["marked"] for row in rows(folder)][:3] == list(FACTORS["marked"])


def test_the_distance_is_the_root_mean_square_over_locations(page, folder):
    distances = {}
    for row in rows(folder):
        places = scores(folder, row["name"])["locations"]
        shares = {place["location"]: place["share"] for place in places}
        squares = [(shares[key] - share) ** 2 for key, share in PUBLISHED.items()]
        distances[row["name"]] = math.sqrt(sum(squares) / 6)
        assert float(row["distance_to_published"]) == pytest.approx(
            distances[row["name"]], abs=1e-5
        )
    nearest = min(distances, key=distances.get)
    assert f"Nearest is {nearest}," in page.words
    # sqrt(mean of p (1 - p) / 3)
    expected = math.sqrt(sum(p * (1 - p) / 3 for p in PUBLISHED.values()) / 6)
    assert read_variants(folder).nearest.expected_distance == pytest.approx(expected)


def test_the_page_shows_every_variant_and_links_to_the_reports_that_are_there(page, folder):
    assert "Readings of the report" in page.words
    for name in ("v00", "v05", "every <novel>", "What each choice does", "published 65 %"):
        assert name in page.words
    links = [a["href"] for tag, a in page.tags if tag == "a" and not a["href"].startswith("#")]
    assert links == ["v02/report.html"]
    ET.fromstring((folder / "figures" / "variants.svg").read_text(encoding="utf-8"))
    assert sum(tag == "svg" for tag, _ in page.tags) == 1
    lit = [a for tag, a in page.tags if tag == "tr" and a.get("class") == "lit"]
    assert len(lit) == 1


def test_what_each_choice_does_is_a_mean_over_the_others(page, folder):
    tumbling = [float(r["recall"]) for r in rows(folder) if r["intervals"] == "tumbling"]
    assert f"intervals tumbling 3 {100 * sum(tumbling) / 3:.0f} %" in page.words


def test_equal_variants_give_equal_bytes(page, folder, tmp_path):
    shutil.copytree(folder, tmp_path / "twin")
    for name in ("report.html", "variants.csv", "figures/variants.svg"):
        (tmp_path / "twin" / name).unlink()
    write_variants_report(tmp_path / "twin")
    for name in ("report.html", "variants.csv", "figures/variants.svg"):
        assert (tmp_path / "twin" / name).read_bytes() == (folder / name).read_bytes()


def test_the_command_line_knows_such_a_folder(folder, tmp_path, capsys):
    twin = shutil.copytree(folder, tmp_path / "twin")
    for at, file in ((twin, "variants.csv"), (twin / "v00", "locations.csv")):
        (at / file).unlink(missing_ok=True)
        with pytest.raises(SystemExit) as stopped:
            main(["report", str(at)])
        assert stopped.value.code == 0
        assert f"report: {at / 'report.html'}" in capsys.readouterr().out
        assert (at / file).is_file()
    assert has_variants(twin)
    assert not has_variants(twin / "v00")


def test_no_tied_variant_is_named_as_the_only_best(folder, tmp_path):
    twin = shutil.copytree(folder, tmp_path / "twin")
    best = max((row for row in rows(folder)), key=lambda row: float(row["recall"]))["name"]
    for name in ("v00", "v01"):
        shutil.copy(twin / best / "scores.json", twin / name)
    words = Page(write_variants_report(twin)).words
    assert re.search(r"highest recall \d+ % v00 and [2-9] others", words)


def test_what_is_above_chance_has_one_meaning(page):
    assert "points above chance" in page.words
    assert page.words.count("above chance") == 3  # the card, and what corrected recall is
    assert "corrected recall" in page.words


def test_a_single_run_is_not_called_several(tmp_path):
    out = build_variants(tmp_path / "v", {"x": ("a", "b")}, runs=1, poses=20, published=PUBLISHED)
    assert "because there is only one; differences" in Page(write_variants_report(out)).words


def test_variants_that_have_not_run_are_named(folder, tmp_path):
    twin = shutil.copytree(folder, tmp_path / "twin")
    shutil.rmtree(twin / "v01")
    page = Page(write_variants_report(twin))
    assert "1 variant has no results yet: v01" in page.words
    assert [row["name"] for row in rows(twin)] == ["v00", "v02", "v03", "v04", "v05"]
    for name in ("v00", "v02", "v03", "v04", "v05"):
        shutil.rmtree(twin / name)
    with pytest.raises(ResultsError, match="no variant has results"):
        write_variants_report(twin)


def test_nothing_labelled_leaves_the_figures_empty(tmp_path):
    bare = Building("bare", building().grid)
    out = build_variants(tmp_path / "v", {"runs": ("a", "b")}, runs=2, poses=20, places=bare)
    page = Page(write_variants_report(out))
    assert "no variant could be scored" in page.words
    assert (out / "variants.csv").read_text().splitlines() == [
        COLUMNS.replace("intervals,marked", "factor_runs"),
        "v00,a,2" + "," * 12,
        "v01,b,2" + "," * 12,
    ]
    assert not (out / "figures" / "variants.svg").exists()


def test_without_factors_every_variant_is_called_by_its_title(tmp_path):
    out = build_variants(tmp_path / "v", {}, runs=2, poses=20)
    data = json.loads((out / "variants.json").read_text())
    data["variants"][0] |= {"title": "As it is", "factors": {}}
    (out / "variants.json").write_text(json.dumps(data))
    page = Page(write_variants_report(out))
    assert "As it is" in page.words
    assert "What each choice does" not in page.words


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("{]", r"variants\.json: is damaged"),
        ("[]", "expected a mapping"),
        ("{}", r"is damaged: KeyError\('format'\)"),
        ('{"format": "other", "version": 1}', "is no list of variants"),
        ('{"format": "ssrics-variants", "version": 9}', "variants of version 9"),
        (
            '{"format": "ssrics-variants", "version": 1, "title": "", "variants": [{"name": "../x"}]}',
            "'../x' cannot be the name",
        ),
    ],
)
def test_a_damaged_list_is_one_clear_line(text, message, tmp_path):
    (tmp_path / "variants.json").write_text(text)
    with pytest.raises(ResultsError, match=message) as caught:
        write_variants_report(tmp_path)
    assert "\n" not in str(caught.value)


def test_damaged_scores_are_named(folder, tmp_path):
    twin = shutil.copytree(folder, tmp_path / "twin")
    (twin / "v01" / "scores.json").write_text('{"locations": [{}]}')
    with pytest.raises(ResultsError, match=r"v01/scores\.json: is damaged: KeyError"):
        write_variants_report(twin)


def test_rows_are_grouped_by_their_factors_in_order_of_appearance():
    def variant(name, **factors):
        return Variant(name, "", factors, {}, 1, {}, {}, {})

    mixed = [variant("a", x="2", y="q"), variant("b", x="1", y="p"), variant("c", x="2", y="p"),
             variant("d", x="1", y="q"), variant("e", y="q")]  # fmt: skip
    assert [v.name for v in grouped(mixed, ("x", "y"))] == ["a", "c", "d", "b", "e"]


def test_a_level_is_written_once_and_groups_stand_apart():
    def variant(**factors):
        return Variant("n", "alone", factors, {}, 1, {}, {}, {})

    rows = [variant(x="1", y="p", z="u"), variant(x="1", y="p", z="v"),
            variant(x="1", y="q", z="u"), variant(x="2", y="q", z="u"), variant()]  # fmt: skip
    labels = labels_of(rows, ("x", "y", "z"))
    assert labels == [
        ("1", "p", "u"), ("", "", "v"), ("", "q", "u"), ("2", "q", "u"), ("alone", "", ""),
    ]  # fmt: skip
    places, lines = places_of(labels)
    assert places == [0.0, 1.0, 2.0, 3.5, 5.0]
    assert lines == [(1.5, 1), (2.75, 0), (4.25, 0)]
