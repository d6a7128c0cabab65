"""Real runs for the tests of the view, each made once."""

import atexit
import functools
import shutil
import tempfile
from pathlib import Path

import yaml

from ssrics_like.library import find
from ssrics_like.scenarios.resolving import load_resolved
from ssrics_like.scenarios.runner import run_scenario
from ssrics_like.viewer import write_view

DEMO = find("scenarios", "demo")
DEMO_LOG = DEMO.parent / "logs" / "demo.log.gz"
WAITING_S = 600  # of the scenario closed-door, most of whose time this is
WAIT_S = 20


@functools.cache
def _shelf() -> Path:
    folder = Path(tempfile.mkdtemp(prefix="viewer-"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder


def _errand() -> Path:
    """Write the scenario closed-door with a short wait: a door shuts, and is gone round."""
    shipped = find("scenarios", "closed-door")
    scenario = yaml.safe_load(shipped.read_text(encoding="utf-8"))
    world = scenario["world"]
    world["map"] = str(shipped.parent / world["map"])
    (leg,) = [leg for leg in world["legs"] if leg.get("wait_s") == WAITING_S]
    leg["wait_s"] = WAIT_S
    world["doors"][0]["closes_s"] = 170.0  # while it waits
    file = _shelf() / "errand.yaml"
    file.write_text(yaml.safe_dump(scenario), encoding="utf-8")
    return file


@functools.cache
def results(name: str) -> Path:
    """Return the results folder of a run: `demo` is of a log, `errand` of a building."""
    out = _shelf() / name
    run_scenario(load_resolved(DEMO if name == "demo" else _errand()), out)
    return out


@functools.cache
def page(name: str) -> Path:
    """Return the page of such a run, the log's with its scans."""
    log = DEMO_LOG if name == "demo" else None
    return write_view(results(name), log=log, out=_shelf() / f"{name}.html")
