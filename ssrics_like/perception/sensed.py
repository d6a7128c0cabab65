"""What perception keeps of an observation."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ssrics_like.perception.observation import Observation, Pose

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
    here : Pose
        Where the laser is by path integration: as odometry has it, or corrected by `Egomotion`.
    turned_rad : float
        Sum of all turns from the first observation to it.
    carried : int
        How often the robot was suddenly elsewhere by then.
    structure : str
        What the place looks like: "unknown" where structure is not perceived.
    gap : Pose or None
        In a doorway its middle, and the direction through that the robot takes; frame of odometry.
    around : ndarray or None
        What surrounds the place, as `Surroundings.view_of`; None where that is not perceived.
    """

    observation: Observation
    ranges_m: NDArray[np.float64]
    travelled_m: float
    here: Pose
    turned_rad: float
    carried: int
    structure: str = UNKNOWN
    gap: Pose | None = None
    around: NDArray[np.float32] | None = None
