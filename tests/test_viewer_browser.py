"""The page in a real browser: it opens offline, moves, and shows what the results hold."""

import os
from pathlib import Path

import pytest
from results_folders import build
from viewer_runs import page, results

from ssrics_like.results.reading import read_records
from ssrics_like.viewer import write_view

CHROMIUM = Path("/usr/bin/chromium")
FLAGS = (
    "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync",
)  # fmt: skip
NAMES = ("demo", "errand")


@pytest.fixture(scope="module")
def browser():
    if not CHROMIUM.exists():
        if os.environ.get("SSRICS_BROWSER") == "required":
            pytest.fail(f"{CHROMIUM} is not there, and SSRICS_BROWSER=required")
        pytest.skip(f"{CHROMIUM} is not there")
    sync_api = pytest.importorskip("playwright.sync_api")
    with sync_api.sync_playwright() as playwright:
        chromium = playwright.chromium.launch(executable_path=str(CHROMIUM), args=list(FLAGS))
        yield chromium
        chromium.close()


@pytest.fixture
def opened(browser):
    """Opens a page; at the end nothing must have gone wrong, and nothing have been asked for."""
    wrong, asked, contexts = [], [], []

    def opens(which, width=1440, height=900, at="", **options):
        context = browser.new_context(viewport={"width": width, "height": height}, **options)
        context.set_offline(True)
        contexts.append(context)
        tab = context.new_page()
        tab.on("console", lambda m: wrong.append(m.text) if m.type == "error" else None)
        tab.on("pageerror", lambda e: wrong.append(str(e)))
        tab.on("request", lambda r: asked.append(r.url))
        file = page(which) if isinstance(which, str) else which
        tab.goto(file.as_uri() + at)
        tab.wait_for_selector("html[data-ready]")
        return tab

    yield opens
    for context in contexts:
        context.close()
    assert wrong == []
    assert [url for url in asked if not url.startswith(("file:", "data:", "blob:"))] == []


def now(tab):
    return tab.evaluate("window.ssricsView.state.t")


def go(tab, t_s):
    tab.evaluate("t => window.ssricsView.seek(t)", t_s)
    settle(tab)


def until(tab, condition):
    """Wait for a condition; the page's own policy forbids the browser to poll it."""
    for _ in range(200):
        if tab.evaluate(condition):
            return
        tab.wait_for_timeout(25)
    pytest.fail(f"never came true: {condition}")


def settle(tab):
    tab.evaluate("() => new Promise(r => requestAnimationFrame(() => requestAnimationFrame(r)))")


def coloured(tab, canvas, variable, near=24):
    """Count the pixels of a layer that have about the page's colour of a name."""
    return tab.evaluate(
        """([id, name, near]) => {
          const canvas = document.getElementById(id);
          const hex = getComputedStyle(document.documentElement).getPropertyValue(name).trim();
          const want = [1, 3, 5].map(at => parseInt(hex.slice(at, at + 2), 16));
          const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
          let count = 0;
          for (let i = 0; i < data.length; i += 4)
            if (data[i + 3] > 200 && want.every((part, k) => Math.abs(data[i + k] - part) < near)) count++;
          return count;
        }""",
        [canvas, variable, near],
    )


def run_of(name):
    return read_records(results(name)).runs[0]


@pytest.mark.parametrize("name", NAMES)
def test_the_map_is_not_blank_and_the_path_grows(opened, name):
    tab = opened(name)
    assert coloured(tab, "map-past", "--past") == 0
    go(tab, run_of(name).duration_s / 3)
    some = coloured(tab, "map-past", "--past")
    go(tab, run_of(name).duration_s)
    all_of_it = coloured(tab, "map-past", "--past")
    assert 100 < some < all_of_it
    assert coloured(tab, "map-now", "--hit") > 50
    assert coloured(tab, "map-now", "--robot") > 20
    walls = "--wall" if name == "errand" else "--seen"
    assert coloured(tab, "map-ground", walls) > 500
    go(tab, 0.0)
    assert coloured(tab, "map-past", "--past") == 0


@pytest.mark.parametrize("name", NAMES)
def test_keys_move_time(opened, name):
    tab = opened(name)
    go(tab, 100.0)
    for key, t_s in [("ArrowRight", 101.0), ("Shift+ArrowRight", 111.0), ("ArrowLeft", 110.0)]:
        tab.keyboard.press(key)
        assert now(tab) == pytest.approx(t_s)
    tab.keyboard.press("End")
    end_s = tab.evaluate("window.ssricsView.data.end_s")
    assert now(tab) == end_s
    tab.keyboard.press("Home")
    assert now(tab) == 0.0


def test_the_space_bar_plays_and_pauses_even_on_the_play_button(opened):
    tab = opened("demo")
    for focus in ("body", "#play", "#time"):
        go(tab, 10.0)
        if focus != "body":
            tab.focus(focus)
        tab.keyboard.press("Space")
        until(tab, "window.ssricsView.state.t > 10.5")
        assert tab.get_attribute("#play", "aria-label") == "Pause"
        tab.keyboard.press("Space")
        assert tab.get_attribute("#play", "aria-label") == "Play"
        settle(tab)
        stopped = now(tab)
        tab.wait_for_timeout(80)
        assert now(tab) == stopped


