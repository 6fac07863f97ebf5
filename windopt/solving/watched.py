"""A HiGHS run that can be watched and stopped.

HiGHS takes the main thread for as long as it runs, and Ctrl-C is delivered seconds late. Here it
runs beside the main thread, which wakes ten times a second, hears what was found since, and
passes a Ctrl-C on to HiGHS, which then returns at once. What HiGHS finds is queued and looked at
in the main thread, because an exception inside one of its callbacks would end the process; so
would a run that is left behind, and however this ends, HiGHS has ended before.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from queue import Empty, SimpleQueue
from threading import Event, Thread
from typing import NamedTuple

import highspy
import numpy as np
from numpy.typing import NDArray

from windopt.solving.interrupts import ctrl_c_sets

WAKE = 0.1  # s


class News(NamedTuple):
    """What HiGHS reports while it runs: a bound, and the columns of a better solution."""

    bound: float
    values: NDArray[np.float64] | None


def run(model: highspy.Highs, hear: Callable[[News], None]) -> bool:
    """Run ``model`` and return whether the user stopped it.

    Parameters
    ----------
    hear
        Called in this thread with each piece of news; the last may come after the run. What it
        raises stops the run and reaches the caller.
    """
    stop, ended = Event(), Event()
    queue, failures = SimpleQueue[News](), SimpleQueue[BaseException]()

    def work() -> None:
        try:
            model.run()
            highspy.Highs.resetGlobalScheduler(False)  # Threads of HiGHS's own end with this one.
        except BaseException as failure:
            failures.put(failure)
        finally:
            ended.set()

    thread = Thread(target=work, daemon=True)
    with ctrl_c_sets(stop), _listening(model, stop, queue):
        try:
            thread.start()
            while not ended.wait(WAKE):
                _drain(queue, hear)
            _drain(queue, hear)
        except KeyboardInterrupt:
            stop.set()
        except BaseException:
            stop.set()
            raise
        finally:
            while thread.is_alive() and not ended.is_set():
                with suppress(KeyboardInterrupt):  # of a handler that is not Python's own
                    ended.wait()  # A join that is interrupted takes the thread for ended.
    thread.join()
    if not failures.empty():
        raise failures.get()
    return stop.is_set()


@contextmanager
def _listening(model: highspy.Highs, stop: Event, queue: SimpleQueue[News]) -> Iterator[None]:
    """Let ``model`` queue what it finds, and end its run once ``stop`` is set."""

    def interrupt(event: highspy.HighsCallbackEvent) -> None:
        event.interrupt(stop.is_set())

    def report_bound(event: highspy.HighsCallbackEvent) -> None:
        queue.put(News(event.data_out.mip_dual_bound, None))

    def report_solution(event: highspy.HighsCallbackEvent) -> None:
        queue.put(News(event.data_out.mip_dual_bound, np.array(event.data_out.mip_solution)))

    listeners = (
        (model.cbSimplexInterrupt, interrupt),
        (model.cbIpmInterrupt, interrupt),
        (model.cbMipInterrupt, interrupt),
        (model.cbMipInterrupt, report_bound),
        (model.cbMipImprovingSolution, report_solution),
    )
    try:
        for callback, listener in listeners:
            callback.subscribe(listener)
        yield
    finally:
        for callback, listener in listeners:
            callback.unsubscribe(listener)


def _drain(queue: SimpleQueue[News], hear: Callable[[News], None]) -> None:
    """Hear all that is in the queue."""
    while True:
        try:
            news = queue.get_nowait()
        except Empty:
            return
        hear(news)
