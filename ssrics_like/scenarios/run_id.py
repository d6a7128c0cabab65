"""Names a run among all runs, so that its landmarks are known again in any memory."""

from __future__ import annotations

import hashlib
from typing import Any

from ssrics_like.results.files import json_text

LETTERS = 12  # hexadecimal: among a million runs two share a name with a chance of 0.2 %
SAID_ONLY = (
    "title",
    "description",
    "humans",
    "match_radius_m",
    "trace",
    "published",
    "runs",
    "set",
)
"""What a scenario says that changes nothing in a run; what `set` does shows elsewhere."""


def run_id(description: dict[str, Any], run: int) -> str:
    """Return the name of a run: a digest of all that decides it, the same for an equal run.

    Parameters
    ----------
    description : dict
        Scenario, seed, frame, and the digest of the input, as in the manifest. Versions do not
        count: the run of a later version is still the same one.
    run : int
        Its number.
    """
    scenario = {k: v for k, v in description["scenario"].items() if k not in SAID_ONLY}
    decides = [scenario, description["seed"], description["frame"], description["input"], run]
    return hashlib.sha256(json_text(decides).encode()).hexdigest()[:LETTERS]
