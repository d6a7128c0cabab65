"""A study's participants at real browsers: Debian's Chromium, without a window."""

import contextlib
import os
import shutil

import pytest

CHROMIUM = "/usr/bin/chromium"
FLAGS = [
    "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync",
]  # fmt: skip
WIDTH_M, HEIGHT_M = 18.0, 11.0  # of the map `simple`, whose lower left corner is (0, 0)


@contextlib.contextmanager
def launched():
    if not shutil.which(CHROMIUM):
        if os.environ.get("SSRICS_BROWSER") == "required":
            pytest.fail(f"{CHROMIUM} is missing, and SSRICS_BROWSER is required")
        pytest.skip(f"{CHROMIUM} is missing")
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        found = playwright.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
        yield found
        found.close()


class Visitor:
    """A participant at a browser of their own."""

    def __init__(self, browser, server, **device):
        self.context = browser.new_context(**{"viewport": {"width": 1280, "height": 800}, **device})
        self.page = self.context.new_page()
        self.page.set_default_timeout(20_000)
        self.complaints, self.asked = [], []
        self.page.on("console", self._note)
        self.page.on("pageerror", lambda error: self.complaints.append(str(error)))
        self.page.on("request", lambda request: self.asked.append(request.url))
        self.server = server
        self.page.goto(server.address)

    def _note(self, message):
        if message.type in ("error", "warning"):
            self.complaints.append(message.text)

    def begin(self):
        self.page.check("#agree")
        self.page.click("text=Begin")
        self.done()
        return self

    def done(self):
        """Go on to the next step."""
        where = self.page.locator(".where").inner_text()
        self.page.click("#done:enabled:visible")
        if self.page.locator("#sure").is_visible():
            self.page.click("#on")
        self.page.wait_for_function(
            "text => document.querySelector('.where')?.innerText !== text", arg=where
        )

    def ready(self):
        self.page.wait_for_selector("#done:enabled")

    def state(self):
        return self.page.evaluate("fetch('/api/state').then(answer => answer.json())")

    def saved(self):
        self.page.wait_for_selector("#saved[data-state=saved]")

    def pixel(self, right_m, down_m):
        """Where on the screen a place of the plan is, by the picture that is shown."""
        x, y, width, height = self.page.evaluate(
            "(() => { const b = document.getElementById('picture').getBoundingClientRect();"
            " return [b.x, b.y, b.width, b.height]; })()"
        )
        return x + width * right_m / WIDTH_M, y + height * down_m / HEIGHT_M

    def click(self, right_m, down_m):
        self.page.mouse.click(*self.pixel(right_m, down_m))

    def marks(self):
        self.saved()
        return [(mark["right_m"], mark["down_m"]) for mark in self.state()["marks"]]

    def close(self):
        self.context.close()
