"""Times that never fall, from stamps that do.

Logs carry stamps that were printed with six digits, wrapped around, jumped back
or are all equal. A scan is never dropped for that and the order is the file's:

* If fewer than half of the steps between the first stamps (at most 500 are
  looked at) lead forward by at most an hour, the stamps are unusable and scan k
  is at ``k / fallback_rate_hz``.
* Otherwise every stamp that follows the time before it, by at most an hour, is
  kept to the digit. One that does not is replaced by the time before plus a
  millisecond, so that the log's own stamps are met again as soon as they catch up.
* If twenty stamps in a row do not fit, yet each follows the one before, the
  clock was set anew: from there an offset is added. A clock that merely stands
  still is bridged with the log's typical step after twenty records.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from statistics import median
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

LOOK_AHEAD = 500
MAX_STEP_S = 3600.0
MIN_FORWARD_SHARE = 0.5
CATCH_UP_STEP_S = 0.001
RESET_RUN = 20


def forward_steps(stamps: Sequence[float]) -> list[float]:
    """Return the plausible steps: forward by at most an hour, seconds."""
    steps = (after - before for before, after in pairwise(stamps))
    return [step for step in steps if 0 < step <= MAX_STEP_S]


def usable(stamps: Sequence[float]) -> bool:
    """Whether at least half of the steps are plausible; a lone stamp must be finite."""
    if len(stamps) <= 1:
        return all(math.isfinite(stamp) for stamp in stamps) and len(stamps) == 1
    return len(forward_steps(stamps)) >= MIN_FORWARD_SHARE * (len(stamps) - 1)


def _beginning(stamps: Sequence[float]) -> int:
    """Return the index of the first stamp that one of the next twenty follows.

    A first stamp that nothing follows is no beginning; the times before the
    beginning are laid out backwards from it.
    """
    for index, stamp in enumerate(stamps):
        following = stamps[index + 1 : index + 1 + RESET_RUN]
        if any(0 < after - stamp <= MAX_STEP_S for after in following):
            return index
    return 0


@dataclass
class TimingSummary:
    """How the times of a log came about.

    Attributes
    ----------
    usable : bool
        Whether the log's own stamps were used.
    column : str
        Name of the field that they were read from, empty for none.
    fallback_rate_hz : float
        Scan rate that stands in where the stamps are unusable.
    repaired : int
        Scans whose stamp was replaced.
    resets : int
        Times that the clock was found set anew and an offset began.
    """

    usable: bool = False
    column: str = ""
    fallback_rate_hz: float = 10.0
    repaired: int = 0
    resets: int = 0


class Timekeeper:
    """Turn a log's stamps, one after the other, into times that never fall.

    Parameters
    ----------
    first_stamps : sequence of float
        The log's first stamps in seconds, from which it is decided whether they
        are usable. They are given again, one by one, to `time`.
    fallback_rate_hz : float
        Scan rate for unusable stamps.
    """

    def __init__(self, first_stamps: Sequence[float], fallback_rate_hz: float) -> None:
        self.usable = usable(first_stamps)
        self.repaired = 0
        self.resets = 0
        self._rate_hz = fallback_rate_hz
        steps = forward_steps(first_stamps)
        self._typical_s = median(steps) if steps else 1.0 / fallback_rate_hz
        self._lead = _beginning(first_stamps)
        self._begin = first_stamps[self._lead] if self.usable else 0.0
        self._given = 0
        self._last = -math.inf
        self._offset = 0.0
        self._unfit = 0
        self._chain = 0
        self._chain_stamp = self._chain_time = self._stamp_before = math.nan

    def time(self, stamp: float) -> float:
        """Return the time of the next scan, seconds; never less than the one before."""
        index = self._given
        self._given += 1
        if not self.usable:
            return index / self._rate_hz
        if index <= self._lead:
            self.repaired += index < self._lead
            self._last = self._begin - (self._lead - index) * CATCH_UP_STEP_S
            return self._last
        if self._follows(stamp):
            self._last = stamp
        elif self._offset and self._follows(stamp + self._offset):
            self._last = stamp + self._offset
        else:
            self._repair(stamp)
            return self._last
        self._unfit = self._chain = 0
        return self._last

    def _follows(self, time: float) -> bool:
        return 0 < time - self._last <= MAX_STEP_S

    def _repair(self, stamp: float) -> None:
        step = CATCH_UP_STEP_S if self._unfit < RESET_RUN else self._typical_s
        time = max(self._last + step, math.nextafter(self._last, math.inf))
        self._unfit += 1
        if self._chain and 0 < stamp - self._stamp_before <= MAX_STEP_S:
            self._chain += 1
        else:
            self._chain, self._chain_stamp, self._chain_time = 1, stamp, time
        self._stamp_before = stamp
        if self._chain == RESET_RUN:
            # The time that passed within the run itself is known: give it back.
            passed = self._chain_time + (stamp - self._chain_stamp)
            time = passed if self._follows(passed) else time
            self._offset = time - stamp
            self.resets += 1
        self.repaired += 1
        self._last = time