def test_speed_is_seconds_of_the_run_a_second(opened):
    tab = opened("demo")
    tab.select_option("#speed", "100")
    tab.click("#play")
    until(tab, "window.ssricsView.state.t >= window.ssricsView.data.end_s")
    assert not tab.evaluate("window.ssricsView.state.isPlaying")


def test_the_slider_moves_time_and_the_clock(opened):
    tab = opened("demo")
    box = tab.locator("#time").bounding_box()
    tab.mouse.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    settle(tab)
    end_s = tab.evaluate("window.ssricsView.data.end_s")
    assert now(tab) == pytest.approx(end_s / 2, rel=0.02)
    minutes, seconds = divmod(round(now(tab), 1), 60)
    assert tab.inner_text("#clock") == f"{minutes:.0f}:{seconds:04.1f}"


def test_a_click_on_the_novelty_plot_moves_the_robot(opened):
    tab = opened("errand")
    box = tab.locator("#novelty").bounding_box()
    plot = tab.evaluate("(({ left, inner }) => ({ left, inner }))(window.ssricsView.plots[0][0])")
    share = 0.12
    before = tab.evaluate("document.getElementById('map-now').toDataURL()")
    tab.mouse.click(box["x"] + plot["left"] + share * plot["inner"], box["y"] + 40)
    settle(tab)
    end_s = tab.evaluate("window.ssricsView.data.end_s")
    assert now(tab) == pytest.approx(share * end_s, abs=end_s / plot["inner"])
    assert tab.evaluate("document.getElementById('map-now').toDataURL()") != before
    for which in (0, 1):  # the cursors of both plots stand at that moment
        x = tab.evaluate(
            "k => new DOMMatrix(document.querySelectorAll('.cursor')[k].style.transform).e", which
        )
        assert x == pytest.approx(plot["left"] + share * plot["inner"], abs=2.0)


def test_a_click_on_the_path_goes_to_that_moment(opened):
    tab = opened("errand")
    at = tab.evaluate(
        """() => {
          const { map, path } = window.ssricsView, i = 700;
          return { x: map.camera.px(path.x[i]), y: map.camera.py(path.y[i]), px: path.x[i], py: path.y[i] };
        }"""
    )
    box = tab.locator("#stage").bounding_box()
    tab.mouse.click(box["x"] + at["x"], box["y"] + at["y"])
    settle(tab)
    here = tab.evaluate(
        """() => {
          const { path, state, map } = window.ssricsView;
          let i = 0;
          while (i + 1 < path.t.length && path.t[i + 1] <= state.t + 5e-4) i++;
          return { x: map.camera.px(path.x[i]), y: map.camera.py(path.y[i]) };
        }"""
    )
    assert now(tab) > 0.0
    assert abs(here["x"] - at["x"]) + abs(here["y"] - at["y"]) < 4.0


def test_dragging_and_the_wheel_move_the_map_and_not_time(opened):
    tab = opened("errand")
    go(tab, 50.0)
    box = tab.locator("#stage").bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    camera = "(({ x, y, scale }) => ({ x, y, scale }))(window.ssricsView.map.camera)"
    before = tab.evaluate(camera)
    tab.mouse.move(x, y)
    tab.mouse.down()
    tab.mouse.move(x + 80, y + 30, steps=4)
    tab.mouse.up()
    after = tab.evaluate(camera)
    assert after["x"] == pytest.approx(before["x"] - 80 / before["scale"])
    assert after["y"] == pytest.approx(before["y"] + 30 / before["scale"])
    tab.mouse.wheel(0, -400)
    until(tab, f"window.ssricsView.map.camera.scale > {before['scale'] * 1.5}")
    assert now(tab) == 50.0
    tab.click("#whole")
    assert tab.evaluate(camera) == before


