"""Libraries that only some designators need, imported when they are."""

from __future__ import annotations

import importlib
from contextlib import AbstractContextManager
from functools import cache
from typing import Any, cast

from ssrics_like.errors import MissingPackageError


def optional(module: str, package: str, designator: str) -> Any:
    """Return a module of a library that is no dependency of this project.

    Raises
    ------
    MissingPackageError
        It is not installed.
    """
    try:
        return importlib.import_module(module)
    except ImportError:
        raise MissingPackageError(
            f"designator '{designator}' needs the package {package}; pip install {package}"
        ) from None


def one_thread() -> AbstractContextManager[object]:
    """Keep scikit-learn to one thread inside a ``with``.

    Threads that wait for each other over a single scan, on cores that others use too,
    take a hundred times as long as the one that does the work.
    """
    return cast("AbstractContextManager[object]", _controller().limit(limits=1, user_api="openmp"))


@cache
def _controller() -> Any:
    """Find the thread pools of the libraries that are loaded, once: that takes a while."""
    return importlib.import_module("threadpoolctl").ThreadpoolController()
