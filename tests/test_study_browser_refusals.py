"""What a study's pages say and do where not all goes well, in a real browser."""

import itertools
import json

import pytest
from studies import STUDY, TOKEN, Server, write_study
from visitors import Visitor, launched

MOST = 13
PHONE = {"viewport": {"width": 390, "height": 844}, "has_touch": True, "is_mobile": True}


@pytest.fixture(scope="module")
def browser():
    with launched() as found:
        yield found


@pytest.fixture(scope="module")
def server(tmp_path_factory):
    folder = tmp_path_factory.mktemp("refusals")
    text = STUDY.replace("seed: 7", f"seed: 7\nresponses_max: {MOST}\nparticipant: typed")
    made = Server(write_study(folder, text), folder / "answers.sqlite")
    made.folder = folder
    yield made
    made.kill()


@pytest.fixture
def come(browser, server):
    visitors = []

    def begin(name, **device):
        visitors.append(Visitor(browser, server, **device))
        visitors[-1].page.fill("#participant", name)
        return visitors[-1].begin()

    yield begin
    for visitor in visitors:
        visitor.close()


def says(person, state, text):
    person.page.wait_for_selector(f"#saved[data-state={state}]")
    assert text in person.page.locator("#saved").inner_text()


def test_an_answer_above_the_limit_is_not_called_saved_and_the_step_can_be_ended(come):
    person = come("limit")
    person.ready()
    kept = MOST - 3  # after begin and end of the instructions, and the begin of this step
    for i in range(kept):
        person.click(3.0 + i, 4.0)
    person.saved()
    person.click(16.0, 4.0)
    says(person, "refused", "An answer could not be saved. Load the page again to see what is.")
    person.page.reload()
    person.ready()
    assert person.page.locator("#list li").count() == len(person.state()["marks"]) == kept
    assert person.page.locator("#saved").inner_text() == ""
    person.done()
    assert person.state()["step"] == 2


def test_a_step_that_another_tab_has_ended_is_over(come):
    person = come("tabs")
    person.ready()
    other = person.context.new_page()
    other.goto(person.server.address)
    other.click("#done:enabled")
    other.click("#on")
    other.wait_for_selector("text=Step 3 of 5")
    person.click(4.0, 4.0)
    says(person, "over", "This step is over. Load the page again.")
    person.page.reload()
    person.ready()
    assert person.page.locator(".where").inner_text() == "Step 3 of 5"
    assert person.state()["marks"] == []
    person.click(6.0, 4.0)
    person.saved()


def test_an_answer_that_waited_and_is_refused_is_told_after_the_reload(come):
    person = come("waited")
    person.ready()
    waiting = {"key": "r-waiting", "step": 1, "event": "add", "t_ms": 0, "client_ms": 0,
               "right_m": 99.0, "down_m": 1.0}  # fmt: skip
    person.page.evaluate(
        "text => localStorage.setItem('ssrics:waited', text)", json.dumps([waiting])
    )
    person.page.reload()
    person.ready()
    says(person, "lost", "An answer could not be saved. This page shows those that are.")
    person.click(4.0, 4.0)
    person.saved()
    assert len(person.state()["marks"]) == 1


def test_a_press_just_after_the_walk_does_not_leave_it(come):
    person = come("walk")
    for _ in range(2):
        person.ready()
        person.done()
    person.page.click("#start")
    person.page.wait_for_selector("text=That was the walk.")
    for key in (" ", "Enter"):
        person.page.keyboard.press(key)
    person.page.wait_for_timeout(300)
    assert person.page.locator(".where").inner_text() == "Step 4 of 5"
    person.page.wait_for_function("() => document.activeElement.id === 'done'")
    person.page.keyboard.press(" ")
    person.page.wait_for_selector("text=Step 5 of 5")


