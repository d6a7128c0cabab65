"""A study in a real browser: Debian's Chromium, without a window."""

import csv
import io
import zipfile

import httpx
import numpy as np
import pytest
from studies import TOKEN, Server, write_study
from visitors import HEIGHT_M, WIDTH_M, Visitor, launched

from ssrics_like.study import read_study


@pytest.fixture(scope="module")
def browser():
    with launched() as found:
        yield found


@pytest.fixture(scope="module")
def server(tmp_path_factory):
    folder = tmp_path_factory.mktemp("browser")
    made = Server(write_study(folder), folder / "answers.sqlite")
    made.study = read_study(folder / "small.yaml")
    yield made
    made.kill()


@pytest.fixture
def visit(browser, server):
    visitors = []

    def come(**device):
        visitors.append(Visitor(browser, server, **device))
        return visitors[-1]

    yield come
    for visitor in visitors:
        visitor.close()


def exported(server):
    answer = httpx.get(
        f"{server.address}/admin/export.zip", headers={"Authorization": f"Bearer {TOKEN}"}
    )
    archive = zipfile.ZipFile(io.BytesIO(answer.content))
    return {
        name: list(csv.DictReader(io.StringIO(archive.read(name).decode())))
        for name in archive.namelist()
    }


def check_export(server, targets):
    """Compare the tables with what `test_a_whole_study_of_two_people_at_the_same_time` did."""
    tables = exported(server)
    finished = [row["participant"] for row in tables["participants.csv"] if row["finished"]]
    assert len(finished) == 2
    assert {row["checks_passed"] for row in tables["participants.csv"] if row["finished"]} == {"1"}
    for name, mirrored, presses in zip(finished, (False, True), (3, 1), strict=True):
        mine = [row for row in tables["choices.csv"] if row["participant"] == name]
        plan = [row for row in mine if row["landmark"].startswith("plan-")]
        for row, (right_m, down_m) in zip(plan, targets, strict=True):
            x_m = WIDTH_M - right_m if mirrored else right_m
            assert float(row["x_m"]) == pytest.approx(x_m, abs=0.01)
            assert float(row["y_m"]) == pytest.approx(HEIGHT_M - down_m, abs=0.01)
        walk = [row for row in mine if row["landmark"].startswith("walk-")]
        assert len(walk) == presses
        times = np.array([float(row["t_s"]) for row in walk])
        assert (np.diff(times) > 0).all()
        there = server.study.by_id["walk"].replay.at(times)
        found = [[float(row["x_m"]), float(row["y_m"])] for row in walk]
        assert found == pytest.approx(there[:, :2], abs=1e-3)
    labels = [
        row["label"] for row in tables["choices-plan.csv"] if row["participant"] == finished[0]
    ]
    assert labels == ["", '<b>"door"</b>, left', ""]


def test_a_whole_study_of_two_people_at_the_same_time(visit, server):
    one, two = visit(), visit()
    targets = [(2.5, 3.0), (11.75, 6.4), (15.25, 8.125)]
    for person in (one, two):
        person.begin()
        person.ready()
        person.done()  # practice, without a mark
        person.ready()
    for right_m, down_m in targets:
        one.click(right_m, down_m)
        two.click(WIDTH_M - right_m, down_m)
    one.page.fill("#list li:nth-child(2) input", '<b>"door"</b>, left')
    one.page.keyboard.press("Enter")
    one.saved()
    one.page.reload()
    one.ready()
    assert one.page.locator("#list li").count() == 3
    assert one.page.locator("#list b").first.inner_text() == "1"
    assert one.page.input_value("#list li:nth-child(2) input") == '<b>"door"</b>, left'
    for person in (one, two):
        person.done()
        person.page.click("#start")
    pressed = []
    for person in (one, one, two):
        person.page.wait_for_timeout(600)
        person.page.keyboard.press(" ")
        pressed.append(person)
    one.page.reload()
    one.page.click("#start:has-text('Go on')")
    assert one.page.locator("#count").inner_text() == "2"
    one.page.wait_for_timeout(400)
    one.page.click("#mark")
    for person in (one, two):
        person.done()
        person.page.wait_for_selector("#keys button")
        person.page.keyboard.press("k")
        person.page.wait_for_selector("text=Thank you")

    check_export(server, targets)
    for person in (one, two):
        assert person.complaints == []
        assert [url for url in person.asked if not url.startswith(server.address)] == []


