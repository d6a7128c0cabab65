"""Packages that only studies need."""

from __future__ import annotations

import importlib
from typing import Any

from ssrics_like.errors import MissingPackageError

NAMES = {
    "sqlalchemy": ("SQLAlchemy", "study"),
    "fastapi": ("fastapi", "study"),
    "uvicorn": ("uvicorn", "study"),
    "markdown_it": ("markdown-it-py", "study"),
    "psycopg": ("psycopg", "postgres"),
}
"""Module -> package, and the extra that brings it."""


def needed(module: str) -> Any:
    """Import a module.

    Raises
    ------
    MissingPackageError
        Its package is not installed.
    """
    try:
        return importlib.import_module(module)
    except ImportError:
        package, extra = NAMES[module.partition(".")[0]]
        raise MissingPackageError(
            f"a study needs the package {package}; pip install 'ssrics-like[{extra}]'"
        ) from None
