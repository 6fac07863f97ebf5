"""Windows: stretches of history and what followed them, never across a gap.

A window begins at a row of a series and spans L rows of history and the H rows after them. It
counts only if every one of these rows is valid, so nothing is learnt from, or scored on, a value
that was not measured.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from windopt.domain.quantiles import Quantiles
from windopt.domain.wind import Floats, WindSeries
from windopt.errors import InvalidInput

HISTORY = np.timedelta64(2, "h")
HORIZON = np.timedelta64(40, "m")


def steps_in(duration: np.timedelta64, step: np.timedelta64, field: str) -> int:
    """Return how many steps make up ``duration``.

    Raises
    ------
    InvalidInput
        Naming ``field``, if the step does not divide the duration.
    """
    whole, rest = divmod(duration, step)
    if whole < 1 or rest != np.timedelta64(0):
        expected = f"to be a multiple of the series' step, {minutes(step)}"
        raise InvalidInput(field, expected, minutes(duration))
    return int(whole)


def minutes(duration: np.timedelta64) -> str:
    """Return ``duration`` in words."""
    count = float(duration / np.timedelta64(1, "m"))
    return f"{count:g} minute{'' if count == 1 else 's'}"


@dataclass(frozen=True)
class Traces:
    """Wind over equally many steps, many traces at once.

    Parameters
    ----------
    speed
        Wind speed [m/s], shape ``(B, n)``.
    theta_met
        Where it blows from, clockwise from north [rad], shape ``(B, n)``.
    quantiles
        How sure it is, if it is a forecast that says so, shapes ``(B, n, Q)``.
    """

    speed: Floats
    theta_met: Floats
    quantiles: Quantiles | None = None

    @property
    def velocity(self) -> Floats:
        """Velocity of the air, eastward and northward [m/s], shape ``(B, n, 2)``."""
        return np.stack(
            [-self.speed * np.sin(self.theta_met), -self.speed * np.cos(self.theta_met)], axis=-1
        )

    def last(self, n: int) -> "Traces":
        """Return the last ``n`` steps."""
        return Traces(self.speed[:, -n:], self.theta_met[:, -n:])

    def __len__(self) -> int:
        return len(self.speed)


@dataclass(frozen=True)
class Windows:
    """The windows of one series.

    Parameters
    ----------
    series
        Where they lie.
    history, horizon
        Rows of history L and rows to forecast H.
    start
        First row of each window, increasing, shape ``(B,)``.
    """

    series: WindSeries
    history: int
    horizon: int
    start: NDArray[np.intp]

    def __len__(self) -> int:
        return len(self.start)

    @property
    def past(self) -> Traces:
        """What was known when each forecast was made, L steps."""
        return self._traces(0, self.history)

    @property
    def future(self) -> Traces:
        """What then happened, H steps."""
        return self._traces(self.history, self.history + self.horizon)

    def blocks(self, size: int = 20_000) -> Iterator["Windows"]:
        """Yield the windows in blocks of at most ``size``, so that memory stays bounded."""
        for first in range(0, len(self), size):
            start = self.start[first : first + size]
            yield Windows(self.series, self.history, self.horizon, start)

    def _traces(self, first: int, last: int) -> Traces:
        rows = self.start[:, None] + np.arange(first, last)
        return Traces(self.series.speed[rows], self.series.theta_met[rows])


def windows(
    series: WindSeries, *, history: np.timedelta64 = HISTORY, horizon: np.timedelta64 = HORIZON
) -> Windows:
    """Find every window of ``series`` without a gap.

    Parameters
    ----------
    history, horizon
        Durations, multiples of the series' step.

    Raises
    ------
    InvalidInput
        If the step does not divide a duration, or the series holds no window: it is too short,
        empty of valid rows, or cut into shorter pieces by its gaps.
    """
    L = steps_in(history, series.step, "history")
    H = steps_in(horizon, series.step, "horizon")
    if len(series) < L + H:
        raise InvalidInput("wind series", f"of at least {L + H} rows", f"{len(series)} rows")
    if not series.valid.any():
        raise InvalidInput("wind series", "to hold valid rows", f"none {why(series)}".strip())
    start = np.flatnonzero(sliding_window_view(series.valid, L + H).all(axis=1))
    if not len(start):
        found = f"{series.valid.sum()} with gaps between them {why(series)}".strip()
        raise InvalidInput("wind series", f"to hold {L + H} valid rows in sequence", found)
    return Windows(series, L, H, start)


def why(series: WindSeries) -> str:
    """Return what the series' notes say of its rows, in brackets."""
    return f"({' '.join(series.notes)})" if series.notes else ""


def chronological_split(series: WindSeries, test: float = 1 / 3) -> tuple[WindSeries, WindSeries]:
    """Return the earlier part of ``series`` and its last fraction ``test``.

    No row lies in both, so no window of the one shares a value with a window of the other.
    """
    if not 0 < test < 1:
        raise InvalidInput("test fraction", "between 0 and 1", test)
    cut = round(len(series) * (1 - test))
    return series.part(slice(0, cut)), series.part(slice(cut, len(series)))
