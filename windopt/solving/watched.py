"""A HiGHS run that can be watched and stopped.

HiGHS takes the main thread for as long as it runs, and Ctrl-C is delivered seconds late. Here it
runs beside the main thread, which wakes ten times a second, hears what was found since, and
passes a Ctrl-C on to HiGHS, which then returns at once. What HiGHS finds is queued and looked at
in the main thread, because an exception inside one of its callbacks would end the process.
"""

from collections.abc import Callable
from queue import Empty, SimpleQueue
from threading import Event, Thread
from typing import NamedTuple

import highspy
import numpy as np
from numpy.typing import NDArray

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
        Called in this thread with each piece of news; the last may come after the run.
    """
    stop, queue = Event(), SimpleQueue[News]()

    def interrupt(event: highspy.HighsCallbackEvent) -> None:
        event.interrupt(stop.is_set())

    def report_bound(event: highspy.HighsCallbackEvent) -> None:
        queue.put(News(event.data_out.mip_dual_bound, None))

    def report_solution(event: highspy.HighsCallbackEvent) -> None:
        queue.put(News(event.data_out.mip_dual_bound, np.array(event.data_out.mip_solution)))

    def work() -> None:
        model.run()
        highspy.Highs.resetGlobalScheduler(False)  # Threads of HiGHS's own end with this one.

    listeners = (
        (model.cbSimplexInterrupt, interrupt),
        (model.cbIpmInterrupt, interrupt),
        (model.cbMipInterrupt, interrupt),
        (model.cbMipInterrupt, report_bound),
        (model.cbMipImprovingSolution, report_solution),
    )
    for callback, listener in listeners:
        callback.subscribe(listener)
    thread = Thread(target=work, daemon=True)
    thread.start()
    while thread.is_alive():
        try:
            thread.join(WAKE)
            _drain(queue, hear)
        except KeyboardInterrupt:
            stop.set()
    _drain(queue, hear)
    for callback, listener in listeners:
        callback.unsubscribe(listener)
    return stop.is_set()


def _drain(queue: SimpleQueue[News], hear: Callable[[News], None]) -> None:
    """Hear all that is in the queue."""
    while True:
        try:
            news = queue.get_nowait()
        except Empty:
            return
        hear(news)
