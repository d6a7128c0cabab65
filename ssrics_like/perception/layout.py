"""The layout of a place: how far it goes on along the walls, by name."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.perception import layout_kernels as kernels
from ssrics_like.perception.wide_map import SCALE, WideMap

if TYPE_CHECKING:
    from numpy.typing import NDArray

REVISION = 1
"""Version of the measures, raised whenever one of them comes out otherwise than before."""


def _names() -> tuple[str, ...]:
    names = ["oblique_rad"]
    for number, side in enumerate(("ahead", "lesser", "behind", "greater")):
        lanes = kernels.LANES[number % 2]
        for lane in range(lanes):
            off_m = SCALE * kernels.LANE_M * (lane - lanes // 2)
            names += [f"{side}_m@{off_m:+.1f}", f"{side}_unknown_m@{off_m:+.1f}"]
        names.append(f"{side}_strip_m")
    return tuple(f"walls_{name}" for name in names)


LAYOUT = _names()
"""Names of the measures. Along the walls it is looked ahead, behind and to both sides: how far it
goes on in lanes 0.3 m apart, how much of that is unknown, and how far in a strip of lanes 0.9 m
wide. `lesser` is the side to which it goes on less far; ``ahead@+0.3`` is 0.3 m towards the
greater side, ``lesser@+0.3`` 0.3 m ahead. So a mirror image is the same."""


def layout_measures(
    wide: WideMap, place: tuple[float, float, float], travelled_m: float
) -> NDArray[np.float64]:
    """Describe the layout of a place.

    Parameters
    ----------
    wide : WideMap
        The surroundings.
    place : tuple of float
        x, y and direction of travel: metres, radians, frame of odometry.
    travelled_m : float
        Metres travelled so far.

    Returns
    -------
    ndarray, shape (measures,), float64
        In the order of `LAYOUT`.
    """
    measures = np.empty(len(LAYOUT))
    x_m, y_m, heading_rad = place
    kernels.layout(
        wide.scaled.evidence, wide.scaled.seen_m, (x_m / SCALE, y_m / SCALE, heading_rad),
        WideMap.oldest(travelled_m), SCALE, measures,
    )  # fmt: skip
    return measures
