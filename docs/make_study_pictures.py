"""The pictures of docs/study.md, taken in a browser from the shipped study.

    python docs/make_study_pictures.py [--all FOLDER]

Needs Chromium at /usr/bin/chromium and the extra `test`. With --all, every page of the study is
taken at the size of a desktop and of a phone, to be looked at.
"""

from __future__ import annotations

import argparse
import re
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from playwright.sync_api import Page, sync_playwright

IMAGES = Path(__file__).parent / "images"
TOKEN = "only-for-the-pictures"
FLAGS = [
    "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync",
]  # fmt: skip
MARKS = (
    (3.1, 10.3, "lobby side door"), (6.4, 6.9, "big meeting room"), (13.7, 8.0, "hallway crossing"),
    (10.1, 9.1, ""), (21.9, 12.4, "seminar room"),
)  # fmt: skip
"""Metres right of and below the top left corner of the plan of `complex`, and a name."""
MOMENT_MS = 31_000.0
"""Of the walk: a hallway, with a doorway on either side."""
DESKTOP: dict[str, Any] = {"viewport": {"width": 1280, "height": 800}}
PHONE: dict[str, Any] = {
    "viewport": {"width": 390, "height": 844}, "device_scale_factor": 2, "is_mobile": True,
    "has_touch": True,
}  # fmt: skip


def end(page: Page) -> None:
    """Go on to the next step by the interface, as after all of it was seen."""
    page.wait_for_selector("#saved[data-state=saved]")
    page.evaluate(
        "async () => { const state = await (await fetch('/api/state')).json();"
        " await fetch('/api/responses', {method: 'POST', headers: {'Content-Type':"
        " 'application/json'}, body: JSON.stringify({key: `picture-${state.step}`, step:"
        " state.step, event: 'end', replay_ms: state.length_ms, t_ms: 0, client_ms: 0})}); }"
    )
    page.reload()


def set_marks(page: Page) -> None:
    """Set the marks on the plan of `complex` and name them."""
    page.wait_for_selector("#done:enabled")
    for i, (right_m, down_m, name) in enumerate(MARKS, 1):
        box = page.evaluate(
            "(() => { const b = document.getElementById('picture').getBoundingClientRect();"
            " return [b.x, b.y, b.width, b.height]; })()"
        )
        page.mouse.click(box[0] + box[2] * right_m / 24, box[1] + box[3] * down_m / 16)
        if name:
            page.fill(f"#list li:nth-child({i}) input", name)
            page.keyboard.press("Enter")
    page.wait_for_selector("#saved[data-state=saved]")
    page.evaluate("window.scrollTo(0, 0)")


def walk_on(page: Page) -> None:
    """Show the walk at a moment, just after a landmark was marked."""
    page.wait_for_selector("#start:visible")
    page.evaluate(
        "async ms => { const state = await (await fetch('/api/state')).json();"
        " await fetch('/api/progress', {method: 'POST', headers: {'Content-Type':"
        " 'application/json'}, body: JSON.stringify({step: state.step, replay_ms: ms})}); }",
        MOMENT_MS,
    )
    page.reload()
    page.click("#start")
    page.wait_for_timeout(300)
    page.keyboard.press(" ")
    page.wait_for_timeout(60)


def take(page: Page, address: str, folder: Path, prefix: str, wanted: tuple[str, ...]) -> None:
    """Go through the study and take the pictures that are wanted; all if none is named."""

    def shot(name: str) -> None:
        if not wanted or name in wanted:
            page.screenshot(path=folder / f"{prefix}{name}.png")

    page.goto(address)
    shot("consent")
    page.check("#agree")
    page.click("text=Begin")
    page.wait_for_selector("#done:enabled")
    shot("instructions")
    for _ in range(3):  # instructions and practice
        end(page)
    for _ in range(2):
        if page.locator("#plan").count():
            set_marks(page)
            shot("plan")
        else:
            walk_on(page)
            shot("walk")
        end(page)
    page.wait_for_selector("text=Thank you")
    shot("thanks")
    if not wanted:
        page.goto(f"{address}admin")
        shot("login")
        page.goto(f"{address}admin#token={TOKEN}")
        page.reload()
        page.wait_for_selector("table")
        shot("admin")


def main() -> None:
    """Serve the shipped study and take its pictures."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--all", type=Path, help="folder for pictures of every page")
    every: Path | None = parser.parse_args().all
    with tempfile.TemporaryDirectory() as place:
        command = [sys.executable, "-u", "-m", "ssrics_like", "study", "serve", "complex"]
        command += ["--port", "0", "--database", f"{place}/answers.sqlite", "--admin-token", TOKEN]
        server = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        try:
            assert server.stdout is not None
            found = re.search(r"http://\S+", server.stdout.readline())
            assert found is not None, "the server did not start"
            with sync_playwright() as playwright:
                browser = playwright.chromium.launch(
                    executable_path="/usr/bin/chromium", args=FLAGS
                )
                folder = IMAGES if every is None else every
                folder.mkdir(parents=True, exist_ok=True)
                looks = [("study-", DESKTOP, ("plan", "walk"))]
                if every is not None:
                    looks = [("desktop-", DESKTOP, ()), ("phone-", PHONE, ())]
                for prefix, device, wanted in looks:
                    page = browser.new_context(**device).new_page()
                    take(page, found[0], folder, prefix, wanted)
                browser.close()
        finally:
            server.kill()
            server.wait()


if __name__ == "__main__":
    main()
