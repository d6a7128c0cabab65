"""How much to train, and by which seed."""

from __future__ import annotations

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field


class TrainingSettings(BaseModel):
    """Settings of a training.

    Attributes
    ----------
    buildings : int
        How many buildings are driven through to learn from.
    held_out : int
        How many others the threshold is chosen on.
    seed : int
        Of everything: buildings, drives, trees.
    repeats : int
        How many trainings, with this seed and those that follow.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True)

    buildings: Annotated[int, Field(ge=1, le=100_000)] = 160
    held_out: Annotated[int, Field(ge=1, le=100_000)] = 40
    seed: Annotated[int, Field(ge=0, le=2**31)] = 1
    repeats: Annotated[int, Field(ge=1, le=100)] = 1
