"""Records what a method tells of its progress, so that its answer can show how it came about."""

from collections.abc import Callable
from time import perf_counter

from windopt.result import Moment

Progress = Callable[[float, float], None]


class Recorder:
    """A progress callback that remembers, and passes on.

    Parameters
    ----------
    progress
        Called with objective and bound in turn.
    """

    def __init__(self, progress: Progress | None = None) -> None:
        self._began = perf_counter()
        self._progress = progress
        self._moments: list[Moment] = []

    def __call__(self, objective: float, bound: float) -> None:
        self._moments.append(Moment(perf_counter() - self._began, objective, bound))
        if self._progress is not None:
            self._progress(objective, bound)

    def until(self, objective: float, bound: float) -> tuple[Moment, ...]:
        """Return what was recorded, ending now with the given objective and bound."""
        last = Moment(perf_counter() - self._began, objective, bound)
        same = bool(self._moments) and self._moments[-1][1:] == last[1:]
        return tuple(self._moments) if same else (*self._moments, last)
