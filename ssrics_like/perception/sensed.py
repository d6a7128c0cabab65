"""What perception keeps of an observation."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ssrics_like.perception.observation import Observation

UNKNOWN = "unknown"


class Sensed(NamedTuple):
    """An observation, made fit for use.

    Attributes
    ----------
    observation : Observation
        As it came.
    ranges_m : ndarray, shape (beams,), float64
        Its conditioned readings.
    travelled_m : float
        Length of the path from the first observation to it, metres.
    structure : str
        What the place looks like: "unknown" where structure is not perceived.
    """

    observation: Observation
    ranges_m: NDArray[np.float64]
    travelled_m: float
    structure: str = UNKNOWN
