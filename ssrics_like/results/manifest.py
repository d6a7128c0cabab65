"""The manifest of a results folder, and what it says of how far the runs have got."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from ssrics_like.errors import ResultsError

MANIFEST = "manifest.json"
FORMAT = "ssrics-results"
VERSION = 1
SHOWN_MAX = 40
"""Longer values are shortened in messages."""


def read_manifest(path: Path) -> dict[str, Any]:
    """Read the manifest of a results folder.

    Raises
    ------
    ResultsError
        The folder holds no results, or those of a newer version.
    """
    file = path / MANIFEST
    if not file.is_file():
        what = "no such folder" if not path.exists() else f"no results here ({MANIFEST} is missing)"
        raise ResultsError(f"{path}: {what}")
    try:
        manifest: dict[str, Any] = json.loads(file.read_text(encoding="utf-8"))
    except ValueError as e:
        raise ResultsError(f"{file}: is damaged: {e}") from None
    if (
        not isinstance(manifest, dict)
        or manifest.get("format") != FORMAT
        or not isinstance(manifest.get("version"), int)
    ):
        raise ResultsError(f"{file}: is not a results manifest")
    if manifest["version"] > VERSION:
        raise ResultsError(
            f"{file}: results of version {manifest['version']}, this program reads up to {VERSION}"
        )
    return manifest


def unfinished(manifest: dict[str, Any]) -> str:
    """Say how many of the runs are there; nothing where that is all of them."""
    done = len(manifest["runs"])
    wanted = manifest["scenario"].get("runs", done)
    return f"{done} of {wanted} runs are complete; --resume goes on" if done < wanted else ""


def but_for_runs(description: dict[str, Any]) -> dict[str, Any]:
    """Return what decides a single run: all but how many there are."""
    scenario = dict(description["scenario"] or {})
    scenario.pop("runs", None)
    return {**description, "scenario": scenario}


def difference(before: Any, now: Any, at: str = "") -> str:
    """Name the first setting that differs, and how; nothing where none does.

    Parameters
    ----------
    before, now : plain values
        Nested mappings and lists, as JSON has them.
    at : str
        Dotted key of them.
    """
    if isinstance(before, dict) and isinstance(now, dict):
        both = {**now, **before}
        found = (
            difference(before.get(key), now.get(key), f"{at}.{key}" if at else key) for key in both
        )
        return next(filter(None, found), "")
    if before == now:
        return ""
    return f"{at.removeprefix('scenario.')} was {_shown(before)}, now it is {_shown(now)}"


def _shown(value: Any) -> str:
    text = "left out" if value is None else json.dumps(value, ensure_ascii=False)
    return text if len(text) <= SHOWN_MAX else f"{text[: SHOWN_MAX - 3]}..."
