"""Worker processes, which an interrupt ends in order.

Processes, not threads: pyactr keeps its state for the whole process. An interrupt that came amid
handing out work could leave a lock taken for ever, and one that met a process at its beginning
wrote a traceback. So workers never get one, and this process takes it while it waits for them.
"""

from __future__ import annotations

import multiprocessing
import multiprocessing.connection
import multiprocessing.forkserver
import multiprocessing.resource_tracker
import os
import signal
import threading
from collections.abc import Callable, Collection, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from typing import Any, Generic, TypeVar

from ssrics_like.errors import ResultsError

Given = TypeVar("Given")
Result = TypeVar("Result")

# Forking this process, which may have threads, is not safe; a clean server can be forked.
CONTEXT = multiprocessing.get_context("forkserver")
POLL_S = 0.1


def cores() -> int:
    """Return how many processes can work at the same time."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


class Workers(Generic[Result]):
    """Some processes, and what they were given to do.

    Attributes
    ----------
    interrupted : bool
        Whether there was an interrupt that nobody has been told of.
    """

    def __init__(self, pool: ProcessPoolExecutor) -> None:
        self._pool = pool
        self.interrupted = False

    def submit(self, function: Callable[..., Result], *arguments: Any) -> Future[Result]:
        """Give them a function of a module to call."""
        return self._pool.submit(function, *arguments)

    def rounds(self, futures: Collection[Future[Result]]) -> Iterator[set[Future[Result]]]:
        """Yield what has been done, every tenth of a second at least, until all is.

        Raises
        ------
        KeyboardInterrupt
            There was an interrupt since they began.
        """
        waiting = set(futures)
        while waiting:
            finished, waiting = wait(waiting, POLL_S, FIRST_COMPLETED)
            if self.interrupted:
                self.interrupted = False
                raise KeyboardInterrupt
            yield finished

    def interrupt(self, *_: object) -> None:
        """Note an interrupt; `rounds` raises it."""
        self.interrupted = True


@contextmanager
def workers(
    count: int,
    begin: Callable[..., None] | None = None,
    arguments: tuple[Any, ...] = (),
    preload: Sequence[str] = (),
) -> Iterator[Workers[Any]]:
    """Have so many processes; in the end what they have not begun is left undone.

    Parameters
    ----------
    count : int
        How many.
    begin : callable, optional
        What each calls first, with `arguments`.
    arguments : tuple
        For `begin`.
    preload : sequence of str
        Modules that all need; they are imported once.

    Raises
    ------
    ResultsError
        One of them died.
    KeyboardInterrupt
        At the end, if there was an interrupt that `rounds` has not raised.
    """
    CONTEXT.set_forkserver_preload(list(preload))
    multiprocessing.resource_tracker.ensure_running()  # which lets interrupts through again
    with _spawning():
        multiprocessing.forkserver.ensure_running()
    pool = ProcessPoolExecutor(
        count, mp_context=CONTEXT, initializer=_prepare, initargs=(begin, arguments)
    )
    at_work: Workers[Any] = Workers(pool)
    with _interrupts_to(at_work.interrupt):
        try:
            yield at_work
        except BrokenProcessPool:
            raise ResultsError(
                "a worker process died, perhaps for lack of memory; --jobs 1 needs least"
            ) from None
        finally:
            pool.shutdown(cancel_futures=True)
    if at_work.interrupted:  # after the last round; it is not to be lost
        raise KeyboardInterrupt


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
    with workers(min(jobs, len(values))) as at_work:
        futures = [at_work.submit(function, value) for value in values]
        next_one = 0
        for _ in at_work.rounds(futures):
            while next_one < len(futures) and futures[next_one].done():
                yield futures[next_one].result()
                next_one += 1


@contextmanager
def _spawning() -> Iterator[None]:
    """Hold interrupts back: the server of processes begins so, and all that it forks."""
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


@contextmanager
def _interrupts_to(note: Callable[..., None]) -> Iterator[None]:
    """Let interrupts be noted, where this thread gets them and does not ignore them."""
    here = threading.current_thread() is threading.main_thread()
    if not here or not callable(signal.getsignal(signal.SIGINT)):
        yield
        return
    before = signal.signal(signal.SIGINT, note)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


def _prepare(begin: Callable[..., None] | None, arguments: tuple[Any, ...]) -> None:
    """Prepare a worker: an interrupt is the first process's to handle, and without that it ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()
    if begin is not None:
        begin(*arguments)


def _end_with_parent() -> None:
    """Wait for the first process to end; killed, it cannot send its workers home."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        multiprocessing.connection.wait([parent.sentinel])
        os._exit(1)
