"""Find the project's content: rule sets, profiles, scenarios, robots.

The content folders stand beside the package in a checkout and inside it in an
installed wheel. Users name an entry, or give the path of a file of their own.
"""

from __future__ import annotations

from pathlib import Path

from ssrics_like.errors import LibraryError, choices, nearest

FOLDERS = {
    "productions": "productions",
    "perception": "perception",
    "memory": "memory",
    "scenarios": "scenarios",
    "robots": "scenarios/robots",
    "studies": "scenarios/studies",
}
"""Kind of entry -> where its files are."""

KINDS = tuple(FOLDERS)
SUFFIXES = (".yaml", ".yml")


def root() -> Path:
    """Return the folder that holds the four content folders."""
    package = Path(__file__).resolve().parent
    installed = package / "_library"
    return installed if installed.is_dir() else package.parent


def folder(kind: str) -> Path:
    """Return the content folder of a kind.

    Raises
    ------
    LibraryError
        There is no such kind.
    """
    if kind not in KINDS:
        raise LibraryError(
            f"no library folder '{kind}'{nearest(kind, KINDS)}; the folders are {choices(KINDS)}"
        )
    return root() / FOLDERS[kind]


def entries(kind: str) -> dict[str, Path]:
    """Return name -> file of the library's entries of a kind, sorted by name."""
    return {path.stem: path for path in sorted(folder(kind).glob("*.yaml"))}


def find_cue(name: str) -> Path:
    """Return the file of a learned cue: an entry of the perception folder, or a path.

    Raises
    ------
    LibraryError
        No entry or file has this name.
    """
    known = {path.stem: path for path in sorted(folder("perception").glob("*.json"))}
    if "/" in name or "\\" in name or name.endswith(".json"):
        path = Path(name)
        if path.is_file():
            return path
        what = "is a folder, expected a JSON file" if path.is_dir() else "no such file"
        raise LibraryError(f"{path}: {what}")
    if name in known:
        return known[name]
    raise LibraryError(
        f"no cue '{name}'{nearest(name, known)}; "
        f"the library has {choices(known)} (a path ends in .json)"
    )


def find(kind: str, name: str | Path) -> Path:
    """Return the file of a library entry, or of the user's own file.

    A name with a folder or a YAML ending is a path; anything else is an entry.

    Raises
    ------
    LibraryError
        No entry or file has this name.
    """
    text = str(name)
    if isinstance(name, Path) or "/" in text or "\\" in text or text.endswith(SUFFIXES):
        path = Path(text)
        if path.is_file():
            return path
        what = "is a folder, expected a YAML file" if path.is_dir() else "no such file"
        raise LibraryError(f"{path}: {what}")
    known = entries(kind)
    if text in known:
        return known[text]
    raise LibraryError(
        f"no {kind} entry '{text}'{nearest(text, known)}; "
        f"the library has {choices(known)} (a path ends in .yaml)"
    )
