"""The simulated robot: body, drive, odometry and laser, as data."""

from __future__ import annotations

from functools import cached_property
from typing import Annotated, Self

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict, Field, model_validator

NotNegative = Annotated[float, Field(ge=0.0, le=100.0)]
Positive = Annotated[float, Field(gt=0.0, le=100.0)]
Share = Annotated[float, Field(ge=0.0, le=1.0)]


class _Strict(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid", strict=True, allow_inf_nan=False)


class LaserProfile(_Strict):
    """A planar laser and its faults.

    Attributes
    ----------
    beams : int
        Beams of a scan.
    first_bearing_deg, step_deg : float
        Bearing of the first beam and step to the next, degrees; 0 is straight ahead, positive is
        left, so that the first is negative.
    rate_hz : float
        Scans per second.
    range_max_m : float
        A beam that meets nothing up to here has no return: infinity. Noise comes after that, so
        that a reading may be a little longer.
    noise_m : float
        Standard deviation of each range, Gaussian.
    dropout : float
        Probability that a beam has no return whatever it meets.
    mixed : float
        Probability that a beam at the edge of something reports a range between it and what is
        behind it.
    edge_m : float
        Step in range from which neighbouring beams are such an edge.
    x_m : float
        How far ahead of the robot's centre the laser sits, metres.
    """

    beams: Annotated[int, Field(ge=2, le=10_000)] = 180
    first_bearing_deg: Annotated[float, Field(ge=-360.0, le=360.0)] = -89.5
    step_deg: Annotated[float, Field(gt=0.0, le=90.0)] = 1.0
    rate_hz: Annotated[float, Field(ge=1.0, le=200.0)] = 10.0
    range_max_m: Annotated[float, Field(gt=0.0, le=1000.0)] = 80.0
    noise_m: Annotated[float, Field(ge=0.0, le=10.0)] = 0.02
    dropout: Share = 0.0
    mixed: Share = 0.0
    edge_m: Annotated[float, Field(gt=0.0)] = 0.3
    x_m: Annotated[float, Field(ge=-5.0, le=5.0)] = 0.0

    @cached_property
    def bearings_rad(self) -> NDArray[np.float64]:
        """Bearing of each beam, shape (beams,)."""
        bearings: NDArray[np.float64] = np.radians(
            self.first_bearing_deg + self.step_deg * np.arange(self.beams)
        )
        return bearings

    @cached_property
    def directions(self) -> NDArray[np.float64]:
        """Cosine and sine of each bearing, shape (beams, 2)."""
        return np.column_stack([np.cos(self.bearings_rad), np.sin(self.bearings_rad)])


class OdometryProfile(_Strict):
    """How dead reckoning errs.

    Attributes
    ----------
    scale, turn_scale : float
        Systematic errors: standard deviation, over runs, of the factor by which way and turns are
        mismeasured.
    way_noise_m : float
        Random error of the way, metres after one metre; it grows with the way's square root.
    turn_noise_rad : float
        Random error of the heading, radians after one radian of turn; it grows with the turn's
        square root.
    drift_rad : float
        Random error of the heading, radians after one metre; it grows with the way's square root.
    """

    scale: NotNegative = 0.01
    turn_scale: NotNegative = 0.01
    way_noise_m: NotNegative = 0.01
    turn_noise_rad: NotNegative = 0.02
    drift_rad: NotNegative = 0.01


class RobotProfile(_Strict):
    """A round robot with two driven wheels.

    Attributes
    ----------
    title, source : str
        What it is, and where its figures come from; free text.
    radius_m : float
        Radius of the circle that its body sweeps when it turns on the spot.
    speed_m_s, turn_rad_s : float
        Most that it drives and turns.
    acceleration_m_s2, turn_acceleration_rad_s2 : float
        Most that these rise; the robot brakes twice as hard.
    actuation : float
        Standard deviation of the random factors by which its wheels miss the commanded speeds.
    odometry : OdometryProfile
        How its dead reckoning errs.
    laser : LaserProfile
        What it senses with.
    """

    title: str = ""
    source: str = ""
    radius_m: Annotated[float, Field(ge=0.01, le=5.0)] = 0.27
    speed_m_s: Positive = 0.894
    turn_rad_s: Positive = 1.7
    acceleration_m_s2: Positive = 0.6
    turn_acceleration_rad_s2: Positive = 3.0
    actuation: Annotated[float, Field(ge=0.0, le=0.5)] = 0.02
    odometry: OdometryProfile = OdometryProfile()
    laser: LaserProfile = LaserProfile()

    @model_validator(mode="after")
    def _laser_on_board(self) -> Self:
        if abs(self.laser.x_m) > self.radius_m:
            raise ValueError(
                f"laser.x_m is {self.laser.x_m:g}, outside the body of radius {self.radius_m:g} m"
            )
        return self
