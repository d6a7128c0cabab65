"""How kernels are compiled; the only file that imports numba."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeVar

import numba

if TYPE_CHECKING:
    from collections.abc import Callable

F = TypeVar("F", bound="Callable[..., Any]")

HUGE_M = 1e150
"""A reading beyond this is no answer, as NaN and infinity are: its square would overflow."""


def _compile(function: F, **options: Any) -> F:
    try:
        return numba.njit(cache=True, nogil=True, **options)(function)  # type: ignore[no-any-return]
    except RuntimeError:
        # numba refuses to cache when no folder is writable: a read-only
        # installation and no home. Then each process compiles for itself.
        return numba.njit(nogil=True, **options)(function)  # type: ignore[no-any-return]


def compiled(function: F) -> F:
    """Compile `function` when first called, cached on disk where a folder can be written."""
    return _compile(function)


def compiled_reordering(function: F) -> F:
    """Compile as `compiled` does, and let float sums be reordered and fused for speed."""
    return _compile(function, fastmath={"reassoc", "contract", "nsz"})
