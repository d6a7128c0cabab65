"""The way that a robot went, and places on it by the metres driven up to them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ssrics_like.comparison.matching import points

CARRIED_M = 5.0
"""Between two poses of a path, a tenth of a second apart, no robot drives this far."""


@dataclass(frozen=True, eq=False)
class Way:
    """A path with the metres driven along it.

    Attributes
    ----------
    xy_m : ndarray, shape (poses, 2)
        Where the robot was, in order, metres. A step of more than 5 m was not driven (the robot
        was carried) and has no length.
    """

    xy_m: NDArray[np.float64]

    @classmethod
    def through(cls, poses: ArrayLike) -> Way:
        """Return the way through poses, shape (poses, 2); there may be none."""
        return cls(points(poses))

    @cached_property
    def along_m(self) -> NDArray[np.float64]:
        """Metres driven up to each pose, shape (poses,); they never fall."""
        steps = np.hypot(*np.diff(self.xy_m, axis=0).T)
        driven = np.where(steps > CARRIED_M, 0.0, steps).cumsum()
        return np.concatenate([[0.0], driven])[: len(self.xy_m)]

    @property
    def length_m(self) -> float:
        """Metres driven in all."""
        return float(self.along_m[-1]) if len(self.xy_m) else 0.0

    def at(self, along_m: ArrayLike) -> NDArray[np.float64]:
        """Return where the robot was after some metres.

        Parameters
        ----------
        along_m : array_like, any shape
            Metres, 0 to the length of the way, which must have a pose.

        Returns
        -------
        ndarray, shape (..., 2)
            On the straight line between two poses.
        """
        along = np.asarray(along_m, np.float64)
        last = max(len(self.xy_m) - 2, 0)
        leg = np.clip(np.searchsorted(self.along_m, along, side="right") - 1, 0, last)
        after = np.minimum(leg + 1, len(self.xy_m) - 1)
        length = self.along_m[after] - self.along_m[leg]
        share = np.divide(
            along - self.along_m[leg], length, out=np.zeros(along.shape), where=length > 0
        )
        start = self.xy_m[leg]
        places: NDArray[np.float64] = start + share[..., np.newaxis] * (self.xy_m[after] - start)
        return places
