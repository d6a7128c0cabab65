"""In which order a participant meets the trials.

Trials are sorted by the SHA-256 digest of the text ``seed/participant/trial``.
Digests of different texts are as good as independent random numbers, so every
order is equally likely; and whoever knows seed and id can work the order out in
any language, whatever the version of a random number generator.
"""

from __future__ import annotations

import hashlib
from collections.abc import Sequence


def order_of(trials: Sequence[str], seed: int, participant: str, how: str) -> tuple[str, ...]:
    """Return the trials in the order of one participant.

    Parameters
    ----------
    trials : sequence of str
        Ids of the trials, as listed in the study.
    seed : int
        Of the study.
    participant : str
        The participant's id.
    how : {"random", "fixed"}
        ``fixed`` keeps the order of the list.
    """
    if how == "fixed":
        return tuple(trials)

    def digest(trial: str) -> bytes:
        return hashlib.sha256(f"{seed}/{participant}/{trial}".encode()).digest()

    return tuple(sorted(trials, key=digest))
