"""A cue's file as a document: read, checked, refused in one line with the place of the fault."""

from __future__ import annotations

import json
from collections.abc import Collection, Mapping, Sequence
from pathlib import Path
from typing import Any, NoReturn

from ssrics_like.errors import CueError

DIGITS = 7
MOST = 1e30


def load(path: Path) -> Any:
    """Return the content of a JSON file.

    Raises
    ------
    CueError
        It cannot be read, or is not JSON.
    """
    try:
        text = path.read_text(encoding="utf-8")
    except FileNotFoundError:
        raise CueError(f"{path}: no such file") from None
    except UnicodeDecodeError:
        raise CueError(f"{path}: is not UTF-8, expected a cue in JSON") from None
    except OSError as e:
        raise CueError(f"{path}: cannot be read ({e.strerror})") from None
    try:
        return json.loads(text)
    except json.JSONDecodeError as e:
        raise CueError(f"{path}:{e.lineno}:{e.colno}: not valid JSON: {e.msg}") from None
    except (RecursionError, ValueError):  # nested too deeply; a number of too many digits
        raise CueError(f"{path}: not a cue: expected one that `ssrics train` wrote") from None


def expect_format(path: Path, document: Any, *formats: str) -> None:
    """Complain of a document that is of none of some formats."""
    kind = document.get("format") if isinstance(document, dict) else None
    if kind not in formats:
        expected = " or ".join(f"'{one}'" for one in formats)
        refuse(path, "format", f"{shown(kind)}, expected {expected}")


def expect_version(path: Path, document: Mapping[str, Any], version: int) -> None:
    """Complain of another version of the format."""
    if document.get("version") != version:
        refuse(
            path, "version",
            f"{shown(document.get('version'))}; this version of ssrics reads {version}: "
            "train the cue anew",
        )  # fmt: skip


def expect_keys(path: Path, document: Any, keys: Collection[str], within: str = "") -> None:
    """Complain of the first key that is missing, in a document or in a mapping within it."""
    if not isinstance(document, dict):
        refuse(path, within, f"{shown(document)}, expected a mapping")
    for key in keys:
        if key not in document:
            refuse(path, f"{within}.{key}" if within else key, "is missing")


def expect_measures(path: Path, key: str, found: Any, version: int) -> None:
    """Complain of measures of another version."""
    if found != version:
        refuse(
            path, key,
            f"{shown(found)}; this version of ssrics makes {version}: train the cue anew",
        )  # fmt: skip


def expect_features(path: Path, names: Any, features: Sequence[str]) -> None:
    """Complain of the first measure that is not the one made here."""
    if not isinstance(names, list):
        refuse(path, "features", f"{shown(names)}, expected a list of {len(features)} names")
    for i, name in enumerate(features):
        if i == len(names) or names[i] != name:
            there = "missing" if i == len(names) else shown(names[i])
            refuse(path, f"features[{i}]", f"{there}, expected '{name}'; train the cue anew")
    if len(names) > len(features):
        last = len(features)
        refuse(path, f"features[{last}]", f"{shown(names[last])}, expected no more measures")


def read_threshold(path: Path, key: str, value: Any) -> float:
    """Return a number that is more than 0 and at most 1."""
    threshold = read_number(path, key, value)
    if not 0.0 < threshold <= 1.0:
        refuse(path, key, f"{threshold:g}, expected more than 0 and at most 1")
    return threshold


def read_number(path: Path, key: str, value: Any) -> float:
    """Return a finite number."""
    number = isinstance(value, int | float) and not isinstance(value, bool)
    if not number or not abs(value) <= MOST:  # neither is NaN, nor a whole number without end
        refuse(path, key, f"{shown(value)}, expected a number")
    return float(value)


def read_whole(path: Path, key: str, value: Any, least: int, most: int) -> int:
    """Return a whole number within limits."""
    if not isinstance(value, int) or isinstance(value, bool) or not least <= value <= most:
        expected = f"{least}" if least == most else f"a whole number from {least} to {most}"
        if most < least:
            expected = f"a node behind its parent; the tree has {most + 1}"
        refuse(path, key, f"{shown(value)}, expected {expected}")
    return value


def head_text(head: Mapping[str, Any]) -> str:
    """Return the first keys of a document, each on a line that ends in a comma."""
    return "\n".join(
        f'"{key}": {json.dumps(value, ensure_ascii=False)},' for key, value in head.items()
    )


def rounded(value: float) -> float | int:
    """Return a number with 7 significant digits; most zeros stand for nothing, and are short."""
    number = float(f"{value:.{DIGITS}g}")
    return int(number) if number == 0.0 else number


def refuse(path: Path, key: str, why: str) -> NoReturn:
    """Complain of a value."""
    raise CueError(f"{path}: {key}: {why}")


def shown(value: Any) -> str:
    """Return a value as a complaint shows it."""
    text = "nothing" if value is None else repr(value)
    return text if len(text) <= 60 else text[:57] + "..."  # noqa: PLR2004 - a line's worth
