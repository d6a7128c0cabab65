"""What a caller may ask of perception, refused in one clear line when it is wrong."""

from __future__ import annotations

import math
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np

from ssrics_like.errors import ScanError, SettingsError, choices, nearest

if TYPE_CHECKING:
    from collections.abc import Iterable
    from types import ModuleType

    from numpy.typing import ArrayLike, NDArray

ADVANCES = ("tumbling", "sliding")
MARKS = ("every", "onset", "peak")
SECTOR_RULES = ("maximum", "robust")


@cache
def kernels() -> ModuleType:
    """Return the compiled kernels of the novelty algorithm, importing numba only now.

    Importing numba takes about half a second, which a command such as
    ``ssrics --help`` must not pay.
    """
    from ssrics_like.perception import kernels as module  # noqa: PLC0415  (see the docstring)

    return module


@cache
def scan_kernels() -> ModuleType:
    """Return the compiled kernels for single scans, importing numba only now."""
    from ssrics_like.perception import scan_kernels as module  # noqa: PLC0415  (as above)

    return module


def require_interval(interval: Any) -> int:
    """Return `interval` as an int, or raise `SettingsError` when it is not a whole number >= 2."""
    try:
        whole = int(interval)
    except (TypeError, ValueError, OverflowError):
        whole = 0
    if whole < 2 or whole != interval:  # noqa: PLR2004  (a pair needs two observations)
        raise SettingsError(
            f"interval is {interval!r}; expected a whole number of scans, 2 or more"
        )
    return whole


def require_fraction(name: str, value: Any) -> float:
    """Return `value` as a float, or raise `SettingsError` when it is not between 0 and 1."""
    try:
        fraction = float(value)
    except (TypeError, ValueError):
        fraction = math.nan
    if not 0.0 < fraction < 1.0:
        raise SettingsError(f"{name} is {value!r}; expected a fraction above 0 and below 1")
    return fraction


def require_choice(name: str, value: Any, known: Iterable[str]) -> str:
    """Return `value`, or raise `SettingsError` naming the known choices when it is not one."""
    known = tuple(known)
    if value not in known:
        hint = nearest(str(value), known)
        raise SettingsError(f"{name} is {value!r}; expected one of {choices(known)}{hint}")
    return str(value)


def require_ranges(ranges: ArrayLike, beams: int | None = None) -> NDArray[np.float64]:
    """Return one scan as float64, shape (beams,), or raise `ScanError`.

    Parameters
    ----------
    ranges : array_like, shape (beams,)
        Readings in metres.
    beams : int, optional
        The number of beams that the scan must have.
    """
    try:
        array = np.asarray(ranges, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise ScanError(f"a scan is not a row of numbers: {error}") from error
    if array.ndim != 1 or array.size == 0:
        raise ScanError(f"a scan has shape {array.shape}; expected one row of at least one beam")
    if beams is not None and array.size != beams:
        raise ScanError(f"a scan has {array.size} beams; the interval began with {beams}")
    return array
