"""What the robot's surroundings look like, place by place along its way."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Generic, TypeVar

import numpy as np

from ssrics_like.perception.gap import DoorwayFrame, doorway_frame, gap_features
from ssrics_like.perception.layout import layout_measures
from ssrics_like.perception.local_map import LocalMap
from ssrics_like.perception.surround_view import DIRECTIONS, REACH_M, surround_view
from ssrics_like.perception.vista import Vista
from ssrics_like.perception.walk import STEP_M, Walk
from ssrics_like.perception.wide_map import WideMap

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ssrics_like.perception.observation import Pose
    from ssrics_like.perception.walk import Place

T = TypeVar("T")

UNSEEN = np.concatenate(
    [np.full(2 * DIRECTIONS, REACH_M, np.float32), np.zeros(DIRECTIONS, np.float32)]
)
"""The view of a place of which nothing is known."""
DECIMALS = 3
"""Views are told to the millimetre: no laser knows more, and files of memory stay small."""
LAG_M = 0.4
"""A place is described when the robot is so far past it: what lies behind it has then been seen."""
MOVED_M, TURNED_RAD = 0.02, 0.026
"""A scan taken nearer to the one before, and less turned, shows nothing new."""


@dataclass(frozen=True, eq=False)
class Described(Generic[T]):
    """A place and what it looks like.

    Attributes
    ----------
    place : Place
        The place.
    measures : ndarray, shape (features,), float64
        In the order of `ssrics_like.perception.gap.FEATURES`.
    gap : Pose
        The middle of the gap that it lies in, and the direction through; frame of odometry.
    layout : ndarray, shape (measures,), float64
        In the order of `ssrics_like.perception.layout.LAYOUT`; empty unless it is measured.
    """

    place: Place[T]
    measures: NDArray[np.float64]
    gap: Pose
    layout: NDArray[np.float64] = field(default_factory=lambda: np.empty(0))


class Surroundings(Generic[T]):
    """Keeps the local map and describes a place every 0.1 m of path.

    Neither speed nor scan rate matters, only the way; a robot that stands describes nothing.

    Parameters
    ----------
    wide : bool
        Whether a wide map is kept too.
    layout : bool
        Whether the layout of places is measured; needs the wide map.

    Attributes
    ----------
    since_m : float
        Metres of path at which the map begins: nothing is known of the places before.
    """

    def __init__(self, *, wide: bool = False, layout: bool = False) -> None:
        self._layout = layout
        self._map = LocalMap()
        self._wide = WideMap() if wide else None
        self._vista = Vista()
        self._walk: Walk[T] = Walk(STEP_M, LAG_M)
        self._mapped: tuple[float, float] | None = None
        self.since_m = 0.0

    @property
    def travelled_m(self) -> float:
        """Length of the path so far, metres."""
        return self._walk.travelled_m

    def update(
        self,
        pose: Pose,
        bearings_rad: NDArray[np.float64],
        ranges_m: NDArray[np.float64],
        sensed: T,
        readings_m: NDArray[np.float64] | None = None,
    ) -> list[Described[T]]:
        """Take a scan and describe the places that the robot is now far enough past.

        Parameters
        ----------
        pose : Pose
            Of the laser, frame of odometry.
        bearings_rad, ranges_m : ndarray, shape (beams,), float64
            The conditioned scan.
        sensed : object
            Whatever is to be handed out with the places that lie nearest to this pose.
        readings_m : ndarray, shape (beams,), float64
            The scan as it came; without it nothing is seen in the distance.
        """
        if not self._walk.advance(pose, sensed):
            self._map = LocalMap()
            self._wide = None if self._wide is None else WideMap()
            self._vista = Vista()
            self.since_m = self._walk.travelled_m
        here_m = self._walk.travelled_m
        if (
            self._mapped is None
            or here_m - self._mapped[0] > MOVED_M
            or abs(math.remainder(pose.theta_rad - self._mapped[1], math.tau)) > TURNED_RAD
        ):
            self._map.take(pose, bearings_rad, ranges_m, here_m)
            if self._wide is not None:
                self._wide.take(pose, bearings_rad, ranges_m, here_m)
            if readings_m is not None:
                self._vista.take(pose, bearings_rad, readings_m, here_m)
            self._mapped = (here_m, pose.theta_rad)
        return [self._described(place) for place in self._walk.places()]

    def view_of(self, place: Pose, *, far: bool = True) -> NDArray[np.float32]:
        """Describe what surrounds a place near the robot; needs a wide map.

        Parameters
        ----------
        place : Pose
            Frame of odometry.
        far : bool
            Whether it is looked into the distance.

        Returns
        -------
        ndarray, shape (108,), float32
            As `surround_view`; then as `Vista.view_of`. Metres.
        """
        assert self._wide is not None
        near = surround_view(self._wide, place, self._walk.travelled_m)
        vista = self._vista.view_of(place) if far else np.zeros(DIRECTIONS, np.float32)
        view = np.concatenate([near, vista])
        return np.asarray(np.round(view, DECIMALS))

    def doorway_on(self, way_m: NDArray[np.float64], through_rad: float) -> DoorwayFrame | None:
        """Say where the doorway is that lies on the robot's way, as `doorway_frame`."""
        return doorway_frame(self._map, way_m, through_rad, self._walk.travelled_m)

    def _described(self, place: Place[T]) -> Described[T]:
        here_m = self._walk.travelled_m
        at = (place.x_m, place.y_m, place.heading_rad)
        measures, gap = gap_features(self._map, at, here_m)
        if self._wide is None or not self._layout:
            return Described(place, measures, gap)
        return Described(place, measures, gap, layout_measures(self._wide, at, here_m))