@pytest.mark.parametrize("scale", [1, 2, 2.625])
def test_clicks_land_within_a_centimetre_at_every_zoom(visit, scale):
    person = visit(device_scale_factor=scale).begin()
    person.ready()
    targets = []
    for zooms, right_m, down_m in (
        (0, 6.337, 4.123),
        (1, 8.0, 4.0),
        (2, 9.871, 5.432),
        (5, 9.013, 5.487),
    ):
        for _ in range(zooms):
            person.page.click("#in")
        person.click(right_m, down_m)
        targets.append((right_m, down_m))
    found = person.marks()
    assert found == [pytest.approx(target, abs=0.01) for target in targets]


def test_marks_are_dragged_moved_by_keys_and_deleted(visit):
    person = visit().begin()
    person.ready()
    person.click(4.0, 4.0)
    person.click(8.0, 4.0)
    # Grabbed beside its middle: it does not jump there.
    x, y = person.pixel(4.0, 4.0)
    person.page.mouse.move(x + 4, y + 3)
    person.page.mouse.down()
    to = person.pixel(5.0, 6.0)
    person.page.mouse.move(to[0] + 4, to[1] + 3, steps=5)
    person.page.mouse.up()
    assert person.marks()[0] == pytest.approx((5.0, 6.0), abs=0.01)
    person.page.keyboard.press("ArrowRight")
    person.page.keyboard.press("Shift+ArrowDown")
    person.page.wait_for_timeout(700)
    assert person.marks()[0] == pytest.approx((5.1, 7.0), abs=0.01)
    person.page.keyboard.press("Delete")
    assert person.marks() == [pytest.approx((8.0, 4.0), abs=0.01)]
    person.page.click("#list button")
    assert person.marks() == []
    assert person.page.locator("#none").is_visible()


