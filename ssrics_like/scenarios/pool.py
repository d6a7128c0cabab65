"""Carries tasks out, one after the other or in processes of their own.

Processes, not threads: pyactr keeps its state for the whole process. Whichever
way, a task's result depends on nothing but the task.
"""

from __future__ import annotations

import multiprocessing
import multiprocessing.connection
import os
import signal
import threading
from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path
from typing import Any

from ssrics_like.errors import ResultsError
from ssrics_like.scenarios.one_run import Task, carry_out

Done = Callable[[Task, list[dict[str, Any]]], None]
Progress = Callable[[int, float], None]
"""Called now and then with a task's number and the share of it that is done."""

POLL_S = 0.1


def cores() -> int:
    """Return how many processes can work at the same time."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def carry_out_all(tasks: Sequence[Task], jobs: int, progress: Progress, done: Done) -> None:
    """Carry out tasks.

    Parameters
    ----------
    tasks : sequence of Task
        In the order in which they are begun.
    jobs : int
        How many at the same time; 1 stays in this process.
    progress, done : callable
        Called in this process, the latter for each task as soon as it is complete.

    Raises
    ------
    SourceError, ResultsError, EngineError
        As a task raises; those that are complete have been reported.
    """
    if min(jobs, len(tasks)) <= 1:
        for number, task in enumerate(tasks):
            done(task, carry_out(task, lambda share, n=number: progress(n, share)))  # type: ignore[misc]
        return
    # Forking this process, which may have threads, is not safe; a clean server can be forked.
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload(["ssrics_like.scenarios.one_run"])
    shares = context.Array("d", len(tasks), lock=False)
    stop = context.Event()
    with ProcessPoolExecutor(
        min(jobs, len(tasks)), mp_context=context, initializer=_begin, initargs=(shares, stop)
    ) as pool:
        futures = {pool.submit(_in_worker, i, task): i for i, task in enumerate(tasks)}
        try:
            _collect(futures, tasks, shares, progress, done)
        except BrokenProcessPool:
            raise ResultsError(
                "a worker process died, perhaps for lack of memory; finished runs are kept, "
                "--resume goes on, --jobs 1 needs least memory"
            ) from None
        finally:
            stop.set()  # whoever still works notices at its next scans
            pool.shutdown(cancel_futures=True)


def over_processes(
    function: Callable[[Path], object],
    paths: Sequence[Path],
    jobs: int,
    done: Callable[[], object] = lambda: None,
) -> None:
    """Call a function of a module for each path, in processes of their own if there are several.

    `done` is called after each.

    Raises
    ------
    SsricsError
        As the function raises.
    """
    if min(jobs, len(paths)) <= 1:
        for path in paths:
            function(path)
            done()
        return
    context = multiprocessing.get_context("forkserver")
    with ProcessPoolExecutor(
        min(jobs, len(paths)), mp_context=context, initializer=_prepare
    ) as pool:
        for _ in pool.map(function, paths):
            done()


def _collect(
    futures: dict[Future[list[dict[str, Any]]], int],
    tasks: Sequence[Task],
    shares: Any,
    progress: Progress,
    done: Done,
) -> None:
    waiting = set(futures)
    while waiting:
        finished, waiting = wait(waiting, POLL_S, FIRST_COMPLETED)
        for future in sorted(finished, key=lambda f: futures[f]):
            done(tasks[futures[future]], future.result())
        for i, share in enumerate(shares):
            progress(i, share)


_shares: Any = None
_stop: Any = None


class _Stopped(BaseException):
    """The command is being ended; nobody waits for this task any more."""


def _prepare() -> None:
    """Prepare a worker: Ctrl-C is the first process's to handle, and without that it ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    """Wait for the first process to end; killed, it cannot send its workers home."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        multiprocessing.connection.wait([parent.sentinel])
        os._exit(1)


def _begin(shares: Any, stop: Any) -> None:
    """Prepare a worker that reports how far it is."""
    global _shares, _stop
    _prepare()
    _shares, _stop = shares, stop


def _in_worker(number: int, task: Task) -> list[dict[str, Any]]:
    def progress(share: float) -> None:
        _shares[number] = share
        if _stop.is_set():
            raise _Stopped

    return carry_out(task, progress)
