"""The packages that only this comparison needs, with a word on where they come from."""

from __future__ import annotations

import importlib
from typing import Any

from ssrics_like.errors import MissingPackageError


def needed(module: str) -> Any:
    """Return a module of statsmodels or krippendorff.

    Raises
    ------
    MissingPackageError
        The package is not installed.
    """
    try:
        return importlib.import_module(module)
    except ImportError:
        package = module.split(".", 1)[0]
        raise MissingPackageError(
            f"comparing people needs the package {package}; pip install 'ssrics-like[people]'"
        ) from None
