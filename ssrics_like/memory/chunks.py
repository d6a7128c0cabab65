"""What memory holds and what can be asked of it: chunks, requests and slot values."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray

LEAST_DESCRIPTOR_LENGTH = 2


@dataclass(frozen=True, eq=False)
class View:
    """What a place looked like: a vector of numbers under a name.

    Attributes
    ----------
    name : str
        Handle that stands for this view where only text can (rules, traces).
    descriptor : ndarray, shape (n,), float32
        For example a conditioned scan, metres. Two views of one memory have equal
        length, at least 2, and are finite.
    there : mapping of str to ndarray
        Of a view that is asked for: what is seen now where other views were taken, by the names of
        those. It is no part of what a place looked like.
    """

    name: str
    descriptor: NDArray[np.float32]
    there: Mapping[str, NDArray[np.float32]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        descriptor = np.array(self.descriptor, dtype=np.float32)
        if descriptor.ndim != 1 or len(descriptor) < LEAST_DESCRIPTOR_LENGTH:
            raise ValueError(
                f"view '{self.name}': descriptor has shape {descriptor.shape}; "
                "expected one row of at least 2 numbers"
            )
        if not np.isfinite(descriptor).all():
            raise ValueError(f"view '{self.name}': descriptor holds a value that is not finite")
        descriptor.flags.writeable = False
        object.__setattr__(self, "descriptor", descriptor)

    @cached_property
    def direction(self) -> NDArray[np.float32]:
        """The descriptor less its mean, scaled to length 1; shape (n,).

        Pearson's r of two views is the product of their directions. That of a constant
        descriptor is all 0.
        """
        if (self.descriptor == self.descriptor[0]).all():
            return np.zeros_like(self.descriptor)
        centred = self.descriptor.astype(np.float64)
        centred -= centred.sum() / len(centred)
        return np.asarray(centred / math.sqrt(centred @ centred), np.float32)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, View):
            return NotImplemented
        return self is other or (
            self.name == other.name and np.array_equal(self.descriptor, other.descriptor)
        )

    def __hash__(self) -> int:
        return hash(self.name)


Value: TypeAlias = str | float | View
"""What a slot can hold. Text is a symbol: it can be a source of spreading activation."""

Modifier: TypeAlias = bool | Literal["<", "<=", ">", ">="]
"""How a slot is tested: False equal, True not equal, or an order of numbers."""

ORDER_MODIFIERS = ("<", "<=", ">", ">=")

SlotTest: TypeAlias = tuple[str, Value | None, Modifier]
"""Slot, value and modifier; the value None stands for "the slot is empty"."""


@dataclass(frozen=True)
class Chunk:
    """A unit of declarative memory.

    Attributes
    ----------
    name : str
        Unique in a memory. Equal activations are decided by the order of names.
    type : str
        Chunk type.
    slots : mapping of str to Value
        A slot that is None is left out: it is empty. Must not be changed afterwards.
    """

    name: str
    type: str
    slots: Mapping[str, Value]

    def __post_init__(self) -> None:
        filled = {slot: value for slot, value in self.slots.items() if value is not None}
        object.__setattr__(self, "slots", filled)


@dataclass(frozen=True)
class Request:
    """A question to declarative memory.

    Attributes
    ----------
    type : str or None
        Chunk type wanted; None for any.
    slots : tuple of (slot, value, modifier)
        All must hold. With modifier False the slot equals the value, with True it does
        not; with one of ``<  <=  >  >=`` it holds a number so ordered to the value.
        A value of None with False wants the slot empty, with True filled.

    Raises
    ------
    ValueError
        For an unknown modifier, or an order asked of None.
    """

    type: str | None
    slots: tuple[SlotTest, ...] = ()

    def __post_init__(self) -> None:
        for slot, value, modifier in self.slots:
            if isinstance(modifier, bool):
                continue
            if modifier not in ORDER_MODIFIERS or value is None:
                raise ValueError(
                    f"slot '{slot}': modifier {modifier!r} with value {value!r}; expected True or "
                    f"False, or one of {' '.join(ORDER_MODIFIERS)} with a number"
                )
