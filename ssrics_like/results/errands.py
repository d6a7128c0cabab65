"""Errands in words: what the robot was sent to do, and how that went."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ssrics_like.results.counts import counted

REASONS = {
    "no-open-way": "no way leads there that was not found shut",
    "no-such-landmark": "memory has no such landmark",
    "left-out": "some landmarks could not be got to",
    "lost": "the robot never knew where it was",
}
"""What the reasons of the rule set wayfinding mean; others are said as they are."""


def errand_text(errand: Mapping[str, Any]) -> str:
    """Return a line on one errand of a run's entry in the manifest."""
    return f"errand {errand['order']}: {outcome_text(errand)}"


def outcome_text(errand: Mapping[str, Any]) -> str:
    """Say how an errand ended, and what happened on the way."""
    if not errand["outcome"]:
        return "not ended when the run was"
    said = errand["outcome"]
    if errand["outcome"] == "failed":
        word, _, hint = errand["reason"].partition(",")
        said += f", because {REASONS.get(word, word) or 'of no stated reason'}"
        said += f",{hint}" if hint else ""
    parts = [f"{said} after {errand['ended_s'] - errand['started_s']:.0f} s"]
    if errand["visited"]:
        parts.append(f"by {', '.join(errand['visited'])}")
    if errand["shut"]:
        parts.append(f"found shut: {', '.join(errand['shut'])}")
    if errand["left_out"]:
        parts.append(f"left out: {', '.join(errand['left_out'])}")
    if errand["searches"]:
        parts.append(f"looked about {counted(errand['searches'], 'time')}")
    return "; ".join(parts)
