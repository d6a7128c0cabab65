"""Carries tasks out, one after the other or in processes of their own.

Whichever way, a task's result depends on nothing but the task.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from ssrics_like.scenarios.one_run import Task, carry_out
from ssrics_like.workers import CONTEXT, workers

Done = Callable[[Task, list[dict[str, Any]]], None]
Progress = Callable[[int, float], None]
"""Called now and then with a task's number and the share of it that is done."""


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
    shares = CONTEXT.Array("d", len(tasks), lock=False)
    stop = CONTEXT.Event()
    with workers(min(jobs, len(tasks)), _begin, (shares, stop), [carry_out.__module__]) as at_work:
        futures = {at_work.submit(_in_worker, i, task): i for i, task in enumerate(tasks)}
        try:
            for finished in at_work.rounds(futures):
                for future in sorted(finished, key=futures.__getitem__):
                    done(tasks[futures[future]], future.result())
                for i, share in enumerate(shares):
                    progress(i, share)
        finally:
            stop.set()  # whoever still works notices at its next scans


_shares: Any = None
_stop: Any = None


class _Stopped(BaseException):
    """The command is being ended; nobody waits for this task any more."""


def _begin(shares: Any, stop: Any) -> None:
    """Prepare a worker that reports how far it is."""
    global _shares, _stop
    _shares, _stop = shares, stop


def _in_worker(number: int, task: Task) -> list[dict[str, Any]]:
    def progress(share: float) -> None:
        _shares[number] = share
        if _stop.is_set():
            raise _Stopped

    return carry_out(task, progress)
