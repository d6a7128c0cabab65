"""The page of a comparison: one word for one thing, long names, small windows, figures in print."""

import re
import xml.etree.ElementTree as ET

import pytest
from people_choices import at_doors, near, run, write_choices
from results_folders import build_world

from ssrics_like.people import Settings, compare_people, read_folders
from ssrics_like.people.definitions import FIGURES, TERMS, WORDS
from ssrics_like.people.names import in_a_row, short
from ssrics_like.report import style
from ssrics_like.report.people_agreement_figure import draw_people_agreement
from ssrics_like.report.people_page import page_and_figures
from ssrics_like.report.people_style import mark_look
from ssrics_like.report.people_tables import (
    figure_table,
    location_table,
    pair_table,
    people_table,
)

PLAIN = {"figure", "against", "participant", "first", "second"}
"""Headings that say what they are."""
LONG = "prolific-" + "7" * 200 + "-left"
SVG = "{http://www.w3.org/2000/svg}"


@pytest.fixture(scope="module")
def folders(tmp_path_factory):
    folder = tmp_path_factory.mktemp("worlds")
    return [
        build_world(folder / name, runs=2, poses=400, misses=misses)
        for name, misses in (("plain", 0.3), ("m" * 120, 0.8))
    ]


def made_of(folders, choices):
    settings = Settings(resamples=50)
    read = read_folders(folders, choices, None, settings.radius_m)
    return read, compare_people(read.people, read.models, read.locations, settings)


@pytest.fixture(scope="module")
def compared(folders, tmp_path_factory):
    marks = {**at_doors(5), LONG: [near(0)], LONG.replace("left", "right"): [near(1)]}
    return made_of(folders, write_choices(tmp_path_factory.mktemp("c") / "c.csv", marks))


@pytest.fixture(scope="module")
def page(compared):
    return page_and_figures(*compared)


def test_every_heading_is_defined_and_every_definition_is_a_heading(compared):
    _, made = compared
    tables = {
        table: table(made) for table in (location_table, figure_table, pair_table, people_table)
    }
    groups = {whole or name for name, whole in tables[figure_table].headings[2:]}
    assert groups == set(made.marked)
    used = {name for table in tables.values() for name, whole in table.headings if not whole}
    used -= PLAIN | groups
    # The rows of these two are figures, and against what they are.
    for table, columns in ((figure_table, (0, 1)), (pair_table, (2, 3))):
        used |= {row[column][0] for row in tables[table].rows for column in columns}
    assert used - set(TERMS) == set()
    assert set(TERMS) - set(WORDS) - used == set()
    assert set(WORDS) <= set(TERMS)


def test_words_that_are_no_headings_stand_elsewhere_on_the_page(page):
    html = page["comparison.html"]
    text = re.sub(r"<[^>]+>|<style>.*?</style>", " ", html.split('id="words"')[0], flags=re.DOTALL)
    for word in WORDS:
        assert re.search(rf"\b{word}s?\b", text), word
    for term in TERMS:
        assert html.count(f"<dt>{term.replace(chr(39), '&#39;')}</dt>") == 1, term


def test_each_figure_stands_in_the_table_once(compared):
    _, made = compared
    assert {name for figures in made.figures.values() for name in figures} == {
        row.key for row in FIGURES
    }
    assert len({(row.term, row.against) for row in FIGURES}) == len(FIGURES)


def test_long_names_are_shortened_and_told_in_full_on_pointing(page):
    html = page["comparison.html"]
    bare = re.sub(r'(title|data-key|aria-label)="[^"]*"|<title>.*?</title>', "", html)
    assert LONG not in bare
    assert "m" * 120 not in bare
    assert f'title="{LONG}"' in html
    for name in ("agreement", "ceiling", "map", "locations", "novelty"):
        svg = page[f"figures/{name}.svg"]
        root = ET.fromstring(svg)
        texts = [e.text or "" for e in root.iter(f"{SVG}text")]
        assert max(map(len, texts)) < 120, name
        if name == "agreement":
            tips = [e.text for e in root.iter(f"{SVG}title")]
            assert LONG in tips


