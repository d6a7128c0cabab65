"""Home: where the first run began, seen from the landmark that was marked first.

A robot that is put down there again knows where it is, as a person does who comes in by the same
door; one that is put down elsewhere does not.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

from ssrics_like.memory.expectation import Uncertainty
from ssrics_like.memory.hypotheses import Here, Hypothesis
from ssrics_like.memory.landmark import finite
from ssrics_like.memory.links import Link
from ssrics_like.poses import Pose

UNKNOWN, HOME = "unknown", "home"
"""Where a run begins: anywhere, or where the first one began."""
PUT_DOWN_M, PUT_DOWN_RAD = 0.2, 0.1
"""So exactly a robot is put down where it was before (standard deviations)."""


@dataclass(frozen=True)
class Home:
    """Where the first run began.

    Attributes
    ----------
    landmark : str
        The landmark that was marked first.
    x_m, y_m, theta_rad : float
        Pose of the laser at the beginning, in the frame of that landmark.
    position_sd_m, direction_sd_rad : float
        How uncertain that is, standard deviations, more than 0.

    Raises
    ------
    ValueError
        For a number that is not finite, or a deviation that is not above 0.
    """

    landmark: str
    x_m: float
    y_m: float
    theta_rad: float
    position_sd_m: float
    direction_sd_rad: float

    def __post_init__(self) -> None:
        for each in fields(self)[1:]:
            value = getattr(self, each.name)
            finite(f"home: {each.name}", value)
            if each.name.split("_")[1] == "sd" and not value > 0.0:
                raise ValueError(f"home: {each.name} is {value!r}; expected more than 0")

    @classmethod
    def of(cls, landmark: str, start: Link) -> Home:
        """Return home, if the first run began there, seen from a landmark."""
        pose, variance_m2, variance_rad2 = start.bounded
        return cls(
            landmark, pose.x_m, pose.y_m, pose.theta_rad,
            math.sqrt(variance_m2), math.sqrt(variance_rad2),
        )  # fmt: skip

    @classmethod
    def behind(cls, landmark: str, start: Pose, here: Here, sd: Uncertainty) -> Home | None:
        """Return home, if the first run began there and this is its first landmark.

        Parameters
        ----------
        landmark : str
            Its name.
        start : Pose
            Where the run began, by path integration; None is returned where that is no number.
        here : Here
            Where the landmark was perceived.
        sd : Uncertainty
            How well the way between is known.
        """
        seen = start.seen_from(here.place)
        if not all(map(math.isfinite, (seen.x_m, seen.y_m, seen.theta_rad))):
            return None
        begun = Hypothesis(None, Link(start, 0.0, 0.0), Here(start, False, 0.0, 0.0), 0.0)
        return cls.of(landmark, sd.since(begun, here)._replace(pose=seen))

    def landmark_from(self, start: Pose) -> Link:
        """Return where the landmark lies if the robot was put down here, at home."""
        pose = Pose(self.x_m, self.y_m, self.theta_rad)
        home = Link(pose, self.position_sd_m**2, self.direction_sd_rad**2)
        return Link(start, PUT_DOWN_M**2, PUT_DOWN_RAD**2).and_then(home.reversed)
