"""The gap at a place: which measures describe it, by name."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ssrics_like.perception import frame_kernels
from ssrics_like.perception import gap_kernels as kernels
from ssrics_like.perception.local_map import MEMORY_M
from ssrics_like.perception.observation import Pose

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ssrics_like.perception.local_map import LocalMap

MEASURES = 2
"""Version of the measures, raised whenever one of them comes out otherwise than before: by the
kernels, the local map or the lag. A cue knows only those that it was trained on."""


def _names() -> tuple[str, ...]:
    names = ["width_m", "off_middle_m", "oblique_rad"]
    for step in range(0, kernels.STEPS, 2):
        ahead_m = (step - kernels.HERE) * kernels.STEP_M
        names += [f"near_wall_m@{ahead_m:+.1f}", f"far_wall_m@{ahead_m:+.1f}"]
    for first, last in kernels.STRETCHES:
        part = "..".join(
            f"{(step - kernels.HERE) * kernels.STEP_M:+.1f}" for step in (first, last - 1)
        )
        names += [
            f"{what}@{part}"
            for what in ("narrowest_m", "widest_m", "mean_width_m", "mean_unknown_m")
        ]
    names += ["neck_steps_ahead", "neck_steps_behind"]
    for wall in (
        "wall_0.0_0.5", "wall_0.5_1.0", "wall_1.0_1.5", "unbroken_wall_m", "unknown_wall_m",
        "wall_roughness_m", "wall_offset_m", "wall_in_all",
    ):  # fmt: skip
        names += [f"{wall}_lesser", f"{wall}_greater"]
    for first_m, last_m in kernels.BANDS_M:
        for lane in ("lane", "aside"):
            names += [f"{what}_{lane}@{first_m:+.1f}..{last_m:+.1f}" for what in ("full", "free")]
    names += ["way_round_m", "way_round_unknown_m"]
    for measure in ("jamb_aside_m", "jamb_along_m", "jamb_cells_m"):
        names += [f"{measure}_lesser", f"{measure}_greater"]
    return tuple(names)


FEATURES = _names()
"""Names of the measures. `lesser` and `greater` are the two sides in order of size, so that a
doorway and its mirror image are the same; ``@+0.4`` is 0.4 m ahead of the gap."""


def gap_features(
    local: LocalMap, place: tuple[float, float, float], travelled_m: float
) -> tuple[NDArray[np.float64], Pose]:
    """Describe the gap at a place, and say where it is.

    Parameters
    ----------
    local : LocalMap
        The surroundings.
    place : tuple of float
        x, y and direction of travel: metres, radians, frame of odometry.
    travelled_m : float
        Metres travelled so far.

    Returns
    -------
    ndarray, shape (features,), float64
        In the order of `FEATURES`.
    Pose
        Midway between what stands left and right, and the direction through that the robot takes;
        frame of odometry.
    """
    measures = np.empty(len(FEATURES))
    x_m, y_m, theta_rad = kernels.gap_features(
        local.evidence, local.seen_m, place, travelled_m - MEMORY_M, measures
    )
    return measures, Pose(x_m, y_m, math.remainder(theta_rad, math.tau))


class DoorwayFrame(NamedTuple):
    """Where a doorway is.

    Attributes
    ----------
    middle : Pose
        Midway between its jambs, and the direction through that the robot takes; frame of odometry.
    width_m : float
        From jamb to jamb.
    """

    middle: Pose
    width_m: float


def doorway_frame(
    local: LocalMap, way_m: NDArray[np.float64], through_rad: float, travelled_m: float
) -> DoorwayFrame | None:
    """Say where the doorway is that lies on the robot's way.

    Parameters
    ----------
    local : LocalMap
        The surroundings.
    way_m : ndarray, shape (n, 2)
        Places along the way through, one at least; metres, frame of odometry.
    through_rad : float
        The direction through, nearly.
    travelled_m : float
        Metres travelled so far.

    Returns
    -------
    DoorwayFrame or None
        None where nothing stands on both sides of the way.
    """
    x_m, y_m, theta_rad, width_m = frame_kernels.doorway_frame(
        local.evidence, local.seen_m, way_m, through_rad, travelled_m - MEMORY_M
    )
    if math.isinf(width_m):
        return None
    return DoorwayFrame(Pose(x_m, y_m, math.remainder(theta_rad, math.tau)), width_m)