def test_both_ends_of_a_long_name_are_kept():
    left, right = short(LONG), short(LONG.replace("left", "right"))
    assert left != right
    assert (len(left), left[:9], left[-5:]) == (30, "prolific-", "-left")
    assert short("P01") == "P01"
    assert in_a_row(["a", "b", "c"], "location") == "locations a, b and c"
    assert in_a_row([*"abcdefgh"]) == "a, b, c, d, e, f and 2 others"


def test_intervals_are_promised_only_where_there_are_some(folders, page, tmp_path):
    assert "small numbers are 95 % intervals" in page["comparison.html"]
    choices = write_choices(tmp_path / "c.csv", at_doors(2))
    few = page_and_figures(*made_of(folders, choices))["comparison.html"]
    assert "small numbers" not in few
    assert (
        "with so few people only shares, and κ against each other run, have 95 % intervals" in few
    )
    assert "[0–0 %]" not in few


def test_people_and_models_are_told_apart_without_colour(compared):
    _, made = compared
    looks = [mark_look(made, group) for group in made.marked]
    assert looks[0]["markerfacecolor"] != "white"
    assert looks[0]["markeredgecolor"] == "white"
    assert {look["markerfacecolor"] for look in looks[1:]} == {"white"}
    assert len({look["marker"] for look in looks}) == len(looks)


def test_marks_lie_over_the_lines_of_densities_and_none_hides_another(compared):
    from ssrics_like.report.people_map_figure import draw_people_map

    read, made = compared
    with style.context():
        axes = draw_people_map(read, made).figure.axes[0]
    marks = {line.get_marker(): line for line in axes.lines if line.get_marker() in "oD"}
    lines = max(collection.get_zorder() for collection in axes.collections)
    assert marks["D"].get_zorder() > marks["o"].get_zorder() > lines
    assert 2 * marks["D"].get_markersize() > marks["o"].get_markersize()  # it can be seen
    assert 1.5 * marks["D"].get_markersize() < marks["o"].get_markersize()  # and what is under it


@pytest.mark.parametrize("people", [2, 12, 50, 170])
def test_the_matrix_fills_the_page_and_no_more(folders, tmp_path, people):
    marks = {f"p{k:03}": [near(door) for door in (0, 1, 2 + k % 4)] for k in range(people)}
    _, made = made_of(folders[:1], write_choices(tmp_path / "c.csv", marks))
    with style.context():
        figure = draw_people_agreement(made).figure
        width_pt = figure.get_size_inches()[0] * style.POINTS
        matrix = figure.axes[0]
        side_pt = matrix.get_position().width * width_pt / (people + 2)
        sizes = [label.get_fontsize() for label in matrix.get_yticklabels()]
        written = [text for text in matrix.texts if re.fullmatch(r"−?(\.\d\d|1)", text.get_text())]
    assert width_pt <= style.WIDTH_IN * style.POINTS + 0.01
    assert side_pt == pytest.approx({2: 34, 12: 34, 50: 11, 170: 3.6}[people], rel=0.1)
    # Names may not be higher than their rows, nor too small to be read.
    assert all(5.5 <= size < side_pt for size in sizes)
    assert len(sizes) == (people + 2 if people < 170 else 0)
    assert bool(written) == (people <= 12)


def test_the_page_is_the_same_for_a_phone_and_its_definitions_are_stacked(page):
    html = page["comparison.html"]
    assert 'name="viewport"' in html
    narrow = html.split("@media (max-width: 700px) {")[1].split("</style>")[0]
    assert re.search(r"\.paired \{[^}]*grid-template-columns: 1fr", narrow)
    assert 'style="grid-template-columns' not in html
    assert html.count('class="swipe"') == 5


def test_a_table_of_choices_with_long_names_is_told_of_in_short_lines(folders, tmp_path, capsys):
    marks = {**at_doors(5), LONG: [(100.0, 100.0)]}
    status, said, _ = run(capsys, *folders, write_choices(tmp_path / "c.csv", marks))
    assert status == 0
    assert LONG not in said
    assert f"note: {short(LONG)} of people marked nothing on the route" in said
