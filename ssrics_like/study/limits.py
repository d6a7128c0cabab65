"""How much and how often somebody may send."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable

KEPT_MAX = 10_000


class RateLimit:
    """A bucket of tokens for each sender: one is taken for each request, time refills it.

    Parameters
    ----------
    per_s : float
        How many a second in the long run.
    burst : float
        How many at once.
    clock : callable
        Returns seconds that only rise.
    """

    def __init__(
        self, per_s: float, burst: float, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._per_s = per_s
        self._burst = burst
        self._clock = clock
        self._buckets: dict[str, tuple[float, float]] = {}
        self._lock = threading.Lock()

    def allows(self, sender: str) -> bool:
        """Take a token of a sender, if there is one."""
        with self._lock:
            now = self._clock()
            tokens, before = self._buckets.pop(sender, (self._burst, now))
            tokens = min(self._burst, tokens + (now - before) * self._per_s)
            allowed = tokens >= 1.0
            self._buckets[sender] = (tokens - 1.0 if allowed else tokens, now)
            while len(self._buckets) > KEPT_MAX:  # the one that was heard of least recently
                del self._buckets[next(iter(self._buckets))]
            return allowed
