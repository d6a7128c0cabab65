"""The parameters of declarative memory: ACT-R 7's, under names that can be read."""

from __future__ import annotations

from typing import Annotated, Self

from pydantic import BaseModel, ConfigDict, Field, StrictBool, StrictInt, model_validator

LARGEST_EXPONENT = 700.0  # e**709.8 is the largest double
"""Bound on latency_exponent * -retrieval_threshold, so that every latency is finite."""


class MemoryParameters(BaseModel):
    """How a declarative memory forgets, matches and is timed.

    The meaning of each parameter is that of ACT-R 7 (named in brackets); so are the
    defaults, but for `decay` and `subsymbolic`, which ACT-R leaves off and which every
    published model of forgetting turns on.

    Attributes
    ----------
    subsymbolic : bool
        [:esc] Whether activation is computed at all. Off: any chunk that matches is
        retrieved at once.
    decay : float or None
        [:bll] Exponent d of base-level learning, no unit. None: no learning; every
        chunk's base level is `base_level_constant`.
    base_level_constant : float
        [:blc] Added to every base level, in units of activation.
    optimized_learning : bool or int
        [:ol] False: every reference is summed. True: only the number of references and
        the age of the chunk count. k > 0: the newest k references are summed, the
        others approximated.
    retrieval_threshold : float
        [:rt] Least activation tau of a chunk that can be retrieved.
    latency_factor : float
        [:lf] F in the latency F exp(-f A), seconds; used to the whole millisecond.
    latency_exponent : float
        [:le] f in the latency F exp(-f A), no unit.
    mismatch_penalty : float or None
        [:mp] Weight P of a similarity in the activation. None: no partial matching.
    max_similarity : float
        [:ms] Similarity of two equal values.
    max_difference : float
        [:md] Similarity of two values about which nothing is known.
    activation_noise : float
        [:ans] Scale s of the logistic noise drawn for every candidate of every
        retrieval. 0: none.
    strength_of_association : float or None
        [:mas] S in the strength S - ln(fan). None: no spreading activation.
    association_floor : float or None
        [:nsji] Least strength of an association; 0 is ACT-R's `nil` and `warn`. None
        is its `t`: strengths may be negative.
    source_activation : dict of str to float
        [:ga, :imaginal-activation, ...] Activation W that each buffer spreads; a buffer
        that is not named spreads none.

    References
    ----------
    Bothell, D. ACT-R 7.27+ Reference Manual, "Declarative module".
    Anderson, J. R. (2007). How Can the Human Mind Occur in the Physical Universe?
    """

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True, allow_inf_nan=False)

    subsymbolic: bool = True
    decay: Annotated[float, Field(gt=0)] | None = 0.5
    base_level_constant: float = 0.0
    optimized_learning: StrictBool | Annotated[StrictInt, Field(gt=0, le=1_000_000)] = False
    retrieval_threshold: float = 0.0
    latency_factor: Annotated[float, Field(ge=0, le=1e6)] = 1.0
    latency_exponent: Annotated[float, Field(ge=0)] = 1.0
    mismatch_penalty: float | None = None
    max_similarity: float = 0.0
    max_difference: float = -1.0
    activation_noise: Annotated[float, Field(ge=0)] = 0.0
    strength_of_association: float | None = None
    association_floor: float | None = 0.0
    source_activation: dict[str, float] = Field(default_factory=lambda: {"imaginal": 1.0})

    @model_validator(mode="after")
    def _computable(self) -> Self:
        if self.optimized_learning is True and self.decay is not None and self.decay >= 1:
            raise ValueError(
                f"decay {self.decay:g} with optimized_learning true divides by 1 - decay; "
                "expected a decay below 1, or optimized_learning false or a number"
            )
        if self.max_difference > self.max_similarity:
            raise ValueError(
                f"max_difference {self.max_difference:g} is above "
                f"max_similarity {self.max_similarity:g}"
            )
        if -self.latency_exponent * self.retrieval_threshold > LARGEST_EXPONENT:
            raise ValueError(
                f"retrieval_threshold {self.retrieval_threshold:g} makes a latency that is not "
                f"finite; expected latency_exponent * -threshold of {LARGEST_EXPONENT:g} at most"
            )
        return self
