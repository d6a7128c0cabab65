"""What the files of memory have in common: written whole, told by a header, refused in a line."""

from __future__ import annotations

import contextlib
import gc
import json
import os
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, NoReturn

from ssrics_like.errors import MemoryFileError

LARGEST = sys.float_info.max


def write_whole(path: Path, content: bytes) -> None:
    """Write a file under another name and rename it, so that it is whole or not there.

    Raises
    ------
    MemoryFileError
        If it cannot be written.
    """
    temporary = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        temporary.write_bytes(content)
        temporary.replace(path)
    except OSError as error:
        raise MemoryFileError(f"{path}: cannot be written: {error.strerror}") from error
    finally:
        with contextlib.suppress(OSError):  # gone already, unless writing was cut short
            temporary.unlink()


def read_whole(path: Path) -> bytes:
    """Return what stands in a file.

    Raises
    ------
    MemoryFileError
        If it cannot be read.
    """
    try:
        return path.read_bytes()
    except OSError as error:
        raise MemoryFileError(f"{path}: cannot be read: {error.strerror}") from error


@contextlib.contextmanager
def uncollected() -> Iterator[None]:
    """Look for no garbage meanwhile: a large memory has a million objects, none of them any."""
    collecting = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if collecting:
            gc.enable()


def parsed_json(path: Path, content: bytes) -> Any:
    """Return what a JSON file says.

    Raises
    ------
    MemoryFileError
        If it is none.
    """
    try:
        return json.loads(content)
    except UnicodeDecodeError as error:
        raise MemoryFileError(f"{path}: damaged: {error}") from error
    except json.JSONDecodeError as error:
        raise MemoryFileError(f"{path}:{error.lineno}: damaged: {error.msg}") from error
    except RecursionError as error:
        raise MemoryFileError(f"{path}: damaged: nested too deep") from error
    except ValueError as error:  # a whole number of thousands of digits
        raise MemoryFileError(f"{path}: damaged: {error}") from error


def check_header(path: Path, header: Mapping[str, Any], what: str, kind: str, newest: int) -> None:
    """Check that a file is of a kind, and of a version that is known.

    Parameters
    ----------
    path : Path
        The file, for messages.
    header : mapping
        Has its `format` and `version`.
    what : str
        What is expected, in words.
    kind : str
        The format of that.
    newest : int
        The newest version known.

    Raises
    ------
    MemoryFileError
        If it is foreign, damaged or newer.
    """
    if header.get("format") != kind:
        raise MemoryFileError(
            f"{path}: no {what}: its format is {shown(header.get('format'))}, expected '{kind}'"
        )
    version = header.get("version")
    if isinstance(version, bool) or not isinstance(version, int) or version < 1:
        damaged(path, f"its version is {shown(version)}, expected {newest}")
    if version > newest:
        raise MemoryFileError(
            f"{path}: written by a newer ssrics: its version is {version}, "
            f"this one reads up to {newest}"
        )


def is_finite_number(value: Any) -> bool:
    """Tell whether a value is a number, as files hold them, that a float can hold."""
    return type(value) in (float, int) and bool(abs(value) <= LARGEST)  # True is an int as well


def shown(value: Any) -> str:
    """Return a value for a message of one line."""
    text = repr(value)
    return text if len(text) <= 60 else text[:57] + "..."  # noqa: PLR2004 - a line's worth


def damaged(path: Path, what: str) -> NoReturn:
    """Say what is wrong inside a file."""
    raise MemoryFileError(f"{path}: damaged: {what}")
