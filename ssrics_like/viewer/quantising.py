"""Numbers as few bytes: steps of a fixed size, sixteen bits each, in base64."""

from __future__ import annotations

import base64
import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

NOTHING = 65_535
"""Stands for what is not a finite number."""
STEPS = 65_534
RANGE_STEP_M = 0.01
TURN_STEPS = 65_536


def in_steps(values: ArrayLike, step: float) -> dict[str, Any]:
    """Return numbers as unsigned steps from their least, as the page reads them.

    Parameters
    ----------
    values : array_like, shape (n,)
        The numbers; what is not finite stays so.
    step : float
        The step that is wanted; a larger one is taken where sixteen bits do not reach.

    Returns
    -------
    dict
        ``least``, ``step`` and ``data``: a value is least + step * data, 65535 is none. It is off
        by half a step at most.
    """
    numbers = np.asarray(values, np.float64)
    is_there = np.isfinite(numbers)
    # Whole millionths: the page's JSON, which has six decimals, holds them as they are.
    least = math.floor(float(numbers[is_there].min()) * 1e6) / 1e6 if is_there.any() else 0.0
    span = float(numbers[is_there].max()) - least if is_there.any() else 0.0
    step = max(step, math.ceil(span / STEPS * 1e6) / 1e6)
    steps = np.full(numbers.shape, NOTHING, np.uint16)
    steps[is_there] = np.rint((numbers[is_there] - least) / step).astype(np.uint16)
    return {"least": least, "step": step, "data": packed(steps)}


def ranges_in_steps(ranges_m: NDArray[np.float64]) -> NDArray[np.uint16]:
    """Return ranges in whole centimetres; 65535 for a beam without return, or beyond 655 m."""
    steps = np.full(ranges_m.shape, NOTHING, np.uint16)
    is_there = np.isfinite(ranges_m) & (ranges_m >= 0.0) & (ranges_m < NOTHING * RANGE_STEP_M - 1.0)
    steps[is_there] = np.rint(ranges_m[is_there] / RANGE_STEP_M).astype(np.uint16)
    return steps


def turns(angles_rad: ArrayLike) -> str:
    """Return angles as sixteen-bit shares of a full turn, in base64."""
    shares = np.rint(np.asarray(angles_rad, np.float64) / (2 * np.pi) * TURN_STEPS)
    return packed(np.mod(shares, TURN_STEPS).astype(np.uint16))


def milliseconds(times_s: ArrayLike) -> str:
    """Return times since the start as thirty-two-bit milliseconds, in base64."""
    whole = np.rint(np.asarray(times_s, np.float64) * 1000.0)
    return packed(np.clip(whole, 0.0, 2.0**32 - 1.0).astype(np.uint32))


def packed(values: NDArray[Any]) -> str:
    """Return the bytes of an array, little-endian, in base64."""
    little = values.astype(values.dtype.newbyteorder("<"), copy=False)
    return base64.b64encode(little.tobytes()).decode("ascii")