@pytest.mark.parametrize("name", NAMES)
def test_the_panel_names_the_production_of_the_trace(opened, name):
    tab = opened(name)
    data = tab.evaluate("window.ssricsView.data")
    firings = data["story"]["firings"]
    tab.click("#others summary")
    for t_s, rule, _ in firings[:: max(len(firings) // 12, 1)]:
        go(tab, t_s)
        title, why, _ = data["rules"][rule]
        assert tab.inner_text("#production b") == title
        assert tab.inner_text("#production span") == why
        assert tab.inner_text("#verdicts .fired b") == title
        assert "every condition holds" in tab.inner_text("#verdicts .fired span")
        assert tab.locator("#verdicts li").count() == len(data["rules"])
    go(tab, firings[0][0] / 2)
    assert tab.inner_text("#production") == "None has fired yet."


def test_keys_go_from_production_to_production(opened):
    tab = opened("demo")
    firings = [t_s for t_s, *_ in tab.evaluate("window.ssricsView.data.story.firings")]
    for t_s in firings[:5]:
        tab.keyboard.press(".")
        assert now(tab) == pytest.approx(t_s)
    settle(tab)
    for t_s in reversed(firings[:4]):
        tab.keyboard.press(",")
        assert now(tab) == pytest.approx(t_s)


@pytest.mark.parametrize("name", NAMES)
def test_buffers_hold_the_chunks_of_the_trace(opened, name):
    tab = opened(name)
    data = tab.evaluate("window.ssricsView.data")
    changes = [c for c in data["story"]["buffers"]["orienting"] if c[1] >= 0]
    for t_s, chunk, _ in changes[:5]:
        go(tab, t_s)
        text = " ".join(tab.inner_text("#buffers").split())
        _, slots = data["story"]["chunks"][chunk]
        assert f"structure {dict(slots)['structure']}" in text
        assert f"event {dict(slots)['event']}" in text


def test_a_decision_that_is_clicked_is_gone_to_and_lit(opened):
    tab = opened("errand")
    reflex = sorted(run_of("errand").reflexes, key=lambda r: r.decided_s)[7]
    tab.click("#decisions tbody tr:nth-child(8) button")
    settle(tab)
    assert now(tab) == pytest.approx(reflex.decided_s)
    assert tab.inner_text("#decisions tr.lit td:nth-child(2)") == reflex.decision
    assert tab.inner_text("#decided-count").startswith("8 of ")


def test_landmarks_and_arcs_appear_as_they_come(opened):
    tab = opened("errand")
    shown = []
    for t_s in (0.0, *(r.decided_s for r in run_of("errand").reflexes[-1:])):
        go(tab, t_s)
        shown.append(tab.evaluate("window.ssricsView.map.shown"))
    data = tab.evaluate("window.ssricsView.data")
    assert shown[0] == "0 0 true"
    assert shown[1] == f"{len(data['landmarks'])} {len(data['arcs'])} true"
    tab.uncheck("#show-graph")
    settle(tab)
    assert tab.evaluate("window.ssricsView.map.shown") == f"{len(data['landmarks'])} 0 false"


@pytest.mark.parametrize(
    ("width", "height", "options"),
    [(1440, 900, {}), (1100, 720, {"color_scheme": "dark"}), (390, 844, {"has_touch": True})],
)
def test_nothing_runs_over_the_side(opened, width, height, options):
    tab = opened("errand", width, height, **options)
    go(tab, 300.0)
    assert tab.evaluate("document.documentElement.scrollWidth") <= width
    boxes = [tab.locator(f".panel.{name}").bounding_box() for name in
             ("map", "novelty", "activation", "productions", "buffers", "decisions")]  # fmt: skip
    for i, one in enumerate(boxes):
        for other in boxes[i + 1 :]:
            assert (
                one["x"] + one["width"] <= other["x"] + 0.5
                or other["x"] + other["width"] <= one["x"] + 0.5
                or one["y"] + one["height"] <= other["y"] + 0.5
                or other["y"] + other["height"] <= one["y"] + 0.5
            )


def test_kept_layers_show_what_drawing_anew_shows(opened):
    tab = opened("demo")
    for t_s in range(0, 120, 8):
        go(tab, float(t_s))
    layers = "[...document.querySelectorAll('.stage canvas')].map(c => c.toDataURL())"
    kept = tab.evaluate(layers)
    tab.evaluate("() => { window.ssricsView.forget(); window.ssricsView.draw(); }")
    anew = tab.evaluate(layers)
    assert [a == b for a, b in zip(kept, anew, strict=True)] == [True, False, True, True] or (
        kept == anew  # the path alone may differ, where two strokes meet
    )
    go(tab, 40.0)
    back = tab.evaluate(layers)
    tab.evaluate("() => { window.ssricsView.forget(); window.ssricsView.draw(); }")
    assert tab.evaluate(layers) == back


def test_an_address_names_a_moment(opened):
    tab = opened("demo", at="#t=42.5&why")
    settle(tab)
    assert now(tab) == 42.5
    assert tab.inner_text("#clock") == "42.5 s"
    assert tab.locator("#verdicts li").first.is_visible()
    tab.evaluate("location.hash = '#t=1e9'")
    settle(tab)
    assert now(tab) == tab.evaluate("window.ssricsView.data.end_s")
    tab.evaluate("location.hash = '#t=soon'")
    settle(tab)
    assert now(tab) == tab.evaluate("window.ssricsView.data.end_s")


def test_a_run_without_landmarks_intervals_or_trace_still_opens(opened, tmp_path):
    folder = build(tmp_path / "r", laps=0.5, per_lap=0, intervals=False, walls=False, poses=2)
    tab = opened(write_view(folder))
    assert "The run ended before the first interval" in tab.inner_text("#novelty")
    assert "No landmark was declared" in tab.inner_text("#activation")
    assert "No reflex was decided" in tab.inner_text("#decisions")
    tab.keyboard.press("End")
    settle(tab)
    assert now(tab) == 30.0


def test_a_memoryless_run_says_that_it_has_no_activation(opened, tmp_path):
    tab = opened(write_view(build(tmp_path / "r", memory=False)))
    assert "keeps no landmark in declarative memory" in tab.inner_text("#activation")
