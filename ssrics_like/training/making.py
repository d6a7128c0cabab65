"""Makes the examples of a training, in order, and tells how far it is."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeVar

from ssrics_like.workers import in_order

Asked = TypeVar("Asked")
Made = TypeVar("Made")

Say = Callable[[str], None]
TELL = 20
"""Progress is told after so many drives."""


def made(
    what: str,
    make: Callable[[Asked], Made],
    asked: Sequence[Asked],
    seed: int,
    jobs: int,
    say: Say,
) -> list[Made]:
    """Make examples.

    Parameters
    ----------
    what : str
        What they are for, as it is told.
    make : callable
        Makes one; a function of a module.
    asked : sequence
        What it is called with, once for each.
    seed : int
        Of the training, as it is told.
    jobs : int
        How many processes.
    say : callable
        Is told how far it is, a line at a time.

    Raises
    ------
    ResultsError
        A worker process died.
    """
    done: list[Made] = []
    for one in in_order(make, asked, jobs):
        done.append(one)
        if len(done) % TELL == 0 or len(done) == len(asked):
            say(f"seed {seed}: {len(done)} of {len(asked)} {what} drives")
    return done
