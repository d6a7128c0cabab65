"""How much is benchmarked, and by which seeds."""

from __future__ import annotations

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

SEEDS, SWEEP_SEEDS, TUNING, TRAINING = 20, 5, 11, 11
QUICK_SEEDS, QUICK_TUNING, QUICK_TRAINING = 2, 3, 3


class BenchSettings(BaseModel):
    """Settings of a benchmark.

    Attributes
    ----------
    seeds : int
        How many buildings a simulated course has, and how many drives a plan; their seeds are
        0, 1, 2, ...
    sweep_seeds : int
        How many of these each point of a curve has, at most.
    tuning, training : int
        How many drives settings are tuned on, and how many `boosted-scan` is trained on: through
        buildings of their own.
    radius_m : float
        How far from a place, or along the path from a passage, a mark still finds it.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True, allow_inf_nan=False)

    seeds: Annotated[int, Field(ge=1, le=10_000)] = SEEDS
    sweep_seeds: Annotated[int, Field(ge=1, le=10_000)] = SWEEP_SEEDS
    tuning: Annotated[int, Field(ge=1, le=10_000)] = TUNING
    training: Annotated[int, Field(ge=1, le=10_000)] = TRAINING
    radius_m: Annotated[float, Field(gt=0.0, le=100.0)] = 1.0
