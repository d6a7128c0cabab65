"""Options that several commands share."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter, Token, validators


def _whole(_kind: type, tokens: Sequence[Token]) -> int:
    """Read a whole number; 1.5 is none, and not rounded."""
    try:
        return int(tokens[0].value)
    except ValueError:
        raise ValueError(f"'{tokens[0].value}': expected a whole number") from None


Whole = Annotated[int, Parameter(converter=_whole)]
Out = Annotated[Path | None, Parameter(name=["--out", "-o"])]
NeededOut = Annotated[Path, Parameter(name=["--out", "-o"])]
Pair = Annotated[tuple[float, float], Parameter(negative="")]
Overrides = Annotated[tuple[str, ...], Parameter(name="--set", negative="", consume_multiple=False)]
Radii = Annotated[
    tuple[str, ...], Parameter(negative="", consume_multiple=False, show_default=False)
]
MemoryFrom = Annotated[Path | None, Parameter(name="--memory-from")]
Runs = Annotated[
    int | None,
    Parameter(name=["--runs", "-n"], converter=_whole, validator=validators.Number(gte=1)),
]
Columns = Annotated[tuple[str, ...], Parameter(negative="", consume_multiple=False)]
Trials = Annotated[tuple[str, ...], Parameter(name="--trial", negative="", consume_multiple=False)]
Bin = Annotated[str | None, Parameter(name="--bin")]
Jobs = Annotated[
    int | None,
    Parameter(name=["--jobs", "-j"], converter=_whole, validator=validators.Number(gte=1)),
]
Quiet = Annotated[bool, Parameter(name=["--quiet", "-q"], negative="")]
Flag = Annotated[bool, Parameter(negative="")]

METRES_MAX = 100.0
"""No building is larger."""


def metres_of(name: str, text: str, *, least: float = 0.0) -> float:
    """Read metres: more than 0, or `least` and more, and at most 100.

    Raises
    ------
    SettingsError
        They are not.
    """
    from ssrics_like.errors import SettingsError

    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if not (value > 0.0 and least <= value <= METRES_MAX):
        from_m = f"{least:g} or more" if least else "more than 0"
        raise SettingsError(f"{name}: '{text}': expected metres, {from_m} and at most 100")
    return value