def test_without_the_database_answers_wait_and_are_saved_when_it_is_back(come, server):
    person = come("database")
    person.ready()
    database, aside = server.folder / "answers.sqlite", server.folder / "aside.sqlite"
    database.rename(aside)
    try:
        person.click(4.0, 4.0)
        says(person, "waiting", "Your answers are kept here and sent later.")
        other = person.context.new_page()
        other.goto(server.address)
        assert "The study cannot be reached at the moment." in other.inner_text("main")
    finally:
        aside.rename(database)
    person.saved()
    assert len(person.state()["marks"]) == 1


def test_no_name_begins_as_a_formula_and_the_page_shows_so(come):
    person = come("formula")
    person.ready()
    person.click(4.0, 4.0)
    person.page.fill("#list input", "=1+1")
    person.page.keyboard.press("Enter")
    person.saved()
    assert person.page.input_value("#list input") == "1+1"
    assert person.state()["marks"][0]["label"] == "1+1"


def boxes(page, selector):
    found = page.locator(selector).evaluate_all(
        "all => all.map(e => e.getBoundingClientRect()).map(b => [b.left, b.top, b.right, b.bottom])"
    )
    assert found
    return found


def test_long_names_are_cut_on_a_phone_and_none_lies_over_another(come):
    person = come("names", **PHONE)
    person.ready()
    for i, (right_m, down_m) in enumerate([(4.0, 4.0), (6.0, 4.4), (8.2, 3.9), (17.0, 4.0)], 1):
        person.click(right_m, down_m)
        person.page.fill(f"#list li:nth-child({i}) input", f"the {i}th fire extinguisher")
        person.page.keyboard.press("Enter")
        person.page.evaluate("scrollTo(0, 0)")
    names = person.page.locator(".mark .name").all_text_contents()
    assert names[3] == "the 4th fire…"
    shown = boxes(person.page, ".mark .name:not(.covered)")
    plan = person.page.locator("#plan").bounding_box()
    assert len(shown) >= 2
    for left, _, right, _ in shown:
        assert left >= plan["x"] - 2
        assert right <= plan["x"] + plan["width"] + 2
    for a, b in itertools.combinations([*shown, *boxes(person.page, ".mark .ring")], 2):
        apart = a[2] <= b[0] + 2 or b[2] <= a[0] + 2 or a[3] <= b[1] + 2 or b[3] <= a[1] + 2
        assert apart or a == b


def test_the_experimenters_table_fits_a_phone_whatever_the_ids(come, server):
    come("x" * 64)
    admin = come("admin", **PHONE)
    admin.page.goto(f"{server.address}/admin#token={TOKEN}")
    admin.page.wait_for_selector("table")
    sizes = admin.page.evaluate(
        "[document.documentElement, document.querySelector('.people')].map(e => "
        "e.scrollWidth - e.clientWidth)"
    )
    assert sizes == [0, 0]
    assert "began (UTC)" in admin.page.locator("td").first.evaluate(
        "cell => getComputedStyle(cell, '::before').content"
    )


def test_two_fingers_zoom_the_plan_and_set_no_mark(come):
    person = come("pinch", **PHONE)
    person.ready()
    middle_x, middle_y = person.pixel(9.0, 5.5)
    cdp = person.context.new_cdp_session(person.page)

    def touch(kind, apart=None):
        points = [] if apart is None else [
            {"x": middle_x - apart, "y": middle_y, "id": 0},
            {"x": middle_x + apart, "y": middle_y, "id": 1},
        ]  # fmt: skip
        cdp.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

    def metre():
        return person.pixel(10.0, 5.5)[0] - person.pixel(9.0, 5.5)[0]

    before = metre()
    touch("touchStart", 30)
    for apart in range(35, 95, 5):
        touch("touchMove", apart)
    touch("touchEnd")
    person.page.wait_for_timeout(100)
    assert metre() == pytest.approx(3 * before, rel=0.05)
    assert person.pixel(9.0, 5.5) == pytest.approx((middle_x, middle_y), abs=3.0)
    assert person.state()["marks"] == []
