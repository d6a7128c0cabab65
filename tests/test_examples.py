"""Every example runs and prints what is stored beside it."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).parents[1] / "examples"


@pytest.mark.parametrize("output", sorted(EXAMPLES.glob("*.txt")), ids=lambda path: path.stem)
def test_an_example_prints_what_is_stored(output, tmp_path):
    done = subprocess.run(
        [sys.executable, str(output.with_suffix(".py"))],
        capture_output=True, text=True, check=True, cwd=tmp_path, env=os.environ,
    )  # fmt: skip
    assert done.stdout == output.read_text()


def test_examples_are_short_enough_to_read_at_once():
    for path in EXAMPLES.glob("*.py"):
        limit = 160 if path.name == "make_demo_log.py" else 100
        assert len(path.read_text().splitlines()) < limit, path.name
