"""Worker processes: results in order, and an interrupt that is taken while waiting for them."""

import os
import signal
import time

import pytest

from ssrics_like.errors import ResultsError
from ssrics_like.workers import in_order, workers


def slowly(number):
    time.sleep(0.05 * (3 - number % 4))
    return number**2


def blocked(_=None):
    ignored = signal.getsignal(signal.SIGINT) is signal.SIG_IGN
    return ignored and signal.SIGINT in signal.pthread_sigmask(signal.SIG_BLOCK, ())


def dies(_=None):
    os._exit(3)


@pytest.mark.parametrize("jobs", [1, 2, 9])
def test_results_come_in_the_order_of_the_values(jobs):
    assert list(in_order(slowly, range(6), jobs)) == [0, 1, 4, 9, 16, 25]


def test_an_interrupt_while_work_is_handed_out_is_raised_while_waiting():
    with workers(2) as at_work:
        first = at_work.submit(slowly, 1)
        signal.raise_signal(signal.SIGINT)  # nothing is raised here, whatever is being done
        rest = [at_work.submit(slowly, number) for number in range(20)]
        with pytest.raises(KeyboardInterrupt):
            list(at_work.rounds([first, *rest]))
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
    assert sum(future.cancelled() for future in rest) > 10  # what was not begun is not done


def hand_out_and_be_interrupted_at_the_last():
    with workers(1) as at_work:
        for _ in at_work.rounds([at_work.submit(slowly, 3)]):
            pass
        signal.raise_signal(signal.SIGINT)


def test_an_interrupt_after_the_last_result_is_not_lost():
    with pytest.raises(KeyboardInterrupt):
        hand_out_and_be_interrupted_at_the_last()


def test_workers_never_get_an_interrupt():
    with workers(2) as at_work:
        for _ in at_work.rounds(futures := [at_work.submit(blocked) for _ in range(4)]):
            pass
    assert [future.result() for future in futures] == [True] * 4
    assert signal.SIGINT not in signal.pthread_sigmask(signal.SIG_BLOCK, ())


def test_who_ignores_interrupts_goes_on_ignoring_them():
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        with workers(1) as at_work:
            assert signal.getsignal(signal.SIGINT) is signal.SIG_IGN
            assert at_work.submit(slowly, 3).result() == 9
    finally:
        signal.signal(signal.SIGINT, before)


def test_a_worker_that_dies_is_told():
    with pytest.raises(ResultsError, match="a worker process died"):
        list(in_order(dies, range(4), 2))
