"""Hour-ahead forecasting: the habit of one-hour means, on the same truth as everything else.

The paper compares forecasts of 5-minute winds with forecasts of one-hour means, each against its
own truth; but a mean over an hour is easier to forecast than a single step, and a different thing.
Here the hourly forecaster sees the same measurements, as one-hour means that end now, and what it
says of the next hour is taken for each step ahead. Both are then wrong about the same wind.
"""

from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from windopt.domain.wind import WindForecast, WindSeries
from windopt.forecasting.averaging import averaged, mean_of
from windopt.forecasting.forecaster import Forecaster, issue
from windopt.forecasting.windows import HORIZON, Traces, steps_in

HOUR = np.timedelta64(1, "h")


@dataclass(frozen=True)
class HourAhead:
    """A forecaster of hourly means, asked about the steps within the next hour.

    Parameters
    ----------
    hourly
        What forecasts the means; its horizon is an hour.
    horizon
        How far to look ahead.
    """

    hourly: Forecaster
    horizon: np.timedelta64 = HORIZON

    @property
    def name(self) -> str:
        """What tables call it."""
        return f"hour ahead, {self.hourly.name}"

    @property
    def history(self) -> np.timedelta64:
        """How far it looks back."""
        return self.hourly.history

    def fit(self, series: WindSeries) -> Self:
        """Return this forecaster, fitted to the hourly means of ``series``."""
        return replace(self, hourly=self.hourly.fit(averaged(series, HOUR)))

    def forecast(self, past: Traces, step: np.timedelta64) -> Traces:
        """Return the mean expected of the next hour at every step ahead."""
        rows, H = steps_in(HOUR, step, "hour"), steps_in(self.horizon, step, "horizon")
        B, L = past.speed.shape
        hours = L // rows
        kept = Traces(
            past.speed[:, L - hours * rows :].reshape(B * hours, rows),
            past.theta_met[:, L - hours * rows :].reshape(B * hours, rows),
        )
        speed, theta_met = (mean.reshape(B, hours) for mean in mean_of(kept))
        ahead = self.hourly.forecast(Traces(speed, theta_met), HOUR)
        return Traces(
            np.repeat(ahead.speed[:, :1], H, axis=1), np.repeat(ahead.theta_met[:, :1], H, axis=1)
        )

    def predict(self, history: WindSeries) -> WindForecast:
        """Return the forecast after the last row of ``history``."""
        return issue(self, history)
