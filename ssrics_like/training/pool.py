"""Calls a function for many values in processes of their own; the results come in order."""

from __future__ import annotations

import multiprocessing
import multiprocessing.connection
import os
import signal
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from typing import TypeVar

from ssrics_like.errors import ResultsError

Given = TypeVar("Given")
Result = TypeVar("Result")


def in_order(
    function: Callable[[Given], Result], values: Sequence[Given], jobs: int
) -> Iterator[Result]:
    """Yield what a function of a module returns for each value.

    Parameters
    ----------
    function : callable
        Its result depends on nothing but the value.
    values : sequence
        What it is called with.
    jobs : int
        How many processes; 1 stays in this one.

    Raises
    ------
    ResultsError
        A process died.
    """
    if min(jobs, len(values)) <= 1:
        yield from map(function, values)
        return
    # Forking this process, which may have threads, is not safe; a clean server can be forked.
    context = multiprocessing.get_context("forkserver")
    pool = ProcessPoolExecutor(min(jobs, len(values)), mp_context=context, initializer=_prepare)
    try:
        yield from pool.map(function, values)
    except BrokenProcessPool:
        raise ResultsError(
            "a worker process died, perhaps for lack of memory; --jobs 1 needs least"
        ) from None
    finally:
        pool.shutdown(cancel_futures=True)


def _prepare() -> None:
    """Prepare a worker: Ctrl-C is the first process's to handle, and without that it ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    parent = multiprocessing.parent_process()
    if parent is not None:
        multiprocessing.connection.wait([parent.sentinel])
        os._exit(1)
