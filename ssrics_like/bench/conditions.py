"""What simulated drives are like: the nominal one, the hard ones, and those of the curves."""

from __future__ import annotations

from dataclasses import dataclass, replace

from ssrics_like.scenarios.modules import load_robot
from ssrics_like.world.buildings.generator import DOORWAY_MIN_M, BuildingSettings
from ssrics_like.world.robot import RobotProfile

ROBOT = "pioneer-dx"


@dataclass(frozen=True)
class Condition:
    """What a simulated drive is like.

    Attributes
    ----------
    noise_m, dropout, rate_hz
        Of the laser.
    speed : float
        Factor on the robot's speed.
    doorway_m : tuple of float
        Narrowest and widest doorway of the building.
    false_gaps : int
        Pairs of obstacles with a gap as wide as a doorway, put away from all that is labelled.
    drift : float
        By how much, as a share, odometry mismeasures ways and turns, over drives and at random;
        0 leaves the robot's own.
    people : int
        How many walk about.
    rooms : int
        Of the building.
    """

    noise_m: float = 0.02
    dropout: float = 0.0
    rate_hz: float = 10.0
    speed: float = 1.0
    doorway_m: tuple[float, float] = (DOORWAY_MIN_M, 1.1)
    false_gaps: int = 0
    drift: float = 0.0
    people: int = 0
    rooms: int = 9

    def robot(self) -> RobotProfile:
        """Return the robot that drives."""
        robot = load_robot(ROBOT)
        laser = robot.laser.model_copy(
            update={"noise_m": self.noise_m, "dropout": self.dropout, "rate_hz": self.rate_hz}
        )
        odometry = robot.odometry
        if self.drift:
            odometry = odometry.model_copy(
                update=dict.fromkeys(("scale", "turn_scale", "way_noise_m"), self.drift)
            )
        return robot.model_copy(
            update={
                "laser": laser,
                "odometry": odometry,
                "speed_m_s": self.speed * robot.speed_m_s,
            }
        )

    def building(self) -> BuildingSettings:
        """Return what the generator is asked for."""
        return BuildingSettings(rooms=self.rooms, doorway_m=self.doorway_m)


NOMINAL = Condition()
CONDITIONS: dict[str, tuple[str, Condition]] = {
    "generated": ("generated buildings, furnished", NOMINAL),
    "noise": ("5 cm of range noise", Condition(noise_m=0.05)),
    "dropout": ("3 % of the beams drop out", Condition(dropout=0.03)),
    "wide-doors": ("doorways of 1.3 to 1.75 m", Condition(doorway_m=(1.3, 1.75))),
    "false-gaps": ("eight false gaps", Condition(false_gaps=8)),
    "slow-scans": ("5 scans a second", Condition(rate_hz=5.0)),
    "fast-scans": ("40 scans a second", Condition(rate_hz=40.0)),
    "half-speed": ("half the speed", Condition(speed=0.5)),
    "double-speed": ("twice the speed", Condition(speed=2.0)),
    "drift": ("odometry 5 % off", Condition(drift=0.05)),
    "people": ("five people walk about", Condition(people=5)),
}
"""Name of a simulated course -> what is said of it, and its condition."""


@dataclass(frozen=True)
class Sweep:
    """One quantity over a range, the rest nominal.

    Attributes
    ----------
    title : str
        Label of the axis.
    field : str
        Of `Condition`.
    values : tuple of float
        In the unit of that field.
    shown : float
        Factor from that unit to the axis.
    logarithmic : bool
        Whether the axis is.
    """

    title: str
    field: str
    values: tuple[float, ...]
    shown: float = 1.0
    logarithmic: bool = False

    def condition(self, value: float) -> Condition:
        """Return the condition of one point."""
        changed: Condition = replace(NOMINAL, **{self.field: value})  # type: ignore[arg-type]
        return changed


SWEEPS = {
    "over-noise": Sweep("range noise, cm", "noise_m", (0.0, 0.02, 0.05, 0.1), 100.0),
    "over-dropout": Sweep("dropouts, % of beams", "dropout", (0.0, 0.01, 0.03, 0.1), 100.0),
    "over-rate": Sweep(
        "scans a second", "rate_hz", (2.5, 5.0, 10.0, 20.0, 40.0), logarithmic=True
    ),
    "over-speed": Sweep(
        "speed, of the nominal one", "speed", (0.5, 1.0, 1.5, 2.0), logarithmic=True
    ),
}  # fmt: skip
"""Name of a sweep -> what it varies."""
