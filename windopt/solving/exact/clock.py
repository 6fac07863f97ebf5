"""The clock: a limit on wall time that compiled loops obey as well as Python's.

Compiled loops run in threads of their own and look at ``Clock.stop`` now and then. It is set
when time is up, and when the user interrupts, whom the waiting main thread can hear.
"""

from collections.abc import Callable, Iterable
from concurrent.futures import FIRST_EXCEPTION, Future, ThreadPoolExecutor, wait
from math import inf
from os import cpu_count
from threading import Timer
from time import perf_counter
from types import TracebackType
from typing import Any, Self

import highspy
import numpy as np

from windopt.solving import watched

POLL = 0.1
"""How often the main thread listens for an interrupt [s]."""


class OutOfTime(Exception):  # noqa: N818  (a way out of nested loops, not a mistake)
    """The time limit was reached."""


def _raise_mistake(future: "Future[Any]") -> None:
    """Raise what ended a call, if that was not the end of time."""
    if future.cancelled():
        return
    error = future.exception()
    if error is not None and not isinstance(error, OutOfTime):
        raise error


class Clock:
    """Wall time since it was made, its limit, and the threads that work under it.

    Parameters
    ----------
    limit
        Time to run [s].
    """

    def __init__(self, limit: float) -> None:
        self.began = perf_counter()
        self.limit = limit
        self.stop = np.zeros(1, np.uint8)
        self.threads = min(4, cpu_count() or 1)
        self.workers = ThreadPoolExecutor(self.threads)
        self.leaders = ThreadPoolExecutor(self.threads)  # who wait for workers
        self._alarm = Timer(max(0.0, min(limit, 1e7)), self.halt)
        self._alarm.daemon = True

    def __enter__(self) -> Self:
        self._alarm.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.halt()
        self._alarm.cancel()
        self.leaders.shutdown()
        self.workers.shutdown()

    @property
    def elapsed(self) -> float:
        """Time since the start [s]."""
        return perf_counter() - self.began

    @property
    def left(self) -> float:
        """Time until the limit [s]."""
        return max(0.0, self.limit - self.elapsed)

    def halt(self) -> None:
        """Tell compiled loops to end."""
        self.stop[0] = 1

    def check(self) -> None:
        """Raise :class:`OutOfTime` when time is up."""
        if self.stop[0] or self.left <= 0.0:
            raise OutOfTime

    def map(self, function: Callable[..., Any], *arguments: Iterable[Any]) -> list[Any]:
        """Call ``function`` on each set of arguments, in threads, and wait for all."""
        return self._map(self.workers, function, *arguments)

    def side_by_side(self, function: Callable[..., Any], *arguments: Iterable[Any]) -> list[Any]:
        """As :meth:`map`, for functions that call it themselves."""
        return self._map(self.leaders, function, *arguments)

    def _map(
        self, team: ThreadPoolExecutor, function: Callable[..., Any], *arguments: Iterable[Any]
    ) -> list[Any]:
        """Call ``function`` on each set of arguments, in the threads of a team."""
        self.check()
        futures = [team.submit(function, *each) for each in zip(*arguments, strict=True)]
        pending = set(futures)
        try:
            while pending:  # between two waits Python hears the user
                done, pending = wait(pending, POLL, FIRST_EXCEPTION)
                for future in done:
                    future.result()
        except BaseException as error:
            self.halt()
            for future in futures:
                future.cancel()
            wait(futures)
            if isinstance(error, OutOfTime):  # perhaps because a mistake has halted the clock
                for future in futures:
                    _raise_mistake(future)
            raise
        self.check()
        return [future.result() for future in futures]

    def run(self, model: highspy.Highs) -> None:
        """Solve a small linear program, or raise :class:`OutOfTime`."""
        self.check()
        model.setOptionValue("time_limit", model.getRunTime() + self.left)
        model.run()
        if model.getModelStatus() == highspy.HighsModelStatus.kUnknown:
            model.clearSolver()  # a basis kept over many rounds may have become useless
            model.run()
        if model.getModelStatus() != highspy.HighsModelStatus.kOptimal:
            self.check()
            raise RuntimeError(f"A linear program ended as {model.getModelStatus()}.")

    def minimise(self, model: highspy.Highs, limit: float = inf) -> highspy.HighsModelStatus:
        """Run HiGHS until it is done or time is up; an interrupt by the user stops it at once.

        Parameters
        ----------
        limit
            Time to run at most [s], where less than is left.
        """
        self.check()
        model.setOptionValue("time_limit", model.getRunTime() + min(limit, self.left))
        if watched.run(model, lambda news: None):
            raise KeyboardInterrupt
        status: highspy.HighsModelStatus = model.getModelStatus()
        return status
