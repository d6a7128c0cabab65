"""The page of `ssrics view` in a browser: its size, how long it loads, how long a frame takes.

    python benchmarks/bench_view.py [--scans N] [--frames N] [--browser PATH]

A run is made up: the robot explores the map `complex` and then goes to every landmark, over and
over, until it has taken so many scans. The page is opened in headless Chromium at 1440 x 900, and
a stretch of time is played, ten seconds of the run a second, frame by frame. The alternative, in
the same page and over the same frames, draws everything anew: map, path, landmarks and plots. A
frame is measured twice: what the script takes, and what it takes until the pixels are there (one
of each canvas is read back). Painting is done by the processor here: no graphics card is used.
"""

from __future__ import annotations

import argparse
import importlib.util
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np
import yaml

from ssrics_like.library import root
from ssrics_like.scenarios.resolving import load_resolved
from ssrics_like.scenarios.runner import run_scenario
from ssrics_like.viewer import write_view

FLAGS = (
    "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync",
)  # fmt: skip
SIZE = {"width": 1440, "height": 900}
RATE_HZ = 10.0
TOURS = 200  # more than there is time for
GOAL_MS = 8.0
PLAYED_S = 6.0
# Plays frames one by one and returns what each took, milliseconds: script, and script and painting.
FRAMES = """async ({ frames, isAnew }) => {
  const { state, draw, forget, data } = window.ssricsView;
  const canvases = [...document.querySelectorAll("canvas")];
  const script = [], painted = [];
  const from = data.end_s * 0.6;
  for (let i = 0; i < 2 * frames; i++) {
    await new Promise(requestAnimationFrame);
    state.t = Math.min(from + (i >> 1) / 6, data.end_s);
    const isRead = i % 2 === 1;
    if (isRead) state.t += 1 / 12;
    if (isAnew) forget();
    const begin = performance.now();
    draw();
    if (isRead) for (const canvas of canvases) canvas.getContext("2d").getImageData(0, 0, 1, 1);
    (isRead ? painted : script).push(performance.now() - begin);
  }
  return { script, painted };
}"""
# Plays as a user does and returns the time from each frame to the next, milliseconds.
PLAYED = """async seconds => {
  const { seek, play, data } = window.ssricsView;
  seek(data.end_s * 0.6);
  play(true);
  const between = [];
  let before = await new Promise(requestAnimationFrame);
  const last = before + 1000 * seconds;
  while (before < last) {
    const now = await new Promise(requestAnimationFrame);
    between.push(now - before);
    before = now;
  }
  play(false);
  return between;
}"""


def made_up(folder: Path, scans: int) -> Path:
    """Write a scenario of so many scans, run it, and return its results folder."""
    complex_map = root() / "scenarios" / "maps" / "complex.yaml"
    tours = [{"goto": "visit-all"}] * TOURS
    scenario = {
        "title": f"Made up: {scans} scans",
        "world": {
            "map": str(complex_map),
            "start": [1.6, 1.0, 0.0],
            "legs": [{"explore": "frontier"}, *tours],
            "time_limit_s": (scans - 1) / RATE_HZ,
        },
        "productions": "wayfinding",
        "seed": 2006,
    }
    file = folder / "made-up.yaml"
    file.write_text(yaml.safe_dump(scenario))
    results = folder / "results"
    run_scenario(load_resolved(file), results)
    return results


def measured(page_file: Path, frames: int, browser: str) -> dict[str, Any]:
    """Open a page and return what was measured, milliseconds."""
    from playwright.sync_api import sync_playwright  # noqa: PLC0415 - may not be installed

    with sync_playwright() as playwright:
        chromium = playwright.chromium.launch(executable_path=browser, args=list(FLAGS))
        page = chromium.new_page(viewport=SIZE)
        begin = time.perf_counter()
        page.goto(page_file.as_uri())
        page.wait_for_selector("html[data-ready]")
        load_ms = 1000.0 * (time.perf_counter() - begin)
        found = {
            "load": load_ms,
            "layers": page.evaluate(FRAMES, {"frames": frames, "isAnew": False}),
            "anew": page.evaluate(FRAMES, {"frames": frames, "isAnew": True}),
            "between": page.evaluate(PLAYED, PLAYED_S if frames >= 100 else 0.5),
        }
        chromium.close()
    return found


def line(name: str, values: list[float]) -> str:
    """Return a row of the table."""
    median, p95 = np.percentile(values, [50, 95])
    return f"| {name} | {median:.1f} | {p95:.1f} |"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--scans", type=int, default=20_000)
    parser.add_argument("--frames", type=int, default=300)
    parser.add_argument("--browser", default="/usr/bin/chromium")
    options = parser.parse_args()
    if importlib.util.find_spec("playwright") is None:
        print("playwright is not installed here (pip install playwright); nothing was measured")
        return 0
    if not Path(options.browser).exists():
        print(f"{options.browser} is not there; nothing was measured")
        return 0
    with tempfile.TemporaryDirectory() as name:
        results = made_up(Path(name), options.scans)
        begin = time.perf_counter()
        page = write_view(results, out=Path(name) / "page.html")
        took_s = time.perf_counter() - begin
        size = page.stat().st_size
        found = measured(page, options.frames, options.browser)
    print(f"{options.scans} scans: a page of {size / 1e6:.1f} MB, written in {took_s:.1f} s, "
          f"loaded in {found['load'] / 1000:.1f} s")  # fmt: skip
    print("\n| a frame, ms | median | 95 % |\n|---|---|---|")
    layers, anew = found["layers"], found["anew"]
    print(line("script, layers kept", layers["script"]))
    print(line("script, everything drawn anew", anew["script"]))
    print(line("script and painting, layers kept", layers["painted"]))
    print(line("script and painting, everything drawn anew", anew["painted"]))
    print(line("from frame to frame while playing", found["between"]))
    kept, whole = np.median(layers["painted"]), np.median(anew["painted"])
    print(f"\nDrawing everything anew takes {whole / kept:.1f} times as long; the goal is a frame "
          f"below {GOAL_MS:g} ms.")  # fmt: skip
    return 0


if __name__ == "__main__":
    sys.exit(main())
