"""Shared fixtures: where the real logs are, when they are there at all."""

import os
from pathlib import Path

import pytest


@pytest.fixture(scope="session")
def data_dir() -> Path:
    """Folder of real logs and truth: SSRICS_DATA, then ../shared/data beside the checkout."""
    named = os.environ.get("SSRICS_DATA")
    folder = Path(named) if named else Path(__file__).parents[1].parent / "shared" / "data"
    if not (folder / "logs").is_dir():
        pytest.skip(f"real logs not found in {folder} (set SSRICS_DATA)")
    return folder
