"""What a participant's browser may send, and what of it is kept."""

from __future__ import annotations

import unicodedata
from dataclasses import dataclass
from typing import Annotated, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, field_validator, model_validator

LABEL_MAX = 200
FORMULA = "=+-@\uff1d\uff0b\uff0d\uff20"
"""A cell that begins with one of these, plain or of full width, is run by spreadsheets."""
DAY_MS = 86_400_000.0

Event = Literal["begin", "add", "move", "name", "delete", "press", "pause", "resume", "end"]
OF_A_MARK = ("add", "move", "name", "delete")

Key = Annotated[str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9_-]{7,63}$")]
"""Made by the browser, a different one for each response; also the name of the mark it adds."""


class Incoming(BaseModel):
    """One response as a browser sends it.

    Attributes
    ----------
    key : str
        Tells it from all others; sent again with the same key, it is taken once.
    step : int
        Which step of the study it belongs to.
    event : str
        What happened: begin and end of a step; add, move, name and delete of a mark; press of a
        key; pause and resume of a walk.
    mark : str or None
        Which mark, by the key of the response that added it.
    right_m, down_m : float or None
        Where on the picture of the plan.
    label : str or None
        What the mark is called.
    pressed : str or None
        Which key, a letter or digit.
    t_ms : float
        Milliseconds since the step was shown.
    replay_ms : float or None
        Milliseconds of the replay that had been shown.
    client_ms : float
        The browser's clock, milliseconds since 1970.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True, allow_inf_nan=False)

    key: Key
    step: Annotated[int, Field(ge=0, le=100_000)]
    event: Event
    mark: Key | None = None
    right_m: Annotated[float, Field(ge=-1e6, le=1e6)] | None = None
    down_m: Annotated[float, Field(ge=-1e6, le=1e6)] | None = None
    label: Annotated[str, Field(max_length=LABEL_MAX)] | None = None
    pressed: Annotated[str, Field(pattern=r"^[a-z0-9]$")] | None = None
    t_ms: Annotated[float, Field(ge=0.0, le=1e14)]  # a clock that was put right may be far off
    replay_ms: Annotated[float, Field(ge=0.0, le=DAY_MS)] | None = None
    client_ms: Annotated[float, Field(ge=0.0, le=1e14)]

    @field_validator("label")
    @classmethod
    def _is_one_line(cls, text: str | None) -> str | None:
        if text is not None and any(unicodedata.category(c) in ("Cc", "Cs") for c in text):
            raise ValueError("expected text without control characters")
        return text

    @model_validator(mode="after")
    def _is_whole(self) -> Self:
        placed = self.right_m is not None and self.down_m is not None
        if self.event in ("add", "move") and not placed:
            raise ValueError(f"{self.event} needs right_m and down_m")
        if self.event in ("move", "name", "delete") and self.mark is None:
            raise ValueError(f"{self.event} needs mark")
        if self.event == "name" and self.label is None:
            raise ValueError("name needs label")
        return self


def named(label: str) -> str:
    """Return a label as it is kept: no spaces around it, and none of `FORMULA` before it."""
    kept = label.strip()
    while kept and kept[0] in FORMULA:
        kept = kept[1:].lstrip()
    return kept


class Progress(BaseModel):
    """How far a replay has got.

    Attributes
    ----------
    step : int
        Which step of the study.
    replay_ms : float
        Milliseconds of it that have been shown.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True, allow_inf_nan=False)

    step: Annotated[int, Field(ge=0, le=100_000)]
    replay_ms: Annotated[float, Field(ge=0.0, le=DAY_MS)]


@dataclass(frozen=True, slots=True)
class Response:
    """One response as it is kept.

    Attributes
    ----------
    participant : str
        Who.
    trial : str
        Id of the trial; ``instructions`` for the step before the first.
    kind : str
        Of the trial; empty for the instructions.
    position : int
        0-based place of the step in this participant's study.
    event, mark, label, pressed
        As of `Incoming`; empty where they do not apply.
    x_m, y_m : float or None
        Where, map frame: of the mark, or of the robot's laser when the key was pressed.
    t_ms, replay_ms, client_ms
        As of `Incoming`.
    server_time : str
        When it was saved, ISO 8601, UTC.
    key : str
        As of `Incoming`.
    """

    participant: str
    trial: str
    kind: str
    position: int
    event: str
    mark: str
    x_m: float | None
    y_m: float | None
    label: str
    pressed: str
    t_ms: float
    replay_ms: float | None
    client_ms: float
    server_time: str
    key: str
