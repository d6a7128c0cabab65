"""CMU logs (Wean Hall): ``O x y th t`` and ``L x y th lx ly lth r1..rn t``.

Centimetres and radians, beams from right to left. ``lx ly lth`` is the pose of
the laser, 25 cm ahead of the robot's centre. The line does not say how many
beams it has: everything between the poses and the time is a reading.
"""

from __future__ import annotations

from collections import Counter

from ssrics_like.sources.angles import fan
from ssrics_like.sources.records import (
    MIN_BEAMS,
    LaserRecord,
    MalformedLineError,
    numbers,
    pose,
    quote,
    stamp,
)

_METRES = 0.01
_EXTRA = 8  # keyword, two poses, time


class CmuReader:
    """L records of a CMU log; O records (odometry alone) are skipped."""

    stamp_names: tuple[str, ...] = ("time",)

    states_beams = False

    def __init__(self) -> None:
        self.skipped: dict[str, int] = Counter()

    def parse(self, line: bytes) -> LaserRecord | None:
        """Return the line's laser record, if it is one."""
        keyword = line[:2].strip()
        if keyword == b"O" or keyword.startswith(b"#"):
            return None
        tokens = line.split()
        if not tokens:
            return None
        if tokens[0] != b"L":
            raise MalformedLineError(f"{quote(tokens[0])} is not a kind of CMU record (O or L)")
        beams = len(tokens) - _EXTRA
        if beams < MIN_BEAMS:
            raise MalformedLineError(f"L has {len(tokens)} fields: no readings", short=True)
        values = numbers(tokens[1:-1])
        angle_min, increment = fan(beams)
        return LaserRecord(
            ranges_m=values[6:] * _METRES,
            angle_min_rad=angle_min,
            angle_increment_rad=increment,
            laser=pose(values[3:6], _METRES),
            base=pose(values[:3], _METRES),
            stamps_s=(stamp(tokens[-1]),),
        )

    def notes(self) -> list[str]:
        """Nothing: the records state the laser's pose themselves."""
        return []
