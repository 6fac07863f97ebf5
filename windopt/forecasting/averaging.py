"""Averaging: a series in longer steps, as the forecaster for those steps wants it.

Means end with the last row, so nothing that was just measured is left out, and carry the time stamp
of the last row in them, at which they are known.
"""

from dataclasses import replace

import numpy as np

from windopt.domain.wind import Floats, WindSeries
from windopt.forecasting.windows import Traces, minutes, steps_in


def averaged(series: WindSeries, step: np.timedelta64) -> WindSeries:
    """Return means of ``series`` over ``step``, or the series itself where that is its own step.

    A mean takes half of its rows at least; with fewer it is missing.

    Raises
    ------
    InvalidInput
        If ``step`` is not a multiple of the series' step.
    """
    if step == series.step:
        return series
    rows = steps_in(step, series.step, "step")
    means = len(series) // rows
    cut = slice(len(series) - means * rows, None)
    traces = Traces(
        series.speed[cut].reshape(means, rows), series.theta_met[cut].reshape(means, rows)
    )
    speed, theta_met = mean_of(traces)
    told = f"Means over {minutes(step)} were taken of rows every {minutes(series.step)}."
    time = series.time[cut][rows - 1 :: rows]
    return replace(series, time=time, speed=speed, theta_met=theta_met, notes=(*series.notes, told))


def mean_of(traces: Traces) -> tuple[Floats, Floats]:
    """Mean speed, and direction of the mean velocity, of each trace; NaN if half of it is missing.

    Where velocities cancel, as in a calm, the last direction stands for their mean.
    """
    velocity = traces.velocity
    known = np.isfinite(velocity[..., 0])
    count = known.sum(axis=1)
    share = np.where(2 * count >= known.shape[1], 1.0 / np.maximum(count, 1), np.nan)
    u, v = share * np.where(known[..., None], velocity, 0.0).sum(axis=1).T
    speed = share * np.where(known, traces.speed, 0.0).sum(axis=1)
    still = np.hypot(u, v) <= 1e-9 * speed
    theta_met = np.where(still, traces.theta_met[:, -1], np.arctan2(-u, -v))
    return speed, theta_met % (2 * np.pi)
