"""What every forecaster can do, and how a forecast is issued from a measured series.

Forecasters work on many traces at once; :func:`issue` asks one for a single forecast, from the
last rows of a series as they come off a mast.
"""

from dataclasses import replace
from typing import Protocol, Self

import numpy as np

from windopt.domain.wind import WindForecast, WindSeries
from windopt.errors import InvalidInput
from windopt.forecasting.faults import suspected
from windopt.forecasting.windows import Traces, steps_in

FILL_LIMIT = np.timedelta64(20, "m")


class Forecaster(Protocol):
    """Something that looks at the wind of the last hours and says what comes next."""

    @property
    def name(self) -> str:
        """What tables call it."""

    @property
    def history(self) -> np.timedelta64:
        """How far it looks back."""

    @property
    def horizon(self) -> np.timedelta64:
        """How far it looks ahead."""

    def fit(self, series: WindSeries) -> Self:
        """Return this forecaster, having learnt from ``series``."""

    def forecast(self, past: Traces, step: np.timedelta64) -> Traces:
        """Return what follows each trace of ``past``, measured every ``step``."""

    def predict(self, history: WindSeries) -> WindForecast:
        """Return what follows the last row of ``history``."""


def issue(forecaster: Forecaster, history: WindSeries) -> WindForecast:
    """Ask ``forecaster`` what follows the last row of ``history``.

    Rows that look as if no sensor had measured them are used, and the forecast's notes say so.

    Raises
    ------
    InvalidInput
        If the series is too short, its step does not divide the forecaster's durations, or a gap
        in its last rows is longer than ``FILL_LIMIT``.
    """
    L = steps_in(forecaster.history, history.step, "history")
    H = steps_in(forecaster.horizon, history.step, "horizon")
    if len(history) < L:
        raise InvalidInput("history", f"of at least {L} rows", f"{len(history)} rows")
    known = without_short_gaps(history, L)
    past = Traces(known.speed[None, -L:], known.theta_met[None, -L:])
    ahead = forecaster.forecast(past, history.step)
    return WindForecast(
        issued=np.datetime64(history.time[-1]),
        time=history.time[-1] + history.step * np.arange(1, H + 1),
        speed=ahead.speed[0],
        theta_met=ahead.theta_met[0],
        method=forecaster.name,
        notes=(*known.notes[len(history.notes) :], *suspected(history, L)),
        quantiles=ahead.quantiles and ahead.quantiles[0],
    )


def without_short_gaps(series: WindSeries, rows: int) -> WindSeries:
    """Return ``series`` with the gaps in its last ``rows`` rows filled by the value before them.

    Raises
    ------
    InvalidInput
        Naming the first gap that is longer than ``FILL_LIMIT``, or that nothing precedes.
    """
    first = len(series) - rows
    missing = ~series.valid
    if not missing[first:].any():
        return series
    last_valid = np.maximum.accumulate(np.where(missing, -1, np.arange(len(series))))
    age = np.arange(len(series)) - last_valid
    limit = int(FILL_LIMIT / series.step)
    late = missing & ((age > limit) | (last_valid < 0))
    if late[first:].any():
        row = first + int(np.argmax(late[first:]))
        began = series.time[last_valid[row] + 1]
        raise InvalidInput("history", f"without gaps longer than {FILL_LIMIT}", f"one from {began}")
    filled = int(missing[first:].sum())
    source = np.maximum(last_valid, 0)
    return replace(
        series,
        speed=series.speed[source],
        theta_met=series.theta_met[source],
        notes=(*series.notes, f"{filled} missing rows of the history repeat the row before them."),
    )