def test_the_plan_is_shifted_and_zoomed_without_setting_marks(visit):
    person = visit().begin()
    person.ready()
    box = person.page.locator("#plan").bounding_box()
    middle = (box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    person.page.mouse.move(*middle)
    before = person.pixel(9.0, 5.5)
    person.page.mouse.wheel(0, -600)
    person.page.wait_for_timeout(100)
    assert person.pixel(9.0, 5.5) == pytest.approx(before, abs=2.0)  # stays below the pointer
    assert person.pixel(10.0, 5.5)[0] - person.pixel(9.0, 5.5)[0] > 80
    person.page.mouse.down()
    person.page.mouse.move(middle[0] + 50, middle[1] - 30, steps=4)
    person.page.mouse.up()
    assert person.pixel(9.0, 5.5) == pytest.approx((before[0] + 50, before[1] - 30), abs=2.5)
    assert person.marks() == []


def test_the_keyboard_alone_is_enough(visit):
    person = visit()
    page = person.page
    page.focus("#agree")
    page.keyboard.press(" ")
    page.keyboard.press("Enter")
    page.wait_for_selector("#done:enabled")
    page.focus("#done")
    page.keyboard.press("Enter")
    page.wait_for_selector("#plan")
    person.ready()
    page.focus("#plan")
    page.keyboard.press("Shift+ArrowLeft")
    page.keyboard.press("ArrowUp")
    page.keyboard.press("Enter")
    assert person.marks() == [pytest.approx((8.0, 5.4))]
    page.keyboard.press("Tab")
    assert page.evaluate("document.activeElement.getAttribute('aria-label')") == "Mark 1"
    page.keyboard.press("Enter")
    page.keyboard.type("hall")
    page.keyboard.press("Enter")
    page.wait_for_timeout(100)
    person.saved()
    assert [mark["label"] for mark in person.state()["marks"]] == ["hall"]


def test_a_phone_is_wide_enough_and_taps_mark(visit):
    person = visit(viewport={"width": 360, "height": 740}, has_touch=True, is_mobile=True,
                   device_scale_factor=3)  # fmt: skip
    page = person.page

    def fits():
        assert page.evaluate("document.documentElement.scrollWidth") <= 360

    fits()
    person.begin()
    person.ready()
    fits()
    page.touchscreen.tap(*person.pixel(6.0, 4.0))
    assert person.marks() == [pytest.approx((6.0, 4.0), abs=0.03)]  # a finger's pixel is 5 cm
    person.done()
    person.ready()
    person.done()
    page.wait_for_selector("#start:visible")
    fits()
    page.tap("#start")
    page.wait_for_timeout(300)
    page.tap("#mark")
    page.tap("#view")
    assert page.locator("#count").inner_text() == "2"
    person.done()
    page.wait_for_selector("#keys button")
    fits()
    page.tap("#keys button:has-text('k')")
    page.wait_for_selector("text=Thank you")
    fits()
    assert person.complaints == []


def test_the_walk_shows_walls_and_no_plan(visit, server):
    person = visit().begin()
    for _ in range(2):
        person.ready()
        person.done()
    person.page.wait_for_selector("#start:visible")
    assert not {"width_m", "height_m", "marks", "x_m", "y_m", "map"} & set(person.state())
    assert not any("/api/plan/3" in url for url in person.asked)
    colours = person.page.evaluate(
        "(() => { const c = document.getElementById('view');"
        " const d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;"
        " const seen = new Set(); for (let i = 0; i < d.length; i += 404) seen.add(d[i] << 8 | d[i + 1]);"
        " return seen.size; })()"
    )
    assert colours > 20
    # A page that is hidden stops; nothing passes unseen.
    person.page.click("#start")
    person.page.wait_for_timeout(300)
    person.page.evaluate(
        "Object.defineProperty(document, 'hidden', {get: () => true, configurable: true});"
        "document.dispatchEvent(new Event('visibilitychange'))"
    )
    person.page.wait_for_selector("text=The walk was interrupted")
    person.saved()
    shown = person.page.locator("#time").evaluate("bar => bar.value")
    person.page.wait_for_timeout(400)
    person.page.keyboard.press(" ")  # goes on, which is no press at a landmark
    assert person.page.locator("#time").evaluate("bar => bar.value") == pytest.approx(
        shown, abs=0.1
    )
    assert person.state()["presses"] == 0


def test_answers_wait_in_the_browser_while_the_server_is_down(visit, server):
    person = visit().begin()
    person.ready()
    person.click(4.0, 4.0)
    person.saved()
    server.kill()
    person.click(8.0, 4.0)
    person.click(12.0, 4.0)
    person.page.wait_for_selector("#saved[data-state=waiting]")
    server.restart()
    person.page.wait_for_selector("#saved[data-state=saved]")
    assert len(person.marks()) == 3
    person.page.reload()
    person.ready()
    assert person.page.locator("#list li").count() == 3


def test_the_experimenter_sees_who_is_where(visit, server):
    person = visit().begin()
    person.ready()
    admin = visit()
    admin.page.goto(f"{server.address}/admin#token={TOKEN}")
    admin.page.wait_for_selector("table")
    name = person.state()["participant"]
    row = admin.page.locator("tr", has_text=name).inner_text()
    assert "try" in row
    assert "0 of 4" in row
    assert TOKEN not in admin.page.url
    with admin.page.expect_download() as download:
        admin.page.click("text=Download the tables")
    assert download.value.suggested_filename == "study-export.zip"
    admin.page.click("#logout")
    admin.page.wait_for_selector("#login")
