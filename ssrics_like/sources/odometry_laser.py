"""DP-SLAM logs: ``Odometry x y th`` before each ``Laser n r1..rn``; metres, no times."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING

from ssrics_like.sources.angles import fan
from ssrics_like.sources.records import (
    MIN_BEAMS,
    LaserRecord,
    MalformedLineError,
    count,
    expect_fields,
    numbers,
    pose,
    quote,
)

if TYPE_CHECKING:
    from ssrics_like.perception.observation import Pose


class OdometryLaserReader:
    """Laser records, each at the pose of the last Odometry record before it."""

    stamp_names: tuple[str, ...] = ()

    states_beams = True

    def __init__(self) -> None:
        self.skipped: dict[str, int] = Counter()
        self._pose: Pose | None = None

    def parse(self, line: bytes) -> LaserRecord | None:
        """Return the line's laser record, if it is one."""
        tokens = line.split()
        if not tokens or tokens[0].startswith(b"#"):
            return None
        if tokens[0] == b"Odometry":
            expect_fields(len(tokens), 4, "Odometry")
            self._pose = pose(numbers(tokens[1:]))
            return None
        if tokens[0] != b"Laser":
            raise MalformedLineError(
                f"{quote(tokens[0])} is not a kind of DP-SLAM record (Odometry or Laser)"
            )
        if len(tokens) == 1:
            raise MalformedLineError("Laser ends before its beam count", short=True)
        beams = count(tokens[1], "beam count")
        if beams < MIN_BEAMS:
            raise MalformedLineError(f"Laser has {beams} beams, expected at least {MIN_BEAMS}")
        expect_fields(len(tokens), beams + 2, f"Laser of {beams} beams")
        if self._pose is None:
            raise MalformedLineError("Laser stands before the first Odometry")
        angle_min, increment = fan(beams)
        return LaserRecord(numbers(tokens[2:]), angle_min, increment, self._pose)

    def notes(self) -> list[str]:
        """Say what the format leaves out."""
        offset = (
            "The log does not say where the laser sits on the robot: "
            "the odometry's pose is used as the laser's."
        )
        return [offset]
