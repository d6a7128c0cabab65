"""Which variants a folder of results folders holds: variants.json."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from ssrics_like.errors import ResultsError
from ssrics_like.results.files import json_text, write_atomically

VARIANTS = "variants.json"
FORMAT, VERSION = "ssrics-variants", 1


@dataclass(frozen=True)
class Variant:
    """A scenario with some values changed.

    Attributes
    ----------
    name, title : str
        Its folder, and what it is.
    factors : dict
        Name of a factor -> the level that it has here.
    set : dict
        What is changed.
    """

    name: str
    title: str
    factors: dict[str, str]
    set: dict[str, Any]


@dataclass(frozen=True)
class Listing:
    """The content of variants.json.

    Attributes
    ----------
    title, description : str
        Of the scenario.
    variants : tuple of Variant
        In their order.
    """

    title: str
    description: str
    variants: tuple[Variant, ...]


def has_variants(folder: Path) -> bool:
    """Tell whether a folder holds the variants of a scenario."""
    return (folder / VARIANTS).is_file()


def write_listing(folder: Path, listing: Listing) -> None:
    """Write variants.json."""
    data = {"format": FORMAT, "version": VERSION, **asdict(listing)}
    write_atomically(folder / VARIANTS, json_text(data))


def read_listing(folder: Path) -> Listing:
    """Read variants.json.

    Raises
    ------
    ResultsError
        It is missing, damaged or newer than this program.
    """
    file = folder / VARIANTS
    data = read_json(file)
    try:
        if data["format"] != FORMAT or not isinstance(data["version"], int):
            raise ResultsError(f"{file}: is no list of variants")
        if data["version"] > VERSION:
            raise ResultsError(
                f"{file}: variants of version {data['version']}, this program reads up to {VERSION}"
            )
        return Listing(
            str(data["title"]),
            str(data.get("description") or ""),
            tuple(_variant(file, entry) for entry in data["variants"]),
        )
    except (KeyError, TypeError, AttributeError) as e:
        raise ResultsError(f"{file}: is damaged: {e!r}") from None


def _variant(file: Path, entry: dict[str, Any]) -> Variant:
    """Check an entry; a variant's name is that of its folder, and no path."""
    name = str(entry["name"])
    if name in ("", ".", "..") or set(name) & set("/\\\0"):
        raise ResultsError(f"{file}: '{name}' cannot be the name of a variant's folder")
    return Variant(
        name,
        str(entry.get("title") or ""),
        {str(k): str(v) for k, v in (entry.get("factors") or {}).items()},
        dict(entry.get("set") or {}),
    )


def read_json(file: Path) -> dict[str, Any]:
    """Read a JSON file that holds a mapping.

    Raises
    ------
    ResultsError
        It cannot be read or is damaged.
    """
    try:
        data = json.loads(file.read_text(encoding="utf-8"))
    except OSError as e:
        raise ResultsError(f"{file}: cannot be read ({e.strerror})") from None
    except ValueError as e:
        raise ResultsError(f"{file}: is damaged: {e}") from None
    if not isinstance(data, dict):
        raise ResultsError(f"{file}: is damaged: expected a mapping")
    return data
